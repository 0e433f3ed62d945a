//! The outbox: which messages wait, and when the robot reports without being asked. It holds kinds of messages instead
//! of texts, because a report is written when it is sent. `R25` and the like are rules of docs/protocol.md.

use lightbots_base::{Instant, Span, Vec2, wrap};
use lightbots_wire::RobotState;

/// Time between two periodic status reports while the robot drives or is held. With a smaller value, 1,000 robots flood
/// the broker. With a larger value, the screen lags.
const BUSY: Span = Span::from_millis(500);
/// Time between two periodic status reports while the robot neither drives nor is held.
const CALM: Span = Span::from_millis(2000);
/// A robot reports at once if it is farther than this from its route, metres. A robot that stands reports at once if it
/// is farther than this, plus a margin by [`SURE`], from its last reported place. With a smaller value, ordinary
/// tracking errors are reported.
const OFF_M: f64 = 0.008;
/// Least time between two reports of a robot that stands and is being moved. With a smaller value, a robot that is
/// carried floods the broker.
const MOVED_AGAIN: Span = Span::from_millis(200);
/// Standard deviations of the reported place that are added to [`OFF_M`] for a robot that stands. The place of a robot
/// that was just switched on still changes while its estimate settles.
const SURE: f64 = 3.0;
/// A robot is back on its route once it is within this distance of it, metres. The difference to [`OFF_M`] is
/// hysteresis.
const BACK_M: f64 = 0.006;
/// The distance from the route is reported again once it has grown by this factor. While a robot brakes for a
/// neighbour, the distance grows by less. If it grows by more, the robot may be standing.
const FARTHER: f64 = 4.0;
/// While fixes are overdue, the error of the place is reported again once it exceeds this factor times the last
/// reported error, plus [`MORE_M`]. With a smaller value, a robot without fixes sends more reports.
const MORE: f64 = 1.25;
/// Error that is added to the last reported one times [`MORE`] before a new error is reported, metres. See [`MORE`].
const MORE_M: f64 = 0.0005;
/// The direction of an obstacle is reported again if it has changed by more than this, radians.
const ELSEWHERE: f64 = 0.08;
/// How long a robot that was switched on, or has a new link, waits for its place before it introduces itself. After
/// this time it introduces itself without a place. With a larger value, a robot without fixes is noticed later.
const POWER_ON: Span = Span::from_millis(500);

const _: () = assert!(BACK_M < OFF_M && BUSY.0 < CALM.0);

/// A kind of outgoing message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MessageKind {
    /// The introduction, on `UUID`.
    Introduction,
    /// An arrival, on `Arrival`. Holds the number of the route that ended; 0 for a target.
    Arrival(u32),
    /// A status report, on `Status`.
    Status,
    /// A question for the time, on `Time`.
    Question,
}

/// The messages that wait: at most one of each kind, because a newer one replaces an older one.
#[derive(Debug)]
pub(crate) struct Outbox {
    introduction: bool,
    /// When the robot began to wait for its place before introducing itself, own clock. `None` if it does not wait.
    newcomer: Option<Instant>,
    /// Whether the last introduction was sent without a place.
    introduced_without_place: bool,
    arrival: Option<u32>,
    status: bool,
    /// Whether a command, and not only the robot's own rules, requires the waiting status report.
    is_status_required: bool,
    question: bool,
    next_status: Instant,
    state: RobotState,
    /// Place of the robot at the last status report, stage metres. With it, the distance from there beyond which the
    /// robot counts as moved, metres. `None` if the place was unknown.
    reported_at: Option<(Vec2, f64)>,
    /// The last reported distance from the route, metres; 0 if the robot was reported on its route.
    reported_off_m: f64,
    /// The last reported error of the place, metres; `None` if fixes were not overdue then.
    reported_err_m: Option<f64>,
    /// The last reported direction of an obstacle, radians in the stage; `None` if the last report named none.
    reported_towards: Option<f64>,
}

