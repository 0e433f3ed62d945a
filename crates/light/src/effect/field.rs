//! Effects that are fields over the floor.

use crate::colour::within_one;
use crate::ease::fraction;
use crate::look::Look;
use crate::noise::{octaves, unit};
use core::f64::consts::TAU;
use lightbots_base::Vec2;

/// Number of cells of noise over one size of the effect. Judged by eye on a floor of 16 x 10 robots: fewer cells look like
/// clouds, more look like sparks.
const FIRE_CELLS: f64 = 3.0;
/// Factor from noise, 0 to 1, to heat. Together with `FIRE_FUEL`, it bounds the height of flames: 1.35 sizes of the effect,
/// which hardly any noise reaches. Judged by eye.
const FIRE_HEAT: f64 = 1.1;
/// Heat at the foot of a flame where noise is 0. Judged by eye: with 0, the foot of the flames has dark holes.
const FIRE_FUEL: f64 = 0.25;
/// Number of octaves of a flame's noise. Judged by eye.
const FIRE_OCTAVES: u32 = 2;

/// The mean of four sine waves, 0 to 1. They run along the effect's direction, across it, diagonally, and inwards or
/// outwards around the effect's place. The seed decides their phases. All waves repeat after one cycle; `turns`: cycles
/// since the effect began.
pub(super) fn plasma(look: &Look, turns: f64, place: Vec2) -> f64 {
    let from_place = place - look.place;
    let along = Vec2::unit(look.angle);
    let (x, y) = (from_place.dot(along) / look.size_m, along.cross(from_place) / look.size_m);
    let around = from_place.length() / look.size_m;
    let turn = fraction(turns);
    let wave = |number: u64, phase: f64| libm::sin(TAU * (phase + unit(look.seed, number, 0)));
    let sum =
        wave(0, x + turn) + wave(1, y - turn) + wave(2, (x + y) / 2.0 + 2.0 * turn) + wave(3, around - turn);
    0.5 + sum / 8.0
}

/// Noise of `count` octaves, 0 to 1. Its cells have the size of the effect. It changes completely within one cycle;
/// `turns`: cycles since the effect began.
pub(super) fn noise(look: &Look, turns: f64, place: Vec2, count: u32) -> f64 {
    let at = (place - look.place) / look.size_m;
    octaves(look.seed, [at.x, at.y, turns], count)
}

/// Noise, 0 to 1, that moves along the effect's direction by the effect's size per cycle. It gets darker with the
/// height above the effect's place. `turns`: cycles since the effect began.
pub(super) fn fire(look: &Look, turns: f64, place: Vec2) -> f64 {
    let up = Vec2::unit(look.angle);
    let from_place = (place - look.place) / look.size_m;
    let (height, across) = (up.dot(from_place), up.cross(from_place));
    let at = [FIRE_CELLS * across, FIRE_CELLS * (height - turns), turns];
    within_one(FIRE_HEAT * octaves(look.seed, at, FIRE_OCTAVES) + FIRE_FUEL - height)
}
