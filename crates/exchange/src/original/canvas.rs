//! The canvas of the original's editor: canvas pixels, origin at the top left, y down.

use lightbots_base::Vec2;

/// Side of the square canvas of the original's editor, canvas pixels: `pixelLocation` in the original's files goes from
/// 0 to this value.
pub(super) const CANVAS_PX: f64 = 720.0;
/// Side of the original's square floor, metres: the width of the range of `physicalLocation` in the original's files.
const FLOOR_M: f64 = 3.0;

/// Converts a place in canvas pixels to stage metres.
pub(super) fn stage_from_canvas(px: Vec2) -> Vec2 {
    let metres = FLOOR_M / CANVAS_PX;
    Vec2::new((px.x - CANVAS_PX / 2.0) * metres, (CANVAS_PX / 2.0 - px.y) * metres)
}

/// Converts a place in stage metres to canvas pixels.
pub(super) fn canvas_from_stage(at: Vec2) -> Vec2 {
    let scale = CANVAS_PX / FLOOR_M;
    Vec2::new(at.x * scale + CANVAS_PX / 2.0, CANVAS_PX / 2.0 - at.y * scale)
}
