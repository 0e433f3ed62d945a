//! Routes on their way to the robots: sent within a window, acknowledged by reports, sent again until they are.

use crate::desk::Desk;
use crate::driving::CHECK;
use crate::event::{EventKind, Outcome, Trouble};
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Pieces, Route, Topic};
use std::collections::VecDeque;

/// Routes of the next leg wait this long after the current one began: a robot whose clock or step is a little behind has
/// not begun it yet, and would take the next one in its place.
const BEGUN: Span = CHECK;
/// The most room that is told, millimetres.
const ROOM_MOST_MM: f64 = 40.0;

/// The upload of one leg.
#[derive(Clone, Debug)]
pub(crate) struct Upload {
    pub seq: u32,
    began: Instant,
    /// It was said that nobody hears.
    told: bool,
    /// The next seat to be served for the first time.
    cursor: usize,
    /// Sent and not known to be acknowledged: when to look again, and the seat. In order of time.
    sent: VecDeque<(Instant, usize)>,
    /// Seats sent to and not yet acknowledged.
    open: usize,
    /// Acknowledgements of routes sent once, and the slowest of them.
    once: (usize, Span),
    /// Acknowledgements of routes sent more often, and the slowest since the first sending.
    again: (usize, Span),
}

impl Upload {
    /// When something is due.
    pub fn due(&self) -> Option<Instant> {
        self.sent.front().map(|(due, _)| *due)
    }

    /// Whether several were sent to, and not one acknowledged.
    fn is_unheard(&self) -> bool {
        self.open > 1 && self.once.0 + self.again.0 == 0
    }
}

impl Run {
    /// Whether all who take part in the next leg have its route.
    pub fn is_uploaded(&self) -> bool {
        match (&self.upload, self.queue.front()) {
            (Some(upload), Some(leg)) => {
                upload.seq == leg.seq && upload.open == 0 && upload.cursor >= leg.moves.len()
            }
            _ => false,
        }
    }

    /// Begins handing out the first leg of the queue, unless that has begun.
    pub fn begin_upload(&mut self, now: Instant) {
        let Some(leg) = self.queue.front() else { return };
        if self.upload.as_ref().is_some_and(|upload| upload.seq == leg.seq) {
            return;
        }
        self.upload = Some(Upload {
            seq: leg.seq,
            began: now,
            told: false,
            cursor: 0,
            sent: VecDeque::new(),
            open: 0,
            once: (0, Span::ZERO),
            again: (0, Span::ZERO),
        });
    }

    /// Sends what may be sent now: first those not served yet, then those who did not acknowledge.
    pub fn pump_upload(&mut self, desk: &mut Desk, now: Instant) {
        if matches!(&self.phase, Phase::Driving(drive) if now < drive.began + BEGUN) {
            return;
        }
        self.begin_upload(now);
        let Some(mut upload) = self.upload.take() else { return };
        if self.queue.front().is_none_or(|leg| leg.seq != upload.seq) {
            return;
        }
        let resend_after = desk.config.resend_after.max(self.round_trip * 5 / 4);
        while let Some(&(due, seat)) = upload.sent.front() {
            let settled = self.seats[seat].out || self.seats[seat].acked == upload.seq;
            if !settled && due > now {
                break;
            }
            upload.sent.pop_front();
            if settled {
                continue;
            }
            if self.seats[seat].tries >= desk.config.tries && !self.is_link_dumb(desk, now, &mut upload, seat)
            {
                self.upload = Some(upload);
                self.drop_out(desk, now, seat, Trouble::Deaf);
                return;
            }
            desk.resent += 1;
            self.send_route(desk, now, seat);
            upload.sent.push_back((now + resend_after, seat));
        }
        let count = self.queue.front().map_or(0, |leg| leg.moves.len());
        while upload.cursor < count && upload.open < desk.config.window {
            let seat = upload.cursor;
            upload.cursor += 1;
            if self.seats[seat].out || self.queue.front().is_none_or(|leg| leg.path(seat).is_none()) {
                continue;
            }
            self.seats[seat].tries = 0;
            self.send_route(desk, now, seat);
            upload.open += 1;
            upload.sent.push_back((now + resend_after, seat));
        }
        self.upload = Some(upload);
    }

