//! The positioning system: fixes with noise, bias, delay, drop-outs and outliers.

use lightbots_base::{Pose, Span, Vec2, wrap};

use crate::conditions::FixConditions;
use crate::dice::{Dice, Purpose, normal3_of};
use crate::world::{STEP, STEP_S};

/// Mean time from the end of a robot's drop-out until its next drop-out begins, seconds, however rarely there are
/// fixes.
const DROPOUT_EVERY_S: f64 = 20.0;
/// Largest error of an outlier along each axis, metres.
const OUTLIER_M: f64 = 1.0;

/// The position sensors of all robots.
#[derive(Clone, Debug)]
pub(crate) struct FixSensors {
    conditions: FixConditions,
    dice: Dice,
    /// `[robot]`: constant error of the robot's fixes, metres.
    bias: Vec<Vec2>,
    /// `past[step % length][robot]`: true poses in the last steps; empty if fixes are not delayed.
    past: Vec<Vec<Pose>>,
    /// `[robot]`: the first step after the robot's latest drop-out; empty if there are no drop-outs.
    dark_until: Vec<u64>,
    step: u64,
    /// Whether noise is the only error of fixes: no bias, delay, skipped steps, drop-outs or outliers.
    plain: bool,
    /// `[robot]`: random bits for the robot's noise in this step; empty unless `plain`.
    draws: Vec<u64>,
}

impl FixSensors {
    /// The position sensors of robots that stand at the poses `starts`.
    pub fn new(conditions: &FixConditions, starts: &[Pose], seed: u64) -> Self {
        let mut dice = Dice::new(seed, Purpose::Sensors);
        let delay_steps = (conditions.delay.0.max(0) + STEP.0 / 2) / STEP.0;
        let past = if delay_steps > 0 { vec![starts.to_vec(); delay_steps as usize + 1] } else { Vec::new() };
        let plain = past.is_empty()
            && conditions.every <= 1
            && conditions.dropout == Span::ZERO
            && conditions.outliers == 0.0
            && conditions.bias_m == 0.0;
        let dark = if conditions.dropout > Span::ZERO { starts.len() } else { 0 };
        let mut offset = || dice.between(-conditions.bias_m, conditions.bias_m);
        let bias = starts.iter().map(|_| Vec2::new(offset(), offset())).collect();
        Self {
            conditions: conditions.clone(),
            bias,
            past,
            dark_until: vec![0; dark],
            step: 0,
            plain,
            draws: vec![0; if plain { starts.len() } else { 0 }],
            dice,
        }
    }

    /// Begins the next step. Call it before the fixes of the step are taken. `alive[robot]`: whether the robot has
    /// power.
    pub fn next_step(&mut self, alive: &[bool]) {
        self.step += 1;
        for (draw, _) in self.draws.iter_mut().zip(alive).filter(|&(_, &alive)| alive) {
            *draw = self.dice.bits();
        }
    }

    /// Whether the fixes of a step may be taken in any order of robots. If not, take them in ascending order, because
    /// all robots draw from one random stream.
    pub fn in_any_order(&self) -> bool {
        self.plain
    }

    /// The fix that `robot` gets if `pose` is its true pose; `None` if it gets no fix in this step. The reason is a
    /// drop-out, or it is not its turn. Call it once a step for each robot that has power.
    #[inline]
    pub fn fix(&mut self, robot: usize, pose: Pose) -> Option<Pose> {
        if self.plain {
            return Some(self.noisy(pose, self.draws[robot]));
        }
        let pose = self.delayed(robot, pose);
        let staggered = self.step + robot as u64;
        // In every step, so that drop-outs are as frequent however rarely there are fixes.
        let is_dark = self.is_dark(robot);
        if is_dark || !staggered.is_multiple_of(u64::from(self.conditions.every.max(1))) {
            return None;
        }
        let draw = self.dice.bits();
        let mut fix = self.noisy(Pose { at: pose.at + self.bias[robot], ..pose }, draw);
        if self.dice.chance(self.conditions.outliers) {
            let mut off = || self.dice.between(-OUTLIER_M, OUTLIER_M);
            fix.at += Vec2::new(off(), off());
        }
        Some(fix)
    }

    #[inline]
    fn noisy(&self, pose: Pose, draw: u64) -> Pose {
        let [x, y, turn] = normal3_of(draw);
        let sigma = self.conditions.place_sigma_m;
        Pose {
            at: pose.at + Vec2::new(x * sigma, y * sigma),
            heading: wrap(pose.heading + turn * self.conditions.heading_sigma_rad),
        }
    }

    fn delayed(&mut self, robot: usize, pose: Pose) -> Pose {
        let steps = self.past.len() as u64;
        if steps == 0 {
            return pose;
        }
        self.past[(self.step % steps) as usize][robot] = pose;
        self.past[((self.step + 1) % steps) as usize][robot]
    }

