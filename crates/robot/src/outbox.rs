//! What the robot has to say, and when it says it unasked. Facts, not texts: a report is written when it is sent.

use lightbots_base::{Instant, Span, wrap};
use lightbots_wire::RobotState;

/// Pace of status reports while something goes on, and while nothing does.
const BUSY: Span = Span::from_millis(500);
const CALM: Span = Span::from_millis(2000);
/// Further off its route than this is news; nearer than that, it is over.
const OFF_M: f64 = 0.008;
const BACK_M: f64 = 0.006;
/// So many times as far off as it last said is news again, beyond what braking for a neighbour costs: it may stand.
const FARTHER: f64 = 4.0;
/// Without fixes, being so many times as unsure as it last said, and this many metres more, is news.
const MORE: f64 = 1.25;
const MORE_M: f64 = 0.0005;
/// What stands in its way is news again so far, radians, from where it last said.
const ELSEWHERE: f64 = 0.08;
/// A robot that has just been switched on waits so long for its first fix before it introduces itself without.
const POWER_ON: Span = Span::from_millis(500);

/// One thing to say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fact {
    /// On `UUID`.
    Introduction,
    /// On `Arrival`: the number of the route that ended, 0 for a target.
    Arrival(u32),
    /// On `Status`.
    Status,
    /// On `Time`.
    Question,
}

/// Bounded by its shape: at most one of each fact waits, the latest.
#[derive(Debug)]
pub(crate) struct Outbox {
    introduction: bool,
    /// Since when it waits to introduce itself of its own accord.
    newcomer: Option<Instant>,
    /// It said that it did not know where it was.
    said_nowhere: bool,
    arrival: Option<u32>,
    status: bool,
    question: bool,
    next_status: Instant,
    state: RobotState,
    /// How far off its route it last said to be, metres; 0: not worth saying.
    said_off_m: f64,
    /// How unsure of its place it last said to be for want of fixes, metres.
    said_err_m: Option<f64>,
    /// In which direction of the stage it last said that something stands in its way, radians.
    said_towards: Option<f64>,
}

impl Outbox {
    /// An outbox whose periodic messages are `phase` later than those of others.
    pub(crate) fn new(phase: Span) -> Self {
        Self {
            introduction: false,
            newcomer: None,
            said_nowhere: false,
            arrival: None,
            status: false,
            question: false,
            next_status: Instant::ZERO + CALM + phase,
            state: RobotState::Lost,
            said_off_m: 0.0,
            said_err_m: None,
            said_towards: None,
        }
    }

    pub(crate) fn introduce(&mut self) {
        self.introduction = true;
    }

    /// It was switched on, or the link is new: it introduces itself as soon as it knows where it is.
    pub(crate) fn arrive_new(&mut self, now: Instant) {
        self.newcomer = Some(now);
    }

    pub(crate) fn arrived(&mut self, route: u32) {
        self.arrival = Some(route);
    }

    pub(crate) fn report_status(&mut self) {
        self.status = true;
    }

    pub(crate) fn ask_time(&mut self) {
        self.question = true;
    }

    /// Notes what is news of itself; `err_m`: how unsure it is of its place, where fixes stay away.
    pub(crate) fn notice(
        &mut self,
        now: Instant,
        state: RobotState,
        off_m: Option<f64>,
        err_m: Option<f64>,
        knows_place: bool,
    ) {
        if self.newcomer.is_some_and(|since| knows_place || now - since > POWER_ON) {
            self.newcomer = None;
            self.introduction = true;
        }
        if self.said_nowhere && knows_place {
            self.introduction = true;
        }
        let off_m = off_m.unwrap_or(0.0);
        let (was_off, farther_m) = (self.said_off_m > 0.0, self.said_off_m * FARTHER);
        let is_off = off_m > if was_off { BACK_M } else { OFF_M };
        let unsure = match (err_m, self.said_err_m) {
            (Some(err_m), Some(said_m)) => err_m > said_m * MORE + MORE_M,
            (err_m, said_m) => err_m.is_some() || said_m.is_some(),
        };
        if unsure {
            self.said_err_m = err_m;
        }
        let strays = is_off != was_off || is_off && off_m > farther_m;
        if unsure || state != self.state || strays || now >= self.next_status {
            self.status = true;
            self.state = state;
        }
        if self.status {
            self.said_off_m = if is_off { off_m } else { 0.0 };
            let busy = matches!(state, RobotState::Driving | RobotState::Held);
            self.next_status = now + if busy { BUSY } else { CALM };
        }
    }

