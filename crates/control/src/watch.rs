//! The watch over a drive: who is silent, late or overdue, and whether a hold holds.

use crate::desk::Desk;
use crate::driving::{CHECK, Drive, is_there};
use crate::event::Trouble;
use crate::holding::Hold;
use crate::leg::Kind;
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Command, Details, RobotState, Topic};

/// Robots that are looked at in one check, and an eighth of all more. A silent one is asked each time: with one message in
/// ten lost, a robot that was asked four times before it was given up dropped out in one of ten runs of 200.
const SLICE: usize = 512;
/// At most this far off its path a robot may be without anybody waiting for it, metres.
const LATE_MAX_M: f64 = 0.03;
/// A robot is back on its path when it is off it by less than this share of what makes it late.
const BACK: f64 = 0.6;
/// A robot no less sure of its place than this (1 sigma, metres) makes nobody wait, …
const SURE_M: f64 = 0.004;
/// … one less sure than this does in any case, before it is lost, …
const UNSURE_M: f64 = 0.010;
/// … and one between, if anybody comes closer than so many sigmas, …
const UNSURE: f64 = 2.5;
/// … and this for the others' own errors, metres, …
const OTHERS_M: f64 = 0.003;
/// … within this time, in steps of that.
const AHEAD: Span = Span::from_millis(1_000);
const AHEAD_STEP: Span = Span::from_millis(50);
/// Everybody waits for robots that are unsure for so long in fleets of up to …
const PATIENCE: Span = Span::from_millis(3_500);
/// … so many robots, less in larger ones, but at least …
const PATIENCE_ROBOTS: f64 = 40.0;
/// … this.
const IMPATIENCE: Span = Span::from_millis(700);
/// A driving robot that was not heard for so long, link times on top, is asked for a sign of life, …
const QUIET: Span = Span::from_millis(560);
/// … this often at most.
const ASK: Span = Span::from_millis(90);
/// Robots that have not arrived so long after the planned end are judged by where they stand.
const OVERDUE: Span = Span::from_millis(3_000);
/// A robot that drives on its route but is not at its end when the plan ends is in a world that is slower than the plan: a
/// simulation on a busy machine. The fleet waits for it this long after the planned end; without a bound, a robot that
/// reports nonsense would stop the show for good.
const SLOW: Span = Span::from_millis(60_000);
/// A robot this much farther from its goal than it is off its route is still on its way, metres.
const END_M: f64 = 0.01;
/// A robot has made progress once it is this much nearer to its goal, metres: more than its fixes are off.
const NEARER_M: f64 = 0.005;
/// A robot standing farther from its goal than this has missed it, metres.
pub(crate) const MISSED_M: f64 = 0.06;
/// News older than this at the begin of a drive may be from before it.
const OLD_NEWS: Span = Span::from_millis(800);
/// A robot whose clock is ahead may end its route this much before the planned end.
const EARLY: Span = Span::from_millis(100);
/// A hold that not all keep after this is given up, and all are stopped.
const HOLD_BOUND: Span = Span::from_millis(1_200);

impl Run {
    /// A driving robot says how it is.
    pub fn judge(&mut self, desk: &mut Desk, now: Instant, seat: usize, details: &Details) {
        let Phase::Driving(drive) = &self.phase else { return };
        let Some(leg) = &self.current else { return };
        if !self.is_awaited(seat) || self.seats[seat].arrived || leg.kind != Kind::Routes {
            return;
        }
        let (began, ends, seq) = (drive.began, drive.ends, leg.seq);
        let goal = leg.moves[seat].goal;
        let rested = details.route == seq && leg.path(seat).is_some_and(|path| path.as_ref().rests());
        match details.state {
            RobotState::Lost => self.drop_out(desk, now, seat, Trouble::Lost),
            RobotState::Faulty => self.drop_out(desk, now, seat, Trouble::Faulty),
            RobotState::Cut => self.replan_with(desk, now, seat),
            RobotState::Driving | RobotState::Held => {
                self.hear_block(desk, now, seat, details.blocked);
                self.judge_progress(desk, now, seat, details);
            }
            RobotState::Idle | RobotState::Ready => {
                let at = desk.fleet.robot(self.seats[seat].robot).at;
                let there = at.is_some_and(|at| is_there(at, goal, desk.config.arrival_tolerance_m));
                let waits = details.state == RobotState::Ready && details.route == seq;
                // Whether one that only had to rest began too early makes no difference.
                if there && (now + EARLY >= ends || rested) && !waits {
                    self.arrive(desk, now, seat);
                } else if now + EARLY < ends && now > began + OLD_NEWS {
                    self.replan_with(desk, now, seat);
                }
            }
        }
    }

    /// A robot lost its route but can go on: all stop and are planned anew, with it.
    pub fn replan_with(&mut self, desk: &mut Desk, now: Instant, seat: usize) {
        let robot = desk.fleet.robot(self.seats[seat].robot).id;
        let told = crate::event::EventKind::Waiting { robot, why: Trouble::Cut };
        desk.log.tell_limited(now, told);
        self.recover(desk, now);
    }

