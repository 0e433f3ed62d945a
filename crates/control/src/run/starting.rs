//! The phase of START, the message that names the moment at which all robots begin their routes. START is sent ahead of
//! that moment to all robots at once, repeated, and confirmed by their reports. It is postponed a bounded number of
//! times while some robots do not confirm it.

use crate::event::Trouble;
use crate::run::link::{ASK_AGAIN, REPEAT};
use crate::run::misplaced;
use crate::run::next::Next;
use crate::run::path_clock::PathClock;
use crate::run::roster::Whereabouts;
use crate::run::run_context::RunContext;
use crate::run::silence::{self, LINK_LOSS};
use crate::run::standing::drop_if_unfit;
use crate::run::stop_times::StopTimes;
use crate::run::target_progress::TargetProgress;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Details, RobotState, Topic};

/// Percentage of the lead, counted from sending, after which robots that did not confirm a START are first asked
/// individually. The lead is the time from sending START to its moment. By the time of asking, the confirmations of the
/// broadcast have arrived.
const ASK_FIRST_PERCENT: i64 = 27;
/// If at most this number of robots did not confirm, each is asked individually. In large fleets the bound is one in
/// `MANY` of the robots that start. If more did not confirm, only the repeated broadcast asks them.
const ASKED_MAX: usize = 64;
/// If at most this number of robots did not confirm, messages count as lost. In large fleets the bound is one in `MANY`
/// of the robots that start. If more did not confirm, the link counts as slow.
const LOST_MAX: usize = 2;
/// Share that replaces `ASKED_MAX` and `LOST_MAX` where it gives a larger number: one robot in this many of those that
/// start.
const MANY: usize = 8;
/// Time between two copies of a START that was postponed. It is short, because a robot that does not receive the new
/// moment starts alone at the old one.
const REPEAT_POSTPONED: Span = Span::from_millis(15);
/// How often a START is postponed at most. After that, robots that did not confirm it drop out.
const POSTPONED_MAX: u32 = 12;
/// After this many postponements of a START, an event names the robots that did not confirm it.
const POSTPONED_NAMED: u32 = 4;

/// A START that was sent and whose moment is still to come.
#[derive(Clone, Debug)]
pub(crate) struct Starting {
    /// The moment of the START, show clock.
    pub at: Instant,
    /// Number of the routes that begin with this START.
    seq: u32,
    /// When to check whether all robots have confirmed: early enough to postpone the START for all.
    check_at: Instant,
    repeat_at: Instant,
    /// When robots that did not confirm are asked individually next.
    ask_at: Instant,
    /// When this START was first sent, and the round-trip estimate of the link at that time.
    first: (Instant, Span),
    /// The moment that this START named when it was first sent.
    first_at: Instant,
    postponed: u32,
    /// Whether all robots had confirmed at the last check.
    is_confirmed: bool,
    /// `[participant]`: the moment of START that the robot confirmed last.
    confirmed: Vec<Option<Instant>>,
}

impl Starting {
    /// Sends START for the first leg of the queue. Its moment is the earliest possible one that is not before
    /// `earliest`. A leg is the drive of all robots between two moments at which all stand. Panics if no leg is queued.
    pub fn begin(cx: &mut RunContext, earliest: Instant) -> Self {
        let seq = cx.pipeline.queue.front().map_or(0, |leg| leg.seq);
        assert!(seq != 0, "a START needs a queued leg");
        let lead = cx.start_lead();
        let at = earliest.max(cx.earliest_start());
        cx.io.outbox.send(Topic::Broadcast, &[Command::Start { seq, at }]);
        Self {
            at,
            seq,
            check_at: at - cx.link.check_ahead(),
            repeat_at: cx.now + REPEAT,
            ask_at: cx.now + lead * ASK_FIRST_PERCENT / 100,
            first: (cx.now, cx.link.round_trip),
            first_at: at,
            postponed: 0,
            is_confirmed: false,
            confirmed: vec![None; cx.roster.len()],
        }
    }

    /// When [`on_tick`](Self::on_tick) has something to do next.
    pub fn due(&self) -> Instant {
        let moment = if self.is_confirmed { self.at } else { self.check_at };
        moment.min(self.repeat_at).min(self.ask_at)
    }

