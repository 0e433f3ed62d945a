//! The drive train of an Elisa-3: how the body moves at commanded wheel rates. Fitted to measurements in Webots R2023b
//! of 2026-11-21; docs/simulator.md shows both side by side. Every constant below comes from these measurements.

use lightbots_base::braking::GRIP_MPS2;

use crate::track::{WHEEL_RADIUS_M, turn_radps};

/// Largest change of the speed in a step of 16 ms, m/s: the grip of the tyres.
const SPEED_CHANGE_MPS: f64 = GRIP_MPS2 * 0.016;
/// Largest change of the speed in the third and in the fourth step of a braking that grip limits, m/s: the body hops.
const HOP_CHANGE_MPS: [f64; 2] = [0.129, 0.076];
/// Change of the turning rate in a step if the wanted change is larger than [`TURN_SNAP`] times this, rad/s.
const TURN_CHANGE_RADPS: f64 = 3.12;
/// A change of the turning rate up to this multiple of [`TURN_CHANGE_RADPS`] is still made in one step.
const TURN_SNAP: f64 = 1.2;
/// The body tips over its wheels if it gains more speed than this in a step, m/s. It stumbles when it falls back. A
/// ramp of 1 m/s² gains 0.016 m/s.
const TIPPING_MPS: f64 = 0.0205;
/// Speed lost in the stumble, as a multiple of the speed gained beyond [`TIPPING_MPS`] in the two steps before.
const STUMBLE: f64 = 1.053;
/// In the step after the stumble, the speed exceeds the speed without stumbling by this share of the speed lost in the
/// stumble.
const REBOUND: f64 = 0.199;

/// The state of one robot's drive train.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DriveTrain {
    /// Wheel rates commanded in the last step, left and right, rad/s. They act from the next step on: the dead time is
    /// one step.
    commanded: [f64; 2],
    /// Present rates of the wheels, rad/s.
    wheels: [f64; 2],
    /// Speed along the body's front, without the effect of stumbling, m/s.
    speed_mps: f64,
    /// Turning rate, rad/s.
    turn_radps: f64,
    /// Sum of the speed gained beyond [`TIPPING_MPS`] in the step in which the body tipped and in the step after it,
    /// m/s.
    jolt_mps: f64,
    /// Number of steps since the body tipped over its wheels, with the step in which it tipped; 0 if it is not tipped.
    tipped: u8,
    /// Number of successive steps, up to this one, in which grip limited the braking; 0 again after the fourth.
    sliding: u8,
}

/// Motion of a body during one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twist {
    /// Along its front, m/s.
    pub speed_mps: f64,
    /// Counter-clockwise, rad/s.
    pub turn_radps: f64,
}

impl DriveTrain {
    /// Rates of the wheels in the last step, rad/s.
    #[inline]
    pub fn wheels(&self) -> [f64; 2] {
        self.wheels
    }

    /// Whether the drive train rests and is commanded to rest.
    #[inline]
    pub fn rests(&self) -> bool {
        self.commanded == [0.0; 2]
            && self.wheels == [0.0; 2]
            && self.speed_mps == 0.0
            && self.turn_radps == 0.0
            && self.tipped == 0
    }

    /// Advances the drive train by one step of 16 ms. `command`: wheel rates from the next step on, left and right,
    /// rad/s. `grip`: share of each wheel's turning that moves the body. Returns the body's motion in this step.
    #[inline]
    pub fn step(&mut self, command: [f64; 2], grip: [f64; 2]) -> Twist {
        self.wheels = self.commanded;
        self.commanded = command;
        let (left, right) = (self.wheels[0] * grip[0], self.wheels[1] * grip[1]);
        let turn_change = turn_radps(left, right) - self.turn_radps;
        self.turn_radps += if turn_change.abs() <= TURN_CHANGE_RADPS * TURN_SNAP {
            turn_change
        } else {
            TURN_CHANGE_RADPS.copysign(turn_change)
        };
        let goal_mps = 0.5 * WHEEL_RADIUS_M * (left + right);
        let kick = self.change_speed(goal_mps);
        Twist { speed_mps: self.speed_mps + kick, turn_radps: self.turn_radps }
    }

    /// Changes the speed towards `goal_mps`. Returns what stumbling adds to the speed in this step, m/s.
    #[inline]
    fn change_speed(&mut self, goal_mps: f64) -> f64 {
        let before = self.speed_mps;
        let change = goal_mps - before;
        let grip = match self.sliding {
            0 | 1 => SPEED_CHANGE_MPS,
            steps => HOP_CHANGE_MPS[usize::from(steps - 2).min(1)],
        };
        if change.abs() <= grip {
            self.speed_mps = goal_mps;
            self.sliding = 0;
        } else {
            self.speed_mps = before + grip.copysign(change);
            let brakes = change * before < 0.0;
            self.sliding = if brakes && self.sliding < 3 { self.sliding + 1 } else { 0 };
        }
        let gained = self.speed_mps.abs() - before.abs();
        if gained <= TIPPING_MPS && self.tipped == 0 {
            return 0.0;
        }
        self.stumble(gained)
    }

