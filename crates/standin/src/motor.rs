//! A motor as in Webots: it turns at a rate, or towards a position.
//!
//! Source: reference manual of R2025a, `Motor`, and `WbMotor::computeCurrentDynamicVelocity`. Towards a position, a
//! motor turns at `P` times the remaining angle, but no faster than its rate; the sign of the rate is ignored.

/// Proportional part of a motor's default `controlPID`, rad/s per radian of error (stated in Webots' reference manual,
/// `Motor`).
const P: f64 = 10.0;
/// `maxVelocity` of the LightBot's motors, rad/s (stated in `webots/protos/LightBot.proto`).
pub const RATE_MAX_RADPS: f64 = 133.33;

/// The last command that a motor got.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Target position, in radians as the motor's sensor reads them. Infinite: the motor turns at its rate without end.
    pub target_rad: f64,
    /// Commanded rate, rad/s. Towards a finite target position it is only a limit, and its sign is ignored.
    pub radps: f64,
}

impl Default for Motor {
    /// In Webots, motors begin with their highest rate and a target at their present position, which is 0 here.
    fn default() -> Self {
        Self { target_rad: 0.0, radps: RATE_MAX_RADPS }
    }
}

impl Motor {
    /// Returns the rate at which the motor turns while its sensor reads `read_rad`, rad/s.
    #[must_use]
    pub fn rate_radps(&self, read_rad: f64) -> f64 {
        if self.target_rad.is_infinite() {
            return self.radps;
        }
        let most = self.radps.abs();
        (P * (self.target_rad - read_rad)).clamp(-most, most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_is_reached_and_kept_and_infinity_never() {
        let mut read_rad = 5.0;
        let motor = Motor { target_rad: -3.0, radps: 60.0 };
        assert_eq!(motor.rate_radps(5.0), -60.0);
        for _ in 0..100 {
            read_rad += motor.rate_radps(read_rad) * 0.016;
        }
        assert!((read_rad + 3.0).abs() < 1e-6, "{read_rad}");
        assert_eq!(Motor { target_rad: f64::INFINITY, radps: -60.0 }.rate_radps(1e6), -60.0);
        assert_eq!(Motor { target_rad: 9.0, radps: 0.0 }.rate_radps(0.0), 0.0);
        assert_eq!(Motor::default().rate_radps(0.0), 0.0);
    }
}
