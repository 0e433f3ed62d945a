//! Robots drive: departure, arrivals, hold and resume, the end of a leg.

use crate::desk::Desk;
use crate::event::EventKind;
use crate::holding::Hold;
use crate::leg::Kind;
use crate::run::{Phase, Purpose, Run, Standing};
use crate::watch::MISSED_M;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Command, RobotState, Route, Topic};

/// The START that is under way is repeated, so that robots know the link is alive.
const HEARTBEAT: Span = Span::from_millis(500);
/// Robots are looked at this often.
pub(crate) const CHECK: Span = Span::from_millis(100);
/// An arrival reported within this of the planned end counts as in time: the picture stands since the planned end.
const IN_TIME: Span = Span::from_millis(250);
/// A drive under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    /// When it began, show clock.
    pub began: Instant,
    /// When it ends by plan, holds included.
    pub ends: Instant,
    /// Progress is held from this moment.
    pub hold: Option<Hold>,
    /// Time lost by holds that are over.
    pub lost: Span,
    pub arrived: usize,
    last_arrival: Instant,
    heartbeat_at: Instant,
    pub check_at: Instant,
    /// When those who have not arrived are asked, once they are overdue.
    pub ask_at: Instant,
    /// Seats that are late.
    pub late: usize,
    /// When lights that change at a moment do so, for robots that cannot fade.
    pub colors_at: Instant,
    /// When changes of light are said again.
    pub fades_at: Instant,
    /// How often that is still done.
    pub fades_left: u32,
}

impl Drive {
    /// When something is due.
    pub fn due(&self) -> Instant {
        let release_at = self.hold.and_then(|hold| hold.release_at).unwrap_or(Instant::FAR);
        self.check_at.min(self.heartbeat_at).min(self.colors_at).min(self.fades_at).min(release_at)
    }

    /// How far along their paths robots are by plan.
    pub fn path_time(&self, now: Instant) -> Span {
        let free = now - self.began - self.lost;
        let Some(hold) = self.hold.filter(|hold| now > hold.at) else { return free };
        let held = (now - hold.at).0 as f64;
        let ease = Route::EASE.0 as f64;
        let slowing = held.min(ease);
        let rolled = slowing - slowing * slowing / (2.0 * ease);
        let picked = hold.until.filter(|until| now > *until).map_or(0.0, |until| {
            let since = (now - until).0 as f64;
            if since < ease { since * since / (2.0 * ease) } else { since - ease / 2.0 }
        });
        hold.at - self.began - self.lost + Span((rolled + picked) as i64)
    }
}

impl Run {
    /// The first leg of the queue is under way since `began`.
    pub fn depart(&mut self, desk: &mut Desk, now: Instant, began: Instant) {
        let Some(leg) = self.queue.pop_front() else { return };
        let ends = began + leg.duration;
        let drive = Drive {
            began,
            ends,
            hold: None,
            lost: Span::ZERO,
            arrived: 0,
            last_arrival: Instant::ZERO,
            heartbeat_at: if leg.kind == Kind::Routes { now + HEARTBEAT } else { Instant::FAR },
            check_at: now + CHECK,
            ask_at: ends + Span::from_millis(300),
            late: 0,
            colors_at: Instant::FAR,
            fades_at: Instant::FAR,
            fades_left: 0,
        };
        for seat in &mut self.seats {
            seat.arrived = false;
            seat.fade = None;
            seat.late = None;
            seat.asked = began;
            seat.nearest = (f64::INFINITY, began);
        }
        self.forget_blocks();
        let told = EventKind::TransitionStarted { frame: leg.frame, starts: began, duration: leg.duration };
        desk.log.tell(now, told);
        let kind = leg.kind;
        self.current = Some(leg);
        self.upload = None;
        self.phase = Phase::Driving(drive);
        match kind {
            Kind::Routes => self.plan_lights(desk, now),
            Kind::Targets => {
                self.color_originals(desk);
                self.begin_hops(desk, now);
            }
        }
        self.pump_upload(desk, now);
        self.arrive_before_start(desk, now);
        self.end_leg_if_all_arrived(desk, now);
    }

