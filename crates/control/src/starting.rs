//! START: stated ahead for everybody at once, repeated, confirmed by reports, put off for those who did not hear it.

use crate::desk::Desk;
use crate::event::{EventKind, Trouble};
use crate::leg::Kind;
use crate::run::{Phase, Run};
use crate::silent::CUT;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Details, RobotState, Topic};

/// When robots that did not confirm are first asked by name, in percent of the lead.
const ASK_FIRST: i64 = 27;
/// They are asked again after this, or after a round trip where that is longer. Every answer passes a lossy link twice:
/// with one message in ten lost, two questions left one START in two of 200 robots unconfirmed, and it was put off.
const ASK_AGAIN: Span = Span::from_millis(50);
/// So many who did not confirm are asked by name.
const FEW: usize = 64;
/// START is said again this often until its moment.
const REPEAT: Span = Span::from_millis(40);
/// A START that was put off is said again this often: whoever misses it leaves alone.
const REPEAT_PUT_OFF: Span = Span::from_millis(15);
/// Whether all have confirmed is looked at this long before the moment at least.
const CHECK_AHEAD: Span = Span::from_millis(80);
/// How often the moment is put off before the deaf ones are given up.
const PUT_OFF_MAX: u32 = 12;
/// A start put off so often is a wait that people are told the reason of.
const PUT_OFF_TOLD: u32 = 4;
/// Where no more robots than this did not confirm, and no more than one in eight, messages are lost rather than slow.
const FEW_LOST: usize = 2;
/// The most that is added to the lead for lost messages: 9 questions by name.
const LOSSY_MAX: Span = Span::from_millis(450);
/// Links slower than this are not waited for.
const ROUND_TRIP_MAX: Span = Span::from_millis(1_500);
/// HOLD and RESUME are stated this long ahead at least.
const HOLD_LEAD: Span = Span::from_millis(150);
/// Added to the lead for every robot, so that all can confirm.
const LEAD_PER_ROBOT: Span = Span(20);

/// A stated START.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub at: Instant,
    pub seq: u32,
    /// When it is looked at whether all have confirmed: early enough to put it off for all.
    check_at: Instant,
    repeat_at: Instant,
    /// When its first moment was stated, and how slow the link was taken to be then.
    first: (Instant, Span),
    /// When robots that did not confirm are asked by name.
    ask_at: Instant,
    put_off: u32,
    /// All had confirmed when it was looked at.
    checked: bool,
}

impl Start {
    /// When something is due.
    pub fn due(&self) -> Instant {
        let moment = if self.checked { self.at } else { self.check_at };
        moment.min(self.repeat_at).min(self.ask_at)
    }
}

impl Run {
    /// How long ahead START is stated now: time for all to hear and confirm it, and to be put off.
    pub fn start_lead(&self, desk: &Desk) -> Span {
        let slow = self.round_trip * 2 + REPEAT;
        desk.config.start_lead.max(slow) + self.lossy + LEAD_PER_ROBOT * self.seats.len() as i64
    }

    /// How long ahead HOLD and RESUME are stated.
    pub fn hold_lead(&self) -> Span {
        self.round_trip.max(HOLD_LEAD)
    }

    fn check_ahead(&self) -> Span {
        CHECK_AHEAD.max(self.round_trip * 3 / 4)
    }

    /// Starts the first leg of the queue as soon as may be, but not before `earliest`.
    pub fn start(&mut self, desk: &mut Desk, now: Instant, earliest: Instant) {
        let Some(leg) = self.queue.front() else { return };
        if leg.kind == Kind::Targets {
            self.depart(desk, now, now);
            return;
        }
        let lead = self.start_lead(desk);
        let (at, seq) = (earliest.max(now + lead), leg.seq);
        let start = Start {
            at,
            seq,
            first: (now, self.round_trip),
            check_at: at - self.check_ahead(),
            repeat_at: now + REPEAT,
            ask_at: now + lead * ASK_FIRST / 100,
            put_off: 0,
            checked: false,
        };
        desk.outbox.say(Topic::Broadcast, &[Command::Start { seq, at }]);
        self.phase = Phase::Starting(start);
    }

    /// A report says when the robot's route starts.
    pub fn hear_start(&mut self, seat: usize, route: u32, starts: Option<Instant>) {
        let Phase::Starting(start) = &self.phase else { return };
        if route == start.seq && starts == Some(start.at) {
            self.seats[seat].starts = starts;
        }
    }

    /// Whether a robot has begun at a moment that was put off, and may have ended its route since: it did not receive the
    /// later moment in time. Where its route leads nowhere that makes no difference.
    pub fn began_alone(&self, seat: usize, details: &Details) -> bool {
        let Phase::Starting(start) = &self.phase else { return false };
        let elsewhen = match details.state {
            RobotState::Driving | RobotState::Held => details.starts != Some(start.at),
            RobotState::Idle => self.seats[seat].starts != Some(start.at),
            _ => false,
        };
        let path = self.queue.front().and_then(|leg| leg.path(seat));
        elsewhen && details.route == start.seq && path.is_some_and(|path| !path.as_ref().rests())
    }

