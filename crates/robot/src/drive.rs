//! The drive base converts speed and turning rate into wheel rates, with acceleration ramps and saturation.

use lightbots_base::{Limits, Vec2};

use crate::filter::turned;

/// Acceleration of the ramp, as a multiple of the acceleration that plans use. Braking for others is not limited by it,
/// and speed lost by that may be regained faster ([`RECOVERY`]). With a smaller value, a robot cannot catch up with its
/// route.
const ACCEL_RESERVE: f64 = 1.25;
/// Largest speed, as a multiple of the speed limit that plans use. With a smaller value, a robot that is late at full
/// speed cannot catch up with its route.
const SPEED_RESERVE: f64 = 1.25;
/// Acceleration with which a robot regains its speed after braking without a ramp, as a multiple of the ramp: about the
/// grip of the tyres. An Elisa-3 slips at it and falls behind by at most 4 mm. With the ramp alone, it falls behind by
/// 20 mm. Robots close behind then brake in turn, each more than the one before.
const RECOVERY: f64 = 9.0;
/// Number of braked steps from which a robot that drives gently regains its speed by the ramp. After fewer braked
/// steps, it regains its speed by [`RECOVERY`]. If a sensor error brakes a robot in one step, regaining speed by the
/// ramp would leave it 18 mm behind. The robot behind would run into it (fault campaign of docs/campaign.md, seeds 498
/// and 703).
const STOP_AND_GO: u32 = 2;
/// Largest change of the commanded turning rate, rad/s²: 2 m/s² at the wheels.
const TURN_ACCEL: f64 = 100.0;
/// Dead time of the drive, seconds: one step until the motors react to a command, and one step for which a command is
/// held.
const DEAD_S: f64 = 0.032;
/// Below this commanded speed the robot counts as standing or turning on the spot, m/s.
const STANDING_MPS: f64 = 0.01;
/// Below this commanded turning rate the robot counts as not turning, rad/s.
const STANDING_RADPS: f64 = 0.2;

/// Commanded motion of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Setpoint {
    /// Speed along the body's front, m/s; negative is backwards.
    pub speed_mps: f64,
    /// Turning rate, rad/s, counter-clockwise.
    pub turn_radps: f64,
}

/// Place of the body, stage metres, and the unit vector of its heading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyPose {
    pub at: Vec2,
    pub facing: Vec2,
}

/// The drive base, with its latest command.
#[derive(Debug, Default)]
pub(crate) struct DriveBase {
    commanded: Setpoint,
    /// Number of steps in which the robot was braked without a ramp since it last drove at its wanted speed.
    braked_steps: u32,
    /// Whether the robot regains its speed gently, by the ramp, after [`STOP_AND_GO`] braked steps or more.
    pub gently: bool,
}

impl DriveBase {
    /// Predicted pose in `dt` seconds, when the next command takes effect. Motors react one step late, so the robot
    /// moves by the last command until then.
    pub(crate) fn foresee(&self, body: BodyPose, dt: f64) -> BodyPose {
        let facing = turned(body.facing, within(self.commanded.turn_radps * dt, 0.1));
        let way = self.commanded.speed_mps * dt;
        BodyPose { at: body.at + (body.facing + facing) * (0.5 * way), facing }
    }

    /// Changes the command towards the setpoint `want`, by at most the ramps, and returns the wheel rates, left and
    /// right, rad/s. Speed that was lost by braking without a ramp may be regained faster, by [`RECOVERY`]. `slip`:
    /// slip of the wheels, left and right, as a share of their turning. `dt`: length of the step, seconds.
    pub(crate) fn step(&mut self, want: Setpoint, slip: [f64; 2], dt: f64, limits: &Limits) -> [f64; 2] {
        let speed_max = limits.speed_mps * SPEED_RESERVE;
        let speed = within(want.speed_mps, speed_max);
        let turn = within(want.turn_radps, limits.turn_radps);
        let (ramp_step, turn_step) = (limits.accel_mps2 * ACCEL_RESERVE * dt, TURN_ACCEL * dt);
        let missing = speed - self.commanded.speed_mps;
        if missing * self.commanded.speed_mps < 0.0 || missing.abs() <= ramp_step {
            self.braked_steps = 0;
        }
        let speed_step = if self.recovers_fast() { RECOVERY * ramp_step } else { ramp_step };
        self.commanded = Setpoint {
            speed_mps: self.commanded.speed_mps + within(missing, speed_step),
            turn_radps: self.commanded.turn_radps + within(turn - self.commanded.turn_radps, turn_step),
        };
        self.wheels(slip, limits)
    }