    /// Robots that had ended the leg's route before it was under way here will not say so again.
    fn arrive_before_start(&mut self, desk: &mut Desk, now: Instant) {
        let Some(leg) = self.current.as_ref().filter(|leg| leg.kind == Kind::Routes) else { return };
        let there = |seat: &usize| {
            let robot = desk.fleet.robot(self.seats[*seat].robot);
            let ended = robot.state == Some(RobotState::Idle) && robot.route == leg.seq;
            let near = |at: Vec2| is_there(at, leg.moves[*seat].goal, desk.config.arrival_tolerance_m);
            self.is_awaited(*seat) && ended && robot.at.is_some_and(near)
        };
        for seat in (0..leg.moves.len()).filter(there).collect::<Vec<usize>>() {
            self.arrive(desk, now, seat);
        }
    }

    /// Originals learn their lights: all at once, as they leave.
    pub fn color_originals(&mut self, desk: &mut Desk) {
        let Some(leg) = &self.current else { return };
        for (seat, step) in leg.moves.iter().enumerate() {
            let known = &self.seats[seat];
            let lit = leg.moves(seat) || leg.airs && step.pixel.is_some();
            if lit && !known.out && desk.relight(known.robot, step.color) {
                let topic = Topic::Robot(desk.fleet.robot(known.robot).id);
                desk.outbox.say(topic, &[Command::Color(step.color)]);
            }
        }
    }

    /// A robot says it has arrived.
    pub fn hear_arrival(&mut self, desk: &mut Desk, now: Instant, seat: usize, at: Option<Vec2>) {
        let Phase::Driving(drive) = &self.phase else {
            self.judge_place(desk, now, seat, at);
            return;
        };
        if self.current.as_ref().is_some_and(|leg| leg.kind == Kind::Targets) {
            if let Some(at) = at {
                self.hear_hop(desk, now, seat, at, true);
            }
            return;
        }
        let (ends, begun, held) = (drive.ends, now >= drive.began, drive.hold.is_some());
        let step = self.current.as_ref().and_then(|leg| leg.moves.get(seat));
        let (Some(at), Some(goal)) = (at, step.map(|step| step.goal)) else { return };
        if !self.is_awaited(seat) || self.seats[seat].arrived {
            return;
        }
        let off_m = at.distance(goal);
        if begun && is_there(at, goal, desk.config.arrival_tolerance_m) {
            self.arrive(desk, now, seat);
        } else if now + IN_TIME >= ends && !held && off_m <= MISSED_M {
            // It believes to be there and will not say so again.
            self.accept_misaligned(desk, now, seat, off_m);
        }
    }

    /// An arrival while nobody drives: late news, or a robot that went somewhere on its own.
    fn judge_place(&mut self, desk: &mut Desk, now: Instant, seat: usize, at: Option<Vec2>) {
        let Phase::Standing(_) = self.phase else { return };
        let goal = self.current.as_ref().and_then(|leg| leg.moves.get(seat)).map(|step| step.goal);
        let (Some(at), Some(goal)) = (at, goal) else { return };
        let id = desk.fleet.robot(self.seats[seat].robot).id;
        if !is_there(at, goal, desk.config.arrival_tolerance_m) {
            desk.unexpected += 1;
            desk.log.tell_limited(now, EventKind::Misaligned { robot: id, off_m: at.distance(goal) });
            self.stray = true;
        }
    }

    /// Counts an arrival; the last one ends the leg.
    pub fn arrive(&mut self, desk: &mut Desk, now: Instant, seat: usize) {
        let Phase::Driving(drive) = &mut self.phase else { return };
        if std::mem::replace(&mut self.seats[seat].arrived, true) {
            return;
        }
        drive.arrived += 1;
        drive.last_arrival = drive.last_arrival.max(now);
        if self.current.as_ref().and_then(|leg| leg.moves.get(seat)).is_some_and(|step| step.settles) {
            let first = self.arrivals.map_or(now, |(first, _)| first);
            self.arrivals = Some((first, now));
        }
        if self.seats[seat].late.take().is_some() {
            drive.late = drive.late.saturating_sub(1);
        }
        self.end_leg_if_all_arrived(desk, now);
    }