    /// Everybody waits for who is too far off its path, or so unsure of its place that others may be in its way, until
    /// that is over.
    fn judge_progress(&mut self, desk: &mut Desk, now: Instant, seat: usize, details: &Details) {
        let room_m = self.current.as_ref().map_or(0.0, |leg| leg.room_m);
        let late_m = desk.config.late_m.max((room_m / 2.0).min(LATE_MAX_M));
        let off_m = details.off_m.unwrap_or(0.0);
        let unsure = details.err_m.is_some_and(|err_m| self.is_too_unsure(now, seat, err_m));
        if (off_m > late_m || unsure) && self.seats[seat].late.is_none() {
            let why = if unsure { Trouble::Unsure } else { Trouble::Late };
            self.mark_late(desk, now, seat, why);
            return;
        }
        let Phase::Driving(drive) = &mut self.phase else { return };
        let late = &mut self.seats[seat].late;
        if off_m < late_m * BACK && !unsure && late.take().is_some() {
            drive.late = drive.late.saturating_sub(1);
            let over = drive.late == 0 && drive.hold.is_some_and(|hold| !hold.by_operator);
            if over {
                self.release(desk, now);
            }
        }
    }

    /// Whether a robot may touch another before all could stand, if its place is off by as much as it may be.
    fn is_too_unsure(&self, now: Instant, seat: usize, err_m: f64) -> bool {
        let (Phase::Driving(drive), Some(leg)) = (&self.phase, &self.current) else { return false };
        if !(SURE_M..UNSURE_M).contains(&err_m) {
            return err_m >= UNSURE_M;
        }
        let needed_m = self.show.stage.limits.contact_m() + UNSURE * err_m + OTHERS_M;
        let from = drive.path_time(now).max(Span::ZERO);
        let place = |seat: usize, time: Span| match leg.path(seat) {
            Some(path) => path.as_ref().at(time).position,
            None => leg.moves.get(seat).map_or(Vec2::ZERO, |step| step.goal),
        };
        let far_m = needed_m + 2.0 * self.show.stage.limits.speed_mps * AHEAD.as_secs();
        let here = place(seat, from);
        let near = |other: &usize| *other != seat && place(*other, from).distance(here) < far_m;
        let near: Vec<usize> = (0..leg.moves.len()).filter(near).collect();
        (0..=AHEAD.0 / AHEAD_STEP.0).any(|step| {
            let time = from + AHEAD_STEP * step;
            let at = place(seat, time);
            near.iter().any(|&other| place(other, time).distance(at) < needed_m)
        })
    }

    pub fn mark_late(&mut self, desk: &mut Desk, now: Instant, seat: usize, why: Trouble) {
        let Phase::Driving(drive) = &mut self.phase else { return };
        drive.late += 1;
        self.seats[seat].late = Some(now);
        self.seats[seat].unsure = why == Trouble::Unsure;
        self.wait_for(desk, now, seat, why);
    }

    /// Looks at the next slice of seats, and at the hold.
    pub fn watch(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Driving(drive) = &mut self.phase else { return };
        if now < drive.check_at {
            return;
        }
        drive.check_at = now + CHECK;
        let drive = *drive;
        self.check_hold(desk, now, &drive);
        self.lose_patience(desk, now, &drive);
        if self.watched >= self.seats.len() {
            self.watched = 0;
        }
        let slice = self.watched..(self.watched + SLICE + self.seats.len() / 8).min(self.seats.len());
        self.watched = slice.end;
        for seat in slice {
            if !matches!(self.phase, Phase::Driving(_)) {
                return;
            }
            if !self.seats[seat].out && !self.seats[seat].arrived && self.is_awaited(seat) {
                match self.current.as_ref().map(|leg| leg.kind) {
                    Some(Kind::Routes) => self.watch_driver(desk, now, seat, &drive),
                    _ => self.watch_original(desk, now, seat),
                }
            }
        }
    }

    fn watch_driver(&mut self, desk: &mut Desk, now: Instant, seat: usize, drive: &Drive) {
        if self.watch_probed(desk, now, seat) {
            return;
        }
        let silent = now - desk.fleet.robot(self.seats[seat].robot).heard.max(drive.began);
        if self.watch_silent(desk, now, seat, silent) {
            return;
        }
        if let Some(since) = self.seats[seat].blocked {
            self.watch_blocked(desk, now, seat, since);
            return;
        }
        let held = drive.hold.is_some_and(|hold| hold.until.is_none());
        let progressed = self.comes_nearer(desk, now, seat);
        let waited =
            |since: Instant| now - since.max(progressed) > desk.config.late_bound || now - since > SLOW;
        if self.seats[seat].late.is_some_and(waited) && held {
            self.drop_out(desk, now, seat, Trouble::Late);
            return;
        }
        if now <= drive.ends + SLOW {
            let on_its_way = if self.is_on_its_way(desk, seat) { now } else { progressed };
            self.seats[seat].on_its_way = on_its_way.max(self.seats[seat].on_its_way);
        }
        if !held && now > drive.ends.max(self.seats[seat].on_its_way) + OVERDUE {
            self.settle_overdue(desk, now, seat);
            return;
        }
        let overdue = !held && now >= drive.ask_at;
        if overdue || silent > QUIET + self.round_trip {
            self.ask_status(desk, now, seat);
        }
    }

