//! A clock that counts from five to one. Then the sun rises.

use lightbots_base::Vec2;
use lightbots_show::{Frame, Show};

use super::color::{DUSK, GOLD, GREEN, ORANGE, RED, WHITE, gradient};
use super::draw::{frame_by_x, lit, show as on_floor};
use super::glyph::letter;
use super::stroke::{ring, row, trace};

/// Number of robots of the show.
const ROBOTS: usize = 30;
/// Number of robots in the ring around a digit.
const RING: usize = 15;

pub fn show() -> Show {
    let mut frames = vec![clock()];
    frames.extend((1..=5).rev().map(digit));
    frames.push(sun("Sun", 0.0, 0.5));
    frames.push(sun("Sunrise", 0.25, 2.0));
    on_floor("Countdown", 3.0, frames)
}

fn clock() -> Frame {
    let mut dots = lit(ring(Vec2::ZERO, 1.3, RING, 0.25), GREEN);
    dots.extend(lit(ring(Vec2::ZERO, 0.7, ROBOTS - RING, 0.25), WHITE));
    frame_by_x("Clock", 0.5, dots)
}

/// A digit in a ring. Of the ring, `count` fifths are bright.
fn digit(count: usize) -> Frame {
    let left = gradient(&[RED, ORANGE, GOLD, GREEN], (count as f64 - 1.0) / 4.0);
    let around = ring(Vec2::ZERO, 1.3, RING, 0.25).into_iter().enumerate();
    let mut dots: Vec<_> =
        around.map(|(nth, at)| (at, if nth < RING * count / 5 { left } else { DUSK })).collect();
    let char = (b'0' + count as u8) as char;
    dots.extend(lit(trace(&letter(char, Vec2::new(0.0, 0.1), 1.25), ROBOTS - RING), WHITE));
    let rest = ROBOTS - dots.len();
    dots.extend(lit(row(Vec2::new(0.0, -0.85), 0.15, rest), DUSK));
    frame_by_x(&char.to_string(), 1.0, dots)
}

/// A disc with rays that extend by `out_m`, metres.
fn sun(name: &str, out_m: f64, air_time_s: f64) -> Frame {
    let mut dots = lit(ring(Vec2::ZERO, 0.2, 6, 0.0), WHITE);
    dots.extend(lit(ring(Vec2::ZERO, 0.45, 12, 0.0), GOLD));
    dots.extend(lit(ring(Vec2::ZERO, 0.7 + out_m, 6, 0.0), ORANGE));
    dots.extend(lit(ring(Vec2::ZERO, 0.95 + 1.4 * out_m, 6, 0.0), RED));
    frame_by_x(name, air_time_s, dots)
}
