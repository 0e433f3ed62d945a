//! Estimation of a sensor's noise from its readings (an adaptive Kalman filter).
//!
//! The variance of the noise is half the mean square of the difference between two consecutive innovations. In this
//! difference a constant error of the prediction cancels out.

/// Time constant of the average, number of readings: 2 s of fixes. With a smaller value, the estimated variance is
/// noisy. With a larger value, the growing noise of a sensor that becomes worse is noticed later.
const READINGS: f64 = 128.0;
/// Upper bound of half a squared difference, as a multiple of the variance: 3 sigma. It keeps outliers from counting as
/// noise.
const CLIP: f64 = 9.0;

/// Estimated noise variance of one sensor.
#[derive(Debug)]
pub(crate) struct NoiseEstimate {
    /// Variance from the configuration.
    described: f64,
    /// Variance estimated from the innovations.
    seen: f64,
}

impl NoiseEstimate {
    /// Begins with the configured variance.
    pub(crate) fn new(described: f64) -> Self {
        Self { described, seen: described }
    }

    /// The variance to use: never less than the configured one.
    pub(crate) fn variance(&self) -> f64 {
        // Not `max`, because that handles NaN at some cost in every step.
        if self.seen > self.described { self.seen } else { self.described }
    }

    /// Updates the estimate. `square`: squared difference of two consecutive innovations, per coordinate.
    pub(crate) fn update(&mut self, square: f64) {
        let (read, most) = (0.5 * square, CLIP * self.variance());
        self.seen += (if read < most { read } else { most } - self.seen) * (1.0 / READINGS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_worse_than_described_gets_its_own_noise_and_a_better_one_the_described() {
        let mut noise = NoiseEstimate::new(4.0);
        for _ in 0..1000 {
            noise.update(2.0 * 25.0);
        }
        assert!((noise.variance() - 25.0).abs() < 0.5);
        for _ in 0..1000 {
            noise.update(0.1);
        }
        assert_eq!(noise.variance(), 4.0);
        noise.update(f64::MAX);
        assert!(noise.variance() < 5.0);
    }
}