    fn command(&self) -> Command {
        Command::Start { seq: self.seq, at: self.at }
    }

    /// Handles a status report of a participant before the moment of START. Notes its confirmation, and sends a
    /// restarted robot its route again. Returns a change of phase if the robot is unfit, began alone, or stands
    /// elsewhere.
    pub fn on_report(
        &mut self,
        cx: &mut RunContext,
        participant: usize,
        details: &Details,
        restarted: bool,
    ) -> Next {
        if details.route == self.seq && details.starts == Some(self.at) {
            self.confirmed[participant] = details.starts;
        }
        let mut next = drop_if_unfit(participant, details);
        if next.stays() && self.began_alone(cx, participant, details) {
            next = cx.replan_with(participant);
        } else if next.stays() && restarted {
            next = cx.upload_again(participant);
        }
        if restarted {
            self.confirmed[participant] = None;
        }
        // The drive may be over before this controller wakes up.
        let may_have_driven = details.state == RobotState::Idle && cx.now >= self.at;
        next.or_else(|| if may_have_driven { Next::Stay } else { misplaced::check_status(cx, participant) })
    }

    /// Handles the arrival of a participant. If it started alone, at a moment before the present one, all robots stop
    /// and are planned again.
    pub fn on_arrival(&mut self, cx: &mut RunContext, participant: usize, details: &Details) -> Next {
        if self.began_alone(cx, participant, details) { cx.replan_with(participant) } else { Next::Stay }
    }

    /// Whether a robot has begun its route at an earlier moment of this START, because the postponed moment reached it
    /// too late. Its route may have ended since. A route without movement does not count.
    fn began_alone(&self, cx: &RunContext, participant: usize, details: &Details) -> bool {
        let elsewhen = match details.state {
            RobotState::Driving | RobotState::Held => details.starts != Some(self.at),
            RobotState::Idle => self.confirmed[participant] != Some(self.at),
            _ => false,
        };
        let path = cx.pipeline.queue.front().and_then(|leg| leg.path(participant));
        elsewhen && details.route == self.seq && path.is_some_and(|path| !path.as_ref().rests())
    }

    /// Where a silent participant may stand. If it confirmed any moment of this START, it may have started at the
    /// moment that was sent first. If it confirmed none, the result is empty: it has not left the place that it
    /// reported.
    pub fn whereabouts(&self, cx: &RunContext, participant: usize) -> Whereabouts {
        let leg = cx.pipeline.queue.front().filter(|_| self.confirmed[participant].is_some());
        let Some(leg) = leg else { return Whereabouts::default() };
        let clock = PathClock::new(self.first_at, leg.duration);
        let stops = StopTimes { began: self.first_at, stood: self.first_at };
        silence::whereabouts(
            (leg, &TargetProgress::new(leg)),
            &clock,
            stops,
            participant,
            cx.robot(participant),
        )
    }

    /// Does what is due: asks for confirmations, postpones or repeats the START, or begins the drive.
    pub fn on_tick(&mut self, cx: &mut RunContext) -> Next {
        cx.pump_lights();
        let next = cx.pump();
        if !next.stays() {
            return next;
        }
        if cx.now >= self.ask_at {
            self.ask_at = cx.now + ASK_AGAIN.max(self.first.1);
            if !self.is_confirmed {
                self.ask_unconfirmed(cx);
            }
        }
        if cx.now >= self.check_at && !self.is_confirmed {
            let unconfirmed = self.unconfirmed(cx);
            self.is_confirmed = unconfirmed.is_empty();
            if !self.is_confirmed {
                let next = self.postpone(cx, &unconfirmed);
                if !next.stays() {
                    return next;
                }
            }
        }
        if cx.now >= self.at {
            return Next::Drive(self.at);
        }
        if cx.now >= self.repeat_at {
            cx.io.outbox.send(Topic::Broadcast, &[self.command()]);
            self.repeat_at = cx.now + if self.postponed > 0 { REPEAT_POSTPONED } else { REPEAT };
        }
        Next::Stay
    }

