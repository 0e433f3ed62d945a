//! How noisy a sensor really is, beside what its type is described as.
//!
//! Half the mean square of the difference of two readings in a row is the variance of its noise, whatever else is
//! wrong with what they are compared with.

/// Readings over which the noise is averaged.
const READINGS: f64 = 128.0;
/// A difference counts as no greater than so many times what is expected (squared).
const CLIP: f64 = 9.0;

/// The noise of one sensor.
#[derive(Debug)]
pub(crate) struct NoiseEstimate {
    described: f64,
    seen: f64,
}

impl NoiseEstimate {
    /// As its type is described: variance.
    pub(crate) fn new(described: f64) -> Self {
        Self { described, seen: described }
    }

    /// The variance to reckon with: never better than described.
    pub(crate) fn variance(&self) -> f64 {
        // Not `max`, which minds NaN at some cost, and this is asked for at every step.
        if self.seen > self.described { self.seen } else { self.described }
    }

    /// Two readings in a row differed by this beyond what the robot did: mean square of one coordinate.
    pub(crate) fn learn(&mut self, square: f64) {
        let (read, most) = (0.5 * square, CLIP * self.variance());
        self.seen += (if read < most { read } else { most } - self.seen) * (1.0 / READINGS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_worse_than_described_is_trusted_less_and_a_better_one_as_described() {
        let mut trust = NoiseEstimate::new(4.0);
        for _ in 0..1000 {
            trust.learn(2.0 * 25.0);
        }
        assert!((trust.variance() - 25.0).abs() < 0.5);
        for _ in 0..1000 {
            trust.learn(0.1);
        }
        assert_eq!(trust.variance(), 4.0);
        trust.learn(f64::MAX);
        assert!(trust.variance() < 5.0);
    }
}