    /// Returns what stumbling adds to the speed in this step, m/s. A body that gains speed too quickly tips over its
    /// wheels for two steps, falls back in the third and swings forward in the fourth. `gained`: increase of the speed
    /// in this step, m/s.
    fn stumble(&mut self, gained: f64) -> f64 {
        self.tipped += 1;
        let forward = 1f64.copysign(self.speed_mps);
        match self.tipped {
            1 | 2 => {
                self.jolt_mps += (gained - TIPPING_MPS).max(0.0);
                0.0
            }
            3 => -forward * STUMBLE * self.jolt_mps,
            _ => {
                let back = forward * STUMBLE * REBOUND * self.jolt_mps;
                self.tipped = 0;
                self.jolt_mps = 0.0;
                back
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Duration of a step, seconds.
    const STEP_S: f64 = 0.016;

    /// Speeds and turning rates of the steps in which new rates act, after 50 steps of the old ones.
    fn after(old: [f64; 2], new: [f64; 2], steps: usize) -> Vec<Twist> {
        let mut drive = DriveTrain::default();
        for _ in 0..50 {
            drive.step(old, [1.0; 2]);
        }
        drive.step(new, [1.0; 2]);
        (0..steps).map(|_| drive.step(new, [1.0; 2])).collect()
    }

    fn travelled(twists: &[Twist]) -> f64 {
        twists.iter().map(|twist| twist.speed_mps * STEP_S).sum()
    }

    fn near(value: f64, measured: f64, share: f64) {
        assert!((value - measured).abs() <= measured.abs() * share, "{value} for {measured}");
    }

    #[test]
    fn wheels_act_one_step_late() {
        let mut drive = DriveTrain::default();
        assert_eq!(drive.step([4.0, 4.0], [1.0; 2]).speed_mps, 0.0);
        assert_eq!(drive.step([4.0, 4.0], [1.0; 2]).speed_mps, 4.0 * WHEEL_RADIUS_M);
    }

    #[test]
    fn a_start_in_one_command_stumbles_as_measured() {
        let start = after([0.0; 2], [60.0; 2], 20);
        for (step, speed) in [(0, 0.188), (1, 0.270), (2, 0.029), (4, 0.270), (9, 0.270)] {
            near(start[step].speed_mps, speed, 0.02);
        }
        near(20.0 * 0.27 * STEP_S - travelled(&start), 0.0044, 0.02);
        let back = after([0.0; 2], [-60.0; 2], 20);
        assert!(start.iter().zip(&back).all(|(a, b)| a.speed_mps == -b.speed_mps));
    }

    #[test]
    fn stops_are_as_long_as_measured() {
        near(travelled(&after([60.0; 2], [0.0; 2], 20)), 0.0013, 0.02);
        assert_eq!(after([60.0; 2], [0.0; 2], 2)[1].speed_mps, 0.0);
        let fast = after([0.6 / WHEEL_RADIUS_M; 2], [0.0; 2], 20);
        near(travelled(&fast), 0.012, 0.02);
        assert!(fast[3].speed_mps > 0.0 && fast[4].speed_mps == 0.0);
    }

    #[test]
    fn spins_run_on_as_measured() {
        let over_deg = |rate: f64| {
            let twists = after([-rate, rate], [0.0; 2], 20);
            twists.iter().map(|twist| (twist.turn_radps * STEP_S).to_degrees()).sum::<f64>()
        };
        near(over_deg(60.0), 19.0, 0.02);
        // Measured to whole degrees.
        assert!((over_deg(20.0) - 1.0).abs() < 0.5);
    }

    #[test]
    fn gentle_ramps_are_followed_and_hard_ones_stumble() {
        let worst = |accel: f64| {
            let mut drive = DriveTrain::default();
            let rate = |step: i32| (accel * STEP_S * f64::from(step)).min(0.27) / WHEEL_RADIUS_M;
            (0..60).fold(0.0, |worst: f64, step| {
                let twist = drive.step([rate(step); 2], [1.0; 2]);
                worst.max((twist.speed_mps - rate((step - 1).max(0)) * WHEEL_RADIUS_M).abs())
            })
        };
        assert!(worst(0.25) < 1e-12 && worst(0.5) < 1e-12);
        assert!(worst(1.0) < 0.005);
        assert!(worst(2.0) > 0.01 && worst(4.0) > worst(2.0) && worst(8.0) > worst(4.0));
    }

    #[test]
    fn a_body_comes_to_rest() {
        let mut drive = DriveTrain::default();
        for wheels in [[60.0, 60.0], [-60.0, 60.0], [133.0, -20.0]] {
            for _ in 0..7 {
                drive.step(wheels, [0.97, 0.99]);
            }
        }
        for _ in 0..12 {
            drive.step([0.0; 2], [0.97, 0.99]);
        }
        assert!(drive.rests());
    }
}