    /// Participants that have not confirmed the present moment of START. A route without movement also counts as
    /// confirmed once its robot has begun it. By a clock that is ahead, the robot may have begun before the START was
    /// postponed, and no later START changes that (R33).
    fn unconfirmed(&self, cx: &RunContext) -> Vec<usize> {
        let Some(leg) = cx.pipeline.queue.front() else { return Vec::new() };
        let owes = |&participant: &usize| {
            let Some(path) = leg.path(participant) else { return false };
            let reported = &cx.robot(participant).reported;
            let begun =
                matches!(reported.state, Some(RobotState::Driving | RobotState::Held | RobotState::Idle));
            let rests_already = begun && reported.route == self.seq && path.as_ref().rests();
            self.confirmed[participant] != Some(self.at) && !rests_already
        };
        cx.roster.active().map(|(one, _)| one).filter(owes).collect()
    }

    /// Sends START and STATUS to each robot that did not confirm, unless there are too many. The confirmation of a
    /// robot may have been lost.
    fn ask_unconfirmed(&self, cx: &mut RunContext) {
        let unconfirmed = self.unconfirmed(cx);
        if unconfirmed.len() > ASKED_MAX.max(starters(cx) / MANY) {
            return;
        }
        for participant in unconfirmed {
            cx.send(participant, &[self.command(), Command::Status]);
        }
    }

    /// Those of `unconfirmed` that have sent no report for longer than a bound, although they were asked again and
    /// again. They count as dead: the fleet waits less long for them than for robots that report over a slow link.
    /// Empty while the broker may still be restoring subscriptions.
    fn silent(&self, cx: &RunContext, unconfirmed: &[usize]) -> Vec<usize> {
        let (first, round_trip) = self.first;
        // If its link broke after it received START, a robot has stopped by itself when this bound is over.
        let bound = cx.io.config.silence + LINK_LOSS.stands_after() + round_trip * 2;
        if cx.link.patience(first) > cx.now - first {
            return Vec::new();
        }
        let is_silent = |one: &usize| cx.now - cx.robot(*one).contact.heard.max(first) > bound;
        unconfirmed.iter().copied().filter(is_silent).collect()
    }

    /// Postpones START: sends a later moment to all robots. Robots that did not confirm also get it individually, and
    /// those without the route get the route again. Returns dropouts instead if robots are silent or START was
    /// postponed too often.
    fn postpone(&mut self, cx: &mut RunContext, unconfirmed: &[usize]) -> Next {
        self.postponed += 1;
        let silent = self.silent(cx, unconfirmed);
        if !silent.is_empty() {
            // The link is no slower than before, because only dead robots did not answer.
            cx.link.round_trip = self.first.1;
            return drop_all(&silent, Trouble::Silent);
        }
        if self.postponed > POSTPONED_MAX {
            return drop_all(unconfirmed, Trouble::Deaf);
        }
        if self.postponed == POSTPONED_NAMED {
            unconfirmed.iter().for_each(|&participant| cx.report_waiting(participant, Trouble::Deaf));
        }
        if unconfirmed.len() > LOST_MAX.max(starters(cx) / MANY) {
            cx.link.widen();
        } else {
            cx.link.add_loss_margin();
        }
        self.restate(cx);
        for &participant in unconfirmed {
            if cx.robot(participant).reported.route != self.seq {
                cx.pipeline.upload_again(cx.now, participant);
            }
            cx.send(participant, &[self.command()]);
        }
        cx.pump()
    }

    fn restate(&mut self, cx: &mut RunContext) {
        let lead = cx.start_lead();
        self.at = cx.earliest_start();
        self.check_at = self.at - cx.link.check_ahead();
        self.repeat_at = cx.now + REPEAT_POSTPONED;
        self.ask_at = cx.now + lead * ASK_FIRST_PERCENT / 100;
        cx.io.outbox.send(Topic::Broadcast, &[self.command()]);
    }
}

/// Number of robots that are to start.
fn starters(cx: &RunContext) -> usize {
    cx.pipeline.queue.front().map_or(0, |leg| leg.drivers)
}

fn drop_all(participants: &[usize], why: Trouble) -> Next {
    Next::Drop(participants.iter().map(|&participant| (participant, why)).collect())
}
