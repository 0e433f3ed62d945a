//! Thirty robots spell HELLO and smile.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Show};

use super::color::{BLUE, CYAN, DUSK, GOLD, GREEN, ORANGE, RED, ROSE, VIOLET, gradient, rainbow};
use super::draw::{Dot, frame_by_x, lit, shaded, show as on_floor};
use super::glyph::letter;
use super::stroke::{along, ring, row, trace};

/// Number of robots of the show.
const ROBOTS: usize = 30;

pub fn show() -> Show {
    let mut frames = vec![wave()];
    let letters = [
        ('H', [ROSE, ORANGE]),
        ('E', [ORANGE, GOLD]),
        ('L', [GOLD, GREEN]),
        ('L', [CYAN, BLUE]),
        ('O', [BLUE, VIOLET]),
    ];
    for (nth, (char, stops)) in letters.into_iter().enumerate() {
        // The second L is a little lower, so that the change of letter is visible.
        let centre = Vec2::new(0.0, if nth == 3 { 0.0 } else { 0.15 });
        frames.push(spelled(char, centre, &stops));
    }
    frames.push(smile());
    on_floor("Hello", 3.0, frames)
}

fn wave() -> Frame {
    let curve: Vec<Vec2> = (0..=120).map(|part| f64::from(part) / 120.0 * 2.7 - 1.35).map(swing).collect();
    frame_by_x("Wave", 0.5, shaded(along(&curve, ROBOTS), |at| rainbow(at.x / 3.0 + 0.5)))
}

fn swing(x: f64) -> Vec2 {
    Vec2::new(x, 0.6 + 0.25 * Vec2::unit(x * 4.0).y)
}

fn spelled(char: char, centre: Vec2, stops: &[Rgb]) -> Frame {
    let places = trace(&letter(char, centre, 1.9), 26);
    let dots = shaded(places, |at| gradient(stops, (at.y + 0.95) / 1.9));
    frame_by_x(&char.to_string(), 1.0, with_footlights(dots))
}

fn smile() -> Frame {
    let mut dots = lit(ring(Vec2::ZERO, 1.2, 19, 0.25), GOLD);
    for x in [-0.42, 0.42] {
        dots.extend(lit(ring(Vec2::new(x, 0.42), 0.09, 2, 0.25), CYAN));
    }
    let mouth: Vec<Vec2> =
        (0..=40).map(|part| Vec2::unit((205.0 + f64::from(part) * 3.25_f64).to_radians()) * 0.7).collect();
    dots.extend(lit(along(&mouth, 7), RED));
    frame_by_x("Smile", 2.0, dots)
}

/// Adds a dim row below a letter, of the robots that the letter does not need.
fn with_footlights(mut dots: Vec<Dot>) -> Vec<Dot> {
    let rest = ROBOTS - dots.len();
    dots.extend(lit(row(Vec2::new(0.0, -1.25), 0.22, rest), DUSK));
    dots
}
