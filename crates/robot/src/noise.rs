//! Estimation of a sensor's noise from its readings (an adaptive Kalman filter).
//!
//! Half the mean square of the difference of two consecutive innovations is the variance of the noise. A constant error of
//! the prediction cancels out.

/// Time constant of the average, readings: 2 s. Below, the estimate itself is noisy. Above, a sensor that becomes worse is
/// trusted for longer.
const READINGS: f64 = 128.0;
/// Largest half of a squared difference that counts, as a multiple of the variance, because outliers are no noise: 3
/// sigma.
const CLIP: f64 = 9.0;

/// The noise variance of one sensor.
#[derive(Debug)]
pub(crate) struct NoiseEstimate {
    /// Variance by the configuration.
    described: f64,
    /// Variance as estimated.
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

    /// Updates the estimate by the squared difference of two consecutive innovations, per coordinate.
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
