//! All stop: robots that know STOP by STOP, those that know TARGET only by a target where they are. Robots on a drive come
//! to rest first, because robots that halt where they are may touch: a STOP reaches some of them later than others.

use crate::context::Context;
use crate::mutant::Mutant;
use crate::robot::KnownRobot;
use crate::snapshot::Age;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Command, RobotState, Route};
use std::collections::BTreeMap;

/// How often STOP is sent, and how far apart.
const COPIES: (u32, Span) = (6, Span::from_millis(50));
/// Shortest time that stopping takes, so that reports from before do not count.
const LEAST: Span = Span::from_millis(300);
/// Longest time that stopping takes, though a robot may still report that it drives.
const MOST: Span = Span::from_millis(3_000);
/// How often robots are looked at.
const CHECK: Span = Span::from_millis(100);
/// A robot that knows TARGET only and has moved this far since it was told to stop is told again, metres.
const MOVED_M: f64 = 0.01;

/// There is no run. A robot that was cut off when its run ended may keep a route of it: it is told by name, until it says
/// that it keeps none.
pub(crate) fn stop_late_comer(context: &mut Context, index: usize) {
    let robot = context.fleet.robot_mut(index);
    let Some(state) = robot.reported.state.filter(|_| robot.last_run.may_keep_route) else { return };
    robot.last_run.may_keep_route = keeps_route(state);
    if robot.last_run.may_keep_route {
        context.send(index, &[Command::Stop]);
    }
}

/// Whether a robot that says this drives, or keeps a route to drive. One that is cut has aborted the route under way only
/// (R43 of docs/protocol.md); which of them it says depends on the order of R12.
fn keeps_route(state: RobotState) -> bool {
    matches!(state, RobotState::Driving | RobotState::Held | RobotState::Ready | RobotState::Cut)
}

/// All are being stopped.
#[derive(Clone, Debug)]
pub(crate) struct Stopping {
    /// When robots that drive rest, and STOP is sent for those that did not hear from when on, if that is still to come.
    stop_at: Option<Instant>,
    /// When STOP was sent.
    since: Instant,
    check_at: Instant,
    /// Where robots that know TARGET only were told to stop, by index into the fleet.
    halted: BTreeMap<usize, Vec2>,
}

impl Stopping {
    /// Tells all robots. `held_from`: from when on those on a drive come to rest.
    pub fn begin(context: &mut Context, now: Instant, held_from: Option<Instant>) -> Self {
        context.outbox.stop_repeating();
        let stop_at = held_from.map(|at| at + Route::EASE);
        let mut stopping =
            Self { stop_at, since: now, check_at: stop_at.unwrap_or(now + CHECK), halted: BTreeMap::new() };
        match held_from {
            Some(at) => context.outbox.broadcast(now, Command::StopFrom { at }, COPIES.0, COPIES.1),
            None => send_stop(context, now),
        }
        for index in 0..context.fleet.robots().len() {
            stopping.halt(context, index);
        }
        stopping
    }

    /// A robot reported: one that knows TARGET only and still drives is told again, where it is now.
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

    /// Whether a robot may drive, now or later.
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

    /// When something is due.
    pub fn due(&self) -> Instant {
        self.check_at
    }

    /// Whether stopping is over. Robots that did not report since that they keep no route are told by name: a link that is
    /// back may have lost all copies.
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