    fn is_dark(&mut self, robot: usize) -> bool {
        let Some(until) = self.dark_until.get_mut(robot) else { return false };
        if self.step >= *until && self.dice.chance(STEP_S / DROPOUT_EVERY_S) {
            *until = self.step + (self.conditions.dropout.0 / STEP.0) as u64;
        }
        self.step < *until
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conditions::Conditions;
    use crate::faults::Faults;

    /// Fixes of a robot that moves 1 mm a step along x from 0, for 5000 steps. Each element is the error of the place
    /// along x and of the heading, or nothing.
    fn errors(faults: &str) -> Vec<Option<(f64, f64)>> {
        errors_of(&Faults::parse(faults).unwrap())
    }

    fn errors_of(faults: &Faults) -> Vec<Option<(f64, f64)>> {
        let conditions = faults.added_to(Conditions::ideal()).fixes;
        let mut sensors = FixSensors::new(&conditions, &[Pose::default()], 4);
        (1..=5000)
            .map(|step| {
                let truth = Pose::new(Vec2::new(f64::from(step) * 0.001, 0.0), 0.5);
                sensors.next_step(&[true]);
                sensors.fix(0, truth).map(|fix| (fix.at.x - truth.at.x, fix.heading - truth.heading))
            })
            .collect()
    }

    fn deviation(values: impl Iterator<Item = f64> + Clone) -> f64 {
        let count = values.clone().count() as f64;
        (values.map(|value| value * value).sum::<f64>() / count).sqrt()
    }

    #[test]
    fn ideal_fixes_are_true() {
        assert!(errors_of(&Faults::default()).iter().all(|&error| error == Some((0.0, 0.0))));
    }

    #[test]
    fn fixes_are_the_same_in_whatever_order_they_are_asked_for() {
        let fixes = |order: [usize; 2]| {
            let mut sensors = FixSensors::new(&Conditions::default().fixes, &[Pose::default(); 3], 4);
            assert!(sensors.in_any_order());
            sensors.next_step(&[true, false, true]);
            let mut fixes = order.map(|robot| (robot, sensors.fix(robot, Pose::default())));
            fixes.sort_by_key(|fix| fix.0);
            fixes
        };
        assert_eq!(fixes([0, 2]), fixes([2, 0]));
        assert_ne!(fixes([0, 2])[0].1, fixes([0, 2])[1].1);
    }

    #[test]
    fn noise_has_the_stated_deviation() {
        let errors = errors("gps=2mm,heading=1deg");
        let place = deviation(errors.iter().map(|error| error.unwrap().0));
        let heading = deviation(errors.iter().map(|error| error.unwrap().1)).to_degrees();
        assert!((place - 0.002).abs() < 1e-4 && (heading - 1.0).abs() < 0.05, "{place} {heading}");
    }

    #[test]
    fn delayed_fixes_are_old() {
        let errors = errors("fix-delay=96ms");
        assert!(errors[10..].iter().all(|error| (error.unwrap().0 + 0.006).abs() < 1e-9));
    }

    #[test]
    fn fixes_come_seldom_drop_out_and_lie_as_told() {
        assert_eq!(errors("fix-every=5").iter().flatten().count(), 1000);
        let dark = errors("fix-dropout=1s").iter().filter(|error| error.is_none()).count();
        assert!((62..1000).contains(&dark), "{dark}");
        let wild = errors("fix-outlier=10%").iter().filter(|error| error.unwrap().0.abs() > 0.01).count();
        assert!((400..600).contains(&wild), "{wild}");
        let bias = errors("bias=1cm")[0].unwrap().0;
        assert!(bias != 0.0 && bias.abs() < 0.01);
        assert!(errors("bias=1cm").iter().all(|error| (error.unwrap().0 - bias).abs() < 1e-9));
    }

    /// A robot is in the dark for a second every 20 s, however rarely it gets fixes.
    #[test]
    fn drop_outs_are_as_frequent_between_rare_fixes() {
        for every in [1, 5] {
            let faults = Faults::parse(&format!("fix-every={every},fix-dropout=1s")).unwrap();
            let conditions = faults.added_to(Conditions::ideal()).fixes;
            let mut sensors = FixSensors::new(&conditions, &[Pose::default()], 4);
            let fixes = (0..50_000)
                .filter(|_| {
                    sensors.next_step(&[true]);
                    sensors.fix(0, Pose::default()).is_some()
                })
                .count();
            let dark = 1.0 - f64::from(every) * fixes as f64 / 50_000.0;
            assert!((0.03..0.07).contains(&dark), "every {every}: {dark} of the time");
        }
    }
}
