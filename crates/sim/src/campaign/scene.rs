//! The show of a seed: robots, floor and frames.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Identity, Pixel, Show, Stage};

use crate::dice::{Dice, Purpose};

/// Smallest and largest number of robots that a seed chooses.
const ROBOTS: (usize, usize) = (10, 100);
/// Least duration of a show, seconds. Frames are added until the sum of air times and estimated drives is this long.
const SHOW_S: f64 = 20.0;
/// Assumed mean speed of a robot over a drive, acceleration included, m/s.
const MEAN_MPS: f64 = 0.2;
/// Smallest and largest value of a scene's least distance between two places, metres. Plans need 0.06 m between places,
/// and more where robots pass each other.
const SPACING_M: (f64, f64) = (0.075, 0.14);
/// Least distance of places from the edge of the floor, metres.
const MARGIN_M: f64 = 0.08;

/// A show and its robots.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The show. It has a start for each robot.
    pub show: Show,
    /// Number of robots.
    pub robots: usize,
}

impl Scene {
    /// Draws the scene of `seed` for `robots` robots; `None`: the seed decides how many.
    pub fn new(seed: u64, robots: Option<usize>) -> Self {
        let mut dice = Dice::new(seed, Purpose::Scene);
        let drawn = ROBOTS.0 + dice.below((ROBOTS.1 - ROBOTS.0 + 1) as u64) as usize;
        let robots = robots.unwrap_or(drawn);
        let (spacing_m, side_m) = floor(&mut dice, robots);
        let stage = Stage { width_m: side_m, depth_m: side_m, ..Stage::default() };
        let identity = if dice.chance(0.3) { Identity::Fixed } else { Identity::Any };
        let starts = places(&mut dice, robots, side_m, spacing_m);
        let (mut frames, mut lasts_s) = (Vec::new(), 0.0);
        while lasts_s < SHOW_S {
            let air_time_s = dice.between(0.1, 2.5);
            lasts_s += air_time_s + 0.5 * side_m / MEAN_MPS;
            let places = places_of_kind(&mut dice, robots, side_m, spacing_m);
            frames.push(frame(&mut dice, places, air_time_s));
        }
        let show = Show {
            name: format!("seed {seed}"),
            stage,
            identity,
            starts: Some(starts),
            frames,
            ..Show::default()
        };
        Self { show, robots }
    }
}

/// Draws the least distance between two places, and the side of a square floor with room for all robots, both in
/// metres.
fn floor(dice: &mut Dice, robots: usize) -> (f64, f64) {
    let spacing_m = dice.between(SPACING_M.0, SPACING_M.1);
    let columns = libm::ceil(libm::sqrt(robots as f64));
    let side_m = (columns * spacing_m * dice.between(1.3, 2.2) + 2.0 * MARGIN_M).max(0.8);
    (spacing_m, side_m)
}

fn frame(dice: &mut Dice, places: Vec<Vec2>, air_time_s: f64) -> Frame {
    let mut part = || 40 + dice.below(200) as u8;
    let color = Rgb::new(part(), part(), part());
    let pixels = (0u32..).zip(places).map(|(id, at)| Pixel { id, at, color, ..Pixel::default() });
    Frame { air_time_s, pixels: pixels.collect(), ..Frame::default() }
}

/// Draws places of a picture: a grid, a ring if all places fit on it, or random places.
fn places_of_kind(dice: &mut Dice, count: usize, side_m: f64, spacing_m: f64) -> Vec<Vec2> {
    let half_m = 0.5 * side_m - MARGIN_M;
    match dice.below(3) {
        0 => grid(dice, count, half_m, spacing_m),
        1 if count as f64 * spacing_m < core::f64::consts::TAU * half_m => {
            let turn = dice.between(0.0, 1.0);
            let angle = |n: usize| core::f64::consts::TAU * (n as f64 + turn) / count as f64;
            (0..count).map(|n| Vec2::unit(angle(n)) * half_m).collect()
        }
        _ => places(dice, count, side_m, spacing_m),
    }
}

/// A square grid of `count` places at a random position. `half_m`: largest coordinate of a place, unless the grid is
/// wider.
fn grid(dice: &mut Dice, count: usize, half_m: f64, spacing_m: f64) -> Vec<Vec2> {
    let columns = libm::ceil(libm::sqrt(count as f64)) as usize;
    let extent_m = (columns - 1) as f64 * spacing_m;
    let room_m = (half_m - 0.5 * extent_m).max(0.0);
    let corner = Vec2::new(dice.between(-room_m, room_m), dice.between(-room_m, room_m))
        - Vec2::new(0.5 * extent_m, 0.5 * extent_m);
    let place = |n: usize| corner + Vec2::new((n % columns) as f64, (n / columns) as f64) * spacing_m;
    (0..count).map(place).collect()
}

/// Random places, no two closer than `spacing_m`; a grid if no such places are found.
fn places(dice: &mut Dice, count: usize, side_m: f64, spacing_m: f64) -> Vec<Vec2> {
    let half_m = 0.5 * side_m - MARGIN_M;
    let mut places: Vec<Vec2> = Vec::new();
    for _ in 0..100 * count {
        let place = Vec2::new(dice.between(-half_m, half_m), dice.between(-half_m, half_m));
        if places.iter().all(|other| other.distance(place) >= spacing_m) {
            places.push(place);
            if places.len() == count {
                return places;
            }
        }
    }
    grid(dice, count, half_m, spacing_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_fit_to_be_played() {
        for seed in 0..200 {
            let scene = Scene::new(seed, None);
            let issues = lightbots_show::validate(&scene.show);
            assert!(!issues.iter().any(lightbots_show::Issue::is_error), "{seed}: {issues:?}");
            assert!((10..=100).contains(&scene.robots));
        }
    }
}