    /// When a robot last said that it came nearer to its goal: it is waited for while it does.
    fn comes_nearer(&mut self, desk: &Desk, now: Instant, seat: usize) -> Instant {
        let goal = self.current.as_ref().and_then(|leg| leg.moves.get(seat)).map(|step| step.goal);
        let at = desk.fleet.robot(self.seats[seat].robot).at;
        if let (Some(at), Some(goal)) = (at, goal)
            && at.distance(goal) < self.seats[seat].nearest.0 - NEARER_M
        {
            self.seats[seat].nearest = (at.distance(goal), now);
        }
        self.seats[seat].nearest.1
    }

    /// Whether a robot said that it is on its route, and is not near its end: nearer to where it should be by now.
    fn is_on_its_way(&self, desk: &Desk, seat: usize) -> bool {
        let robot = desk.fleet.robot(self.seats[seat].robot);
        let goal = self.current.as_ref().and_then(|leg| leg.moves.get(seat)).map(|step| step.goal);
        let (Some(at), Some(goal), Some(off_m)) = (robot.at, goal, robot.off_m) else { return false };
        robot.may_move() && off_m <= LATE_MAX_M && at.distance(goal) > off_m + END_M
    }

    /// Asks a robot how it is, at a bounded rate.
    fn ask_status(&mut self, desk: &mut Desk, now: Instant, seat: usize) {
        if now - self.seats[seat].asked >= ASK {
            self.seats[seat].asked = now;
            let robot = desk.fleet.robot(self.seats[seat].robot);
            desk.outbox.say(Topic::Robot(robot.id), &[Command::Status]);
        }
    }

    /// A robot that should have arrived long ago.
    fn settle_overdue(&mut self, desk: &mut Desk, now: Instant, seat: usize) {
        let robot = desk.fleet.robot(self.seats[seat].robot);
        let goal = self.current.as_ref().map_or(Default::default(), |leg| leg.moves[seat].goal);
        let off_m = robot.at.map_or(f64::INFINITY, |at| at.distance(goal));
        if robot.may_move() || off_m > MISSED_M {
            self.drop_out(desk, now, seat, Trouble::Missed);
        } else {
            self.accept_misaligned(desk, now, seat, off_m);
        }
    }

    /// Where somebody is unsure all the time, waiting until all are sure would never end: after a while it goes on, and
    /// holds again for those who still are. The more robots, the sooner.
    fn lose_patience(&mut self, desk: &mut Desk, now: Instant, drive: &Drive) {
        let share = PATIENCE_ROBOTS / (self.seats.len().max(1) as f64);
        let patience = Span::from_secs((PATIENCE.as_secs() * share).min(PATIENCE.as_secs())).max(IMPATIENCE);
        let waits_long = |hold: &Hold| !hold.by_operator && hold.until.is_none() && now - hold.at > patience;
        let only_unsure = self.seats.iter().all(|known| known.late.is_none() || known.unsure);
        if !drive.hold.as_ref().is_some_and(waits_long) || !only_unsure {
            return;
        }
        self.seats.iter_mut().for_each(|known| known.late = None);
        if let Phase::Driving(drive) = &mut self.phase {
            drive.late = 0;
        }
        self.release(desk, now);
    }

    /// Whether all stand who were told to hold; who does not is told by name, then all are stopped.
    fn check_hold(&mut self, desk: &mut Desk, now: Instant, drive: &Drive) {
        let Some(hold) = drive.hold.filter(|hold| hold.until.is_none() && now >= hold.check_at) else {
            return;
        };
        if self.current.as_ref().is_none_or(|leg| leg.kind == Kind::Targets) {
            return;
        }
        let moving: Vec<usize> = (0..self.seats.len())
            .filter(|&seat| self.is_awaited(seat) && !self.seats[seat].arrived)
            .filter(|&seat| desk.fleet.robot(self.seats[seat].robot).state == Some(RobotState::Driving))
            .collect();
        if moving.is_empty() {
            if let Phase::Driving(drive) = &mut self.phase
                && let Some(hold) = &mut drive.hold
            {
                hold.check_at = now + Span::from_millis(1_000);
            }
            return;
        }
        if now - hold.at > HOLD_BOUND + lightbots_wire::Route::EASE {
            self.recover(desk, now);
            return;
        }
        for seat in moving {
            let topic = Topic::Robot(desk.fleet.robot(self.seats[seat].robot).id);
            desk.outbox.say(topic, &[Command::Hold { at: hold.at }, Command::Status]);
        }
    }
}
