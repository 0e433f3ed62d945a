//! From speed and turning rate to wheels: ramps, limits, and what to do when a wheel cannot.

use lightbots_base::{Limits, Vec2};

use crate::filter::turned;

/// Feedback may ask for a little more than plans do.
const ACCEL_RESERVE: f64 = 1.25;
const SPEED_RESERVE: f64 = 1.25;
/// Speed that it lost by braking at once comes back so many times as fast as its ramp would give it: about as fast as tyres
/// grip. An Elisa-3 stumbles at that, which costs it 4 mm at most; by the ramp it would lose two centimetres, and those
/// close behind it would have to brake in turn, each a little more than the one before.
const RECOVERS: f64 = 9.0;
/// Turning rate changes by at most this, rad/s²: 2 m/s² at the wheels.
const TURN_ACCEL: f64 = 100.0;
/// Motors answer so late, and what is told is told until the next step, seconds.
const DEAD_S: f64 = 0.032;
/// Slower than this counts as standing.
const STANDING_MPS: f64 = 0.01;
const STANDING_RADPS: f64 = 0.2;

/// What the body is to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Setpoint {
    /// Along the body's front, m/s; negative is backwards.
    pub speed_mps: f64,
    /// Counter-clockwise, rad/s.
    pub turn_radps: f64,
}

/// Where the body is and which way it faces: a unit vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyPose {
    pub at: Vec2,
    pub facing: Vec2,
}

/// The drive base: what it was told last.
#[derive(Debug, Default)]
pub(crate) struct DriveBase {
    told: Setpoint,
    /// It braked at once, and has not got its speed back.
    braked: bool,
    /// It does not get that back at once.
    pub gently: bool,
}

impl DriveBase {
    /// Where the body will be in `dt` seconds, when what is said now takes effect: motors answer one step late.
    pub(crate) fn foresee(&self, body: BodyPose, dt: f64) -> BodyPose {
        let facing = turned(body.facing, within(self.told.turn_radps * dt, 0.1));
        let way = self.told.speed_mps * dt;
        BodyPose { at: body.at + (body.facing + facing) * (0.5 * way), facing }
    }

    /// Goes towards a setpoint within the ramps; wheel rates left and right, rad/s, of wheels that lose these shares of
    /// their turning.
    pub(crate) fn step(&mut self, want: Setpoint, slip: [f64; 2], dt: f64, limits: &Limits) -> [f64; 2] {
        let speed_max = limits.speed_mps * SPEED_RESERVE;
        let speed = within(want.speed_mps, speed_max);
        let turn = within(want.turn_radps, limits.turn_radps);
        let (ramp_step, turn_step) = (limits.accel_mps2 * ACCEL_RESERVE * dt, TURN_ACCEL * dt);
        let missing = speed - self.told.speed_mps;
        self.braked &= missing * self.told.speed_mps >= 0.0 && missing.abs() > ramp_step;
        let speed_step = if self.braked && !self.gently { RECOVERS * ramp_step } else { ramp_step };
        self.told = Setpoint {
            speed_mps: self.told.speed_mps + within(missing, speed_step),
            turn_radps: self.told.turn_radps + within(turn - self.told.turn_radps, turn_step),
        };
        self.wheels(slip, limits)
    }

    /// Goes towards a setpoint within the ramps, but along its front no faster than `most_mps`, at once.
    pub(crate) fn step_within(
        &mut self,
        want: Setpoint,
        most_mps: f64,
        slip: [f64; 2],
        dt: f64,
        limits: &Limits,
    ) -> [f64; 2] {
        self.step(want, slip, dt, limits);
        if self.told.speed_mps.abs() > most_mps {
            self.told.speed_mps = within(self.told.speed_mps, most_mps);
            self.braked = true;
        }
        self.wheels(slip, limits)
    }

    /// How far it goes on when it stops by its ramp, metres.
    pub(crate) fn braking_m(&self, limits: &Limits) -> f64 {
        let speed_mps = self.told.speed_mps.abs();
        speed_mps * (speed_mps / (2.0 * ACCEL_RESERVE * limits.accel_mps2) + DEAD_S)
    }

    /// What it was told last along its front, m/s.
    pub(crate) fn speed_mps(&self) -> f64 {
        self.told.speed_mps
    }

    /// Stops at once, without a ramp: an Elisa-3 stands after 32 ms and 1.3 mm.
    pub(crate) fn halt(&mut self) -> [f64; 2] {
        *self = Self::default();
        [0.0; 2]
    }

    /// Whether it was told to stand, or as good as.
    pub(crate) fn stands(&self) -> bool {
        self.told.speed_mps.abs() < STANDING_MPS && self.told.turn_radps.abs() < STANDING_RADPS
    }

    /// Where a wheel would have to turn too fast, both turn slower in proportion: the curve stays, the speed gives.
    fn wheels(&self, slip: [f64; 2], limits: &Limits) -> [f64; 2] {
        let Setpoint { speed_mps, turn_radps } = self.told;
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

/// `value`, at most `most` in size. `f64::clamp` also checks its bounds, at some cost in every step.
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
    fn speed_lost_by_braking_comes_back_faster_than_by_the_ramp_but_a_start_does_not() {
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
    fn it_knows_how_far_it_goes_on_when_it_stops() {
        let mut drive = DriveBase::default();
        for _ in 0..40 {
            drive.step(Setpoint { speed_mps: 0.2, turn_radps: 0.0 }, [0.0; 2], 0.016, &Limits::ELISA_3);
        }
        let (told, mut way_m) = (drive.braking_m(&Limits::ELISA_3), 0.2 * 0.032);
        while !drive.stands() {
            way_m += drive.step(Setpoint::default(), [0.0; 2], 0.016, &Limits::ELISA_3)[0] * 0.0045 * 0.016;
        }
        assert!((told - way_m).abs() < 0.002, "{told} {way_m}");
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
