//! Wheel slip: each wheel moves the body by less than it turns. The missing share changes slowly.

use crate::dice::Dice;

/// Number of steps after which a wheel's slip gets a new goal: half a second.
const STRIDE: u32 = 32;

/// The slip of one robot's two wheels, left and right.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WheelSlip {
    /// Mean slip of each wheel, as a share of its turning.
    mean: [f64; 2],
    /// Present slip of each wheel, as a share of its turning.
    now: [f64; 2],
    /// Change of the slip per step until the next goal.
    slope: [f64; 2],
    steps_left: u32,
}

impl WheelSlip {
    /// Wheels whose slip, averaged over all robots, is `level` (0.03 means 3 %). The mean slip of one wheel is drawn
    /// uniformly between a half and one and a half of `level`. The present slip deviates from that mean by up to half
    /// of `level`.
    pub fn new(level: f64, dice: &mut Dice) -> Self {
        let mean = std::array::from_fn(|_| if level > 0.0 { level * dice.between(0.5, 1.5) } else { 0.0 });
        Self { mean, now: mean, slope: [0.0; 2], steps_left: dice.below(u64::from(STRIDE)) as u32 }
    }

    /// Advances the slip by one step. Returns the share of each wheel's turning that moves the body.
    #[inline]
    pub fn grip(&mut self, level: f64, dice: &mut Dice) -> [f64; 2] {
        if level > 0.0 {
            if self.steps_left == 0 {
                self.steps_left = STRIDE;
                for wheel in 0..2 {
                    let goal = self.mean[wheel] + level * dice.between(-0.5, 0.5);
                    self.slope[wheel] = (goal - self.now[wheel]) * (1.0 / f64::from(STRIDE));
                }
            }
            self.steps_left -= 1;
            self.now[0] += self.slope[0];
            self.now[1] += self.slope[1];
        }
        [1.0 - self.now[0], 1.0 - self.now[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dice::Purpose;

    #[test]
    fn slip_stays_about_its_level_and_wanders() {
        let mut dice = Dice::new(5, Purpose::Slip);
        let (mut sum, mut low, mut high) = (0.0, 1f64, 0f64);
        for _ in 0..200 {
            let mut slip = WheelSlip::new(0.03, &mut dice);
            for _ in 0..500 {
                for grip in slip.grip(0.03, &mut dice) {
                    sum += 1.0 - grip;
                    low = low.min(1.0 - grip);
                    high = high.max(1.0 - grip);
                }
            }
        }
        assert!((sum / 200_000.0 - 0.03).abs() < 0.003);
        assert!((-1e-9..0.01).contains(&low) && high > 0.05 && high < 0.06 + 1e-9);
    }

    #[test]
    fn without_slip_every_turn_counts() {
        let mut dice = Dice::new(5, Purpose::Slip);
        assert_eq!(WheelSlip::new(0.0, &mut dice).grip(0.0, &mut dice), [1.0, 1.0]);
    }
}
