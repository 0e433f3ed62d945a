//! Waiting for precise clocks. If their clocks differ, robots are not where the plan has them, and brake for each
//! other.

use lightbots_base::{Instant, Span};

/// Largest error of a clock that counts as precise, 2 sigma, microseconds. At full speed it is 2.7 mm, less than the 3
/// mm that plans leave. With a larger value, robots on slow links brake for each other without need. With a smaller
/// one, all wait longer on a slow link. On links of 5 to 20 ms each way, clocks are this good as soon as they are set.
pub(crate) const PRECISE_US: u32 = 10_000;
/// Longest time in all that a run waits for clocks. Robots send time questions in quick succession for as long (R28:
/// 150 answers, one every 0.2 s). With a longer wait, a link on which clocks are never precise delays the show in vain.
const MOST: Span = Span::from_millis(30_000);

/// How long a run has waited for precise clocks.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ClockWait {
    waited: Span,
    /// When the wait was last counted. `None` while the run does not wait.
    looked: Option<Instant>,
}

impl ClockWait {
    /// Whether the run waits for precise clocks.
    pub fn is_on(&self) -> bool {
        self.looked.is_some()
    }

    /// Counts the wait until `now`, and returns the time since the last call (zero at the beginning of a wait). `None`
    /// once the run has waited for `MOST` in all.
    pub fn look(&mut self, now: Instant) -> Option<Span> {
        let passed = self.looked.map_or(Span::ZERO, |looked| now - looked);
        self.looked = Some(now);
        self.waited += passed;
        (self.waited < MOST).then_some(passed)
    }

    /// Ends a wait: the time until the next [`look`](Self::look) does not count.
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