    /// Like [`Self::step`], but with a speed of at most `most_mps`. If the command is faster, the robot brakes to
    /// `most_mps` without a ramp.
    pub(crate) fn step_within(
        &mut self,
        want: Setpoint,
        most_mps: f64,
        slip: [f64; 2],
        dt: f64,
        limits: &Limits,
    ) -> [f64; 2] {
        self.step(want, slip, dt, limits);
        if self.commanded.speed_mps.abs() > most_mps {
            self.commanded.speed_mps = within(self.commanded.speed_mps, most_mps);
            self.braked_steps = self.braked_steps.saturating_add(1);
        }
        self.wheels(slip, limits)
    }

    /// Whether speed that was lost by braking without a ramp is regained by [`RECOVERY`] instead of by the ramp.
    fn recovers_fast(&self) -> bool {
        self.braked_steps > 0 && !(self.gently && self.braked_steps >= STOP_AND_GO)
    }

    /// The setpoint of a robot that has nothing to do: it brakes by the ramp on its present curve until it stands.
    /// Robots close behind detect this in time; they could not if it stopped at once. Zero if the robot stands or only
    /// turns.
    pub(crate) fn rolling_out(&self, dt: f64, limits: &Limits) -> Setpoint {
        if !self.rolls() {
            return Setpoint::default();
        }
        let Setpoint { speed_mps, turn_radps } = self.commanded;
        let next_mps = speed_mps - within(speed_mps, limits.accel_mps2 * ACCEL_RESERVE * dt);
        Setpoint { speed_mps: next_mps, turn_radps: turn_radps * next_mps / speed_mps }
    }

    /// Whether the commanded speed counts as driving: it is at least [`STANDING_MPS`], forwards or backwards.
    pub(crate) fn rolls(&self) -> bool {
        self.commanded.speed_mps.abs() >= STANDING_MPS
    }

    /// Distance that the robot drives until it stands if it brakes by the ramp from now on, metres, including the dead
    /// time.
    pub(crate) fn braking_m(&self, limits: &Limits) -> f64 {
        let speed_mps = self.commanded.speed_mps.abs();
        speed_mps * (speed_mps / (2.0 * ACCEL_RESERVE * limits.accel_mps2) + DEAD_S)
    }

    /// Commanded speed along the front, m/s.
    pub(crate) fn speed_mps(&self) -> f64 {
        self.commanded.speed_mps
    }

    /// Stops without a ramp and returns wheel rates of 0. An Elisa-3 then stands after 32 ms and 1.3 mm (Webots R2023b,
    /// 2026-11-21).
    pub(crate) fn halt(&mut self) -> [f64; 2] {
        *self = Self::default();
        [0.0; 2]
    }

    /// Whether the robot is commanded to stand: its speed and turning rate are nearly 0.
    pub(crate) fn stands(&self) -> bool {
        !self.rolls() && self.commanded.turn_radps.abs() < STANDING_RADPS
    }

    /// Wheel rates of the command, left and right, rad/s. If one exceeds the motor's limit, both are scaled down, so
    /// that the robot stays on its curve.
    fn wheels(&self, slip: [f64; 2], limits: &Limits) -> [f64; 2] {
        let Setpoint { speed_mps, turn_radps } = self.commanded;
        let half = turn_radps * limits.track_m * 0.5;
        let rates = [
            (speed_mps - half) / (limits.wheel_radius_m * (1.0 - slip[0])),
            (speed_mps + half) / (limits.wheel_radius_m * (1.0 - slip[1])),
        ];
        if rates.iter().all(|rate| rate.abs() <= limits.wheel_radps) {
            return rates;
        }
        let scale = limits.wheel_radps / rates[0].abs().max(rates[1].abs());
        [rates[0] * scale, rates[1] * scale]
    }
}