impl Outbox {
    /// An empty outbox. `phase` delays the first periodic status report. Different phases spread the reports of a fleet
    /// over time.
    pub(crate) fn new(phase: Span) -> Self {
        Self {
            introduction: false,
            newcomer: None,
            introduced_without_place: false,
            arrival: None,
            status: false,
            is_status_required: false,
            question: false,
            next_status: Instant::ZERO + CALM + phase,
            state: RobotState::Lost,
            reported_at: None,
            reported_off_m: 0.0,
            reported_err_m: None,
            reported_towards: None,
        }
    }

    pub(crate) fn introduce(&mut self) {
        self.introduction = true;
    }

    /// Notes at `now`, own clock, that the robot was switched on or its link is new. The robot introduces itself once
    /// it knows its place, at the latest after [`POWER_ON`].
    pub(crate) fn arrive_new(&mut self, now: Instant) {
        self.newcomer = Some(now);
    }

    pub(crate) fn arrived(&mut self, route: u32) {
        self.arrival = Some(route);
    }

    /// Queues the status report that a command requires.
    pub(crate) fn report_status(&mut self) {
        self.status = true;
        self.is_status_required = true;
    }

    pub(crate) fn ask_time(&mut self) {
        self.question = true;
    }

    /// Decides after a step whether an introduction or a status report is due. `at`: place of the robot, stage metres,
    /// and its error, metres, 1 sigma; `None` if the place is unknown. `off_m`: distance from the route, metres; `None`
    /// if no route is under way. `err_m`: error of the place to report, metres; `None` if fixes are not overdue on a
    /// route.
    pub(crate) fn notice(
        &mut self,
        now: Instant,
        state: RobotState,
        off_m: Option<f64>,
        err_m: Option<f64>,
        at: Option<(Vec2, f64)>,
    ) {
        let knows_place = at.is_some();
        if self.newcomer.is_some_and(|since| knows_place || now - since > POWER_ON) {
            self.newcomer = None;
            self.introduction = true;
        }
        if self.introduced_without_place && knows_place {
            self.introduction = true;
        }
        let off_m = off_m.unwrap_or(0.0);
        let (was_off, farther_m) = (self.reported_off_m > 0.0, self.reported_off_m * FARTHER);
        let is_off = off_m > if was_off { BACK_M } else { OFF_M };
        let unsure = match (err_m, self.reported_err_m) {
            (Some(err_m), Some(reported_m)) => err_m > reported_m * MORE + MORE_M,
            (err_m, reported_m) => err_m.is_some() || reported_m.is_some(),
        };
        if unsure {
            self.reported_err_m = err_m;
        }
        let strays = is_off != was_off || is_off && off_m > farther_m;
        if unsure || state != self.state || strays || now >= self.next_status {
            self.status = true;
            self.state = state;
        }
        if self.status {
            self.reported_at = at.map(|(at, error_m)| (at, OFF_M + SURE * error_m));
            self.reported_off_m = if is_off { off_m } else { 0.0 };
            let busy = matches!(state, RobotState::Driving | RobotState::Held);
            self.next_status = now + if busy { BUSY } else { CALM };
        }
    }

    /// Notes the place `at` (stage metres) of a robot that stands and has nothing to drive. A status report is due if
    /// the robot was lifted or pushed since its last report. None is due within [`MOVED_AGAIN`] of the last report.
    pub(crate) fn notice_place(&mut self, now: Instant, at: Option<Vec2>) {
        if self.next_status - now > CALM - MOVED_AGAIN {
            return;
        }
        let is_off = |(at, (reported, most_m)): (Vec2, (Vec2, f64))| at.distance(reported) > most_m;
        self.status |= at.zip(self.reported_at).is_some_and(is_off);
    }

    /// Notes the direction of the obstacle to report, radians in the stage; `None` if there is none. A status report is
    /// due if this is new.
    #[inline]
    pub(crate) fn notice_block(&mut self, towards: Option<f64>) {
        let news = match (towards, self.reported_towards) {
            (Some(towards), Some(reported)) => wrap(towards - reported).abs() > ELSEWHERE,
            (towards, reported) => towards.is_some() != reported.is_some(),
        };
        if news {
            self.status = true;
            self.reported_towards = towards;
        }
    }

