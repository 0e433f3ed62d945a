//! The progress of all robots on paths of different lengths: the share of its path that each robot has driven.

use lightbots_base::Limits;
use lightbots_show::Easing;

/// The progress as a function of time. It is the same for all robots.
pub(crate) struct ProgressLaw {
    /// Duration of the drive, seconds.
    pub drive_s: f64,
    ramp_s: f64,
}

impl ProgressLaw {
    /// The fastest legal progress with this easing if the longest path has a length of `longest_m` metres. Its
    /// duration, but at least 0.4 s, is multiplied by `stretch`.
    pub fn new(longest_m: f64, limits: &Limits, easing: Easing, stretch: f64) -> Self {
        let (speed, accel) = (limits.speed_mps, limits.accel_mps2);
        let halves = 2.0 * (longest_m / accel).sqrt();
        let least = match easing {
            Easing::Swift if longest_m > speed * speed / accel => longest_m / speed + speed / accel,
            Easing::Swift => halves,
            Easing::Gentle => halves.max(2.0 * longest_m / speed),
        };
        Self::lasting(least.max(0.4) * stretch, limits, easing)
    }

    /// Progress that lasts `drive_s` seconds, with ramps of speed as the limits and the easing ask for.
    pub fn lasting(drive_s: f64, limits: &Limits, easing: Easing) -> Self {
        let ramp_s = match easing {
            Easing::Swift => (limits.speed_mps / limits.accel_mps2).min(drive_s / 2.0),
            Easing::Gentle => drive_s / 2.0,
        };
        Self { drive_s, ramp_s }
    }

    /// Duration of the ramp of speed at each end, seconds.
    pub fn ramp_s(&self) -> f64 {
        self.ramp_s
    }

    /// Progress per second, `t` seconds after the start.
    pub fn rate(&self, t: f64) -> f64 {
        let top = 1.0 / (self.drive_s - self.ramp_s);
        top * (t.min(self.drive_s - t) / self.ramp_s).clamp(0.0, 1.0)
    }

    /// Progress, 0 to 1, `t` seconds after the start.
    pub fn share(&self, t: f64) -> f64 {
        let top = 1.0 / (self.drive_s - self.ramp_s);
        let ramp = |t: f64| top * t * t / (2.0 * self.ramp_s);
        if t <= 0.0 {
            0.0
        } else if t < self.ramp_s {
            ramp(t)
        } else if t <= self.drive_s - self.ramp_s {
            top * (t - self.ramp_s / 2.0)
        } else {
            1.0 - ramp((self.drive_s - t).max(0.0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_keeps_the_limits_it_is_made_for() {
        for (longest, easing) in [(2.0, Easing::Swift), (0.05, Easing::Swift), (2.0, Easing::Gentle)] {
            let progress = ProgressLaw::new(longest, &Limits::ELISA_3, easing, 1.0);
            let at = |i: i32| longest * progress.share(progress.drive_s * f64::from(i) / 1000.0);
            let step = progress.drive_s / 1000.0;
            for i in 1..1000 {
                assert!((at(i + 1) - at(i)) / step <= 0.27 * 1.0001);
                assert!((at(i + 1) - 2.0 * at(i) + at(i - 1)).abs() / (step * step) <= 1.001);
            }
            assert!(at(0) == 0.0 && (at(1000) - longest).abs() < 1e-12);
        }
    }
}
