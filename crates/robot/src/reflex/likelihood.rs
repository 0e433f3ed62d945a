//! Likelihoods of readings.

/// Natural logarithm of the density at `off` of a normal distribution with mean 0.
pub(crate) fn log_density(off: f32, variance: f32) -> f32 {
    -0.5 * (off * off / variance + libm::logf(core::f32::consts::TAU * variance))
}

/// The standard normal distribution function, approximated by the logistic function (within 0.01).
pub(crate) fn cumulative(sigmas: f32) -> f32 {
    1.0 / (1.0 + libm::expf(-1.702 * sigmas.clamp(-20.0, 20.0)))
}

/// Natural logarithm of the sum of likelihoods, given their natural logarithms; about −1e9 if there are none.
pub(crate) fn log_sum(logs: impl Iterator<Item = f32> + Clone) -> f32 {
    let most = logs.clone().fold(-1e9, f32::max);
    most + libm::logf(logs.map(|log| libm::expf(log - most)).sum::<f32>().max(1e-30))
}
