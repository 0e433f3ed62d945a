//! START: stated ahead for everybody at once, repeated, confirmed by reports, put off for those who did not hear it.

use crate::event::Trouble;
use crate::leg::Kind;
use crate::run::{Desk, Phase, Run};
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Topic};

/// So many who did not confirm are asked by name.
const FEW: usize = 64;
/// START is said again this often until its moment.
const REPEAT: Span = Span::from_millis(40);
/// Whether all have confirmed is looked at this long before the moment.
const CHECK_AHEAD: Span = Span::from_millis(60);
/// How often the moment is put off before the deaf ones are given up.
const PUT_OFF_MAX: u32 = 12;
/// The longest START is stated ahead.
const LEAD_MAX: Span = Span::from_millis(3_000);
/// Added to the lead for every robot, so that all can confirm.
const LEAD_PER_ROBOT: Span = Span(20);

/// A stated START.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub at: Instant,
    pub seq: u32,
    stated: Instant,
    repeat_at: Instant,
    /// When those who did not confirm are asked by name.
    ask_at: Instant,
    /// Seats that confirmed this moment.
    confirmed: usize,
    put_off: u32,
    /// All had confirmed when it was looked at.
    checked: bool,
}

impl Start {
    /// When something is due.
    pub fn due(&self) -> Instant {
        let moment = if self.checked { self.at } else { self.at - CHECK_AHEAD };
        moment.min(self.repeat_at).min(self.ask_at)
    }
}

impl Run {
    /// How long ahead START is stated now.
    pub fn start_lead(&self) -> Span {
        self.lead + LEAD_PER_ROBOT * self.seats.len() as i64
    }

    /// Starts the first leg of the queue as soon as may be, but not before `earliest`.
    pub fn start(&mut self, desk: &mut Desk, now: Instant, earliest: Instant) {
        let Some(leg) = self.queue.front() else { return };
        if leg.kind == Kind::Targets {
            self.depart(desk, now, now);
            return;
        }
        let (at, seq) = (earliest.max(now + self.start_lead()), leg.seq);
        let (repeat_at, ask_at) = (now + REPEAT, now + self.start_lead() * 2 / 5);
        let start =
            Start { at, seq, stated: now, repeat_at, ask_at, confirmed: 0, put_off: 0, checked: false };
        desk.outbox.say(Topic::Broadcast, &[Command::Start { seq, at }]);
        self.phase = Phase::Starting(start);
    }

    /// A report says when the robot's route starts.
    pub fn hear_start(&mut self, now: Instant, seat: usize, route: u32, starts: Option<Instant>) {
        let Phase::Starting(start) = &mut self.phase else { return };
        let known = &mut self.seats[seat];
        if route != start.seq || starts != Some(start.at) || known.starts == starts {
            return;
        }
        known.starts = starts;
        start.confirmed += 1;
        // What the slowest needed is stated ahead the next time, with some to spare.
        let took = now - start.stated + CHECK_AHEAD;
        self.lead = self.lead.max(Span(took.0 + took.0 / 4)).min(LEAD_MAX);
    }

    /// Time passes while START is stated.
    pub fn tick_start(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Starting(mut start) = self.phase.clone() else { return };
        let needed = self.queue.front().map_or(0, |leg| leg.movers);
        let check = start.at - CHECK_AHEAD;
        if now >= start.ask_at {
            start.ask_at = Instant::FAR;
            self.ask_unconfirmed(desk, &start, needed);
        }
        if now >= check && !start.checked {
            start.checked = start.confirmed >= needed;
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
            start.repeat_at = now + REPEAT;
        }
        self.phase = Phase::Starting(start);
    }

    /// Seats that did not confirm the stated moment.
    fn unconfirmed(&self, at: Instant) -> Vec<usize> {
        let Some(leg) = self.queue.front() else { return Vec::new() };
        let starts = |seat: &usize| !self.seats[*seat].out && leg.path(*seat).is_some();
        (0..self.seats.len()).filter(starts).filter(|&seat| self.seats[seat].starts != Some(at)).collect()
    }

    /// Asks the few by name whose answer may be lost.
    fn ask_unconfirmed(&mut self, desk: &mut Desk, start: &Start, needed: usize) {
        if needed - start.confirmed.min(needed) > FEW.max(needed / 8) {
            return;
        }
        for seat in self.unconfirmed(start.at) {
            let topic = Topic::Robot(desk.fleet.robot(self.seats[seat].robot).id);
            desk.outbox.say(topic, &[Command::Start { seq: start.seq, at: start.at }, Command::Status]);
        }
    }

    /// A later moment for all; who did not confirm is told by name, or gets the route again.
    fn put_off(&mut self, desk: &mut Desk, now: Instant, start: &mut Start) {
        start.put_off += 1;
        let deaf = self.unconfirmed(start.at);
        if start.put_off > PUT_OFF_MAX {
            for seat in deaf {
                self.drop_out(desk, now, seat, Trouble::Deaf);
            }
            return;
        }
        self.lead = (self.lead * 3 / 2).min(LEAD_MAX);
        start.at = now + self.start_lead();
        start.stated = now;
        start.confirmed = 0;
        start.repeat_at = now + REPEAT;
        start.ask_at = now + self.start_lead() * 2 / 5;
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
