//! The phase in which the run is interrupted because its robots are out of reach: the broker is away, or many robots
//! are silent. The run goes on once robots report where they are.
//!
//! Robots that are out of reach stop by themselves (R43 of docs/protocol.md), so they do not drop out at once. After a
//! short interruption the run goes on by itself. After a longer one the operator has to agree, because people may be on
//! the floor by then.

use crate::event::{EventKind, Trouble};
use crate::journal::Position;
use crate::run::link_loss::many_of;
use crate::run::next::Next;
use crate::run::outdated_journal;
use crate::run::roster::Whereabouts;
use crate::run::run_context::RunContext;
use crate::run::stop_times::StopTimes;
use crate::run::target_commands;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Route, Topic};

/// Time between two checks whether robots report again.
const CHECK_EVERY: Span = Span::from_millis(100);
/// How many copies of HOLD and STOP are sent, and the time between them.
const COPIES: (u32, Span) = (4, Span::from_millis(40));
/// Time between two broadcasts that ask all robots to report. TARGET-only robots (they understand the command TARGET
/// but no routes) report only when asked.
const ASK_EVERY: Span = Span::from_millis(2_000);
/// Time from the last message to a robot to the moment of a HOLD that stops it where it would stop by itself. A robot
/// without messages slows down after 1.9 s (R43). HOLD needs 50 ms longer to the same place.
const SLOWS_AFTER: Span = Span::from_millis(1_850);
/// Least time between two broadcasts of HOLD or STOP for robots that report again. Robots answer each STOP with a
/// report.
const HALT_AGAIN: Span = Span::from_millis(300);
/// After one more robot has reported, the run waits this long for others. Clients look for a broker every 2 s.
const ONE_MORE: Span = Span::from_millis(3_000);

/// The state of a run that stands still.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interrupted {
    /// When the run was interrupted. Only later reports count.
    pub since: Instant,
    /// About when the link broke: when the last report of a robot that is now out of reach was received. For a run from
    /// a journal: the moment of the last entry.
    broke: Instant,
    /// The drive, or the stay in a frame, that was interrupted.
    pub left: Position,
    /// The run goes on without the operator if enough robots report again by this moment.
    by_itself_until: Instant,
    /// When enough robots had reported again for the run to go on, or when the operator let it go on before that.
    /// `None` until then.
    back_at: Option<Instant>,
    /// Largest number of active robots that have reported since the interruption, and when it last grew.
    reported: (usize, Instant),
    ask_at: Instant,
    /// When robots that report again were last sent HOLD or STOP.
    halted: Option<Instant>,
    /// Whether the operator agreed that the run goes on.
    is_agreed: bool,
}

impl Interrupted {
    /// Begins the phase at `now`. `left` is what was interrupted. The run goes on without the operator if enough robots
    /// report again within `by_itself`.
    pub fn begin(now: Instant, mut left: Position, by_itself: Span) -> Self {
        left.stops.get_or_insert(StopTimes { began: now, stood: now });
        Self {
            since: now,
            broke: now,
            left,
            by_itself_until: now + by_itself,
            back_at: None,
            reported: (0, now),
            ask_at: now + ASK_EVERY,
            halted: None,
            is_agreed: false,
        }
    }

    /// Sets when the link broke.
    pub fn broke(self, broke: Instant) -> Self {
        Self { broke, ..self }
    }

    /// When [`on_tick`](Self::on_tick) has something to do next.
    pub fn due(&self, now: Instant) -> Instant {
        now + CHECK_EVERY
    }

    /// Whether enough robots report again and only the operator's agreement is missing.
    pub fn asks_operator(&self) -> bool {
        !self.is_agreed && self.back_at.is_some_and(|back| back > self.by_itself_until)
    }

    /// Whether any robot has reported since the interruption.
    pub fn is_any_back(&self) -> bool {
        self.reported.0 > 0
    }

