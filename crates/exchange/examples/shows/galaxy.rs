//! Scattered stars gather into a galaxy that turns.

use lightbots_base::Vec2;
use lightbots_show::{Frame, Show};

use super::color::{BLUE, CYAN, GOLD, ROSE, VIOLET, WHITE, gradient};
use super::draw::{frame, shaded, show as on_floor};
use super::stroke::along;
use super::timeline::{turned, with_layers};

/// Number of robots of the show.
const ROBOTS: usize = 60;
/// Radius of the galaxy, metres.
const RADIUS_M: f64 = 1.4;

/// Layers: stars that twinkle, and light that turns with the arms.
const LIGHT: &str = r##"
{"name": "Arms", "kind": "chase", "frames": ["2", "5"], "settings": {"along": "angle", "palette": ["#707070", "#ffffff"],
    "speed_hz": 0.12, "width": 0.7, "blend": "multiply"}},
{"name": "Stars", "kind": "twinkle", "settings": {"palette": ["#000000", "#ffffff"], "speed_hz": 0.5, "density": 0.35,
    "width": 0.4, "blend": "screen"}}
"##;

pub fn show() -> Show {
    let two = spiral("Galaxy", 2, 0.0);
    let turned_once = turned(&two, "Turning", 0.3, 1.6);
    let three = spiral("Three arms", 3, 0.35);
    let frames = vec![
        frame("Stars", 1.5, shaded(sunflower(ROBOTS, RADIUS_M), |_| WHITE)),
        two,
        turned_once,
        three.clone(),
        turned(&three, "The other way", 0.3, -1.2),
        frame("Nebula", 3.0, shaded(sunflower(ROBOTS, RADIUS_M), glow)),
    ];
    with_layers(on_floor("Galaxy", 3.0, frames), LIGHT)
}

fn spiral(name: &str, arms: usize, turned: f64) -> Frame {
    let places = (0..arms).flat_map(|arm| {
        let from = turned + arm as f64 / arms as f64;
        along(&self::arm(from, RADIUS_M, 0.8), ROBOTS / arms)
    });
    frame(name, 0.3, shaded(places, glow))
}

/// A spiral arm from near the centre outwards to `radius_m`. It begins at `from_turns` of a turn counter-clockwise from
/// +x, and turns by `turns` turns.
pub fn arm(from_turns: f64, radius_m: f64, turns: f64) -> Vec<Vec2> {
    let at = |part: i32| {
        let share = f64::from(part) / 200.0;
        let angle = std::f64::consts::TAU * (from_turns + turns * share);
        Vec2::unit(angle) * (radius_m * (0.12 + 0.88 * share))
    };
    (0..=200).map(at).collect()
}

/// Places like the seeds of a sunflower: evenly spread, and not in lines.
pub fn sunflower(count: usize, radius_m: f64) -> Vec<Vec2> {
    /// Angle between successive seeds, radians: a full turn divided by the square of the golden ratio.
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let at = |nth: usize| {
        let radius = radius_m * ((nth as f64 + 0.5) / count as f64).sqrt();
        Vec2::unit(nth as f64 * GOLDEN_ANGLE) * radius
    };
    (0..count).map(at).collect()
}

fn glow(at: Vec2) -> lightbots_base::Rgb {
    gradient(&[WHITE, GOLD, ROSE, VIOLET, BLUE, CYAN], at.length() / RADIUS_M)
}
