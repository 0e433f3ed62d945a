//! Original robots on their way: each is told how far it may go, farther and farther as those it yields to get on.

use crate::desk::Desk;
use crate::driving::is_there;
use crate::event::{EventKind, Trouble};
use crate::leg::Leg;
use crate::run::{Phase, Run};
use crate::watch::MISSED_M;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_plan::unsynchronised::StraightDrive;
use lightbots_wire::{Command, Topic};

/// A robot is told to go on only when it may go so much farther, metres: it would not move for less.
const STEP_M: f64 = 0.025;
/// What a report says lies behind a robot may be off by this, metres.
const PASSED_M: f64 = 0.01;
/// A robot that got on by this is not stuck, metres.
const MOVED_M: f64 = 0.005;
/// A robot that stands so near to how far it may go has done what it was told, metres.
const RESTS_M: f64 = 0.06;
/// How fast such a robot may be at most, m/s, and how long until it obeys: it stops ahead of where it is, without turning
/// round.
const SPEED_MPS: f64 = 0.3;
const OBEYS: Span = Span::from_millis(150);
/// Originals are asked where they are this often, and told again where they do not get on.
const ASK: Span = Span::from_millis(500);
/// The same while others wait for them to pass; less often in large fleets.
const ASK_AWAITED: Span = Span::from_millis(90);
const ASK_PER_ROBOT: Span = Span::from_millis(1);
/// Who does not get on for so long is named, …
const NAMED_AFTER: Span = Span::from_millis(2_000);
/// … where it then stands near enough to its goal, it is taken to be there, …
const ACCEPTED_AFTER: Span = Span::from_millis(1_000);
/// Who says that it arrived farther from its goal than this, metres, is told again, so often: it stopped where it was
/// told before, or more short than known. Others may pass no farther away than leaves room for a little more than that.
const OFF_M: f64 = 0.015;
const CORRECTIONS: u8 = 2;
/// Who stands at its goal for so long and does not say that it arrived is told again: that, or its target, was lost.
const SAYS_SO: Span = Span::from_millis(250);
/// After so long it is believed all the same: it has been told again many times.
const SAID_BY: Span = Span::from_millis(2_000);
/// … and given up after so many times the patience with late robots.
const PATIENCE: i64 = 2;

/// How far everybody's hops are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hops {
    /// `[hop]`.
    states: Vec<State>,
    /// `[hop]`: hops that yield to it.
    followers: Vec<Vec<usize>>,
    /// `[seat]`: the hop it is on or drives next.
    present: Vec<Option<usize>>,
}

#[derive(Clone, Copy, Debug)]
struct State {
    /// Share of the way that surely lies behind the robot.
    passed: f64,
    /// Share of the way it was told to go; 0: it has not begun.
    told: f64,
    /// When it was told last.
    told_at: Instant,
    /// When it was told to go farther or got on last.
    moved_at: Instant,
    /// How often it was told again because it stood beside its goal.
    corrected: u8,
    done: bool,
    /// It was said that it does not get on.
    named: bool,
}

impl Hops {
    fn new(leg: &Leg) -> Self {
        let state = State {
            passed: 0.0,
            told: 0.0,
            told_at: Instant::ZERO,
            moved_at: Instant::ZERO,
            corrected: 0,
            done: false,
            named: false,
        };
        let mut followers = vec![Vec::new(); leg.hops.len()];
        let mut present = vec![None; leg.moves.len()];
        for (place, hop) in leg.hops.iter().enumerate().rev() {
            present[hop.robot] = Some(place);
            hop.yields.iter().for_each(|yields| followers[yields.to].push(place));
        }
        Self { states: vec![state; leg.hops.len()], followers, present }
    }

    /// The hop a seat is on, if it was told to go.
    fn under_way(&self, seat: usize) -> Option<usize> {
        let place = self.present.get(seat).copied().flatten()?;
        let state = &self.states[place];
        (state.told > 0.0 && !state.done).then_some(place)
    }

