//! Separation: a robot that is nearer to a neighbour than planned gives way by a few millimetres.
//!
//! A robot deviates from its route by the error of its own place, so the gap between two robots has the errors of both.
//! Their proximity sensors measure the gap far better. Both robots give way, each by a part of the missing clearance.

use lightbots_base::Vec2;

use super::sensors::Sensors;
use super::track::Track;
use crate::config::SafetyPolicy;

/// Clearance to keep to a neighbour if the planned clearance is unknown, metres.
const UNTOLD_M: f32 = 0.003;
/// Largest clearance to keep, metres, even if the plan leaves more.
const MOST_M: f32 = 0.008;
/// Least clearance to keep, metres, even if the plan leaves less. Robots deviate from their places by this much.
const LEAST_M: f32 = 0.0025;
/// If the gap closes slower than this, m/s, the gap after [`SOON_S`] counts instead of the present gap. Neighbours that
/// close faster come near by plan.
const DRIFTING_MPS: f32 = 0.1;
/// How far ahead a slow approach is extrapolated, seconds.
const SOON_S: f32 = 0.1;
/// Gap at which a robot gives way twice as far as at a large gap with the same missing clearance, metres.
const LITTLE_M: f32 = 0.0015;

/// Returns the offset in body space by which the robot gives way to a neighbour, metres; zero if the clearance is
/// sufficient. `own_mps`: the robot's speed along its front. `clearance_m`: planned clearance, metres; `None` if it is
/// unknown.
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
