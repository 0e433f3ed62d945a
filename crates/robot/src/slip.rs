//! Estimate of wheel slip. The slip of each wheel is the sum of a mean, learned over metres, and a deviation from the
//! mean that changes within a second.

use crate::covariance::Drift;

/// Share by which the deviation from the mean decays in a step: a time constant of 1 s. The deviation also decays while
/// the wheels stand, because their grip may be different when they turn again.
const FORGETTING: f64 = 0.015;
/// Distance over which the first estimate of the mean is averaged, metres. With a smaller value, noise of the first
/// fixes is taken for slip.
const FIRST_M: f64 = 0.1;
/// Distance over which the mean is averaged in the long run, metres. With a smaller value, the mean follows single
/// bumps. With a larger value, the mean does not follow worn tyres or another floor within a show.
const LAST_M: f64 = 2.0;
/// First estimate of the deviation, 1 sigma, as a share of the expected slip. With a larger value, the first fixes
/// change the slip faster.
const WANDER: f64 = 0.3;
/// Lower bound of the deviation, 1 sigma, as a share of its first estimate. With a smaller value, the filter ignores
/// slip after a drive with steady slip.
const LEAST: f64 = 0.25;
/// Upper bound of the deviation, 1 sigma, as a share of the wheel's turning. With a larger value, strange fixes can
/// make the filter trust the wheels too little.
const MOST: f64 = 0.1;
/// Largest absolute slip, as a share of the wheel's turning. A wheel with more slip is lifted or stuck.
const BOUND: f64 = 0.4;

const _: () = assert!(FIRST_M < LAST_M && MOST < BOUND);

/// Slip of the left and the right wheel: the shares of their turning that do not move the robot.
#[derive(Debug)]
pub(crate) struct SlipEstimate {
    now: [f64; 2],
    mean: [f64; 2],
    /// Variance of the deviation from the mean, common to both wheels.
    wander: f64,
    /// Lower and upper bound of `wander`.
    bounds: [f64; 2],
    /// Variance of the mean before anything was learned.
    unknown: f64,
    /// Distance over which the mean was learned, at most [`LAST_M`], metres.
    learned_m: f64,
}

impl SlipEstimate {
    /// The estimate before anything was learned. `expected`: expected slip as a share of the turning, 1 sigma.
    pub(crate) fn new(expected: f64) -> Self {
        let wander = WANDER * expected.clamp(0.002, BOUND);
        Self {
            now: [0.0; 2],
            mean: [0.0; 2],
            wander: wander * wander,
            bounds: [LEAST * LEAST * wander * wander, MOST * MOST],
            unknown: expected * expected,
            learned_m: 0.0,
        }
    }

    /// Converts the distances that the left and the right wheel would cover without slip into distances over the
    /// ground, metres.
    pub(crate) fn ground_m(&self, ways: [f64; 2]) -> [f64; 2] {
        [ways[0] * (1.0 - self.now[0]), ways[1] * (1.0 - self.now[1])]
    }

    /// The present slip, left and right.
    pub(crate) fn now(&self) -> [f64; 2] {
        self.now
    }

    /// Predicts the slip over one step: the slip returns towards its mean.
    pub(crate) fn predict(&mut self) {
        self.now[0] += (self.mean[0] - self.now[0]) * FORGETTING;
        self.now[1] += (self.mean[1] - self.now[1]) * FORGETTING;
    }

    /// Adds the filter's corrections to the slip of the left and the right wheel.
    pub(crate) fn correct(&mut self, by: [f64; 2]) {
        self.now[0] = (self.now[0] + by[0]).clamp(-BOUND, BOUND);
        self.now[1] = (self.now[1] + by[1]).clamp(-BOUND, BOUND);
    }

    /// Updates mean and deviation after a drive of `way_m` metres. `uncertain`: variance of the estimated slip.
    pub(crate) fn learn(&mut self, way_m: f64, uncertain: f64) {
        self.learned_m = (self.learned_m + way_m).min(LAST_M);
        let share = way_m / (self.learned_m + FIRST_M);
        let mut square = 0.0;
        for (mean, now) in self.mean.iter_mut().zip(self.now) {
            let off = now - *mean;
            *mean += share * off;
            square += 0.5 * off * off;
        }
        self.wander += share * (square + uncertain - self.wander);
        self.wander = self.wander.clamp(self.bounds[0], self.bounds[1]);
    }

    /// Model of how the slip changes in this number of steps.
    pub(crate) fn drift(&self, steps: u32) -> Drift {
        let share = FIRST_M / (FIRST_M + self.learned_m);
        let mean = self.unknown * share * share;
        Drift { left: 1.0 - FORGETTING * f64::from(steps), variance: self.wander + mean }
    }
}
