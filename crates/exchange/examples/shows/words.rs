//! A hundred robots write words.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Show};

use super::color::{BLUE, CYAN, DUSK, GOLD, GREEN, ORANGE, RED, ROSE, VIOLET, gradient, rainbow};
use super::draw::{frame, lit, shaded, show as on_floor};
use super::glyph::word;
use super::stroke::{Stroke, ring, row, trace};

/// Number of robots of the show.
const ROBOTS: usize = 100;

pub fn show() -> Show {
    let one = |text: &str, height_m: f64| word(text, Vec2::new(0.0, 0.2), height_m, 0.2);
    let two = |above: &str, below: &str| {
        let mut strokes = word(above, Vec2::new(0.0, 0.85), 1.1, 0.2);
        strokes.extend(word(below, Vec2::new(0.0, -0.6), 1.1, 0.2));
        strokes
    };
    let frames = vec![
        bands(),
        written("LIGHT", one("LIGHT", 0.95), &[GOLD, ORANGE, RED]),
        written("BOTS", one("BOTS", 1.2), &[CYAN, BLUE, VIOLET]),
        written("DANCE", one("DANCE", 0.95), &[ROSE, VIOLET, BLUE]),
        written("FOR YOU", two("FOR", "YOU"), &[GREEN, CYAN, BLUE]),
        eye(),
    ];
    on_floor("Words", 4.0, frames)
}

fn bands() -> Frame {
    let rows = (0..5).flat_map(|nth| row(Vec2::new(0.0, 0.6 - 0.3 * f64::from(nth)), 0.18, 20));
    frame("Bands", 0.5, shaded(rows, |at| rainbow(at.x / 4.0 + at.y / 6.0 + 0.5)))
}

fn written(name: &str, strokes: Vec<Stroke>, stops: &[Rgb]) -> Frame {
    let places = trace(&strokes, ROBOTS);
    let rest = ROBOTS - places.len();
    let mut dots = shaded(places, |at| gradient(stops, at.x / 3.6 + 0.5));
    dots.extend(lit(row(Vec2::new(0.0, -1.7), 0.2, rest), DUSK));
    frame(name, 1.5, dots)
}

fn eye() -> Frame {
    let layers = [(10, 0.3), (20, 0.7), (30, 1.2), (40, 1.75)];
    let places = layers.into_iter().flat_map(|(count, radius_m)| ring(Vec2::ZERO, radius_m, count, 0.25));
    frame("Curtain", 2.0, shaded(places, |at| rainbow(at.angle() / std::f64::consts::TAU)))
}
