//! TARGET: turn, drive, curve smoothly, backwards where that is shorter, stand within 20 mm.

use lightbots_base::{Limits, Vec2};

use crate::drive::{BodyPose, Setpoint};

/// The original's arrival test: both coordinates within this, metres.
const ARRIVED_M: f64 = 0.02;
/// Near enough to stop, metres; and near enough where the target lies abeam.
const STOP_M: f64 = 0.003;
const ABEAM_M: f64 = 0.012;
/// Braking it plans with, m/s²: less than the ramps allow.
const BRAKING_MPS2: f64 = 0.8;
/// Turning rate per sine of the heading error, rad/s.
const TURN_GAIN: f64 = 8.0;
/// Below this cosine of the heading error it turns on the spot; above, it curves.
const CURVE_COS: f64 = 0.7;
/// The target must lie this far behind (cosine) before front and back change places.
const BEHIND_COS: f64 = -0.15;

/// A drive to a place.
#[derive(Debug)]
pub(crate) struct Seek {
    goal: Vec2,
    /// 1 forwards, −1 backwards.
    sense: f64,
    /// Nearer than this it stands where the target lies abeam, metres.
    abeam_m: f64,
}

impl Seek {
    pub(crate) fn new(goal: Vec2) -> Self {
        Self { goal, sense: 0.0, abeam_m: ABEAM_M }
    }

    /// A drive to a place as near as it can be reached, whatever turns that takes.
    pub(crate) fn closely(goal: Vec2) -> Self {
        Self { abeam_m: STOP_M, ..Self::new(goal) }
    }

    /// Whether a place counts as reached.
    pub(crate) fn reached(&self, at: Vec2) -> bool {
        within_arrival(at, self.goal)
    }

    /// What to do next.
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

/// The original's arrival test.
pub(crate) fn within_arrival(at: Vec2, goal: Vec2) -> bool {
    let off = at - goal;
    off.x.abs() <= ARRIVED_M && off.y.abs() <= ARRIVED_M
}

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
