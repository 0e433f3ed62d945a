//! The simulated operator: presses buttons of the controller. Most operations that find no controller or broker are
//! tried again later; GO, Go on and the end of an unwanted pause are not stored.

use std::collections::VecDeque;

use lightbots_base::{Instant, Span};
use lightbots_control::Operation;

/// The simulated operator.
#[derive(Clone, Debug, Default)]
pub(crate) struct Operator {
    /// When the operator will press Go on; `None`: the operator does not intend to.
    presses_at: Option<Instant>,
    /// Since when the run has been interrupted with some robots reporting and others missing; `None`: the run is not in
    /// this state.
    waits_since: Option<Instant>,
    /// Time from the moment at which a frame is ready for GO until the operator gives GO.
    go_after: Span,
    /// Since when the present frame has been ready for GO; `None`: it is not.
    cue_since: Option<Instant>,
    /// Other operations that the operator still has to do, the next one first.
    wants: VecDeque<Operation>,
    /// Earliest time at which the operator tries the first of [`Self::wants`].
    tries_at: Instant,
    /// Whether the operator wants the show to be paused.
    wants_pause: bool,
    /// Since when the show is paused although the operator does not want that.
    paused_since: Option<Instant>,
}

impl Operator {
    /// Time that the operator takes to read a message and to look at the floor.
    const LOOKS: Span = Span::from_millis(2_000);
    /// Time that the operator gives missing robots to come back. Clients find a broker again within 2 s.
    const WAITS: Span = Span::from_millis(10_000);
    /// Time until the operator repeats an operation that had no effect.
    const TRIES_AGAIN: Span = Span::from_millis(500);

    /// An operator that gives GO when a frame has been ready for it for `go_after`.
    pub fn new(go_after: Span) -> Self {
        Self { go_after, ..Self::default() }
    }

    /// Whether the operator gives GO now. `waits`: the present frame is ready for GO, because its air time is over.
    pub fn gives_go(&mut self, now: Instant, waits: bool) -> bool {
        if !waits {
            self.cue_since = None;
        }
        waits && now - *self.cue_since.get_or_insert(now) >= self.go_after
    }

    /// Notes that the controller asks whether the run goes on. The operator presses Go on a little later.
    pub fn asked(&mut self, now: Instant) {
        self.presses_at.get_or_insert(now + Self::LOOKS);
    }

    /// Notes whether an interrupted run has some robots that report and others that are missing. After [`Self::WAITS`]
    /// the operator presses Go on, and the run goes on without the missing robots.
    pub fn sees(&mut self, now: Instant, are_some_back: bool) {
        if !are_some_back {
            self.waits_since = None;
        } else if now - *self.waits_since.get_or_insert(now) >= Self::WAITS {
            self.presses_at.get_or_insert(now);
        }
    }

    /// Whether the operator presses Go on now. Returns true once for each decision to press it.
    pub fn presses(&mut self, now: Instant) -> bool {
        self.presses_at.take_if(|at| now >= *at).is_some()
    }

    /// Whether the operator resumes a paused show now. A controller that restarted from an old journal may pause a show
    /// again that the operator had resumed.
    pub fn resumes(&mut self, now: Instant, is_paused: bool) -> bool {
        if !is_paused || self.wants_pause {
            self.paused_since = None;
            return false;
        }
        now - *self.paused_since.get_or_insert(now) >= Self::LOOKS
    }

    /// Adds an operation that the operator does as soon as possible, after those that are still to be done.
    pub fn does(&mut self, now: Instant, operation: Operation) {
        self.tries_at = now;
        match operation {
            Operation::Pause => self.wants_pause = true,
            Operation::Resume => self.wants_pause = false,
            _ => {}
        }
        self.wants.push_back(operation);
    }

    /// Puts back an operation that had no effect. The operator tries it again later.
    pub fn does_later(&mut self, now: Instant, operation: Operation) {
        self.tries_at = now + Self::TRIES_AGAIN;
        self.wants.push_front(operation);
    }

    /// Removes and returns the operation that the operator tries now; `None` if there is none.
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
