//! Trajectory tracking. The motion of the route is feed-forward. The errors along the robot's front, across it, and in
//! heading are feedback. Source: Kanayama et al., "A stable tracking control method for an autonomous mobile robot",
//! 1990.

use lightbots_base::{Motion, Vec2};

use crate::drive::{BodyPose, Setpoint};
use crate::look_ahead::Ahead;

/// Gain of the error along the robot's front, 1/s (Kanayama's Kx). With a larger value, the dead time of two steps
/// makes the speed oscillate.
const ALONG: f64 = 9.0;
/// Deceleration at the end of closing a large error along the front, m/s². It adds to the deceleration of the route.
/// With a larger value, a robot that catches up cannot brake in time and overshoots.
const CLOSING_MPS2: f64 = 0.4;
/// Error along the front from which [`CLOSING_MPS2`] limits the closing speed, metres. At this error the limit equals
/// the linear gain.
const FAR_M: f64 = 2.0 * CLOSING_MPS2 / (ALONG * ALONG);
/// Gain of the error across the front per speed, rad/m² (Kanayama's Ky). With [`TURN`], the error decays nearly
/// critically damped at full speed. With a larger value, the robot swings across its path.
const ACROSS: f64 = 600.0;
/// Gain of the sine of the heading error, rad/s (Kanayama's Kθ, times the speed). With a larger value, errors across
/// the front are closed later. See [`ACROSS`].
const TURN: f64 = 11.0;
/// Gain of the heading error while turning on the spot, 1/s. With a larger value, the dead time of two steps makes the
/// heading oscillate.
const SPOT: f64 = 12.0;
/// Turning rate towards the look-ahead direction, as a multiple of the remaining angle over the remaining time. At 1
/// the turn would end exactly in time, without reserve for the acceleration.
const SWING: f64 = 1.8;
/// Lower bound of the speed by which an error across the front is multiplied for steering, m/s. With a smaller value, a
/// slow robot does not return to its route.
const STEERING_MPS: f64 = 0.05;
/// Below this speed of the route, its tangent is not used as the direction of travel, m/s.
pub(crate) const RESTING_MPS: f64 = 0.002;
/// While the route rests, errors along the front below this are taken for noise, metres. With a smaller value, robots
/// jitter at their places.
const CALM_M: f64 = 0.0015;
/// While the robot turns on the spot, sines of the heading error below this are taken for noise. See [`CALM_M`].
const CALM_SIN: f64 = 0.012;
/// A robot turns towards the place of a creeping route if it is farther from it than this, metres. It does not turn
/// while the route rests: its estimated place may be wrong by as much, and it would arrive later.
const STRAY_M: f64 = 0.004;
/// A route rests up to this speed, and creeps above it (up to [`RESTING_MPS`]), m/s. The bound only has to exclude
/// rounding errors.
const CREEPING_MPS: f64 = 1e-5;
/// Largest speed along the front with which an error is corrected while the route rests, m/s.
const CORRECTION_MPS: f64 = 0.1;
/// Cosine of the angle between the robot's direction of driving and the direction of travel. Below it, the robot
/// changes between driving forwards and backwards. Near zero, noise would make it change repeatedly.
const BEHIND_COS: f64 = -0.1;

const _: () = assert!(CREEPING_MPS < RESTING_MPS && RESTING_MPS < STEERING_MPS);

/// The tracking controller of a robot, with its memory.
#[derive(Debug)]
pub(crate) struct Follow {
    /// Unit vector of the direction of travel, in the stage; zero until a direction is chosen.
    travel: Vec2,
    /// How the robot drives: 1 forwards, −1 backwards, 0 not chosen yet.
    sense: f64,
}

impl Follow {
    pub(crate) fn new() -> Self {
        Self { travel: Vec2::ZERO, sense: 0.0 }
    }

    /// Returns the next setpoint. `motion`: motion of the route per show time, at the moment when the setpoint takes
    /// effect. `ahead`: the look-ahead direction if the route rests or is slow, and later drives off; otherwise `None`.
    #[inline]
    pub(crate) fn step(&mut self, motion: &Motion, ahead: Option<Ahead>, body: BodyPose) -> Setpoint {
        let speed = motion.velocity.length();
        if let Some(ahead) = ahead {
            self.travel = ahead.towards;
            self.choose_sense(body.facing);
            if speed > RESTING_MPS {
                return self.swing(motion, ahead.within_s, body);
            }
        } else if speed > RESTING_MPS {
            self.travel = motion.velocity / speed;
            self.choose_sense(body.facing);
            return self.drive(motion, speed, body);
        }
        let error = motion.position - body.at;
        let stray = ahead.is_none() && speed > CREEPING_MPS && error.length() > STRAY_M;
        if let Some(towards) = error.normalized().filter(|_| stray) {
            // The tangent of a creeping route is no direction, and yet the route leads away to the side in time.
            self.travel = towards;
            self.choose_sense(body.facing);
        }
        self.rest(motion, stray || ahead.is_some(), body)
    }

