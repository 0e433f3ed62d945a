//! Random effects: their values are hashes of (seed, robot, cycle).

use crate::ease::fraction;
use crate::look::Look;
use crate::noise::{cycle, unit};
use core::f64::consts::PI;

/// Combined with the seed of an effect by XOR, gives the seed of the robots' offsets in time. They are then independent of
/// the random choice of the robots that are lit.
const OFFSETS: u64 = 0x6f66_6673;

/// In each of its cycles, a robot glows with the probability `density`, or stays dark. A robot that glows rises from 0
/// to 1 and fades again over the first `width` of the cycle. The cycles of robots start at random moments.
pub(super) fn twinkle(look: &Look, turns: f64, robot: u32, density: f64) -> f64 {
    let own = turns + unit(look.seed ^ OFFSETS, u64::from(robot), 0);
    let phase = fraction(own);
    if phase >= look.width || unit(look.seed, u64::from(robot), cycle(own)) >= density {
        return 0.0;
    }
    let rise = libm::sin(PI * phase / look.width);
    rise * rise
}

/// 1 if the robot is lit in the present cycle, else 0. Robots are lit with the probability `density`.
pub(super) fn sparkle(look: &Look, turns: f64, robot: u32, density: f64) -> f64 {
    if unit(look.seed, u64::from(robot), cycle(turns)) < density { 1.0 } else { 0.0 }
}

/// A random phase of the robot plus `turns`, the cycles since the effect began, wrapped into 0 to 1.
pub(super) fn by_robot(look: &Look, turns: f64, robot: u32) -> f64 {
    look.wrap.at(unit(look.seed, u64::from(robot), 0) + turns)
}
