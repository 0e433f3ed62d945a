//! When something goes wrong: all stop, say where they stand, and are planned anew without those who are lost.

use crate::desk::Desk;
use crate::driving::Drive;
use crate::event::{EventKind, Outcome, Trouble};
use crate::fleet::Robot;
use crate::holding::Hold;
use crate::leg::Kind;
use crate::operation::MissingPolicy;
use crate::run::{Gathering, Phase, Run, Seat, Standing};
use crate::silent::{CUT, UNHEARD};
use crate::snapshot::Age;
use crate::trial::Trial;
use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_plan::Claims;
use lightbots_wire::{Command, RobotState, Route, Topic};

/// STOP is said this often, …
const SAY: u32 = 4;
/// … this far apart.
const SAY_EVERY: Span = Span::from_millis(40);
/// Reports count so long after STOP was said.
const SETTLE: Span = Span::from_millis(200);
/// Those who have not answered are asked again this often.
const ASK: Span = Span::from_millis(300);
/// How long answers are waited for, beyond the silence that drops a robot out.
const ANSWERS: Span = Span::from_millis(1_500);
/// An original robot stands if it said the same place for so long: it may turn on the spot before it drives.
const STILL: Span = Span::from_millis(1_200);
/// How long one may drive on that does not hear that it shall stop.
const DRIVES_ON: Span = Span::from_millis(20_000);
/// How long a robot may take to set its clock.
const CLOCK: Span = Span::from_millis(8_000);
/// Steps in which its path is followed from there.
const GHOST_STEP: Span = Span::from_millis(50);
/// Steps in which the way of an original robot is followed, metres.
const HOP_STEP_M: f64 = 0.03;
/// So many of them may pass until it stops, if it still hears.
const UNTIL_STOP: i64 = 2;
/// Places nearer than this to each other are one, metres: a place that is left out must not stick out.
const GHOST_M: f64 = 0.002;
/// A broker that came back may still be agreeing with itself who is to hear what: for so long, nobody is given up who is
/// heard and does not answer.
const AGREES: Span = Span::from_millis(15_000);
/// A robot that dropped out more often than this in a run stays out.
const DROPOUTS_MAX: u8 = 3;

impl Run {
    /// A robot takes no part any more; the rest goes on.
    pub fn drop_out(&mut self, desk: &mut Desk, now: Instant, seat: usize, why: Trouble) {
        let known = &mut self.seats[seat];
        if std::mem::replace(&mut known.out, true) {
            return;
        }
        // One that does not drive as told may come back once, after the next picture, to see if it does then.
        let fails = matches!(why, Trouble::Late | Trouble::Missed | Trouble::Blocked);
        known.dropouts = known.dropouts.saturating_add(if fails { 2 } else { 1 });
        known.back_from = if fails { self.frames_played + 1 } else { 0 };
        known.trial = if fails || why == Trouble::Faulty { Trial::Owed } else { Trial::None };
        known.late = None;
        known.fade = None;
        self.dropouts += 1;
        let (robot, heard) = (desk.fleet.robot(known.robot).id, desk.fleet.robot(known.robot).heard);
        if why == Trouble::Silent {
            let [mut likely, mut places] = self.whereabouts(now, seat, heard);
            places.extend(&likely);
            self.narrow(desk, &mut places);
            self.narrow(desk, &mut likely);
            (self.seats[seat].ghost, self.seats[seat].likely) = (places, likely);
        }
        desk.log.tell(now, EventKind::Dropout { robot, why });
        self.bound.dropped_out(robot, why);
        self.bound.begins(self.reached_by(now));
        self.recover(desk, now);
    }

    /// When the next frame would be reached as planned.
    pub fn reached_by(&self, now: Instant) -> Instant {
        match &self.phase {
            Phase::Driving(drive) => drive.ends,
            Phase::Starting(start) => start.at + self.queue.front().map_or(Span::ZERO, |leg| leg.duration),
            _ => now + self.queue.front().map_or(Span::ZERO, |leg| leg.duration),
        }
    }

