//! Waiting for precise clocks: robots whose clocks differ are not where their routes say, and brake for each other.

use lightbots_base::{Instant, Span};

/// A clock is precise below this, 2 sigma, microseconds: 2.7 mm at full speed, less than the 3 mm that plans leave.
/// Above, robots on slow links brake for each other where nothing is wrong. Below, all wait longer on such a link; on one
/// of 5 to 20 ms each way, clocks are this good as soon as they are set.
pub(crate) const PRECISE_US: u32 = 10_000;
/// A run waits for this long in all: as long as robots ask quickly. Above, a link on which clocks are never precise
/// delays the show in vain.
const MOST: Span = Span::from_millis(30_000);

/// How long a run has waited for clocks.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ClockWait {
    waited: Span,
    /// When it was looked at last while robots are waited for.
    looked: Option<Instant>,
}

impl ClockWait {
    /// Whether robots are waited for.
    pub fn is_on(&self) -> bool {
        self.looked.is_some()
    }

    /// All wait for clocks, at `now`. The time since the last look; `None`: they have waited long enough.
    pub fn look(&mut self, now: Instant) -> Option<Span> {
        let passed = self.looked.map_or(Span::ZERO, |looked| now - looked);
        self.looked = Some(now);
        self.waited += passed;
        (self.waited < MOST).then_some(passed)
    }

    /// No robot is waited for.
    pub fn end(&mut self) {
        self.looked = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_waits_for_half_a_minute_in_all() {
        let mut wait = ClockWait::default();
        let at = |secs: u64| Instant(secs * 1_000_000);
        assert_eq!(wait.look(at(5)), Some(Span::ZERO));
        assert_eq!(wait.look(at(25)), Some(Span::from_millis(20_000)));
        wait.end();
        assert!(!wait.is_on());
        assert_eq!(wait.look(at(100)), Some(Span::ZERO));
        assert_eq!(wait.look(at(109)), Some(Span::from_millis(9_000)));
        assert_eq!(wait.look(at(110)), None);
    }
}
