//! Being where the route says when it says: its motion as feed-forward, errors along, across and in heading as feedback
//! (Kanayama et al., "A stable tracking control method for an autonomous mobile robot", 1990).

use lightbots_base::{Motion, Vec2};

use crate::drive::{BodyPose, Setpoint};
use crate::look_ahead::Ahead;

/// Speed per error along, 1/s.
const ALONG: f64 = 9.0;
/// Far behind or ahead it closes in no faster than it can brake on top of what the route does, m/s².
const CLOSING_MPS2: f64 = 0.4;
/// From so far on that is slower than the rule above, metres: where both agree.
const FAR_M: f64 = 2.0 * CLOSING_MPS2 / (ALONG * ALONG);
/// Turning rate per error across and speed, rad/m²: together with the next, nearly critically damped in 6 cm.
const ACROSS: f64 = 600.0;
/// Turning rate per sine of the heading error, rad/s.
const TURN: f64 = 11.0;
/// On the spot, rad/s per radian.
const SPOT: f64 = 12.0;
/// Turning rate per angle left and time left for it: it starts faster than evenly, to be there in time.
const SWING: f64 = 1.8;
/// The same errors across steer as at this speed where it drives slower, m/s.
const SLOW_MPS: f64 = 0.05;
/// Slower than this the route says no direction, m/s.
pub(crate) const RESTING_MPS: f64 = 0.002;
/// While it rests, errors below these are noise: metres along, and sine of the heading error.
const CALM_M: f64 = 0.0015;
const CALM_SIN: f64 = 0.012;
/// A robot so far from where a creeping route is turns towards it, metres. Where the route rests, turning would not
/// pay: its sensors may be as wrong, and it would arrive later.
const STRAY_M: f64 = 0.004;
/// Slower than this a route rests, m/s.
const CREEPING_MPS: f64 = 1e-5;
/// Fastest correction while the route rests, m/s.
const CORRECTION_MPS: f64 = 0.1;
/// The direction must lie this far behind (cosine) before front and back change places.
const BEHIND_COS: f64 = -0.1;

/// How a robot follows its route.
#[derive(Debug)]
pub(crate) struct Follow {
    /// Unit vector of travel.
    travel: Vec2,
    /// 1 forwards, −1 backwards, 0 not chosen yet.
    sense: f64,
}

impl Follow {
    pub(crate) fn new() -> Self {
        Self { travel: Vec2::ZERO, sense: 0.0 }
    }

    /// What to do next: `motion` is where the route is and how it moves when this takes effect, by show time; `ahead`
    /// is which way it goes on where it rests or is slow.
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
            // A route that creeps says no direction, and yet leads away to the side in time.
            self.travel = towards;
            self.choose_sense(body.facing);
        }
        self.rest(motion, stray || ahead.is_some(), body)
    }

    /// Turns towards the way ahead without a route under way.
    pub(crate) fn prepare(&mut self, ahead: Vec2, body: BodyPose) -> Setpoint {
        self.travel = ahead;
        self.choose_sense(body.facing);
        Setpoint { speed_mps: 0.0, turn_radps: self.turn_on_the_spot(body.facing) }
    }

    /// Front or back first, whichever is the shorter turn; not changed for small differences.
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
        let steered = self.sense * speed.max(SLOW_MPS);
        Setpoint {
            speed_mps: self.sense * speed * cos.max(0.0) + closing_mps(along),
            turn_radps: curve + ACROSS * steered * across + TURN * sin,
        }
    }

    /// On the slow part of a route it turns to the way ahead in time, and keeps up with the route as far as it can.
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

/// How fast it makes good what it is off along its front, m/s.
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
    fn on_the_route_it_does_what_the_route_does() {
        let setpoint = Follow::new().step(&moving(0.0, 0.0), None, body(0.0));
        assert_eq!(setpoint, Setpoint { speed_mps: 0.2, turn_radps: 0.0 });
        let curve = Motion { acceleration: Vec2::new(0.0, 0.1), ..moving(0.0, 0.0) };
        assert!((Follow::new().step(&curve, None, body(0.0)).turn_radps - 0.5).abs() < 1e-12);
    }

    #[test]
    fn far_behind_it_closes_in_no_faster_than_it_can_brake() {
        // Ten times behind by as much as it may be, it once drove on 14 mm beyond its route.
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