    /// Whether others wait for a hop to get on.
    fn is_awaited(&self, place: usize) -> bool {
        self.followers[place].iter().any(|&follower| self.states[follower].told < 1.0)
    }

    /// Whether the robot has stood still for so long although it was told to go on.
    fn stands(&self, place: usize, hop: &StraightDrive, now: Instant, since: Span) -> bool {
        let state = &self.states[place];
        let rests = state.told < 1.0 && (state.told - state.passed) * hop.length_m() < RESTS_M;
        !rests && now - state.moved_at > since
    }
}

impl Run {
    /// A leg of hops begins: everybody goes as far as nobody is in the way.
    pub fn begin_hops(&mut self, desk: &mut Desk, now: Instant) {
        self.hops = self.current.as_ref().map_or(Hops::default(), Hops::new);
        for seat in 0..self.hops.present.len() {
            self.go_on(desk, now, self.hops.present[seat]);
        }
    }

    /// Tells a robot to go farther, if it may by now.
    fn go_on(&mut self, desk: &mut Desk, now: Instant, place: Option<usize>) {
        let (Some(place), Phase::Driving(drive), Some(leg)) = (place, &self.phase, &self.current) else {
            return;
        };
        let (hop, hops) = (&leg.hops[place], &mut self.hops);
        let state = hops.states[place];
        let held = drive.hold.is_some_and(|hold| hold.until.is_none());
        if held || state.told >= 1.0 || hops.present[hop.robot] != Some(place) || self.seats[hop.robot].out {
            return;
        }
        let may = hop.yields.iter().fold(1.0, |share: f64, yields| match &hops.states[yields.to] {
            first if first.done => share,
            first => share.min(hop.clear_share(&leg.hops[yields.to], first.passed, yields.gap_m)),
        });
        if may < 1.0 && (may - state.told) * hop.length_m() < STEP_M {
            return;
        }
        hops.states[place] = State { told: may, moved_at: now, ..state };
        self.tell(desk, now, place);
    }

    /// Tells a robot how far it may go.
    fn tell(&mut self, desk: &mut Desk, now: Instant, place: usize) {
        let Some(leg) = &self.current else { return };
        let (hop, state) = (&leg.hops[place], &mut self.hops.states[place]);
        state.told_at = now;
        let robot = desk.fleet.robot(self.seats[hop.robot].robot);
        let target = if state.told < 1.0 { hop.at(state.told) } else { self.beyond(hop, robot.short_m) };
        let color = Command::Color(leg.moves[hop.robot].color);
        desk.outbox.say(Topic::Robot(robot.id), &[Command::Target(target), color]);
    }

    /// Where a robot is sent that stops a little before its targets, to stand where a hop ends.
    fn beyond(&self, hop: &StraightDrive, short_m: f64) -> Vec2 {
        let stage = &self.show.stage;
        let inset = Vec2::new(stage.limits.radius_m, stage.limits.radius_m);
        let most = Vec2::new(stage.width_m, stage.depth_m) / 2.0 - inset;
        let target = hop.to + (hop.to - hop.from).normalized().unwrap_or(Vec2::ZERO) * short_m;
        let inside = |value: f64, to: f64, most: f64| value.clamp(-most.max(to.abs()), most.max(to.abs()));
        Vec2::new(inside(target.x, hop.to.x, most.x), inside(target.y, hop.to.y, most.y))
    }

    /// An original robot says where it is; `arrived`: that it is where it was told to go.
    pub fn hear_hop(&mut self, desk: &mut Desk, now: Instant, seat: usize, at: Vec2, arrived: bool) {
        let (Some(place), Some(leg)) = (self.hops.under_way(seat), &self.current) else { return };
        let Phase::Driving(drive) = &self.phase else { return };
        let held = drive.hold.is_some_and(|hold| hold.until.is_none());
        let (hop, state) = (&leg.hops[place], &mut self.hops.states[place]);
        let length_m = hop.length_m();
        let passed = hop.share_at(at) - PASSED_M / length_m;
        if (passed - state.passed) * length_m > MOVED_M {
            (state.passed, state.moved_at) = (passed.min(1.0), now);
        }
        let told = state.told >= 1.0 && (arrived || !held);
        if !(told && self.settle(desk, now, place, at, arrived)) {
            self.let_follow(desk, now, place);
        }
    }

