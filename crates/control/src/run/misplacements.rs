//! Counts how often one robot stood elsewhere than the plan had it.

use lightbots_base::{Instant, Span};

/// Largest number of times that all is planned again because one robot stands elsewhere. The next time the robot drops
/// out. A robot that is somewhere else each time must not hold up the show.
const REPLANS_MAX: u8 = 5;
/// Least time between two counts for one robot. With less, one push counts several times.
const SETTLES: Span = Span::from_millis(1_000);
/// After this time without a count, earlier counts of the robot are forgotten.
const FORGOTTEN: Span = Span::from_millis(60_000);

/// How often all was planned again because one robot stood elsewhere than the plan had it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Misplacements {
    times: u8,
    last: Option<Instant>,
}

impl Misplacements {
    /// Counts that the robot stands elsewhere. Returns whether all may be planned again for it; `false` if the robot
    /// stood elsewhere too often. `None` if the last count is less than `SETTLES` ago, so that this one does not count.
    pub fn count(&mut self, now: Instant) -> Option<bool> {
        let since = self.last.map(|last| now - last);
        if since.is_some_and(|since| since < SETTLES) {
            return None;
        }
        if since.is_some_and(|since| since > FORGOTTEN) {
            self.times = 0;
        }
        let is_bearable = self.times < REPLANS_MAX;
        (self.times, self.last) = (self.times.saturating_add(1), Some(now));
        Some(is_bearable)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_push_counts_once_and_only_many_within_a_minute_are_too_many() {
        let mut known = Misplacements::default();
        let at = |seconds: f64| Instant::ZERO + Span::from_secs(seconds);
        assert_eq!((known.count(at(1.0)), known.count(at(1.5))), (Some(true), None));
        let often: Vec<_> = (1..=5).map(|number| known.count(at(1.0 + 3.0 * f64::from(number)))).collect();
        assert_eq!(often, [Some(true), Some(true), Some(true), Some(true), Some(false)]);
        assert_eq!(known.count(at(100.0)), Some(true));
    }
}
