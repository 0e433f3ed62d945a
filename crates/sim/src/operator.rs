//! The simulated operator: presses buttons, and presses them again where there was no controller or broker.

use std::collections::VecDeque;

use lightbots_base::{Instant, Span};
use lightbots_control::Operation;

/// The simulated operator.
#[derive(Clone, Debug, Default)]
pub(crate) struct Operator {
    /// When Go on is pressed.
    presses_at: Option<Instant>,
    /// Since when some robots report and others stay away.
    waits_since: Option<Instant>,
    /// How long a frame that may be left waits for GO.
    go_after: Span,
    /// Since when one waits.
    cue_since: Option<Instant>,
    /// What else the operator does, in this order.
    wants: VecDeque<Operation>,
    /// When the operator tries the next of it.
    tries_at: Instant,
    /// The operator wants the show to be paused.
    wants_pause: bool,
    /// Since when it is paused though the operator does not want that.
    paused_since: Option<Instant>,
}

impl Operator {
    /// Time to read a message and to look at the floor.
    const LOOKS: Span = Span::from_millis(2_000);
    /// Time that robots that stay away have to come back. Clients find a broker again within 2 s.
    const WAITS: Span = Span::from_millis(10_000);
    /// Time until a button that did nothing is pressed again.
    const TRIES_AGAIN: Span = Span::from_millis(500);

    /// An operator that lets a frame wait this long for GO.
    pub fn new(go_after: Span) -> Self {
        Self { go_after, ..Self::default() }
    }

    /// Whether GO is given now. `waits`: a frame has stood for its air time and waits for it.
    pub fn gives_go(&mut self, now: Instant, waits: bool) -> bool {
        if !waits {
            self.cue_since = None;
        }
        waits && now - *self.cue_since.get_or_insert(now) >= self.go_after
    }

    /// The controller asks whether the run goes on.
    pub fn asked(&mut self, now: Instant) {
        self.presses_at.get_or_insert(now + Self::LOOKS);
    }

    /// Some robots of an interrupted run report or not: after a while the run goes on without the others.
    pub fn sees(&mut self, now: Instant, are_some_back: bool) {
        if !are_some_back {
            self.waits_since = None;
        } else if now - *self.waits_since.get_or_insert(now) >= Self::WAITS {
            self.presses_at.get_or_insert(now);
        }
    }

    /// Whether Go on is pressed now.
    pub fn presses(&mut self, now: Instant) -> bool {
        self.presses_at.take_if(|at| now >= *at).is_some()
    }

    /// Whether the operator resumes now: a controller that was started again with an old journal pauses a show that the
    /// operator has resumed.
    pub fn resumes(&mut self, now: Instant, is_paused: bool) -> bool {
        if !is_paused || self.wants_pause {
            self.paused_since = None;
            return false;
        }
        now - *self.paused_since.get_or_insert(now) >= Self::LOOKS
    }

    /// The operator presses another button.
    pub fn does(&mut self, now: Instant, operation: Operation) {
        self.tries_at = now;
        match operation {
            Operation::Pause => self.wants_pause = true,
            Operation::Resume => self.wants_pause = false,
            _ => {}
        }
        self.wants.push_back(operation);
    }

    /// That button did nothing: the operator presses it again.
    pub fn does_later(&mut self, now: Instant, operation: Operation) {
        self.tries_at = now + Self::TRIES_AGAIN;
        self.wants.push_front(operation);
    }

    /// The next button that is pressed now.
    pub fn next_at(&mut self, now: Instant) -> Option<Operation> {
        if now >= self.tries_at { self.wants.pop_front() } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_operator_presses_once() {
        let mut operator = Operator::default();
        operator.asked(Instant(5_000_000));
        operator.asked(Instant(6_000_000));
        assert!(!operator.presses(Instant(6_999_999)));
        assert!(operator.presses(Instant(7_000_000)) && !operator.presses(Instant(9_000_000)));
    }

    #[test]
    fn each_frame_waits_anew_for_go() {
        let mut operator = Operator::new(Span::from_millis(2_000));
        let mut gives = |seconds: u64, waits| operator.gives_go(Instant(seconds * 1_000_000), waits);
        assert!(!gives(1, true) && !gives(2, true) && gives(3, true));
        assert!(!gives(4, false) && !gives(9, true) && gives(11, true));
    }

    #[test]
    fn the_operator_goes_on_without_robots_that_stay_away() {
        let mut operator = Operator::default();
        let mut presses_at = |seconds: u64, are_some_back| {
            operator.sees(Instant(seconds * 1_000_000), are_some_back);
            operator.presses(Instant(seconds * 1_000_000))
        };
        assert!(
            !presses_at(1, false) && !presses_at(2, true) && !presses_at(11, true) && presses_at(12, true)
        );
        assert!(!presses_at(13, false) && !presses_at(14, true));
    }

    #[test]
    fn the_operator_resumes_what_is_paused_without_being_asked() {
        let mut operator = Operator::default();
        operator.does(Instant(0), Operation::Pause);
        assert!(!operator.resumes(Instant(0), true) && !operator.resumes(Instant(9_000_000), true));
        operator.does(Instant(9_000_000), Operation::Resume);
        assert!(!operator.resumes(Instant(9_000_000), true) && !operator.resumes(Instant(9_500_000), false));
        assert!(!operator.resumes(Instant(10_000_000), true) && operator.resumes(Instant(12_000_000), true));
    }

    #[test]
    fn what_was_refused_is_pressed_again_before_what_comes_later() {
        let mut operator = Operator::default();
        operator.does(Instant(0), Operation::Pause);
        let first = operator.next_at(Instant(0)).unwrap();
        operator.does_later(Instant(0), first);
        operator.does(Instant(100_000), Operation::Resume);
        assert!(matches!(operator.next_at(Instant(500_000)), Some(Operation::Pause)));
        assert!(matches!(operator.next_at(Instant(500_000)), Some(Operation::Resume)));
        assert!(operator.next_at(Instant(500_000)).is_none());
    }
}
