//! Detects by robots' own clocks that two robots share a name. A robot reads its own clock into each time question (R25
//! of docs/protocol.md). The questions of one robot follow one clock.
//!
//! The clock of a robot that restarts goes back once. If two robots ask in turn, the clock in the questions goes back
//! and forward. After each step back it follows the lower clock. Reported places reveal two robots later than this, or
//! never on a small floor.

use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};

/// Largest step back of the clock between two questions of one robot, if one message overtook the other. Two robots
/// that were switched on within this time of each other are not told apart.
const OVERTAKEN: Span = Span::from_millis(500);
/// Largest difference between the delays of two questions of one robot. A robot that restarts repeatedly differs by
/// more: its clock begins low each time, and lags by the time between two starts.
const LATE: Span = Span::from_millis(1_000);
/// Number of steps back to the same lower clock that show two robots. A single step back can be a robot that restarted.
const STEPS_BACK: u8 = 2;
/// Time within which the steps back must come to show two robots. A robot asks at least every 3 s (R28).
const WITHIN: Span = Span::from_millis(15_000);

/// A time question: when it was received (show clock), and when it was sent (the robot's own clock).
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Question {
    received: Instant,
    asked: Instant,
}

/// What the time questions under one name show about the clocks of its robots.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct OwnClocks {
    last: Option<Question>,
    /// The last question at which the clock stepped back from the question before.
    lower: Option<Question>,
    steps_back: u8,
    first_step: Instant,
}

impl OwnClocks {
    /// Handles a time question; `asked`: moment of the question on the robot's own clock. Returns whether this question
    /// shows that two robots share the name.
    pub fn observe(&mut self, now: Instant, asked: Instant) -> bool {
        let question = Question { received: now, asked };
        let Some(last) = self.last.replace(question) else { return false };
        if last.asked - asked <= OVERTAKEN {
            return false;
        }
        let follows = self.lower.replace(question).is_some_and(|lower| question.is_of_clock(lower));
        if !follows || now - self.first_step > WITHIN {
            (self.steps_back, self.first_step) = (0, now);
        }
        self.steps_back = self.steps_back.saturating_add(1);
        self.steps_back >= STEPS_BACK
    }
}

impl Question {
    /// Whether this question and an earlier one may come from one clock that ran on between them.
    fn is_of_clock(self, earlier: Self) -> bool {
        let behind = (self.received - earlier.received) - (self.asked - earlier.asked);
        (-LATE..=LATE).contains(&behind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the index of the first question, `(received, asked)` in milliseconds, that shows two robots.
    fn found(questions: impl IntoIterator<Item = (u64, u64)>) -> Option<usize> {
        let mut clocks = OwnClocks::default();
        let at = |ms: u64| Instant(ms * 1_000);
        questions.into_iter().position(|(received, asked)| clocks.observe(at(received), at(asked)))
    }

    #[test]
    fn two_robots_that_ask_in_turn_share_a_name() {
        let questions = [(0, 90_000), (200, 300), (400, 500), (3_000, 93_000), (3_200, 3_300)];
        assert_eq!(found(questions), Some(4));
    }

    #[test]
    fn a_robot_that_starts_again_and_again_is_one() {
        let start = |number: u64| (0..20).map(move |step| (number * 4_000 + step * 200, 150 + step * 200));
        assert_eq!(found((0..20).flat_map(start)), None);
    }

    #[test]
    fn a_robot_whose_questions_come_late_together_or_overtaken_is_one() {
        // Every 0.2 s; for 4 s of each 5 s the broker passes nothing on, and each fifth question overtakes the one
        // before.
        let received = |ms: u64| if ms % 5_000 < 4_000 { ms / 5_000 * 5_000 + 4_000 } else { ms };
        let order = |step: u64| match step % 5 {
            3 => step + 1,
            4 => step - 1,
            _ => step,
        };
        assert_eq!(found((0..500).map(|step| (received(step * 200), 7_000 + order(step) * 200))), None);
    }
}
