//! The original's format. It loads a file only if its editor's own state is there too, so all of that is derived.

use lightbots_base::{Rgb, Vec2};

use super::{lines, number, quoted};
use crate::{Frame, Issue, Issues, Pixel, Show};

/// Canvas pixels of the original's editor along each side of its floor.
const CANVAS_PX: f64 = 720.0;
/// Pixels of its small pictures in the frame strip.
const TIMELINE_PX: f64 = 100.0;
/// Metres along each side of its floor.
const FLOOR_M: f64 = 3.0;
/// Its fleet.
const ROBOTS: usize = 30;

pub(super) fn text(show: &Show) -> String {
    lines(show.frames.iter().enumerate().map(|(index, frame)| frame_text(frame, index == 0)), "") + "\n"
}

pub(super) fn losses(show: &Show) -> Issues {
    let mut lost = Vec::new();
    if (show.stage.width_m, show.stage.depth_m) != (FLOOR_M, FLOOR_M) {
        lost.push("the size of the floor, which is always 3 m x 3 m there");
    }
    if !show.stage.obstacles.is_empty() {
        lost.push("the no-go areas");
    }
    if show.starts.is_some() {
        lost.push("where robots start");
    }
    if show.music.is_some() {
        lost.push("the music");
    }
    if show.frames.iter().any(|frame| frame.transition_s.is_some()) {
        lost.push("how long transitions take");
    }
    if show.frames.iter().any(|frame| frame.pixels.iter().any(|pixel| pixel.robot.is_some())) {
        lost.push("which robot shows a pixel");
    }
    let mut issues: Issues = lost
        .into_iter()
        .map(|what| Issue::warning("lost-in-format", format!("the original's format does not keep {what}")))
        .collect();
    if let Some(frame) = show.frames.iter().position(|frame| frame.pixels.len() != ROBOTS) {
        let count = show.frames[frame].pixels.len();
        let what = format!("frame {} has {count} pixels; the original plays only shows of 30", frame + 1);
        issues.push(Issue::warning("not-30-pixels", what).in_frame(frame));
    }
    issues
}

fn frame_text(frame: &Frame, selected: bool) -> String {
    // The original numbers its robots from 0 without gaps; pixels are sorted by id, so their order is their number.
    let pixels = frame.pixels.iter().enumerate().map(|(number, pixel)| pixel_text(number, pixel));
    format!(
        "{{\"name\":{},\"pixels\":{},\"selected\":{selected},\"airTime\":{},\"selectedPixels\":[]}}",
        quoted(&frame.name),
        lines(pixels, ""),
        real(frame.air_time_s)
    )
}

fn pixel_text(number: usize, pixel: &Pixel) -> String {
    let canvas = canvas_from_stage(pixel.at);
    let color = color(pixel.color);
    format!(
        "{{\"pixelLocation\":{0},\"physicalLocation\":{1},\"pixelPreviewLocation\":{0},\"pixelTimelineLocation\":{2},\
         \"color\":{color},\"previewColor\":{color},\"pixelId\":{number}}}",
        location(canvas),
        location(pixel.at),
        location(canvas * (TIMELINE_PX / CANVAS_PX))
    )
}

/// Canvas pixels, y down, from metres.
fn canvas_from_stage(at: Vec2) -> Vec2 {
    let scale = CANVAS_PX / FLOOR_M;
    Vec2::new(at.x * scale + CANVAS_PX / 2.0, CANVAS_PX / 2.0 - at.y * scale)
}

fn location(at: Vec2) -> String {
    format!("{{\"X\":{},\"Y\":{}}}", real(at.x), real(at.y))
}

/// Shares of 255 at the precision the original keeps colours in, so that a file of its own comes out as it went in.
fn color(color: Rgb) -> String {
    let share = |byte: u8| match f64::from(f32::from(byte) / 255.0) {
        whole if whole.fract() == 0.0 => format!("{whole:.1}"),
        share => share.to_string(),
    };
    format!("{{\"R\":{},\"G\":{},\"B\":{}}}", share(color.r), share(color.g), share(color.b))
}

/// A number with a decimal point, as Java writes it.
fn real(value: f64) -> String {
    let text = number(value);
    if text.contains('.') || text == "null" { text } else { text + ".0" }
}