/// Returns `value`, limited to ±`most`. `f64::clamp` is not used, because it also checks its bounds, which costs time
/// in every step.
#[inline]
fn within(value: f64, most: f64) -> f64 {
    let value = if value < -most { -most } else { value };
    if value > most { most } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheels_follow_the_ramp_and_the_measured_numbers() {
        let mut drive = DriveBase::default();
        let want = Setpoint { speed_mps: 0.27, turn_radps: 0.0 };
        let first = drive.step(want, [0.0; 2], 0.016, &Limits::ELISA_3);
        assert!((first[0] - 0.02 / 0.0045).abs() < 1e-9);
        for _ in 0..20 {
            drive.step(want, [0.0; 2], 0.016, &Limits::ELISA_3);
        }
        assert!((drive.step(want, [0.0; 2], 0.016, &Limits::ELISA_3)[1] - 60.0).abs() < 1e-9);
        assert_eq!(drive.halt(), [0.0; 2]);
        assert!(drive.stands());
    }

    #[test]
    fn speed_lost_by_braking_is_regained_faster_than_by_the_ramp() {
        let mut drive = DriveBase::default();
        let want = Setpoint { speed_mps: 0.27, turn_radps: 0.0 };
        let steps_to_speed = |drive: &mut DriveBase| {
            (1..60).find(|_| {
                drive.step(want, [0.0; 2], 0.016, &Limits::ELISA_3);
                drive.speed_mps() >= 0.27
            })
        };
        assert_eq!(steps_to_speed(&mut drive), Some(14));
        drive.step_within(want, 0.0, [0.0; 2], 0.016, &Limits::ELISA_3);
        assert_eq!((drive.speed_mps(), steps_to_speed(&mut drive)), (0.0, Some(2)));
        drive.step_within(want, 0.0, [0.0; 2], 0.016, &Limits::ELISA_3);
        drive.halt();
        assert_eq!(steps_to_speed(&mut drive), Some(14));
    }

    #[test]
    fn a_gentle_robot_regains_by_the_ramp_what_it_lost_in_more_than_one_step() {
        let want = Setpoint { speed_mps: 0.27, turn_radps: 0.0 };
        let steps_to_speed = |braked_steps: u32| {
            let mut drive = DriveBase { gently: true, ..DriveBase::default() };
            for _ in 0..20 {
                drive.step(want, [0.0; 2], 0.016, &Limits::ELISA_3);
            }
            for _ in 0..braked_steps {
                drive.step_within(want, 0.06, [0.0; 2], 0.016, &Limits::ELISA_3);
            }
            (1..60).find(|_| {
                drive.step(want, [0.0; 2], 0.016, &Limits::ELISA_3);
                drive.speed_mps() >= 0.27
            })
        };
        assert_eq!([1, 2, 3].map(steps_to_speed), [Some(2), Some(11), Some(11)]);
    }

    #[test]
    fn it_knows_how_far_it_goes_on_when_it_stops() {
        let mut drive = DriveBase::default();
        for _ in 0..40 {
            drive.step(Setpoint { speed_mps: 0.2, turn_radps: 0.0 }, [0.0; 2], 0.016, &Limits::ELISA_3);
        }
        let (expected_m, mut way_m) = (drive.braking_m(&Limits::ELISA_3), 0.2 * 0.032);
        while !drive.stands() {
            way_m += drive.step(Setpoint::default(), [0.0; 2], 0.016, &Limits::ELISA_3)[0] * 0.0045 * 0.016;
        }
        assert!((expected_m - way_m).abs() < 0.002, "{expected_m} {way_m}");
    }

    #[test]
    fn rolling_out_it_keeps_its_curve_and_brakes_by_the_ramp() {
        let mut drive = DriveBase::default();
        for _ in 0..40 {
            drive.step(Setpoint { speed_mps: 0.27, turn_radps: 1.35 }, [0.0; 2], 0.016, &Limits::ELISA_3);
        }
        let mut steps = 0;
        while drive.rolls() {
            let Setpoint { speed_mps, turn_radps } = drive.commanded;
            assert!((turn_radps / speed_mps - 5.0).abs() < 0.01, "{turn_radps} {speed_mps}");
            let wanted = drive.rolling_out(0.016, &Limits::ELISA_3);
            drive.step(wanted, [0.0; 2], 0.016, &Limits::ELISA_3);
            let lost_mps = speed_mps - drive.speed_mps();
            assert!(lost_mps > 0.0 && lost_mps < 0.0201, "{lost_mps}");
            steps += 1;
        }
        assert_eq!(steps, 14);
        assert_eq!(drive.rolling_out(0.016, &Limits::ELISA_3), Setpoint::default());
    }

    #[test]
    fn turning_on_the_spot_stays_below_twenty_at_the_wheels() {
        let mut drive = DriveBase::default();
        let spin = Setpoint { speed_mps: 0.0, turn_radps: 99.0 };
        let wheels = (0..20).map(|_| drive.step(spin, [0.0; 2], 0.016, &Limits::ELISA_3)).last().unwrap();
        assert!(wheels[1] > 20.0 && wheels[1] < 20.2 && wheels[0] == -wheels[1]);
    }

    #[test]
    fn a_wheel_at_its_limit_keeps_the_curve() {
        let limits = Limits { wheel_radps: 30.0, ..Limits::ELISA_3 };
        let mut drive = DriveBase::default();
        let want = Setpoint { speed_mps: 0.27, turn_radps: 2.0 };
        let wheels = (0..40).map(|_| drive.step(want, [0.0; 2], 0.016, &limits)).last().unwrap();
        assert!((wheels[1] - 30.0).abs() < 1e-9);
        assert!((wheels[0] / wheels[1] - (0.27 - 0.0402) / (0.27 + 0.0402)).abs() < 1e-9);
    }
}
