//! The speed that one neighbour allows. The robot must be able to stop before its disc comes too near to the disc of
//! the moving neighbour. The distance to keep grows with the uncertainty of the neighbour's place.

use lightbots_base::braking::{ACTUATION_S, GRIP_MPS2};

use super::point::Point;
use super::sensors::Sensors;
use super::track::Track;
use crate::config::SafetyPolicy;

/// Number of bisections in the search for the highest allowed speed: from 0.27 m/s down to an error of 1 mm/s.
const HALVINGS: usize = 8;
/// Cosine of the angle between the direction of driving and the direction to a neighbour. Below this value, the
/// neighbour does not limit the speed, because driving on brings the robot no nearer to it.
const ABEAM: f32 = 0.05;

/// The motion along its front that the robot wants; negative is backwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    /// The wanted speed, m/s: that of the setpoint for the route, or for rolling out to rest.
    pub speed_mps: f32,
    /// The speed that was commanded in the last step, which the wheels carry out now, m/s.
    pub told_mps: f32,
    /// Length of a step, seconds.
    pub dt: f32,
}

impl Wish {
    /// Direction of driving: 1 forwards, −1 backwards. It is that of the wanted speed, or of the last command if the
    /// wanted speed is nearly 0.
    fn sense(&self) -> f32 {
        let decides = if self.speed_mps.abs() > 1e-3 { self.speed_mps } else { self.told_mps };
        1f32.copysign(decides)
    }
}

/// The highest speed that a neighbour allows, m/s; `None` if it allows the wanted speed. `clearance_m`: planned
/// clearance to this neighbour, metres; `None` if it is unknown or the neighbour stands by plan.
pub(crate) fn allowed_mps(
    track: &Track,
    wish: &Wish,
    clearance_m: Option<f32>,
    sensors: &Sensors,
    of: &SafetyPolicy,
) -> Option<f32> {
    let sense = wish.sense();
    let ahead = track.at.x * sense / track.at.length().max(1e-3);
    if ahead < ABEAM {
        return None;
    }
    // A neighbour that the plan does not know may stop at any moment, so its driving away does not count.
    let away = track.at.times(track.velocity.dot(track.at).max(0.0) / track.at.dot(track.at).max(1e-6));
    let velocity = if clearance_m.is_some() { track.velocity } else { track.velocity.minus(away) };
    let velocity = if track.is_flat { Point::ZERO } else { velocity };
    let stop = Stop { at: track.at, velocity, is_flat: track.is_flat, wish, sense };
    let wanted_mps = wish.speed_mps * sense;
    let (at_wanted, direction, after_s) = stop.nearest(wanted_mps);
    let sigma_m = libm::sqrtf(track.covariance.place_after(direction, after_s).max(0.0));
    let grown_m = of.spare_m + of.sigmas * sigma_m;
    // A neighbour that the plan names is taken to keep to its clearance unless it surely is nearer.
    let planned_m = |clearance_m: f32| (of.planned_share * clearance_m - sigma_m).max(0.0);
    let grown_m = clearance_m.map_or(grown_m, |clearance_m| grown_m.min(planned_m(clearance_m)));
    let least_m = sensors.contact_m() + grown_m;
    if at_wanted >= least_m {
        return None;
    }
    // If the discs come nearer than `least_m` even when the robot stops at once, the robot must not make that worse.
    let (at_rest, ..) = stop.nearest(0.0);
    let tolerance_m = if clearance_m.is_some() { of.tolerance_m } else { 0.0 };
    // Each step may use the tolerance again: it must not add up to a contact.
    let tolerated_m = (at_rest - tolerance_m).max((sensors.contact_m() + of.spare_m).min(at_rest));
    let least_m = least_m.min(tolerated_m);
    if at_wanted >= least_m {
        return None;
    }
    let (mut safe, mut unsafe_) = (0.0, wanted_mps);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (safe + unsafe_);
        if stop.nearest(middle).0 >= least_m { safe = middle } else { unsafe_ = middle }
    }
    Some(safe)
}

/// The manoeuvre that is checked. The robot drives at the last commanded speed until the motors react, and then at a
/// tried speed for one step. After that, it brakes at the grip limit.
struct Stop<'a> {
    /// Centre of the neighbour, body space, metres.
    at: Point,
    /// Velocity of the neighbour over the floor along the axes of body space, m/s.
    velocity: Point,
    /// Whether the neighbour is a straight edge. Its nearest point then moves along with the robot.
    is_flat: bool,
    wish: &'a Wish,
    sense: f32,
}

impl Stop<'_> {
    /// The nearest approach during the manoeuvre at `speed_mps`. Returns the distance of the centres, metres, the unit
    /// vector towards the neighbour, and the time until then, seconds.
    fn nearest(&self, speed_mps: f32) -> (f32, Point, f32) {
        let (reaction_s, grip) = (ACTUATION_S as f32, GRIP_MPS2 as f32);
        let told_mps = self.wish.told_mps * self.sense;
        let way_m = told_mps * reaction_s + speed_mps * (self.wish.dt + speed_mps / (2.0 * grip));
        let over_s = reaction_s + self.wish.dt + speed_mps / grip;
        let start = self.at;
        let step = self.velocity.times(over_s).minus(Point::new(self.sense * way_m, 0.0));
        let across = start.times(start.dot(step) / start.dot(start).max(1e-6));
        let step = if self.is_flat { across } else { step };
        let length2 = step.dot(step).max(1e-12);
        let share = (-start.dot(step) / length2).clamp(0.0, 1.0);
        let nearest = start.plus(step.times(share));
        let far_m = nearest.length().max(1e-3);
        (far_m, nearest.times(1.0 / far_m), share * over_s)
    }
}
