//! Limits the messages of each robot: messages beyond a rate do not count, and an event names the robot.
//!
//! A broker that is not ours may pass on everything. A robot that sends too many messages must not take the time that
//! reports of other robots need.

use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};

/// How many messages of one robot count.
struct Rate {
    /// Time between two messages in the long run: ten times as often as a robot of ours reports.
    every: Span,
    /// Number of messages that count at once, before the rate limits them. A robot that comes back to a long show
    /// acknowledges 100 parts of routes.
    burst: i64,
}

/// The embedded broker has the same bound for a robot. Lower: acknowledgements are lost. Higher: one robot delays the
/// messages of others.
const RATE: Rate = Rate { every: Span::from_millis(10), burst: 1_000 };
/// Least time between two events that name the same robot.
const NAMED_EVERY: Span = Span::from_millis(60_000);

/// Whether a message counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counted {
    /// It does.
    Yes,
    /// It does not, and an event has to name the sender.
    FloodToName,
    /// It does not; the sender was named lately.
    Flood,
}

/// How often a robot has sent messages (generic cell rate algorithm, ITU-T I.371).
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct ReportRate {
    /// When all counted messages would have been sent at the allowed rate.
    paid_until: Instant,
    /// When an event last named the robot.
    named_at: Option<Instant>,
}

impl ReportRate {
    /// Counts a message that arrives at `now`, and returns whether it is within the rate.
    pub fn count(&mut self, now: Instant) -> Counted {
        let paid_until = self.paid_until.max(now) + RATE.every;
        if paid_until - now <= RATE.every * RATE.burst {
            self.paid_until = paid_until;
            return Counted::Yes;
        }
        if self.named_at.is_some_and(|at| now - at < NAMED_EVERY) {
            return Counted::Flood;
        }
        self.named_at = Some(now);
        Counted::FloodToName
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_and_then_a_rate_count_and_a_flood_is_named_once() {
        let mut rate = ReportRate::default();
        let now = Instant(5_000_000);
        assert!((0..1_000).all(|_| rate.count(now) == Counted::Yes));
        assert_eq!(rate.count(now), Counted::FloodToName);
        assert!((0..1_000).all(|_| rate.count(now) == Counted::Flood));
        // It still counts a hundred times a second.
        let second = (0..335_000).filter(|us| rate.count(now + Span(us * 3)) == Counted::Yes).count();
        assert_eq!(second, 100);
    }

    #[test]
    fn a_robot_of_ours_never_floods() {
        let mut rate = ReportRate::default();
        for report in 0..10_000 {
            assert_eq!(rate.count(Instant(report * 100_000)), Counted::Yes);
        }
    }
}