    /// An original robot that was told its goal says where it is: whether that ends its hop.
    fn settle(&mut self, desk: &mut Desk, now: Instant, place: usize, at: Vec2, arrived: bool) -> bool {
        let Some(leg) = &self.current else { return false };
        let (hop, state) = (&leg.hops[place], self.hops.states[place]);
        let (index, off_m, stood) = (self.seats[hop.robot].robot, at.distance(hop.to), now - state.moved_at);
        let there = is_there(at, hop.to, desk.config.arrival_tolerance_m);
        if there && arrived {
            let target = self.beyond(hop, desk.fleet.robot(index).short_m);
            desk.fleet.robot_mut(index).learn_short(hop.from, target, at);
        }
        if there && arrived && off_m > OFF_M && state.corrected < CORRECTIONS {
            self.hops.states[place].corrected += 1;
            self.tell(desk, now, place);
        } else if there && (arrived || stood > SAID_BY) {
            self.end_hop(desk, now, place, None);
            return true;
        } else if there && now - state.told_at.max(state.moved_at) > SAYS_SO {
            // It may also never have heard of this target, and still be as far off as a robot there may be.
            self.tell(desk, now, place);
        } else if arrived && stood > ACCEPTED_AFTER && off_m <= MISSED_M {
            self.end_hop(desk, now, place, Some(off_m));
            return true;
        }
        false
    }

    fn let_follow(&mut self, desk: &mut Desk, now: Instant, place: usize) {
        for follower in 0..self.hops.followers[place].len() {
            self.go_on(desk, now, Some(self.hops.followers[place][follower]));
        }
    }

    /// A hop is over, `off_m` from where it should end if that is too much.
    fn end_hop(&mut self, desk: &mut Desk, now: Instant, place: usize, off_m: Option<f64>) {
        let Some(leg) = &self.current else { return };
        let seat = leg.hops[place].robot;
        let next = (place + 1..leg.hops.len()).find(|&next| leg.hops[next].robot == seat);
        self.hops.states[place].done = true;
        self.hops.present[seat] = next;
        self.let_follow(desk, now, place);
        match (next, off_m) {
            (Some(_), _) => self.go_on(desk, now, next),
            (None, Some(off_m)) => self.accept_misaligned(desk, now, seat, off_m),
            (None, None) => self.arrive(desk, now, seat),
        }
    }

    /// Looks after an original robot on its way, or waiting for others to pass.
    pub fn watch_original(&mut self, desk: &mut Desk, now: Instant, seat: usize) {
        let (Phase::Driving(drive), Some(leg)) = (&self.phase, &self.current) else { return };
        let robot = desk.fleet.robot(self.seats[seat].robot);
        let (id, silent) = (robot.id, now - robot.heard.max(drive.began));
        let held = drive.hold.is_some_and(|hold| hold.until.is_none());
        if silent > desk.config.silence * 4 {
            self.drop_out(desk, now, seat, Trouble::Silent);
            return;
        }
        let place = self.hops.under_way(seat);
        let stands = |since: Span| {
            let stands = |&place: &usize| self.hops.stands(place, &leg.hops[place], now, since);
            place.filter(|_| !held).filter(stands)
        };
        if stands(desk.config.late_bound * PATIENCE).is_some() {
            self.drop_out(desk, now, seat, Trouble::Missed);
            return;
        }
        let unheard = silent > desk.config.silence + self.round_trip;
        let idles = unheard || stands(NAMED_AFTER).is_some();
        if let Some(present) = self.hops.present[seat]
            && !std::mem::replace(&mut self.hops.states[present].named, idles)
            && idles
        {
            let why = if unheard { Trouble::Silent } else { Trouble::Late };
            desk.log.tell_limited(now, EventKind::Waiting { robot: id, why });
        }
        let awaited = place.is_some_and(|place| self.hops.is_awaited(place));
        let often = (ASK_PER_ROBOT * self.seats.len() as i64).clamp(ASK_AWAITED, ASK);
        if now - self.seats[seat].asked < if awaited { often } else { ASK } {
            return;
        }
        self.seats[seat].asked = now;
        let again = |place: &usize| {
            let state = &self.hops.states[*place];
            !held && now - state.told_at.max(state.moved_at) >= ASK
        };
        // The target itself may have been lost: saying it again changes nothing else.
        if let Some(place) = place.filter(again) {
            self.tell(desk, now, place);
        }
        desk.outbox.say(Topic::Robot(id), &[Command::Uuid]);
    }