    /// Does what is due: counts robots that report again, stops them, asks for reports, and goes on or ends the run.
    pub fn on_tick(&mut self, cx: &mut RunContext) -> Next {
        let robots = cx.roster.active().count();
        let missing = self.missing(cx).len();
        if robots - missing > self.reported.0 {
            self.reported = (robots - missing, cx.now);
        }
        let (reported, grew) = self.reported;
        let is_due = |halted: Instant| grew > halted && cx.now >= halted + HALT_AGAIN;
        if reported > 0 && self.halted.is_none_or(is_due) {
            self.halt(cx);
        }
        if missing > 0 && cx.now >= self.ask_at {
            self.ask_at = cx.now + ASK_EVERY;
            cx.io.outbox.send(Topic::Broadcast, &[Command::Uuid]);
        }
        if self.back_at.is_none() && !self.is_back(cx, robots, missing) {
            return self.give_up(cx);
        }
        let is_settled = missing == 0 || cx.now - self.reported.1 > ONE_MORE;
        if self.back_at.is_none() && is_settled {
            self.come_back(cx, robots);
        }
        if self.back_at.is_none() || self.asks_operator() { Next::Stay } else { Next::GoOn }
    }

    /// Continues the run because the operator agrees. Returns the dropout of all robots that have not reported, or
    /// [`Next::Stay`] if all have.
    pub fn go_on(&mut self, cx: &RunContext) -> Next {
        self.is_agreed = true;
        self.back_at.get_or_insert(cx.now);
        let missing = self.missing(cx);
        if missing.is_empty() {
            return Next::Stay;
        }
        Next::Drop(missing.into_iter().map(|participant| (participant, Trouble::Silent)).collect())
    }

    /// Stops robots that report again and may still drive. Called again when more robots report, because these may have
    /// missed earlier commands. On routes, HOLD stops robots when those out of reach slow down by themselves. All then
    /// stay where the plan keeps them apart. If it is too late for that, or no drive was interrupted, STOP is sent.
    fn halt(&mut self, cx: &mut RunContext) {
        let is_first = self.halted.replace(cx.now).is_none();
        let slows_at = self.broke + SLOWS_AFTER;
        match &mut self.left.drive {
            Some(_) if cx.is_target_leg() => {
                if is_first {
                    target_commands::halt_all(cx);
                }
            }
            // After this moment, robots in a hold would roll on into those that have already stopped by themselves.
            // STOP before all rest in a hold would halt some of them sooner than others.
            Some(clock) if cx.now <= slows_at.max(clock.rests_from().unwrap_or(slows_at)) => {
                let at = slows_at.max(cx.now + cx.link.hold_lead());
                let at = clock.open_hold().map_or(at, |hold| hold.at);
                clock.stand(at);
                if let Some(stops) = &mut self.left.stops {
                    stops.stood = stops.stood.max(at + Route::EASE);
                }
                cx.io.outbox.broadcast(cx.now, Command::Hold { at }, COPIES.0, COPIES.1);
            }
            _ => cx.io.outbox.broadcast(cx.now, Command::Stop, COPIES.0, COPIES.1),
        }
    }

    /// Where a participant that has not reported since the interruption may stand.
    pub fn whereabouts(&self, cx: &RunContext, participant: usize) -> Whereabouts {
        outdated_journal::whereabouts_after(cx, &self.left, participant)
    }

    /// Participants that have not reported since the interruption.
    fn missing(&self, cx: &RunContext) -> Vec<usize> {
        let is_missing = |one: &usize| cx.robot(*one).contact.heard <= self.since;
        cx.roster.active().map(|(one, _)| one).filter(is_missing).collect()
    }

    /// Whether enough robots report for the silent ones to count as lost. While many are silent, or the broker is away,
    /// the link counts as lost.
    fn is_back(&self, cx: &RunContext, robots: usize, missing: usize) -> bool {
        cx.io.outbox.linked() && missing < robots && missing < many_of(robots)
    }

    /// Notes that enough robots report again, and records an event.
    fn come_back(&mut self, cx: &mut RunContext, robots: usize) {
        self.back_at = Some(cx.now);
        let (reported, _) = self.reported;
        let (after, asks_operator) = (cx.now - self.since, self.asks_operator());
        cx.io.log.record(cx.now, EventKind::LinkBack { reported, robots, after, asks_operator });
    }

    /// Ends the run if robots have been out of reach for longer than the configured bound.
    fn give_up(&self, cx: &RunContext) -> Next {
        if cx.now - self.since <= cx.io.config.waits.outage {
            return Next::Stay;
        }
        let is_linked = cx.io.outbox.linked();
        Next::failed(match self.reported.0 {
            _ if !is_linked => "the broker did not come back".into(),
            0 => "no robot reports any more".into(),
            reported => format!("only {reported} of {} robots report", cx.roster.active().count()),
        })
    }
}