    /// Returns the setpoint that turns the robot on the spot until its front or its back points along `ahead`. `ahead`
    /// is the first direction of a route that has not begun.
    pub(crate) fn prepare(&mut self, ahead: Vec2, body: BodyPose) -> Setpoint {
        self.travel = ahead;
        self.choose_sense(body.facing);
        Setpoint { speed_mps: 0.0, turn_radps: self.turn_on_the_spot(body.facing) }
    }

    /// Chooses whether the robot drives forwards or backwards: the one that needs the smaller turn, with hysteresis.
    fn choose_sense(&mut self, facing: Vec2) {
        let cos = facing.dot(self.travel);
        if self.sense == 0.0 || cos * self.sense < BEHIND_COS {
            self.sense = if cos < 0.0 { -1.0 } else { 1.0 };
        }
    }

    fn drive(&self, motion: &Motion, speed: f64, body: BodyPose) -> Setpoint {
        let error = motion.position - body.at;
        let (along, across) = (body.facing.dot(error), body.facing.cross(error));
        let cos = body.facing.dot(self.travel) * self.sense;
        let sin = body.facing.cross(self.travel) * self.sense;
        let curve = motion.velocity.cross(motion.acceleration) / (speed * speed);
        let steered = self.sense * speed.max(STEERING_MPS);
        Setpoint {
            speed_mps: self.sense * speed * cos.max(0.0) + closing_mps(along),
            turn_radps: curve + ACROSS * steered * across + TURN * sin,
        }
    }

    /// Returns the setpoint on a slow part of the route. The robot turns to the look-ahead direction within `within_s`
    /// seconds, and keeps up with the route as far as its heading allows.
    fn swing(&self, motion: &Motion, within_s: f64, body: BodyPose) -> Setpoint {
        let along = body.facing.dot(motion.position - body.at);
        let hurry = (SWING / within_s.max(1e-3)).min(SPOT);
        Setpoint {
            speed_mps: body.facing.dot(motion.velocity) + closing_mps(along),
            turn_radps: self.turn_on_the_spot(body.facing) * (hurry / SPOT),
        }
    }

    fn rest(&self, motion: &Motion, turns: bool, body: BodyPose) -> Setpoint {
        let turn_radps = if turns { self.turn_on_the_spot(body.facing) } else { 0.0 };
        let along = body.facing.dot(motion.position - body.at);
        let calm = along.abs() < CALM_M || turn_radps.abs() > 1.0;
        let speed_mps = if calm { 0.0 } else { (ALONG * along).clamp(-CORRECTION_MPS, CORRECTION_MPS) };
        Setpoint { speed_mps, turn_radps }
    }

    fn turn_on_the_spot(&self, facing: Vec2) -> f64 {
        let cos = facing.dot(self.travel) * self.sense;
        let sin = facing.cross(self.travel) * self.sense;
        if cos > 0.0 && sin.abs() < CALM_SIN {
            0.0
        } else if cos > 0.5 {
            SPOT * sin
        } else {
            SPOT.copysign(sin)
        }
    }
}