    /// Something came to stand in its way, turns out to be in another direction of the stage, radians, or has gone.
    #[inline]
    pub(crate) fn notice_block(&mut self, towards: Option<f64>) {
        let news = match (towards, self.said_towards) {
            (Some(towards), Some(said)) => wrap(towards - said).abs() > ELSEWHERE,
            (towards, said) => towards.is_some() != said.is_some(),
        };
        if news {
            self.status = true;
            self.said_towards = towards;
        }
    }

    /// Whether there is nothing to say.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        !(self.introduction || self.arrival.is_some() || self.question || self.status)
    }

    /// The next thing to say. `speaks_ours` is false for a robot that only knows the original protocol.
    pub(crate) fn take(&mut self, knows_place: bool, speaks_ours: bool) -> Option<Fact> {
        if core::mem::take(&mut self.introduction) {
            self.said_nowhere = !knows_place;
            return Some(Fact::Introduction);
        }
        if let Some(route) = self.arrival.take() {
            return Some(Fact::Arrival(route));
        }
        if core::mem::take(&mut self.question) && speaks_ours {
            return Some(Fact::Question);
        }
        (core::mem::take(&mut self.status) && speaks_ours).then_some(Fact::Status)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statuses(outbox: &mut Outbox, seconds: u64, state: RobotState) -> usize {
        let mut count = 0;
        for step in 0..seconds * 1000 / 16 {
            outbox.notice(Instant(step * 16_000), state, None, None, true);
            count += usize::from(outbox.take(true, true) == Some(Fact::Status));
        }
        count
    }

    #[test]
    fn two_a_second_while_driving_and_one_in_two_when_idle() {
        assert!((19..=21).contains(&statuses(&mut Outbox::new(Span::ZERO), 10, RobotState::Driving)));
        assert!((5..=6).contains(&statuses(&mut Outbox::new(Span::ZERO), 10, RobotState::Idle)));
    }

    #[test]
    fn leaving_the_route_is_said_again_when_it_gets_worse_and_coming_back_too() {
        let mut outbox = Outbox::new(Span::ZERO);
        let mut said = |off| {
            outbox.notice(Instant(1), RobotState::Lost, Some(off), None, true);
            outbox.take(true, true).is_some()
        };
        assert!(!said(0.007) && said(0.009) && !said(0.007) && said(0.005) && !said(0.007));
        assert!(said(0.009) && !said(0.035) && said(0.037) && !said(0.147) && said(0.149) && !said(0.007));
    }

    #[test]
    fn want_of_fixes_is_said_at_once_again_when_it_gets_worse_and_when_it_is_over() {
        let mut outbox = Outbox::new(Span::ZERO);
        let mut said = |err| {
            outbox.notice(Instant(1), RobotState::Lost, None, err, true);
            outbox.take(true, true).is_some()
        };
        assert!(!said(None) && said(Some(0.004)) && !said(Some(0.005)) && said(Some(0.006)));
        assert!(!said(Some(0.004)) && said(None) && !said(None));
    }

    #[test]
    fn where_something_blocks_it_is_said_again_once_it_knows_better() {
        let mut outbox = Outbox::new(Span::ZERO);
        let mut said = |towards| {
            outbox.notice_block(towards);
            outbox.take(true, true).is_some()
        };
        assert!(!said(None) && said(Some(3.12)) && !said(Some(3.06)) && !said(Some(-3.11)));
        assert!(said(Some(2.9)) && said(None) && !said(None));
    }

    #[test]
    fn a_robot_that_said_nowhere_says_where_as_soon_as_it_knows() {
        let mut outbox = Outbox::new(Span::ZERO);
        outbox.arrive_new(Instant(0));
        let mut introduced = |at, knows| {
            outbox.notice(Instant(at), RobotState::Lost, None, None, knows);
            core::iter::from_fn(|| outbox.take(knows, false)).any(|fact| fact == Fact::Introduction)
        };
        assert!(!introduced(100_000, false));
        assert!(introduced(600_000, false));
        assert!(!introduced(700_000, false));
        assert!(introduced(800_000, true));
        assert!(!introduced(900_000, true));
    }
}
