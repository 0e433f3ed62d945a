//! Rockets rise, burst in three places and fall as embers. Then all burst once more.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Show};

use super::color::{CYAN, EMBER, GOLD, GREEN, ORANGE, RED, ROSE, VIOLET, WHITE, gradient};
use super::draw::{Dot, frame, lit, shaded, show as on_floor};
use super::galaxy::sunflower;
use super::stroke::{ring, row};
use super::timeline::with_layers;

/// The centres of the three shells, metres, with their colours from the inside out.
const SHELLS: [(Vec2, [Rgb; 3]); 3] = [
    (Vec2::new(-1.15, 0.1), [WHITE, GOLD, RED]),
    (Vec2::new(1.15, 0.1), [WHITE, CYAN, VIOLET]),
    (Vec2::new(0.0, 1.15), [WHITE, GOLD, GREEN]),
];
/// Rings of a shell from the inside: number of robots, and radius as a share of the shell's.
const LAYERS: [(usize, f64); 3] = [(6, 0.32), (11, 0.66), (16, 1.0)];

/// Layers: embers that flicker, and shells that crackle.
const LIGHT: &str = r##"
{"name": "Crackle", "kind": "sparkle", "frames": ["3", "7"], "settings": {"palette": ["#000000", "#ffffff"], "speed_hz": 7,
    "density": 0.12, "blend": "screen"}},
{"name": "Glow", "kind": "noise", "frames": ["1", "2"], "settings": {"palette": ["#404040", "#ffffff"], "size_m": 0.3,
    "speed_hz": 1.2, "blend": "multiply"}}
"##;

pub fn show() -> Show {
    let frames = vec![
        ground(),
        rising(),
        bursting("Burst", 0.42, 0.1),
        bursting("Bloom", 0.72, 0.8),
        falling(),
        frame("Last shell", 0.2, shaded(sunflower(100, 0.62), |_| WHITE)),
        frame("Finale", 2.5, shaded(sunflower(100, 1.85), chrysanthemum)),
    ];
    with_layers(on_floor("Fireworks", 4.0, frames), LIGHT)
}

fn ground() -> Frame {
    let rows = (0..4).flat_map(|nth| row(Vec2::new(0.0, -1.85 + 0.15 * f64::from(nth)), 0.15, 25));
    frame("Ground", 0.5, shaded(rows, |at| gradient(&[EMBER, ORANGE], (at.y + 1.85) / 0.45)))
}

/// A frame in which every shell is a head with a tail. The hundredth robot stays below.
fn rising() -> Frame {
    let mut dots = ember_below();
    for (centre, stops) in SHELLS {
        for step in 0..11 {
            let y = centre.y - 0.13 * f64::from(step);
            let color = gradient(&[stops[0], stops[1], EMBER], f64::from(step) / 10.0);
            dots.extend(lit(row(Vec2::new(centre.x, y), 0.12, 3), color));
        }
    }
    frame("Rising", 0.2, dots)
}

fn bursting(name: &str, radius_m: f64, air_time_s: f64) -> Frame {
    let mut dots = ember_below();
    for (centre, stops) in SHELLS {
        for ((count, share), color) in LAYERS.into_iter().zip(stops) {
            dots.extend(lit(ring(centre, radius_m * share, count, 0.25), color));
        }
    }
    frame(name, air_time_s, dots)
}

fn falling() -> Frame {
    let mut dots = ember_below();
    for (centre, stops) in SHELLS {
        for (count, share) in LAYERS {
            let fallen = |at: Vec2| Vec2::new(at.x, at.y - 0.3 - 0.15 * share);
            let places = ring(centre, 0.72 * share, count, 0.25).into_iter().map(fallen);
            dots.extend(lit(places, stops[2].mixed(EMBER, 0.4 + 0.4 * share)));
        }
    }
    frame("Embers", 0.6, dots)
}

fn ember_below() -> Vec<Dot> {
    vec![(Vec2::new(0.0, -1.7), ORANGE)]
}

fn chrysanthemum(at: Vec2) -> Rgb {
    gradient(&[WHITE, GOLD, ORANGE, ROSE, VIOLET, CYAN], at.length() / 1.85)
}
