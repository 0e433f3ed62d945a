//! Wheels that do not turn although they are told to: a robot that stands in everybody's way and says so at once.

/// Told less than this, rad/s, a wheel may stand: 22 mm/s of an Elisa-3.
const TOLD_RADPS: f64 = 5.0;
/// A wheel that turns less than this share of what it is told does not turn.
const SHARE: f64 = 0.2;
/// So many steps in a row; wheels answer a step or two late.
const STEPS: u8 = 6;

/// Compares what wheels are told with what they do.
#[derive(Debug, Default)]
pub(crate) struct StallDetector {
    told_radps: [f64; 2],
    /// `[wheel]`: steps in a row in which it did not turn.
    steps: [u8; 2],
    /// A wheel has turned since power-on: what says how far wheels turn works.
    turned: bool,
}

impl StallDetector {
    /// What the wheels are told from now on, rad/s.
    #[inline]
    pub(crate) fn command(&mut self, wheels_radps: [f64; 2]) {
        self.told_radps = wheels_radps;
    }

    /// Takes how far the wheels turned in a step of `dt` seconds. Whether one of them is stuck.
    #[inline]
    pub(crate) fn sample(&mut self, turns_rad: [f64; 2], dt: f64) -> bool {
        self.turned |= turns_rad != [0.0; 2];
        for ((told, turn), steps) in self.told_radps.iter().zip(turns_rad).zip(&mut self.steps) {
            let stands = told.abs() > TOLD_RADPS && turn.abs() < SHARE * told.abs() * dt;
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

    const DT: f64 = 0.016;

    #[test]
    fn a_wheel_that_stands_although_it_was_told_to_turn_is_stuck() {
        let mut stall = StallDetector::default();
        stall.command([40.0, 40.0]);
        assert!(!stall.sample([40.0 * DT; 2], DT));
        let stuck: [bool; 12] = core::array::from_fn(|_| stall.sample([40.0 * DT, 0.0], DT));
        let times = stuck.iter().filter(|&&stuck| stuck).count();
        assert!(times == 2 && stuck[5] && stuck[11], "{stuck:?}");
    }

    #[test]
    fn wheels_may_answer_late_creep_or_stand_as_told() {
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