    /// Whether no message waits.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        !(self.introduction || self.arrival.is_some() || self.question || self.status)
    }

    /// Removes the next message and returns its kind; `None` if none is to be sent. A robot that cannot drive routes
    /// does not ask for the time (R25), and sends only status reports that commands require (R41, R55, R59).
    pub(crate) fn take(&mut self, knows_place: bool, drives_routes: bool) -> Option<MessageKind> {
        if core::mem::take(&mut self.introduction) {
            self.introduced_without_place = !knows_place;
            return Some(MessageKind::Introduction);
        }
        if let Some(route) = self.arrival.take() {
            return Some(MessageKind::Arrival(route));
        }
        if core::mem::take(&mut self.question) && drives_routes {
            return Some(MessageKind::Question);
        }
        let is_required = core::mem::take(&mut self.is_status_required);
        (core::mem::take(&mut self.status) && (drives_routes || is_required)).then_some(MessageKind::Status)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statuses(outbox: &mut Outbox, seconds: u64, state: RobotState) -> usize {
        let mut count = 0;
        for step in 0..seconds * 1000 / 16 {
            outbox.notice(Instant(step * 16_000), state, None, None, Some((Vec2::ZERO, 0.0)));
            count += usize::from(outbox.take(true, true) == Some(MessageKind::Status));
        }
        count
    }

    #[test]
    fn two_a_second_while_driving_and_one_in_two_when_idle() {
        assert!((19..=21).contains(&statuses(&mut Outbox::new(Span::ZERO), 10, RobotState::Driving)));
        assert!((5..=6).contains(&statuses(&mut Outbox::new(Span::ZERO), 10, RobotState::Idle)));
    }

    #[test]
    fn a_robot_that_stands_says_at_once_that_it_was_moved() {
        let mut outbox = Outbox::new(Span::ZERO);
        let mut millis = 0;
        let mut says = |x_m| {
            let at = Vec2::new(x_m, 0.0);
            millis += 250;
            outbox.notice_place(Instant(millis * 1_000), Some(at));
            outbox.notice(Instant(millis * 1_000), RobotState::Idle, None, None, Some((at, 0.0)));
            outbox.take(true, true) == Some(MessageKind::Status)
        };
        assert!(says(0.0), "the first report");
        assert!(!says(0.007) && says(0.009) && !says(0.009), "lifted");
        assert!(!says(0.016) && says(0.018), "pushed slowly");
    }

    #[test]
    fn leaving_the_route_is_said_again_when_it_gets_worse_and_coming_back_too() {
        let mut outbox = Outbox::new(Span::ZERO);
        let mut said = |off| {
            outbox.notice(Instant(1), RobotState::Lost, Some(off), None, Some((Vec2::ZERO, 0.0)));
            outbox.take(true, true).is_some()
        };
        assert!(!said(0.007) && said(0.009) && !said(0.007) && said(0.005) && !said(0.007));
        assert!(said(0.009) && !said(0.035) && said(0.037) && !said(0.147) && said(0.149) && !said(0.007));
    }

    #[test]
    fn want_of_fixes_is_said_at_once_again_when_it_gets_worse_and_when_it_is_over() {
        let mut outbox = Outbox::new(Span::ZERO);
        let mut said = |err| {
            outbox.notice(Instant(1), RobotState::Lost, None, err, Some((Vec2::ZERO, 0.0)));
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
    fn a_robot_that_introduced_without_place_says_where_as_soon_as_it_knows() {
        let mut outbox = Outbox::new(Span::ZERO);
        outbox.arrive_new(Instant(0));
        let mut introduced = |at, knows: bool| {
            outbox.notice(Instant(at), RobotState::Lost, None, None, knows.then_some((Vec2::ZERO, 0.0)));
            core::iter::from_fn(|| outbox.take(knows, false)).any(|fact| fact == MessageKind::Introduction)
        };
        assert!(!introduced(100_000, false));
        assert!(introduced(600_000, false));
        assert!(!introduced(700_000, false));
        assert!(introduced(800_000, true));
        assert!(!introduced(900_000, true));
    }
}