    /// Where a robot that was heard last at `heard` may stand. Likely along its path from there, as it died, or where its
    /// path is now, as it only cannot be heard; or else where it gives its route up, as it does not hear either.
    fn whereabouts(&self, now: Instant, seat: usize, heard: Instant) -> [Vec<Vec2>; 2] {
        let (drive, stopping, stopped) = match &self.phase {
            Phase::Driving(drive) => (drive, now, now),
            Phase::Gathering(Gathering { broken_off: Some(drive), stopping, since, .. }) => {
                (drive, *stopping, *since)
            }
            _ => return Default::default(),
        };
        let Some(path) = self.current.as_ref().and_then(|leg| leg.path(seat)) else {
            return [self.hop_whereabouts(seat, HOP_STEP_M), Vec::new()];
        };
        let since = drive.path_time(heard);
        let died = (0..=UNHEARD.0 / GHOST_STEP.0).map(|step| since + GHOST_STEP * step);
        let until = (stopped - stopping).0 / GHOST_STEP.0 + UNTIL_STOP;
        let lives = (0..=until).map(|step| drive.path_time(stopping + GHOST_STEP * step));
        let cut = (0..=CUT.1.0 / GHOST_STEP.0).map(|step| since + CUT.0 + GHOST_STEP * step);
        let place = |time: Span| path.as_ref().at(time).position;
        [thinned(died.chain(lives).map(place)), thinned(cut.map(place))]
    }

    /// Who shows each pixel, or is on the way to it.
    fn shown(&self, desk: &Desk) -> Claims<RobotId> {
        let moves = self.current.iter().flat_map(|leg| leg.moves.iter().zip(&self.seats));
        let taking_part = moves.filter(|(_, seat)| !seat.out);
        let mut shown = Claims::default();
        for (step, seat) in taking_part {
            if let Some(pixel) = step.pixel {
                shown.show(pixel, desk.fleet.robot(seat.robot).id);
            }
        }
        shown
    }

    /// Plans again from where robots are; who drives is stopped first.
    pub fn recover(&mut self, desk: &mut Desk, now: Instant) {
        self.upload = None;
        self.queue.clear();
        self.drafting = None;
        desk.job = None;
        self.stray = false;
        self.hurry = true;
        self.plan_next = (self.next.frame < self.show.frames.len()).then_some(self.next);
        self.plan_from.clear();
        desk.mapping.shown = self.shown(desk);
        self.arrivals = None;
        match self.phase {
            Phase::Offline(_) | Phase::Gathering(_) => {}
            // What originals said last may be old: they say nothing of their own accord.
            Phase::Standing(_) if !self.has_originals(desk) => self.say_replanning(desk, now),
            Phase::Standing(_) | Phase::Starting(_) | Phase::Driving(_) => {
                self.say_replanning(desk, now);
                self.gather(desk, now);
            }
        }
    }

    /// There is no plan to the next frame from where robots stand: without those who came during the run and take no
    /// part, as anybody can say to be anywhere; or only around the likely places of silent ones; or around none of them; or
    /// else to the frame after it. Whether there is anything left to try.
    pub fn plan_something_else(&mut self, desk: &mut Desk, now: Instant) -> bool {
        let guessed = !self.found.is_empty() || self.seats.iter().any(|known| !known.ghost.is_empty());
        let unlikely = self.seats.iter().any(|known| known.ghost.len() > known.likely.len());
        let strangers = desk.fleet.robots().iter().any(|robot| self.is_stranger(robot));
        if strangers && !std::mem::replace(&mut self.disregards_strangers, true) {
        } else if unlikely {
            self.seats.iter_mut().for_each(|known| known.ghost.clone_from(&known.likely));
        } else if guessed {
            self.found.clear();
            self.seats.iter_mut().for_each(Seat::forget_ghost);
        } else {
            match self.after(self.next).filter(|next| next.round == self.next.round) {
                Some(next) => self.next = next,
                None => return false,
            }
        }
        self.recover(desk, now);
        true
    }

    /// Whether a robot takes no part and was not there when the run began.
    pub fn is_stranger(&self, robot: &Robot) -> bool {
        robot.seat.is_none() && robot.found > self.begun
    }

    fn say_replanning(&self, desk: &mut Desk, now: Instant) {
        if let Some(next) = self.plan_next {
            desk.log.tell_limited(now, EventKind::Replanning { frame: next.frame });
        }
    }

    /// Everybody stops and says where they stand.
    pub fn gather(&mut self, desk: &mut Desk, now: Instant) {
        desk.outbox.cease();
        self.forget_blocks();
        let first = self.current.is_none() && self.frames_played == 0;
        let broken_off = match self.phase {
            Phase::Driving(drive) => Some(drive),
            Phase::Standing(standing) => {
                self.stood = Some(standing);
                None
            }
            _ => None,
        };
        let stopping = broken_off.and_then(|drive| self.stops_together(now, &drive));
        let stop_at = stopping.map(|stopping| stopping + Route::EASE);
        match stopping {
            Some(at) => desk.outbox.broadcast(now, Command::Hold { at }, SAY, SAY_EVERY),
            None => desk.outbox.broadcast(now, Command::Stop, SAY, SAY_EVERY),
        }
        let stopping = stopping.unwrap_or(now);
        self.halt_originals(desk, now);
        let since = stop_at.unwrap_or(now);
        let fresh_from = since + SETTLE + self.round_trip;
        let ask_at = fresh_from;
        self.phase =
            Phase::Gathering(Gathering { stopping, since, fresh_from, ask_at, stop_at, first, broken_off });
    }