    /// Whether a robot that does not acknowledge is one of many, all of them alive, or the broker came back only now:
    /// then what is said may not reach it, and it is not for the robot to be left out. That has its bound, as a broker
    /// that is gone has.
    fn is_link_dumb(&mut self, desk: &mut Desk, now: Instant, upload: &mut Upload, seat: usize) -> bool {
        let returns = now - upload.began < self.patience(upload.began);
        let heard = desk.fleet.robot(self.seats[seat].robot).heard > upload.began;
        if !heard || !(upload.is_unheard() || returns) {
            return false;
        }
        if upload.is_unheard() && !std::mem::replace(&mut upload.told, true) {
            desk.log.tell(now, EventKind::NobodyHears);
        }
        // How long the answer takes once the way is free again says nothing of the link.
        self.seats[seat].sent = now;
        if now - upload.began > desk.config.offline_bound {
            self.over = Some(Outcome::Failed("no robot acknowledges its path".into()));
        }
        true
    }

    /// A report names the route its robot keeps.
    pub fn hear_ack(&mut self, desk: &mut Desk, now: Instant, seat: usize, route: u32) {
        let Some(upload) = &mut self.upload else { return };
        let known = &mut self.seats[seat];
        if route != upload.seq || known.acked == route || known.tries == 0 {
            return;
        }
        known.acked = route;
        known.fade = None;
        let (count, slowest) = if known.tries == 1 { &mut upload.once } else { &mut upload.again };
        *count += 1;
        *slowest = (*slowest).max(now - known.sent);
        upload.open = upload.open.saturating_sub(1);
        let more = upload.cursor < self.queue.front().map_or(0, |leg| leg.moves.len());
        if more {
            self.pump_upload(desk, now);
        } else if upload.open == 0 {
            // Where most were sent again the link is slow rather than lossy.
            let slow = upload.again.0 > upload.once.0;
            self.round_trip = self.round_trip.max(if slow { upload.again.1 } else { upload.once.1 });
        }
    }

    /// A robot has lost the route it acknowledged, or never had it: it gets it again.
    pub fn upload_again(&mut self, now: Instant, seat: usize) {
        let Some(upload) = &mut self.upload else { return };
        if self.seats[seat].acked == upload.seq {
            self.seats[seat].acked = 0;
            upload.open += 1;
            upload.sent.push_front((now, seat));
        }
    }

    /// The next leg's route of a seat, with the change of light it may not know yet.
    fn send_route(&mut self, desk: &mut Desk, now: Instant, seat: usize) {
        let Some(leg) = self.queue.front() else { return };
        let Some(path) = leg.path(seat) else { return };
        let Ok(pieces) = Pieces::from_slice(&path.pieces) else { return };
        let known = &mut self.seats[seat];
        if known.tries == 0 {
            known.sent = now;
        }
        known.tries += 1;
        let robot = desk.fleet.robot(known.robot);
        let topic = Topic::Robot(robot.id);
        // The cast rounds down, and less than nothing to nothing.
        let room_mm = robot.abilities.room.then(|| (leg.moves[seat].room_m * 1e3).min(ROOM_MOST_MM) as u16);
        let neighbours = leg.moves[seat].neighbours.as_deref().filter(|_| robot.abilities.neighbours);
        let neighbours = neighbours.cloned().unwrap_or_default();
        let route = Command::Route(Route { seq: leg.seq, start: path.start, pieces, room_mm, neighbours });
        match known.fade {
            Some(fade) => desk.outbox.say(topic, &[route, Command::Fade(fade)]),
            None => desk.outbox.say(topic, &[route]),
        }
    }
}
