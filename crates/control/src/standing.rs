//! All stand: the air time runs, what comes is planned and handed out, and the next drive starts in time.

use crate::desk::Desk;
use crate::drafting::{Done, Job, Request, Rider};
use crate::event::{EventKind, Outcome};
use crate::leg::Kind;
use crate::operation::MissingPolicy;
use crate::run::{Cursor, Phase, Run};
use crate::snapshot::Age;
use lightbots_base::{Instant, Span, Vec2};

/// The most routes one job plans.
const ROUTES_A_JOB: usize = 400_000;
/// Fewer frames ahead than this, and more are planned.
const FRAMES_AHEAD: usize = 3;
/// START is said this much earlier than it must be.
const EARLY: Span = Span::from_millis(20);
/// Two robots cannot stand closer than this share of contact: one report is out of date.
const SAME_PLACE: f64 = 0.9;
/// A guessed disc is moved by at most this out of robots whose places are known, metres: guesses are off by 20 mm.
const GUESS_OFF_M: f64 = 0.03;
/// Clearance it is then given, metres: less than the planner can start with is moved apart by a drive of its own.
const OUTSIDE_M: f64 = 0.001;
/// Sweeps over the robots around a guessed disc: it lies between three at most.
const OUTSIDE_SWEEPS: usize = 10;
/// The most pixels an event lists.
const LISTED: usize = 16;

impl Run {
    /// Time passes while all stand.
    pub fn tick_standing(&mut self, desk: &mut Desk, now: Instant) {
        self.seat_joiners(desk, now);
        if self.stray {
            self.recover(desk, now);
        }
        self.plan_ahead(desk, now);
        self.pump_upload(desk, now);
        let Phase::Standing(standing) = &mut self.phase else { return };
        if self.pause {
            standing.paused.get_or_insert((standing.until - now).max(Span::ZERO));
            return;
        }
        if let Some(left) = standing.paused.take() {
            standing.until = now + left;
        }
        let until = standing.until;
        if let Some((_, since)) = self.drafting
            && now - since > desk.config.plan_bound
        {
            self.over = Some(Outcome::Failed("planning took too long".into()));
            return;
        }
        match self.queue.front().map(|leg| leg.kind) {
            Some(Kind::Targets) if now >= until => self.start(desk, now, until),
            Some(Kind::Routes) if self.is_uploaded() && now + self.start_lead(desk) + EARLY >= until => {
                self.start(desk, now, until)
            }
            None if self.drafting.is_none() && self.plan_next.is_none() && now >= until => {
                match self.failed.take() {
                    None => self.over = Some(Outcome::Finished),
                    // What stood in the way when that was planned ahead may have gone.
                    Some(_) if self.plan_something_else(desk, now) => {}
                    Some(why) => self.over = Some(Outcome::Failed(why)),
                }
            }
            _ => {}
        }
    }

    /// When something is due while all stand.
    pub fn standing_due(&self, desk: &Desk, now: Instant, until: Instant) -> Instant {
        let drafted = self.drafting.map_or(Instant::FAR, |_| now + Span::from_millis(1_000));
        let upload = self.upload.as_ref().and_then(|upload| upload.due()).unwrap_or(Instant::FAR);
        let start = match self.queue.front().map(|leg| leg.kind) {
            _ if self.pause => Instant::FAR,
            Some(Kind::Routes) if self.is_uploaded() => until - self.start_lead(desk) - EARLY,
            Some(Kind::Routes) => Instant::FAR,
            _ => until,
        };
        drafted.min(upload).min(start).min(now + Span::from_millis(1_000))
    }