    /// When a drive is to be held before STOP: a lost STOP reaches its robot 40 ms later than the others, which is 11 mm at
    /// full speed and more than plans leave. `None` where robots stand, or stand before that.
    fn stops_together(&self, now: Instant, drive: &Drive) -> Option<Instant> {
        if self.current.as_ref().is_none_or(|leg| leg.kind == Kind::Targets) {
            return None;
        }
        let soonest = now + self.hold_lead();
        let at = match drive.hold {
            Some(Hold { at, until: None, .. }) => at,
            // All are still picking up again: they slow down once they have.
            Some(Hold { until: Some(until), .. }) => soonest.max(until + Route::EASE),
            None => soonest,
        };
        (now < at + Route::EASE && at < drive.ends).then_some(at)
    }

    /// Time passes while all are asked where they stand.
    pub fn tick_gathering(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Gathering(gathering) = self.phase else { return };
        if let Some(stop_at) = gathering.stop_at {
            if now >= stop_at {
                desk.outbox.broadcast(now, Command::Stop, SAY, SAY_EVERY);
                self.phase = Phase::Gathering(Gathering { stop_at: None, ..gathering });
            }
            return;
        }
        if let Some(why) = self.bound.exceeded(now) {
            self.over = Some(Outcome::Failed(why));
            return;
        }
        let waited = now - gathering.since;
        let mut all_ready = true;
        for seat in 0..self.seats.len() {
            if self.seats[seat].out {
                continue;
            }
            let trouble = missing(desk, &self.seats[seat], gathering.fresh_from);
            let bound = match trouble {
                Some(Trouble::Cut) => CLOCK,
                Some(Trouble::Deaf) if desk.fleet.robot(self.seats[seat].robot).is_original() => DRIVES_ON,
                _ => desk.config.silence + ANSWERS * self.tries(desk, seat) + self.round_trip * 2,
            };
            let unanswered = matches!(trouble, Some(Trouble::Cut | Trouble::Deaf));
            let bound = if unanswered { bound.max(self.patience(gathering.since)) } else { bound };
            match trouble {
                Some(why) if waited > bound => self.drop_out(desk, now, seat, why),
                Some(_) => all_ready = false,
                None => {}
            }
        }
        if all_ready {
            self.gathered(desk, now, &gathering);
        } else if now >= gathering.ask_at {
            self.ask_again(desk, now, gathering.fresh_from);
            self.phase = Phase::Gathering(Gathering { ask_at: now + ASK, ..gathering });
        }
    }

    /// How long from `since` on a robot that is heard may not answer because the broker came back only now.
    pub fn patience(&self, since: Instant) -> Span {
        self.online.map_or(Span::ZERO, |online| (online + AGREES - since).max(Span::ZERO))
    }

    /// How many times longer a robot's answer is waited for: an original says nothing of its own accord, so that a
    /// question and its answer must both come through.
    fn tries(&self, desk: &Desk, seat: usize) -> i64 {
        if desk.fleet.robot(self.seats[seat].robot).is_original() { 3 } else { 1 }
    }

    /// Whether any robot that takes part is an original one.
    fn has_originals(&self, desk: &Desk) -> bool {
        self.seats.iter().any(|known| !known.out && desk.fleet.robot(known.robot).is_original())
    }

    fn ask_again(&self, desk: &mut Desk, now: Instant, fresh_from: Instant) {
        for (seat, known) in self.seats.iter().enumerate().filter(|(_, known)| !known.out) {
            let Some(trouble) = missing(desk, known, fresh_from) else { continue };
            if trouble == Trouble::Deaf {
                self.halt_original(desk, now, seat);
            }
            let robot = desk.fleet.robot(known.robot);
            let command = match trouble {
                _ if robot.is_original() => Command::Uuid,
                Trouble::Deaf => Command::Stop,
                _ => Command::Status,
            };
            desk.outbox.say(Topic::Robot(robot.id), &[command]);
        }
    }

    /// All stand and their places are known.
    fn gathered(&mut self, desk: &mut Desk, now: Instant, gathering: &Gathering) {
        let riders = self.seats.iter().filter(|known| !known.out).count();
        let pixels = self.show.frames.get(self.next.frame).map_or(0, |frame| frame.pixels.len());
        if riders == 0 || gathering.first && self.missing == MissingPolicy::Refuse && riders < pixels {
            let why = self.shortage(desk, gathering.fresh_from, riders, pixels);
            self.over = Some(Outcome::Failed(why));
            return;
        }
        let (until, paused) = self.stood.take().map_or((now, None), |stood| (stood.until, stood.paused));
        self.phase = Phase::Standing(Standing { since: now, until: until.max(now), paused });
        self.tick_standing(desk, now);
    }

