//! How far apart two had better be that drive one behind the other, in case the one ahead dies.
//!
//! Who follows drives on until it has seen that, and a little farther until it stands. Passing side by side, or slowly,
//! it may be as near as ever.

use crate::margins::COMFORT_M;
use crate::{Closest, Path};
use lightbots_base::braking::stopping_m;
use lightbots_base::{Limits, Vec2};

/// The distance of centres within which anybody may be too near to somebody ahead, metres.
pub(super) fn widest_m(limits: &Limits) -> f64 {
    limits.contact_m() + COMFORT_M.max(stopping_m(limits.speed_mps))
}

/// How far apart a pair's centres had better be at the moment it is closest, metres, if everybody drove this many times
/// as fast as on these paths. Discs counted on from the paths stand.
pub(super) fn wanted_m(paths: &[Path], found: &Closest, limits: &Limits, faster: f64) -> f64 {
    let (i, j) = found.pair;
    let comfort_m = limits.contact_m() + COMFORT_M;
    let [Some(one), Some(other)] = [i, j].map(|disc| paths.get(disc)) else { return comfort_m };
    let [one, other] = [one, other].map(|path| path.as_ref().at(found.at));
    let Some(apart) = (other.position - one.position).normalized() else { return comfort_m };
    let following_mps = following_mps(apart, one.velocity, other.velocity) * faster;
    limits.contact_m() + COMFORT_M.max(stopping_m(following_mps.min(limits.speed_mps)))
}

/// How fast either would near the other if that stood; `apart` is the direction from one to the other.
fn following_mps(apart: Vec2, one: Vec2, other: Vec2) -> f64 {
    one.dot(apart).max(-other.dot(apart)).max(0.0)
}
