//! A field of three hundred lights with waves, like a sea under a low sun.

use lightbots_base::Vec2;
use lightbots_show::{Frame, PictureMotion, Show};

use super::color::{BLUE, CYAN, DUSK, GOLD, ORANGE, RED, ROSE, gradient};
use super::draw::{frame, shaded, show as on_floor};
use super::galaxy::sunflower;
use super::stroke::row;
use super::timeline::{moved, with_layers};

/// Number of lights in a row of the sea.
const COLUMNS: usize = 20;
/// Number of rows of the sea.
const ROWS: usize = 15;
/// Distance between neighbouring lights in a row, and between rows, metres.
const STEP_M: f64 = 0.27;

/// Layers: light of the sea, foam and embers.
const LIGHT: &str = r##"
{"name": "Sea", "kind": "noise", "frames": ["1", "4"], "settings": {"palette": ["#001a4d", "#005bbb", "#00b7d8", "#b6fff2"],
    "size_m": 1.6, "speed_hz": 0.3, "octaves": 2}},
{"name": "Foam", "kind": "wave", "frames": ["2", "3"], "settings": {"palette": [{"at": 0, "color": "#ffffff", "opacity": 0},
    {"at": 0.8, "color": "#ffffff", "opacity": 0}, {"at": 1, "color": "#ffffff", "opacity": 0.8}],
    "size_m": 2.4, "speed_hz": 0.25}},
{"name": "Embers", "kind": "plasma", "frames": ["5", "6"], "settings": {"palette": ["#400010", "#ff3b1f", "#ffb347", "#fff0b0"],
    "size_m": 2.2, "speed_hz": 0.15}}
"##;

pub fn show() -> Show {
    let calm = calm();
    let swell = PictureMotion::Wave { radius_m: 0.07, direction: 0.0, length_m: 2.4, times: 3 };
    let cross = PictureMotion::Wave { radius_m: 0.07, direction: 1.2, length_m: 1.8, times: 3 };
    let sun = frame("Sun", 3.0, shaded(sunflower(COLUMNS * ROWS, 2.3), dawn));
    let breath = PictureMotion::Breathe { center: Vec2::ZERO, size: 1.15, times: 2 };
    let frames = vec![
        calm.clone(),
        moved(&calm, "Swell", 0.5, swell),
        moved(&calm, "Cross sea", 0.5, cross),
        moved(
            &calm,
            "Calm again",
            1.5,
            PictureMotion::Wave { radius_m: 0.04, direction: 3.0, length_m: 3.0, times: 2 },
        ),
        sun.clone(),
        moved(&sun, "The sun breathes", 3.0, breath),
    ];
    with_layers(on_floor("Sea", 6.4, frames), LIGHT)
}

fn calm() -> Frame {
    let rows = (0..ROWS).flat_map(|nth| {
        row(Vec2::new(0.0, (nth as f64 - (ROWS as f64 - 1.0) / 2.0) * STEP_M), STEP_M, COLUMNS)
    });
    frame("Calm", 2.0, shaded(rows, |at| gradient(&[CYAN, BLUE, DUSK], (at.y + 1.9) / 3.8)))
}

fn dawn(at: Vec2) -> lightbots_base::Rgb {
    gradient(&[GOLD, ORANGE, ROSE, RED], at.length() / 2.3)
}
