//! Detection of stuck wheels, which do not turn although they are commanded to. A robot with a stuck wheel is faulty,
//! because it blocks the paths of other robots.

/// A wheel that is commanded to turn slower than this cannot count as stuck, rad/s: 22 mm/s of an Elisa-3. With a
/// smaller value, friction is taken for a stall.
const LEAST_RADPS: f64 = 5.0;
/// A wheel counts as not turning if it turns by less than this share of its commanded turn. With a larger value, a
/// wheel that slips or is slow counts as stuck.
const SHARE: f64 = 0.2;
/// Number of steps in a row without turning at which a wheel counts as stuck. With less than three, the dead time of
/// the motors counts as a stall. With a larger value, a robot that is stuck is reported later.
const STEPS: u8 = 6;

/// Compares commanded with measured wheel rates.
#[derive(Debug, Default)]
pub(crate) struct StallDetector {
    commanded_radps: [f64; 2],
    /// Number of steps in a row in which the left and the right wheel did not turn although they were commanded to.
    steps: [u8; 2],
    /// Whether a wheel has turned since power-on, which shows that the encoders work.
    turned: bool,
}

impl StallDetector {
    /// Sets the commanded wheel rates from now on, rad/s.
    #[inline]
    pub(crate) fn command(&mut self, wheels_radps: [f64; 2]) {
        self.commanded_radps = wheels_radps;
    }

    /// Checks the turns of the left and the right wheel in a step of `dt` seconds, radians. Returns whether a wheel is
    /// stuck. If so, the counts begin again at 0. No wheel is stuck before one has turned since power-on.
    #[inline]
    pub(crate) fn sample(&mut self, turns_rad: [f64; 2], dt: f64) -> bool {
        self.turned |= turns_rad != [0.0; 2];
        for ((commanded, turn), steps) in self.commanded_radps.iter().zip(turns_rad).zip(&mut self.steps) {
            let stands = commanded.abs() > LEAST_RADPS && turn.abs() < SHARE * commanded.abs() * dt;
            *steps = if stands { steps.saturating_add(1) } else { 0 };
        }
        let stuck = self.turned && self.steps.iter().any(|&steps| steps >= STEPS);
        if stuck {
            self.steps = [0; 2];
        }
        stuck
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Duration of a step, seconds.
    const DT: f64 = 0.016;

    #[test]
    fn a_wheel_that_stands_against_its_command_is_stuck() {
        let mut stall = StallDetector::default();
        stall.command([40.0, 40.0]);
        assert!(!stall.sample([40.0 * DT; 2], DT));
        let stuck: [bool; 12] = core::array::from_fn(|_| stall.sample([40.0 * DT, 0.0], DT));
        let times = stuck.iter().filter(|&&stuck| stuck).count();
        assert!(times == 2 && stuck[5] && stuck[11], "{stuck:?}");
    }

    #[test]
    fn wheels_may_answer_late_creep_or_stand_as_commanded() {
        let mut stall = StallDetector::default();
        stall.sample([1.0; 2], DT);
        for told in [0.0, 4.0, -4.0] {
            stall.command([told; 2]);
            assert!((0..20).all(|_| !stall.sample([0.0; 2], DT)), "{told}");
        }
        stall.command([60.0; 2]);
        for _ in 0..20 {
            assert!(
                !stall.sample([0.0; 2], DT) && !stall.sample([0.0; 2], DT) && !stall.sample([0.3; 2], DT)
            );
        }
    }

    #[test]
    fn a_robot_that_cannot_tell_how_far_its_wheels_turn_is_not_stuck() {
        let mut stall = StallDetector::default();
        stall.command([60.0; 2]);
        assert!((0..20).all(|_| !stall.sample([0.0; 2], DT)));
    }
}