    fn end_leg_if_all_arrived(&mut self, desk: &mut Desk, now: Instant) {
        let (Phase::Driving(drive), Some(leg)) = (&self.phase, &self.current) else { return };
        let held = drive.hold.is_some_and(|hold| hold.by_operator && hold.until.is_none());
        if drive.arrived < leg.movers || now < drive.began {
            return;
        }
        let (drive, airs, frame) = (*drive, leg.airs, leg.frame);
        let in_time = leg.kind == Kind::Routes && drive.last_arrival - drive.ends <= IN_TIME;
        let stands_since = if in_time { drive.ends.min(now) } else { now };
        let air = if airs { Span::from_secs(self.air_time_s(frame)) } else { Span::ZERO };
        self.pause |= held;
        if airs {
            let spread = self.arrivals.take().map_or(Span::ZERO, |(first, last)| last - first);
            let wait = (now - drive.ends).max(Span::ZERO);
            desk.log.tell(now, EventKind::FrameReached { frame, spread, wait });
            self.frames_played += 1;
            self.bound.reached(now);
            self.round_trip = self.round_trip * 9 / 10;
            self.lossy = self.lossy * 9 / 10;
            self.pause |= std::mem::take(&mut self.step);
            self.advance();
        }
        let paused = self.pause.then_some(air);
        self.phase = Phase::Standing(Standing { since: now, until: stands_since + air, paused });
        self.tick_standing(desk, now);
    }

    /// The picture stands: the next frame is the next to be reached.
    fn advance(&mut self) {
        let done = self.next;
        self.found.clear();
        self.disregards_strangers = false;
        if let Some(next) = self.after(done) {
            self.next = next;
        } else {
            self.next.frame = usize::MAX;
        }
    }

    fn air_time_s(&self, frame: usize) -> f64 {
        let air = self.show.frames.get(frame).map_or(0.0, |frame| frame.air_time_s);
        if self.purpose == Purpose::Play && air.is_finite() { air.clamp(0.0, 86_400.0) } else { 0.0 }
    }

    /// Time passes while robots drive.
    pub fn tick_drive(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Driving(drive) = &mut self.phase else { return };
        if self.pause && drive.hold.is_none() {
            self.hold(desk, now, true);
        }
        let Phase::Driving(drive) = &mut self.phase else { return };
        if drive.hold.and_then(|hold| hold.release_at).is_some_and(|at| now >= at) {
            self.release(desk, now);
        }
        let Phase::Driving(drive) = &mut self.phase else { return };
        if let Some(hold) = drive.hold
            && hold.until.is_some_and(|until| now >= until + Route::EASE)
        {
            drive.lost += hold.until.map_or(Span::ZERO, |until| until - hold.at);
            drive.hold = None;
        }
        if now >= drive.heartbeat_at {
            drive.heartbeat_at = now + HEARTBEAT;
            let (seq, at) = (self.current.as_ref().map_or(0, |leg| leg.seq), drive.began);
            desk.outbox.say(Topic::Broadcast, &[Command::Start { seq, at }]);
        }
        self.tick_lights(desk, now);
        self.pump_upload(desk, now);
        self.watch(desk, now);
        self.end_leg_if_all_arrived(desk, now);
    }

    /// A robot that stands off its goal for good counts as arrived, and the rest is planned from where it is.
    pub fn accept_misaligned(&mut self, desk: &mut Desk, now: Instant, seat: usize, off_m: f64) {
        let robot = desk.fleet.robot(self.seats[seat].robot).id;
        desk.log.tell_limited(now, EventKind::Misaligned { robot, off_m });
        self.stray = true;
        self.arrive(desk, now, seat);
    }
}

/// Whether a place is the goal, as the original tests it.
pub(crate) fn is_there(at: Vec2, goal: Vec2, tolerance_m: f64) -> bool {
    (at.x - goal.x).abs() <= tolerance_m + 1e-9 && (at.y - goal.y).abs() <= tolerance_m + 1e-9
}
