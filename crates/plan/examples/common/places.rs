//! Starts and goals for problems.
// Each example uses only a part of this module.
#![allow(dead_code)]

use super::dice::Dice;
use lightbots_base::{Limits, Vec2};
use lightbots_plan::TransitionProblem;

/// Binding of robots to goals.
#[derive(Clone, Copy, PartialEq)]
pub enum Bound {
    /// Any robot may take any goal.
    No,
    /// Robot i takes goal i.
    Yes,
}

/// A problem on a floor of this half size, with the limits of the Elisa-3.
pub fn problem(starts: Vec<Vec2>, goals: Vec<Vec2>, half: Vec2, bound: Bound) -> TransitionProblem {
    let pinned = if bound == Bound::Yes { (0..goals.len()).map(Some).collect() } else { Vec::new() };
    TransitionProblem { starts, goals, pinned, ..TransitionProblem::on_floor(half, Limits::ELISA_3) }
}

/// Up to `count` random places at least `apart_m` metres apart where `clear` holds. About half of the attempts are just
/// `apart_m` from another place.
pub fn scattered(
    dice: &mut Dice,
    count: usize,
    half: Vec2,
    apart_m: f64,
    clear: &dyn Fn(Vec2) -> bool,
) -> Vec<Vec2> {
    let inner = half - Vec2::new(0.0272, 0.0272);
    let mut places: Vec<Vec2> = Vec::new();
    for throw in 0..count * 300 {
        if places.len() == count {
            break;
        }
        let place = if places.is_empty() || throw % 2 == 0 {
            dice.place(inner)
        } else {
            let beside = places[dice.whole(0, places.len() - 1)];
            beside + Vec2::unit(dice.between(0.0, std::f64::consts::TAU)) * (apart_m + 1e-6)
        };
        let on_floor = place.x.abs() <= inner.x && place.y.abs() <= inner.y;
        if on_floor && clear(place) && places.iter().all(|other| other.distance(place) >= apart_m) {
            places.push(place);
        }
    }
    places
}

/// The `count` places of a hexagonal grid that are nearest to the origin.
pub fn blob(count: usize, pitch_m: f64) -> Vec<Vec2> {
    let reach = (count as f64).sqrt().ceil() as i64 + 2;
    let mut places: Vec<Vec2> = Vec::new();
    for row in -reach..=reach {
        for column in -reach..=reach {
            let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
            places.push(Vec2::new((column as f64 + shift) * pitch_m, row as f64 * pitch_m * 0.75_f64.sqrt()));
        }
    }
    places.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    places.truncate(count);
    places
}

/// `count` places of a square grid, row after row around the origin.
pub fn square(count: usize, pitch_m: f64) -> Vec<Vec2> {
    let side = (count as f64).sqrt().ceil() as usize;
    let at = |i: usize| (i as f64 - (side as f64 - 1.0) / 2.0) * pitch_m;
    (0..count).map(|i| Vec2::new(at(i % side), at(i / side))).collect()
}

/// `count` places on a circle around `middle`, neighbours `apart_m` from each other.
pub fn ring(count: usize, apart_m: f64, middle: Vec2) -> Vec<Vec2> {
    let angle = std::f64::consts::TAU / count as f64;
    let radius = if count > 1 { apart_m / 2.0 / (angle / 2.0).sin() } else { 0.0 };
    (0..count).map(|i| middle + Vec2::unit(angle * i as f64) * radius).collect()
}
