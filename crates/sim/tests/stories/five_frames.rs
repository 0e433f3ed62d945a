//! A show of five very different frames, for tests whose robots drive between any two of them.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Pixel, Show, Stage};
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Number of frames of the show.
pub const FRAMES: usize = 5;

/// Five frames of `count` robots.
pub fn show(count: u32, air_time_s: f64) -> Show {
    let frame = |number: usize| Frame {
        id: Some(number.to_string()),
        air_time_s,
        pixels: (0..count)
            .map(|id| {
                let color = Rgb::new(255, 80, id as u8);
                Pixel { id, at: place(number, id, count), color, ..Pixel::default() }
            })
            .collect(),
        ..Frame::default()
    };
    Show { stage: Stage::default(), frames: (0..FRAMES).map(frame).collect(), ..Show::default() }
}

/// A row, a ring, a grid, a diagonal and another row.
fn place(frame: usize, id: u32, count: u32) -> Vec2 {
    let share = f64::from(id) / f64::from(count);
    let along = (share - 0.5) * 0.1 * f64::from(count);
    match frame {
        0 => Vec2::new(along, 0.9),
        1 => Vec2::unit(share * std::f64::consts::TAU) * (0.2 + 0.02 * f64::from(count)),
        2 => Vec2::new(0.09 * f64::from(id % 4) - 0.2, 0.09 * f64::from(id / 4) - 0.6),
        3 => Vec2::new(along, along),
        _ => Vec2::new(-along, -0.8),
    }
}

/// Rehearses a show. `faults` has the form of the command line, and may be empty.
pub fn play(show: &Show, faults: &str, seed: u64, conditions: Conditions) -> RehearsalReport {
    let faults = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let options = RehearsalOptions { seed, conditions: faults.added_to(conditions), robots: None };
    rehearse(show, &options, &mut |_| {})
}
