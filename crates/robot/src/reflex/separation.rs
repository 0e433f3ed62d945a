//! Separation: a robot nearer to a neighbour than the plan leaves them gives way by a few millimetres.
//!
//! A robot is off its route by what its sensors are wrong, two neighbours by the sum of both; their proximity sensors
//! tell them far better how near they are than both their places do. Both give way, each a part of what is missing.

use lightbots_base::Vec2;

use super::sensors::Sensors;
use super::track::Track;
use crate::config::SafetyPolicy;

/// Clearance where the plan tells none, and the most that is asked for, metres.
const UNTOLD_M: f32 = 0.003;
const MOST_M: f32 = 0.008;
/// Clearance that is asked for even where the plan leaves less, metres: robots are off their places by that.
const LEAST_M: f32 = 0.0025;
/// A neighbour that comes nearer more slowly than this, m/s, counts as near as it will be `SOON_S` later: faster ones
/// come near by plan.
const DRIFTING_MPS: f32 = 0.1;
const SOON_S: f32 = 0.1;
/// With this gap left, metres, a robot gives way twice as far as where as much is missing from plenty.
const LITTLE_M: f32 = 0.0015;

/// How far a robot gives way to a neighbour, metres in body space.
pub(crate) fn give_way(
    track: &Track,
    own_mps: f32,
    clearance_m: Option<f32>,
    sensors: &Sensors,
    of: &SafetyPolicy,
) -> Vec2 {
    let far_m = track.at.length().max(1e-3);
    let towards = track.at.times(1.0 / far_m);
    let gap_m = far_m - sensors.contact_m();
    let planned_m = clearance_m.map_or(UNTOLD_M, |clearance_m| clearance_m.clamp(LEAST_M, MOST_M));
    let sigma_mps = libm::sqrtf(track.covariance.velocity_along(towards).max(0.0));
    let closing_mps = own_mps * towards.x - track.velocity.dot(towards) - sigma_mps;
    let drift_m = if (0.0..DRIFTING_MPS).contains(&closing_mps) { closing_mps * SOON_S } else { 0.0 };
    let missing_m = planned_m - gap_m + drift_m;
    if missing_m <= 0.0 {
        return Vec2::ZERO;
    }
    let more = 1.0 + LITTLE_M / gap_m.max(1e-4);
    let way_m = (of.give_way_share * missing_m * more).min(of.evade_most_m);
    Vec2::new(f64::from(-towards.x * way_m), f64::from(-towards.y * way_m))
}