/// Speed that closes an error along the front of `along_m` metres, m/s.
fn closing_mps(along_m: f64) -> f64 {
    if along_m.abs() <= FAR_M {
        return ALONG * along_m;
    }
    libm::sqrt(2.0 * CLOSING_MPS2 * along_m.abs()).copysign(along_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving(x: f64, y: f64) -> Motion {
        Motion { position: Vec2::new(x, y), velocity: Vec2::new(0.2, 0.0), acceleration: Vec2::ZERO }
    }

    fn body(heading: f64) -> BodyPose {
        BodyPose { at: Vec2::ZERO, facing: Vec2::unit(heading) }
    }

    fn ahead(x: f64, y: f64) -> Option<Ahead> {
        Some(Ahead { towards: Vec2::new(x, y), within_s: 0.2 })
    }

    #[test]
    fn without_errors_the_setpoint_is_the_motion_of_the_route() {
        let setpoint = Follow::new().step(&moving(0.0, 0.0), None, body(0.0));
        assert_eq!(setpoint, Setpoint { speed_mps: 0.2, turn_radps: 0.0 });
        let curve = Motion { acceleration: Vec2::new(0.0, 0.1), ..moving(0.0, 0.0) };
        assert!((Follow::new().step(&curve, None, body(0.0)).turn_radps - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_large_error_is_closed_no_faster_than_the_robot_can_brake() {
        // With the linear gain alone, a robot 40 mm behind drives on 14 mm beyond its route.
        let mut behind_m = 0.04;
        let mut faster_mps: f64 = 0.0;
        while behind_m > 0.001 {
            let wanted_mps = Follow::new().step(&moving(behind_m, 0.0), None, body(0.0)).speed_mps - 0.2;
            assert!(wanted_mps < 0.18, "{wanted_mps}");
            faster_mps += (wanted_mps - faster_mps).clamp(-0.4 * 0.016 * 1.3, 0.02);
            behind_m -= faster_mps * 0.016;
            assert!(behind_m > -0.001, "{behind_m}");
        }
        assert!((closing_mps(FAR_M) - closing_mps(FAR_M + 1e-9)).abs() < 1e-6);
        assert_eq!(closing_mps(-0.02), -closing_mps(0.02));
    }

    #[test]
    fn forwards_and_backwards_it_steers_to_the_same_side() {
        let behind = moving(-0.002, 0.003);
        let forwards = Follow::new().step(&behind, None, body(0.0));
        let backwards = Follow::new().step(&behind, None, body(core::f64::consts::PI));
        assert!(forwards.speed_mps < 0.2 && forwards.turn_radps > 0.0);
        assert!((forwards.speed_mps + backwards.speed_mps).abs() < 1e-9);
        assert!((forwards.turn_radps - backwards.turn_radps).abs() < 1e-9);
    }

    #[test]
    fn while_the_route_rests_it_turns_the_shorter_way_to_what_comes() {
        let resting = Motion::default();
        let mut follow = Follow::new();
        let left = follow.step(&resting, ahead(0.0, 1.0), body(0.3));
        assert!(left.turn_radps > 4.5 && left.speed_mps == 0.0);
        let back = Follow::new().step(&resting, ahead(-1.0, 0.1), body(0.0));
        assert!(back.turn_radps < 0.0 && back.turn_radps > -2.0);
        assert_eq!(Follow::new().step(&resting, None, body(0.3)), Setpoint::default());
    }

    #[test]
    fn where_the_route_reverses_it_drives_back_without_turning() {
        let slow = |speed: f64| Motion { velocity: Vec2::new(speed, 0.0), ..Motion::default() };
        let mut follow = Follow::new();
        assert_eq!(follow.step(&moving(0.0, 0.0), None, body(0.0)).speed_mps, 0.2);
        for speed in [0.01, 0.005, -0.005, -0.01] {
            let setpoint = follow.step(&slow(speed), ahead(-1.0, 0.0), body(0.0));
            assert_eq!((setpoint.speed_mps, setpoint.turn_radps.abs()), (speed, 0.0));
        }
        let back = Motion { velocity: Vec2::new(-0.2, 0.0), ..Motion::default() };
        assert_eq!(follow.step(&back, None, body(0.0)), Setpoint { speed_mps: -0.2, turn_radps: 0.0 });
    }

    #[test]
    fn a_creeping_route_is_followed_to_the_side() {
        let creeping = Motion {
            position: Vec2::new(0.0, 0.006),
            velocity: Vec2::new(0.0, 0.001),
            acceleration: Vec2::ZERO,
        };
        assert!(Follow::new().step(&creeping, None, body(0.0)).turn_radps.abs() > 1.0);
        let facing_it = Follow::new().step(&creeping, None, body(core::f64::consts::FRAC_PI_2));
        assert!(facing_it.speed_mps > 0.02 && facing_it.turn_radps.abs() < 0.1);
        let near = Motion { position: Vec2::new(0.0, 0.003), ..creeping };
        assert_eq!(Follow::new().step(&near, None, body(0.0)).turn_radps, 0.0);
        let over = Motion { velocity: Vec2::ZERO, ..creeping };
        assert_eq!(Follow::new().step(&over, None, body(0.0)).turn_radps, 0.0);
    }

    #[test]
    fn on_a_slow_stretch_it_turns_to_what_comes_in_time() {
        let slow = Motion { velocity: Vec2::new(0.01, 0.0), ..Motion::default() };
        let soon = Some(Ahead { towards: Vec2::unit(1.0), within_s: 0.2 });
        let later = Some(Ahead { towards: Vec2::unit(1.0), within_s: 0.8 });
        let (soon, later) = (
            Follow::new().step(&slow, soon, body(0.0)).turn_radps,
            Follow::new().step(&slow, later, body(0.0)).turn_radps,
        );
        assert!(soon > 1.0 / 0.2 && later > 1.0 / 0.8 && later < soon / 2.0);
    }
}
