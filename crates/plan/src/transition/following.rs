//! The following distance of two robots: with it, a robot can stop behind a robot ahead that stops dead.
//!
//! It covers the way that a robot drives in its reaction time, and its braking distance. Robots that pass side by side,
//! or slowly, need only the comfortable clearance.

use crate::margins::COMFORT_M;
use crate::{Closest, Path};
use lightbots_base::braking::stopping_m;
use lightbots_base::{Limits, Vec2};

/// Greatest following distance of any two robots, between centres, metres.
pub(super) fn widest_m(limits: &Limits) -> f64 {
    limits.contact_m() + COMFORT_M.max(stopping_m(limits.speed_mps))
}

/// Following distance of a pair at its closest moment, between centres, metres, if its paths are driven `faster` times
/// as fast as they are given. A standing disc, whose index is beyond the paths, needs only the comfortable clearance.
pub(super) fn wanted_m(paths: &[Path], found: &Closest, limits: &Limits, faster: f64) -> f64 {
    let (i, j) = found.pair;
    let comfort_m = limits.contact_m() + COMFORT_M;
    let [Some(one), Some(other)] = [i, j].map(|disc| paths.get(disc)) else { return comfort_m };
    let [one, other] = [one, other].map(|path| path.as_ref().at(found.at));
    let Some(apart) = (other.position - one.position).normalized() else { return comfort_m };
    let following_mps = following_mps(apart, one.velocity, other.velocity) * faster;
    limits.contact_m() + COMFORT_M.max(stopping_m(following_mps.min(limits.speed_mps)))
}

/// The greater of two speeds, m/s. At the first, `one` would approach the other robot if that robot stood. At the
/// second, `other` would approach `one` if `one` stood. `apart`: unit vector from `one` to `other`. `one` and `other`:
/// velocities, m/s.
fn following_mps(apart: Vec2, one: Vec2, other: Vec2) -> f64 {
    one.dot(apart).max(-other.dot(apart)).max(0.0)
}