    /// A robot without a part, or out, is heard: it may take part from the next frame on.
    pub fn consider_joiner(&mut self, desk: &mut Desk, now: Instant, robot: usize) {
        let seat = desk.fleet.robot(robot).seat.map(|seat| seat as usize);
        let welcome = match seat {
            Some(seat) => self.seats[seat].dropouts <= DROPOUTS_MAX,
            None => self.dark,
        };
        let plays = self.purpose == crate::run::Purpose::Play;
        if !welcome || !plays || !is_ready(desk, robot) || self.joiners.contains(&robot) {
            return;
        }
        if seat.is_none_or(|seat| self.has_proven_itself(desk, now, seat)) {
            self.joiners.push(robot);
        }
    }

    /// Those who want to take part do, while all stand.
    pub fn seat_joiners(&mut self, desk: &mut Desk, now: Instant) {
        if self.joiners.is_empty() || self.next.frame >= self.show.frames.len() {
            return;
        }
        let mut joined = false;
        for robot in std::mem::take(&mut self.joiners) {
            if !is_ready(desk, robot) {
                continue;
            }
            let seat = desk.fleet.robot(robot).seat.map(|seat| &self.seats[seat as usize]);
            if seat.is_some_and(|known| known.back_from > self.frames_played) {
                self.joiners.push(robot);
                continue;
            }
            match desk.fleet.robot(robot).seat {
                Some(seat) => {
                    self.seats[seat as usize].out = false;
                    self.seats[seat as usize].forget_ghost();
                }
                None => {
                    desk.fleet.robot_mut(robot).seat = Some(self.seats.len() as u32);
                    self.seats.push(Seat::new(robot));
                }
            }
            joined = true;
            desk.log.tell(now, EventKind::Rejoined(desk.fleet.robot(robot).id));
        }
        if joined {
            self.recover(desk, now);
        }
    }

    /// The broker is lost: robots stop by themselves.
    pub fn go_offline(&mut self, desk: &mut Desk, now: Instant) {
        if let Phase::Standing(standing) = self.phase {
            self.stood = Some(standing);
        }
        self.recover(desk, now);
        self.phase = Phase::Offline(now);
    }

    /// The broker is back: who stands where?
    pub fn come_online(&mut self, desk: &mut Desk, now: Instant) {
        if let Phase::Offline(since) = self.phase {
            self.bound.put_off(now - since);
            self.online = Some(now);
            self.say_replanning(desk, now);
            self.gather(desk, now);
        }
    }
}

/// Places without those that are as good as the one before.
fn thinned(places: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = places.collect();
    places.dedup_by(|a, b| a.distance(*b) < GHOST_M);
    places
}

/// What a seat's robot lacks to be planned for; `None`: nothing.
pub(crate) fn missing(desk: &Desk, known: &Seat, fresh_from: Instant) -> Option<Trouble> {
    let robot = desk.fleet.robot(known.robot);
    if robot.heard < fresh_from {
        return Some(Trouble::Silent);
    }
    match robot.state {
        Some(RobotState::Faulty) => Some(Trouble::Faulty),
        Some(RobotState::Lost) => Some(Trouble::Lost),
        Some(RobotState::Driving | RobotState::Held) => Some(Trouble::Deaf),
        _ if robot.at.is_none() => Some(Trouble::Lost),
        _ if robot.is_original() && robot.heard - robot.stands_since < STILL => Some(Trouble::Deaf),
        _ if !robot.is_original() && robot.clock_us.is_none() => Some(Trouble::Cut),
        _ => None,
    }
}

/// Whether a robot could be planned for now.
fn is_ready(desk: &Desk, robot: usize) -> bool {
    desk.fleet.robot(robot).age == Age::Active && missing(desk, &Seat::new(robot), Instant::ZERO).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disc that is left out must not stick out of those that are kept: others pass them as near as planning likes.
    #[test]
    fn no_place_of_a_silent_robot_is_far_from_one_that_is_driven_around() {
        let braking = || (0..30).map(|step| Vec2::new(0.0135 * f64::from(step) * 0.9f64.powi(step), 0.0));
        let kept = thinned(braking());
        assert!(braking().all(|place| kept.iter().any(|disc| disc.distance(place) < 0.002)), "{kept:?}");
        assert_eq!(thinned([Vec2::ZERO; 9].into_iter()).len(), 1);
    }
}