    /// Time passes while START is stated.
    pub fn tick_start(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Starting(mut start) = self.phase.clone() else { return };
        if now >= start.ask_at {
            start.ask_at = now + ASK_AGAIN.max(start.first.1);
            if !start.checked {
                self.ask_unconfirmed(desk, &start);
            }
        }
        if now >= start.check_at && !start.checked {
            start.checked = self.unconfirmed(desk, &start).is_empty();
            if !start.checked {
                self.put_off(desk, now, &mut start);
            }
        }
        if !matches!(self.phase, Phase::Starting(_)) {
            return;
        }
        if now >= start.at {
            self.depart(desk, now, start.at);
            return;
        }
        if now >= start.repeat_at {
            desk.outbox.say(Topic::Broadcast, &[Command::Start { seq: start.seq, at: start.at }]);
            start.repeat_at = now + if start.put_off > 0 { REPEAT_PUT_OFF } else { REPEAT };
        }
        self.phase = Phase::Starting(start);
    }

    /// Seats that did not answer to the stated moment. One whose route leads nowhere has answered as soon as it reports
    /// that it has begun or ended it: its clock was ahead of a moment that was put off, and no later START changes
    /// anything for it.
    fn unconfirmed(&self, desk: &Desk, start: &Start) -> Vec<usize> {
        let Some(leg) = self.queue.front() else { return Vec::new() };
        let owes = |&seat: &usize| {
            let (known, Some(path)) = (&self.seats[seat], leg.path(seat)) else { return false };
            let robot = desk.fleet.robot(known.robot);
            let begun =
                matches!(robot.state, Some(RobotState::Driving | RobotState::Held | RobotState::Idle));
            let rests_already = begun && robot.route == start.seq && path.as_ref().rests();
            !known.out && known.starts != Some(start.at) && !rests_already
        };
        (0..self.seats.len()).filter(owes).collect()
    }

    /// Asks the few by name whose answer may be lost.
    fn ask_unconfirmed(&mut self, desk: &mut Desk, start: &Start) {
        let unconfirmed = self.unconfirmed(desk, start);
        let starters = self.queue.front().map_or(0, |leg| leg.movers);
        if unconfirmed.len() > FEW.max(starters / 8) {
            return;
        }
        for seat in unconfirmed {
            let topic = Topic::Robot(desk.fleet.robot(self.seats[seat].robot).id);
            desk.outbox.say(topic, &[Command::Start { seq: start.seq, at: start.at }, Command::Status]);
        }
    }

    /// A robot that was asked again and again since START was stated first and says nothing at all has died: the others do
    /// not wait as long for it as for one that is heard over a slow link. Whether any dropped out.
    fn drop_silent(&mut self, desk: &mut Desk, now: Instant, start: &Start, deaf: &[usize]) -> bool {
        let (first, round_trip) = start.first;
        // One whose link broke after it received START stands by then.
        let bound = desk.config.silence + CUT.0 + CUT.1 + round_trip * 2;
        let is_silent =
            |seat: &usize| now - desk.fleet.robot(self.seats[*seat].robot).heard.max(first) > bound;
        let silent: Vec<usize> = deaf.iter().copied().filter(is_silent).collect();
        if silent.is_empty() || self.patience(first) > now - first {
            return false;
        }
        // The link is as fast as before: only the dead robot did not answer.
        self.round_trip = round_trip;
        for seat in silent {
            self.drop_out(desk, now, seat, Trouble::Silent);
        }
        true
    }

    /// A later moment for all; who did not confirm is told by name, or gets the route again.
    fn put_off(&mut self, desk: &mut Desk, now: Instant, start: &mut Start) {
        start.put_off += 1;
        let deaf = self.unconfirmed(desk, start);
        if self.drop_silent(desk, now, start, &deaf) {
            return;
        }
        if start.put_off > PUT_OFF_MAX {
            for seat in deaf {
                self.drop_out(desk, now, seat, Trouble::Deaf);
            }
            return;
        }
        if start.put_off == PUT_OFF_TOLD {
            for &seat in &deaf {
                let robot = desk.fleet.robot(self.seats[seat].robot).id;
                desk.log.tell_limited(now, EventKind::Waiting { robot, why: Trouble::Deaf });
            }
        }
        let starters = self.queue.front().map_or(0, |leg| leg.movers);
        if deaf.len() > FEW_LOST.max(starters / 8) {
            self.round_trip = (self.round_trip * 3 / 2).min(ROUND_TRIP_MAX);
        } else {
            // The others answered in time: messages are lost, and a few more questions do.
            self.lossy = (self.lossy + ASK_AGAIN * 3).min(LOSSY_MAX);
        }
        let lead = self.start_lead(desk);
        start.at = now + lead;
        start.check_at = start.at - self.check_ahead();
        start.repeat_at = now + REPEAT_PUT_OFF;
        start.ask_at = now + lead * ASK_FIRST / 100;
        let command = Command::Start { seq: start.seq, at: start.at };
        desk.outbox.say(Topic::Broadcast, std::slice::from_ref(&command));
        for seat in deaf {
            let robot = desk.fleet.robot(self.seats[seat].robot);
            let (topic, has_it) = (Topic::Robot(robot.id), robot.route == start.seq);
            if !has_it {
                self.upload_again(now, seat);
            }
            desk.outbox.say(topic, std::slice::from_ref(&command));
        }
        self.pump_upload(desk, now);
    }
}