    /// Gives out the next planning job, if one is due.
    pub fn plan_ahead(&mut self, desk: &mut Desk, now: Instant) {
        let ahead = self.queue.iter().filter(|leg| leg.airs).count();
        let gathered = matches!(self.phase, Phase::Standing(_) | Phase::Driving(_) | Phase::Starting(_));
        let (Some(first), None, true) = (self.plan_next, self.drafting, ahead < FRAMES_AHEAD && gathered)
        else {
            return;
        };
        if self.plan_from.len() != self.seats.len() {
            self.plan_from = (0..self.seats.len()).map(|seat| self.place(desk, seat)).collect();
        }
        let lenient = self.missing == MissingPolicy::LeaveOut || self.current.is_some() || self.hurry;
        let stopped = std::mem::take(&mut self.hurry);
        let most = if stopped { 1 } else { ROUTES_A_JOB / self.seats.len().max(1) };
        let mut frames = vec![(first.frame, first.round)];
        self.plan_tail = first;
        self.plan_next = self.after(first);
        while let Some(next) = self.plan_next.filter(|next| frames.len() < most && next.round == first.round)
        {
            frames.push((next.frame, next.round));
            self.plan_tail = next;
            self.plan_next = self.after(next);
        }
        let [reported, guessed] = self.standing_discs(desk);
        let request = Request {
            show: self.show.clone(),
            frames,
            riders: self.riders(desk),
            seats: self.seats.len(),
            standing: [&reported[..], &guessed[..]].concat(),
            guessed,
            mapping: desk.mapping.clone(),
            lenient,
            stopped,
        };
        desk.job_number += 1;
        desk.job = Some(Job { number: desk.job_number, request });
        self.drafting = Some((desk.job_number, now));
    }

    fn riders(&self, desk: &Desk) -> Vec<Rider> {
        let rider = |seat: usize| {
            let robot = desk.fleet.robot(self.seats[seat].robot);
            Rider { seat, id: robot.id, at: self.plan_from[seat], original: robot.is_original() }
        };
        (0..self.seats.len()).filter(|&seat| !self.seats[seat].out).map(rider).collect()
    }

    /// Robots that stand on the floor and take no part, and after them what is guessed to stand there. One that would stand
    /// inside another that does is out of date.
    fn standing_discs(&self, desk: &Desk) -> [Vec<Vec2>; 2] {
        let takes_part = |seat: Option<u32>| seat.is_some_and(|seat| !self.seats[seat as usize].out);
        let near_m = self.show.stage.limits.contact_m() * SAME_PLACE;
        let riders: Vec<Vec2> =
            (0..self.seats.len()).filter(|&s| !self.seats[s].out).map(|s| self.plan_from[s]).collect();
        let robots = desk.fleet.robots().iter();
        let idle = robots
            .filter(|robot| !takes_part(robot.seat) && (robot.seat.is_some() || robot.age != Age::Gone))
            .filter(|robot| !(self.disregards_strangers && self.is_stranger(robot)))
            // Where a silent one may be by now is known better than by what it said last.
            .filter(|robot| robot.seat.is_none_or(|seat| self.seats[seat as usize].ghost.is_empty()));
        let ghosts = self.seats.iter().filter(|known| known.out).flat_map(|known| known.ghost.iter());
        let free = |at: &Vec2| riders.iter().all(|rider| rider.distance(*at) >= near_m);
        let outside = |at: &Vec2| outside(*at, &riders, self.show.stage.limits.contact_m());
        [
            idle.filter_map(|robot| robot.at).filter(free).collect(),
            ghosts.chain(&self.found).map(outside).filter(free).collect(),
        ]
    }

