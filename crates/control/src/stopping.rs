//! Stops all robots. Robots that drive routes get STOP. TARGET-only robots (original firmware: TARGET and COLOR, no
//! routes) get their present place as target. Robots on a drive first come to rest together: the command `StopFrom`
//! names the moment at which all of them begin to slow down. STOP alone reaches some robots later than others, and
//! robots that halt at different moments may touch.

use crate::context::Context;
use crate::mutant::Mutant;
use crate::robot::KnownRobot;
use crate::snapshot::Age;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Command, RobotState, Route};
use std::collections::BTreeMap;

/// Number of copies of each STOP or `StopFrom` broadcast, and the time between two copies.
const COPIES: (u32, Span) = (6, Span::from_millis(50));
/// Least time from STOP until stopping can end: time for the reports that answer STOP.
const LEAST: Span = Span::from_millis(300);
/// Largest time from STOP until stopping ends, even if a robot may still drive then.
const MOST: Span = Span::from_millis(3_000);
/// Least time between two STOPs to a robot in a state (such as `Lost` or `Faulty`) that does not say whether it keeps a
/// route.
const STOP_AGAIN: Span = Span::from_millis(1_000);
/// Time between two checks of the robots.
const CHECK: Span = Span::from_millis(100);
/// A TARGET-only robot gets a new target to stop at once it is this far from the last one, metres.
const MOVED_M: f64 = 0.01;

/// Handles a report between runs of the robot at `index` in the fleet. Sends STOP while the robot may keep a route of
/// the last run. No STOP is needed any more once the robot reports that it is `Idle`, or names no route. A `Lost` or
/// `Faulty` robot may keep a route, and would turn towards it after its recovery.
pub(crate) fn stop_late_comer(context: &mut Context, now: Instant, index: usize) {
    let robot = context.fleet.robot_mut(index);
    let last_run = &mut robot.last_run;
    let Some(state) = robot.reported.state.filter(|_| last_run.may_keep_route) else { return };
    last_run.may_keep_route = state != RobotState::Idle && robot.reported.route != 0;
    let is_due = last_run.stop_sent.is_none_or(|sent| now - sent >= STOP_AGAIN);
    if last_run.may_keep_route && (is_due || keeps_route(state)) {
        last_run.stop_sent = Some(now);
        context.send(index, &[Command::Stop]);
    }
}

/// Whether a robot that reports this state drives or may keep a route. A `Cut` robot has aborted the route under way,
/// and may keep the next route (R43 of docs/protocol.md).
fn keeps_route(state: RobotState) -> bool {
    matches!(state, RobotState::Driving | RobotState::Held | RobotState::Ready | RobotState::Cut)
}

/// The stopping of all robots, while it is under way.
#[derive(Clone, Debug)]
pub(crate) struct Stopping {
    /// When STOP will be sent to all robots. Robots on a drive rest by then; STOP is for robots that missed `StopFrom`.
    /// `None` once STOP was sent.
    stop_at: Option<Instant>,
    /// When STOP was sent; before that, when stopping began.
    since: Instant,
    check_at: Instant,
    /// The last target to stop at of each TARGET-only robot, stage metres. The key is the robot's index in the fleet.
    halted: BTreeMap<usize, Vec2>,
}

impl Stopping {
    /// Begins to stop all robots. `held_from`: when robots on a drive are to begin to slow down, show clock. With
    /// `None`, STOP is sent at once.
    pub fn begin(context: &mut Context, now: Instant, held_from: Option<Instant>) -> Self {
        let mut stopping = Self::begin_unplaced(context, now, held_from);
        for index in 0..context.fleet.robots().len() {
            stopping.halt(context, index);
        }
        stopping
    }

    /// Like [`begin`](Self::begin), after an outage of the link: a TARGET-only robot has driven on since it last reported
    /// its place. It is halted when it reports again.
    pub fn begin_unplaced(context: &mut Context, now: Instant, held_from: Option<Instant>) -> Self {
        context.outbox.stop_repeating();
        let stop_at = held_from.map(|at| at + Route::EASE);
        match held_from {
            Some(at) => context.outbox.broadcast(now, Command::StopFrom { at }, COPIES.0, COPIES.1),
            None => send_stop(context, now),
        }
        Self { stop_at, since: now, check_at: stop_at.unwrap_or(now + CHECK), halted: BTreeMap::new() }
    }

    /// Handles a report of the robot at `index` in the fleet. A TARGET-only robot that has moved on gets its present
    /// place as target.
    pub fn on_report(&mut self, context: &mut Context, index: usize) {
        self.halt(context, index);
    }

    fn halt(&mut self, context: &mut Context, index: usize) {
        let robot = context.fleet.robot(index);
        let (true, Some(at)) = (robot.is_original(), robot.reported.at) else { return };
        if self.halted.get(&index).is_some_and(|before| before.distance(at) < MOVED_M) {
            return;
        }
        self.halted.insert(index, at);
        context.send(index, &[Command::Target(at), Command::Uuid]);
    }

    /// Whether a robot may still drive, now or later: it may keep a route, or has not reported since STOP. `false` for
    /// robots that are gone and for TARGET-only robots.
    fn may_go_on(&self, robot: &KnownRobot) -> bool {
        if robot.contact.age == Age::Gone {
            return false;
        }
        match robot.reported.state {
            Some(state) if keeps_route(state) => true,
            Some(_) => robot.contact.heard < self.since,
            None => false,
        }
    }

    /// Returns when to call [`tick`](Self::tick) next.
    pub fn due(&self) -> Instant {
        self.check_at
    }

    /// Does what is due at `now`, and returns whether stopping is over. Robots that may keep a route get STOP on their
    /// own topics, too: they may have missed all copies of the broadcast.
    pub fn tick(&mut self, context: &mut Context, now: Instant) -> bool {
        if now < self.check_at {
            return false;
        }
        self.check_at = now + CHECK;
        if self.stop_at.take().is_some() {
            self.since = now;
            send_stop(context, now);
            return false;
        }
        let waited = now - self.since;
        let unstopped: Vec<usize> = (0..context.fleet.robots().len())
            .filter(|&index| self.may_go_on(context.fleet.robot(index)))
            .collect();
        if waited >= MOST || waited >= LEAST && unstopped.is_empty() {
            return true;
        }
        for index in unstopped.into_iter().filter(|_| !Mutant::StopOnce.is_planted()) {
            context.send(index, &[Command::Stop]);
        }
        false
    }
}

fn send_stop(context: &mut Context, now: Instant) {
    let copies = if Mutant::StopOnce.is_planted() { 1 } else { COPIES.0 };
    context.outbox.broadcast(now, Command::Stop, copies, COPIES.1);
}
