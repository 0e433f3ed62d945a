//! Random effects: their values are hashes of (seed, robot, cycle).

use crate::ease::fraction;
use crate::look::Look;
use crate::noise::{cycle, unit};
use core::f64::consts::PI;

/// Changes the seed for the robots' offsets in time, which are then independent of the choice of robots that are lit.
const OFFSETS: u64 = 0x6f66_6673;

/// In each of its cycles a robot glows up and fades over the first `width`, or stays dark.
pub(super) fn twinkle(look: &Look, turns: f64, robot: u32, density: f64) -> f64 {
    let own = turns + unit(look.seed ^ OFFSETS, u64::from(robot), 0);
    let phase = fraction(own);
    if phase >= look.width || unit(look.seed, u64::from(robot), cycle(own)) >= density {
        return 0.0;
    }
    let rise = libm::sin(PI * phase / look.width);
    rise * rise
}

/// A robot is lit for a whole cycle, or dark.
pub(super) fn sparkle(look: &Look, turns: f64, robot: u32, density: f64) -> f64 {
    if unit(look.seed, u64::from(robot), cycle(turns)) < density { 1.0 } else { 0.0 }
}

/// A random phase for each robot, moved by the turns.
pub(super) fn by_robot(look: &Look, turns: f64, robot: u32) -> f64 {
    look.wrap.at(unit(look.seed, u64::from(robot), 0) + turns)
}