    /// A plan is there.
    pub fn planned(&mut self, desk: &mut Desk, now: Instant, done: Done) {
        if self.drafting.is_none_or(|(number, _)| number != done.number) {
            return;
        }
        self.drafting = None;
        if done.stopped && done.failed.is_none() {
            if self.costs_too_much(desk, now, &done) {
                return;
            }
            self.bound.replanned();
        }
        (desk.mapping.owners, desk.mapping.shown) = (done.mapping.owners, done.mapping.shown);
        if let Some(last) = done.legs.last() {
            self.plan_from = last.moves.iter().map(|step| step.goal).collect();
            for seat in (0..self.seats.len()).filter(|&seat| self.seats[seat].out) {
                self.plan_from[seat] = self.place(desk, seat);
            }
        }
        self.dark = !done.dark.is_empty();
        for (frame, mut pixels) in done.dark {
            let count = pixels.len();
            pixels.truncate(LISTED);
            desk.log.tell(now, EventKind::LeftOut { frame, pixels, count });
        }
        let mut takes = Span::ZERO;
        for mut leg in done.legs {
            leg.seq = desk.take_seq();
            takes += leg.duration;
            if leg.airs {
                let air_s = self.show.frames.get(leg.frame).map_or(0.0, |frame| frame.air_time_s);
                let air = Span::from_secs(if air_s.is_finite() { air_s.clamp(0.0, 86_400.0) } else { 0.0 });
                self.bound.planned(leg.frame, std::mem::take(&mut takes) + air);
            }
            self.queue.push_back(leg);
        }
        desk.log.tell(now, EventKind::Planned { frames: done.frames });
        let unbegun = self.current.is_none();
        if let Some((frame, message)) = done.failed {
            desk.log.tell(now, EventKind::PlanFailed { frame, message: message.clone() });
            let why = format!("no way to frame {}: {message}", frame + 1);
            self.plan_next = None;
            if unbegun && self.frames_played == 0 {
                self.over = Some(Outcome::Failed(why));
                return;
            }
            let stranded = self.queue.is_empty() && matches!(self.phase, Phase::Standing(_));
            if !(stranded && self.plan_something_else(desk, now)) {
                self.failed = Some(why);
            }
        } else if unbegun && self.dark && self.missing == MissingPolicy::Refuse {
            let why = "some pixels have no robot, or one that takes no part stands on them".to_string();
            self.over = Some(Outcome::Failed(why));
            return;
        }
        match self.phase {
            Phase::Standing(_) => self.tick_standing(desk, now),
            Phase::Driving(_) => self.pump_upload(desk, now),
            _ => {}
        }
    }

    /// Whether recovery has cost too much, or would with this plan: then another is made, or the run ends.
    fn costs_too_much(&mut self, desk: &mut Desk, now: Instant, done: &Done) -> bool {
        let takes = done.legs.iter().fold(Span::ZERO, |sum, leg| sum + leg.duration);
        let Some(why) = self.bound.exceeded(now + takes) else { return false };
        let frame = self.next.frame;
        let message = format!("the drive around what stands there would take {:.0} s", takes.as_secs());
        desk.log.tell(now, EventKind::PlanFailed { frame, message });
        if self.bound.exceeded(now).is_some() || !self.plan_something_else(desk, now) {
            self.over = Some(Outcome::Failed(why));
        }
        true
    }

    /// The show starts again after its last frame, or does not.
    pub fn set_looping(&mut self, looping: bool) {
        self.looping = looping;
        let ended = self.next.frame >= self.show.frames.len();
        if looping {
            if ended && self.over.is_none() {
                self.next = Cursor { frame: 0, round: self.next.round + 1 };
            }
            if self.plan_next.is_none() && self.failed.is_none() {
                self.plan_next = self.after(self.plan_tail);
            }
            return;
        }
        let starting = matches!(self.phase, Phase::Starting(_));
        let present = self.current.as_ref().filter(|_| !starting).map_or(self.next.round, |leg| leg.round);
        self.queue.retain(|leg| leg.round <= present);
        if self.plan_tail.round > present {
            self.drafting = None;
            let end = Cursor { frame: self.show.frames.len().saturating_sub(1), round: present };
            self.plan_tail = end;
            if let Some(last) = self.queue.back().or(self.current.as_ref()) {
                self.plan_from = last.moves.iter().map(|step| step.goal).collect();
            }
        }
        self.plan_next = self.plan_next.filter(|next| next.round <= present);
        if self.next.round > present {
            self.next = Cursor { frame: usize::MAX, round: present };
        }
    }
}

/// A guessed place of a disc, moved until it touches none of the robots that are known to stand there; farther than
/// [`GUESS_OFF_M`] it stays inside one, and is wrong.
fn outside(guess: Vec2, riders: &[Vec2], contact_m: f64) -> Vec2 {
    let near: Vec<Vec2> =
        riders.iter().copied().filter(|rider| rider.distance(guess) < 2.0 * contact_m).collect();
    let mut at = guess;
    for _ in 0..OUTSIDE_SWEEPS {
        for rider in &near {
            let missing_m = contact_m + OUTSIDE_M - rider.distance(at);
            if missing_m > 0.0 {
                at += (at - *rider).normalized().unwrap_or(Vec2::new(1.0, 0.0)) * missing_m;
            }
        }
    }
    if at.distance(guess) <= GUESS_OFF_M { at } else { guess }
}
