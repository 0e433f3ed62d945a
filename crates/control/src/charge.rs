//! Estimates how long a battery lasts from the slope of the charge that its robot reports.
//!
//! Robots report whole percents. The moment at which the reported number falls is more precise than the number. So the
//! slope is that of a least-squares line through the falls.

use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};

/// Largest number of falls of the charge (mostly by 1 %) that are kept: about a quarter of a battery. With more, a
/// change of the slope is noticed late. With fewer, the slope is less certain.
const FALLS: usize = 24;
/// Least number of falls from which a slope is computed.
const FALLS_LEAST: usize = 3;
/// Least rise of the charge that means that the battery was charged or changed, percent. A smaller rise is noise.
const CHARGED: u8 = 2;

/// The charge of one robot over time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ChargeTrend {
    /// When the reported charge fell to a new least value, show clock, and that value in percent. The first report is
    /// no fall, because no value was known before.
    falls: Vec<(Instant, u8)>,
    /// Least reported charge since the battery was charged, percent; `None` before the first report.
    least: Option<u8>,
}

impl ChargeTrend {
    /// Adds a reported charge, percent.
    pub fn report(&mut self, now: Instant, percent: u8) {
        let Some(least) = self.least else {
            self.least = Some(percent);
            return;
        };
        if percent >= least.saturating_add(CHARGED) {
            *self = Self { falls: Vec::new(), least: Some(percent) };
        } else if percent < least {
            if self.falls.len() == FALLS {
                self.falls.remove(0);
            }
            self.falls.push((now, percent));
            self.least = Some(percent);
        }
    }

    /// Returns the time from `now` until the battery is empty, if its charge falls on as measured. `None` while too few
    /// falls are known, or if the charge does not fall.
    pub fn left(&self, now: Instant) -> Option<Span> {
        let (first, last) = (self.falls.first()?.0, self.falls.last()?);
        if self.falls.len() < FALLS_LEAST {
            return None;
        }
        let count = self.falls.len() as f64;
        let points = self.falls.iter().map(|&(at, percent)| ((at - first).as_secs(), f64::from(percent)));
        let (sum_s, sum) = points.clone().fold((0.0, 0.0), |(a, b), (s, percent)| (a + s, b + percent));
        let (mean_s, mean) = (sum_s / count, sum / count);
        let (over, under) = points.fold((0.0, 0.0), |(over, under), (s, percent)| {
            (over + (s - mean_s) * (percent - mean), under + (s - mean_s) * (s - mean_s))
        });
        let slope = over / under;
        if slope >= 0.0 || slope.is_nan() {
            return None;
        }
        let empty_s = f64::from(last.1) / -slope - (now - last.0).as_secs();
        Some(Span::from_secs(empty_s.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::random::split_mix;

    /// Returns the relative error of the remaining time after ten minutes; `None` if that time is not known. The
    /// battery lasts `life_s`; its reports, each two seconds, are off by up to `noise` percent.
    fn error_after_ten_minutes(life_s: f64, noise: f64, seed: u64) -> Option<f64> {
        let mut state = seed;
        let mut unit = || (split_mix(&mut state) >> 11) as f64 / (1u64 << 53) as f64;
        let mut trend = ChargeTrend::default();
        let start = 60.0 + 40.0 * unit();
        let charge = |s: f64| start - 100.0 * s / life_s;
        for step in 0..300 {
            let s = 2.0 * f64::from(step);
            let read = charge(s) + noise * (2.0 * unit() - 1.0);
            trend.report(Instant((s * 1e6) as u64), read.clamp(0.0, 100.0) as u8);
        }
        let true_s = charge(600.0) * life_s / 100.0;
        let left_s = trend.left(Instant(600_000_000))?.as_secs();
        Some((left_s - true_s).abs() / true_s)
    }

    #[test]
    fn what_is_left_is_known_after_ten_minutes() {
        for (life_s, noise) in
            [(1_800.0, 0.0), (3_600.0, 0.0), (7_200.0, 0.0), (3_600.0, 0.3), (7_200.0, 0.3)]
        {
            let mut errors: Vec<f64> =
                (0..200).filter_map(|seed| error_after_ten_minutes(life_s, noise, seed)).collect();
            assert!(errors.len() > 190, "{} of 200 know it", errors.len());
            errors.sort_by(f64::total_cmp);
            let (median, worst) = (errors[errors.len() / 2], errors[errors.len() * 95 / 100]);
            assert!(median < 0.025 && worst < 0.045, "{life_s} s, noise {noise} %: {median:.3}, {worst:.3}");
        }
    }

    #[test]
    fn a_battery_that_is_charged_begins_anew() {
        let mut trend = ChargeTrend::default();
        for (minute, percent) in [80, 79, 78, 77, 76].into_iter().enumerate() {
            trend.report(Instant(minute as u64 * 60_000_000), percent);
        }
        let now = Instant(4 * 60_000_000);
        assert_eq!(trend.left(now), Some(Span::from_secs(76.0 * 60.0)));
        trend.report(now, 77);
        assert!(trend.left(now).is_some(), "noise");
        trend.report(now, 90);
        assert_eq!(trend.left(now), None);
    }
}
