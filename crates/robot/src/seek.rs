//! Driving to a TARGET. The robot turns and drives on a smooth curve, backwards if that needs the smaller turn. It
//! stops within 3 mm of the target, or within 12 mm if the target then lies to its side.

use lightbots_base::{Limits, Vec2};

use crate::drive::{BodyPose, Setpoint};

/// Arrival test of the original robots: both coordinates are within this distance of the target, metres.
const ARRIVED_M: f64 = 0.02;
/// The robot stops once it is closer than this to the target, metres. With a smaller value, noise of the place would
/// make the robot turn on the spot.
const STOP_M: f64 = 0.003;
/// The robot also stops once it is closer than this to a target that lies to its side, metres. With a smaller value,
/// the robot would turn back and forth at the target.
const ABEAM_M: f64 = 0.012;
/// Deceleration when approaching the target, m/s². It is less than the ramps of the drive base allow. With a larger
/// value, the robot overshoots.
const BRAKING_MPS2: f64 = 0.8;
/// Turning rate per sine of the heading error, rad/s. With a larger value, the dead time of the motors makes the
/// heading oscillate.
const TURN_GAIN: f64 = 8.0;
/// If the cosine of the heading error is below this (an error of more than 45°), the robot turns on the spot. Otherwise
/// it drives a curve.
const CURVE_COS: f64 = 0.7;
/// The robot changes between driving forwards and backwards if the cosine of the angle from its direction of driving to
/// the target is below this. Near zero, noise would make it change repeatedly.
const BEHIND_COS: f64 = -0.15;

/// A drive to a target.
#[derive(Debug)]
pub(crate) struct Seek {
    goal: Vec2,
    /// How the robot drives: 1 forwards, −1 backwards, 0 not chosen yet.
    sense: f64,
    /// The robot stops once it is closer than this to a goal that lies to its side, metres.
    abeam_m: f64,
}

impl Seek {
    pub(crate) fn new(goal: Vec2) -> Self {
        Self { goal, sense: 0.0, abeam_m: ABEAM_M }
    }

    /// A drive that ends within [`STOP_M`] of the goal, even if the robot must turn on the spot for it.
    pub(crate) fn closely(goal: Vec2) -> Self {
        Self { abeam_m: STOP_M, ..Self::new(goal) }
    }

    /// Whether a robot at `at` (stage metres) has reached the goal by [`within_arrival`].
    pub(crate) fn reached(&self, at: Vec2) -> bool {
        within_arrival(at, self.goal)
    }

    /// The next setpoint towards the goal. Zero once the robot is within [`STOP_M`] of the goal, or near a goal that
    /// lies to its side. `body`: pose in the stage when the setpoint takes effect.
    pub(crate) fn step(&mut self, body: BodyPose, limits: &Limits) -> Setpoint {
        let to_goal = self.goal - body.at;
        let distance = to_goal.length();
        if distance < STOP_M {
            return Setpoint::default();
        }
        let (ahead, aside) = (body.facing.dot(to_goal) / distance, body.facing.cross(to_goal) / distance);
        if self.sense == 0.0 {
            self.sense = if ahead < 0.0 { -1.0 } else { 1.0 };
        } else if ahead * self.sense < BEHIND_COS {
            self.sense = -self.sense;
        }
        let (cos, sin) = (ahead * self.sense, aside * self.sense);
        if distance < self.abeam_m && cos < CURVE_COS {
            return Setpoint::default();
        }
        let fastest = limits.speed_mps.min(libm::sqrt(2.0 * BRAKING_MPS2 * distance));
        let straightness = ((cos - CURVE_COS) / (1.0 - CURVE_COS)).max(0.0);
        Setpoint { speed_mps: self.sense * fastest * straightness, turn_radps: TURN_GAIN * sin }
    }
}

/// The arrival test of the original robots: whether both coordinates are within 20 mm of the goal.
pub(crate) fn within_arrival(at: Vec2, goal: Vec2) -> bool {
    let off = at - goal;
    off.x.abs() <= ARRIVED_M && off.y.abs() <= ARRIVED_M
}

const _: () = assert!(STOP_M < ABEAM_M && ABEAM_M < ARRIVED_M);

#[cfg(test)]
mod tests {
    use super::*;

    fn body(heading: f64) -> BodyPose {
        BodyPose { at: Vec2::ZERO, facing: Vec2::unit(heading) }
    }

    #[test]
    fn backwards_where_that_is_shorter() {
        let mut seek = Seek::new(Vec2::new(-1.0, 0.0));
        let setpoint = seek.step(body(0.0), &Limits::ELISA_3);
        assert!(setpoint.speed_mps < -0.2 && setpoint.turn_radps.abs() < 1e-9);
        let slightly_left = seek.step(body(0.1), &Limits::ELISA_3);
        assert!(slightly_left.turn_radps < 0.0);
    }

    #[test]
    fn a_target_to_the_side_is_turned_to_on_the_spot() {
        let setpoint = Seek::new(Vec2::new(0.1, 1.0)).step(body(0.0), &Limits::ELISA_3);
        assert_eq!(setpoint.speed_mps, 0.0);
        assert!(setpoint.turn_radps > 4.5);
    }

    #[test]
    fn the_arrival_test_is_the_originals() {
        assert!(within_arrival(Vec2::new(0.02, -0.02), Vec2::ZERO));
        assert!(!within_arrival(Vec2::new(0.0201, 0.0), Vec2::ZERO));
        assert_eq!(Seek::new(Vec2::ZERO).step(body(1.0), &Limits::ELISA_3), Setpoint::default());
    }
}
