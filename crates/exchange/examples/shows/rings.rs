//! Rings that breathe, turn and pass their colour outwards.

use lightbots_base::Vec2;
use lightbots_show::{Easing, Frame, Show};

use super::color::rainbow;
use super::draw::{frame, shaded, show as on_floor};
use super::stroke::ring;

/// Robots of each ring, from the inside.
const COUNTS: [usize; 3] = [5, 10, 15];

pub fn show() -> Show {
    let radii = [
        ("Still", [0.30, 0.70, 1.10]),
        ("In", [0.15, 0.40, 0.65]),
        ("Out", [0.60, 1.00, 1.40]),
        ("Pulse", [0.20, 0.85, 1.20]),
        ("Pulse", [0.35, 0.65, 1.35]),
        ("Wide", [0.50, 0.95, 1.40]),
        ("Still", [0.30, 0.70, 1.10]),
    ];
    let mut frames: Vec<Frame> =
        radii.into_iter().enumerate().map(|(nth, (name, radii_m))| wave(name, nth as f64, radii_m)).collect();
    for frame in &mut frames {
        frame.easing = Easing::Gentle;
    }
    on_floor("Rings", 3.0, frames)
}

fn wave(name: &str, nth: f64, radii_m: [f64; 3]) -> Frame {
    let mut dots = Vec::new();
    for (layer, (count, radius_m)) in COUNTS.into_iter().zip(radii_m).enumerate() {
        // Neighbouring rings turn in opposite directions, each by a share of its gap.
        let turned = nth / 5.0 / count as f64 * if layer == 1 { -1.0 } else { 1.0 };
        let color = rainbow(nth / 7.0 - layer as f64 * 0.12 + 0.5);
        dots.extend(shaded(ring(Vec2::ZERO, radius_m, count, turned), |_| color));
    }
    frame(name, 0.4, dots)
}
