//! How much of their turning the wheels lose: each has a mean of its own, learned over metres, and wanders about it.

use crate::covariance::Drift;

/// What a deviation from the mean loses in a step: it is forgotten in about a second, also of wheels that stand, as nothing
/// tells how they will hold when they turn again.
const FORGETTING: f64 = 0.015;
/// After so much way the mean is learned as fast as it is first believed, and never slower than after so much more.
const FIRST_M: f64 = 0.1;
const LAST_M: f64 = 2.0;
/// The wander is taken for this share of the slip expected, until more is known; …
const WANDER: f64 = 0.3;
/// … never for less than this share of that, nor for more than this.
const LEAST: f64 = 0.25;
const MOST: f64 = 0.1;
/// Slip beyond this is no slip.
const BOUND: f64 = 0.4;

/// Slip of the left and the right wheel, shares of their turning.
#[derive(Debug)]
pub(crate) struct Slip {
    now: [f64; 2],
    mean: [f64; 2],
    /// Variance of the wander about the mean, and its bounds.
    wander: f64,
    bounds: [f64; 2],
    /// Variance of the mean before anything was learned.
    unknown: f64,
    /// Way from which the mean was learned, metres.
    learned_m: f64,
}

impl Slip {
    /// Wheels that are expected to slip by up to this share.
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

    /// What of a way by the wheels' turning is made good, left and right.
    pub(crate) fn ground(&self, ways: [f64; 2]) -> [f64; 2] {
        [ways[0] * (1.0 - self.now[0]), ways[1] * (1.0 - self.now[1])]
    }

    /// Slip as it is now.
    pub(crate) fn now(&self) -> [f64; 2] {
        self.now
    }

    /// A step went by.
    pub(crate) fn pass(&mut self) {
        self.now[0] += (self.mean[0] - self.now[0]) * FORGETTING;
        self.now[1] += (self.mean[1] - self.now[1]) * FORGETTING;
    }

    /// It turned out to be so much more, or less.
    pub(crate) fn correct(&mut self, by: [f64; 2]) {
        self.now[0] = (self.now[0] + by[0]).clamp(-BOUND, BOUND);
        self.now[1] = (self.now[1] + by[1]).clamp(-BOUND, BOUND);
    }

    /// Learns mean and wander from a way of so many metres, with slip as uncertain as this variance.
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

    /// How it is expected to change in so many steps.
    pub(crate) fn drift(&self, steps: u32) -> Drift {
        let share = FIRST_M / (FIRST_M + self.learned_m);
        let mean = self.unknown * share * share;
        Drift { left: 1.0 - FORGETTING * f64::from(steps), variance: self.wander + mean }
    }
}