    /// Originals on their way stop a little ahead of where they last said they are, and say where that is.
    pub fn halt_originals(&self, desk: &mut Desk, now: Instant) {
        for seat in 0..self.seats.len() {
            self.halt_original(desk, now, seat);
        }
    }

    /// The same for one, if it is on its way.
    pub fn halt_original(&self, desk: &mut Desk, now: Instant, seat: usize) {
        let (Some(place), Some(leg)) = (self.hops.under_way(seat), &self.current) else { return };
        if self.seats[seat].out {
            return;
        }
        let (hop, state) = (&leg.hops[place], &self.hops.states[place]);
        let robot = desk.fleet.robot(self.seats[seat].robot);
        let unheard = (now - robot.heard).min(ASK);
        let ahead_m = PASSED_M + SPEED_MPS * (unheard + OBEYS).as_secs();
        let target = hop.at((state.passed + ahead_m / hop.length_m()).min(state.told));
        desk.outbox.say(Topic::Robot(robot.id), &[Command::Target(target), Command::Uuid]);
    }

    /// Originals that were halted go on.
    pub fn resume_hops(&mut self, desk: &mut Desk, now: Instant) {
        for seat in 0..self.hops.present.len() {
            if let Some(place) = self.hops.under_way(seat).filter(|_| !self.seats[seat].out) {
                self.hops.states[place].moved_at = now;
                self.tell(desk, now, place);
            }
            self.go_on(desk, now, self.hops.present[seat]);
        }
    }

    /// Share of all ways of the leg that lies behind its robots, as far as they said.
    pub fn hops_passed(&self) -> f64 {
        let Some(leg) = &self.current else { return 0.0 };
        let ways = leg.hops.iter().zip(&self.hops.states);
        let whole_m: f64 = leg.hops.iter().map(StraightDrive::length_m).sum();
        let passed_m: f64 =
            ways.map(|(hop, state)| hop.length_m() * if state.done { 1.0 } else { state.passed }).sum();
        if whole_m > 0.0 { passed_m / whole_m } else { 1.0 }
    }

    /// Whether an original robot is why others wait: it does not get on as told, or is not heard.
    pub fn is_stuck(&self, seat: usize) -> bool {
        self.hops.present.get(seat).copied().flatten().is_some_and(|place| self.hops.states[place].named)
    }

    /// Where an original robot may stand that fell silent on its way: stage metres, about every `step_m`.
    pub fn hop_whereabouts(&self, seat: usize, step_m: f64) -> Vec<Vec2> {
        let (Some(place), Some(leg)) = (self.hops.under_way(seat), &self.current) else { return Vec::new() };
        let (hop, state) = (&leg.hops[place], &self.hops.states[place]);
        let steps = ((state.told - state.passed) * hop.length_m() / step_m).ceil().max(1.0);
        let share = |step: usize| state.passed + (state.told - state.passed) * step as f64 / steps;
        (0..=steps as usize).map(|step| hop.at(share(step))).collect()
    }
}
