//! Limits the messages of each robot: messages above a rate are ignored, and an event names the robot.
//!
//! An external broker may pass on any number of messages. A robot that sends too many must not use up the time that the
//! reports of other robots need.

use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};

/// The allowed rate of the messages of one robot.
struct Rate {
    /// Least mean time between two messages in the long run. It allows ten times the rate at which the project's robots
    /// report.
    every: Span,
    /// Number of messages that may come at once, before the rate limits them. A robot that comes back to a long show
    /// acknowledges 100 parts of routes.
    burst: i64,
}

/// The embedded broker has the same bound for a robot. With a lower rate or burst, acknowledgements are lost. With a
/// higher one, a robot can delay the messages of others.
const RATE: Rate = Rate { every: Span::from_millis(10), burst: 1_000 };
/// Least time between two events that name the same robot.
const NAMED_EVERY: Span = Span::from_millis(60_000);

/// Whether a message is within the rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counted {
    /// It is within the rate.
    Yes,
    /// It is above the rate, and an event has to name the sender.
    FloodToName,
    /// It is above the rate; an event named the sender within [`NAMED_EVERY`].
    Flood,
}

/// Limits the message rate of one robot (generic cell rate algorithm, ITU-T I.371).
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct ReportRate {
    /// The algorithm's theoretical arrival time: when all messages within the rate would have been sent at the mean
    /// rate, show clock.
    paid_until: Instant,
    /// When an event last named the robot, show clock.
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
