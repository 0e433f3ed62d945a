//! All stop at once: robots that know STOP by STOP, originals by a target where they are.

use crate::desk::Desk;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Command, Topic};
use std::collections::BTreeMap;

/// STOP is said this often, …
const SAY: u32 = 6;
/// … this far apart.
const SAY_EVERY: Span = Span::from_millis(50);
/// Stopping takes this long at least, so that reports from before do not count, …
const LEAST: Span = Span::from_millis(300);
/// … and is over then, whoever still says it drives.
const MOST: Span = Span::from_millis(3_000);
/// How often it is looked at.
const CHECK: Span = Span::from_millis(100);
/// An original that has moved this far since it was told to stop is told again, metres.
const MOVED_M: f64 = 0.01;

/// All are being stopped.
#[derive(Clone, Debug)]
pub(crate) struct Stopping {
    since: Instant,
    check_at: Instant,
    /// Where originals were told to stop, by index into the fleet.
    halted: BTreeMap<usize, Vec2>,
}

impl Stopping {
    /// Says so to everybody.
    pub fn begin(desk: &mut Desk, now: Instant) -> Self {
        desk.outbox.cease();
        desk.outbox.broadcast(now, Command::Stop, SAY, SAY_EVERY);
        let mut stopping = Self { since: now, check_at: now + CHECK, halted: BTreeMap::new() };
        for index in 0..desk.fleet.robots().len() {
            stopping.halt(desk, index);
        }
        stopping
    }

    /// A robot was heard: an original that still drives is told again, where it is now.
    pub fn hear(&mut self, desk: &mut Desk, index: usize) {
        self.halt(desk, index);
    }

    fn halt(&mut self, desk: &mut Desk, index: usize) {
        let robot = desk.fleet.robot(index);
        let (true, Some(at)) = (robot.is_original(), robot.at) else { return };
        if self.halted.get(&index).is_some_and(|before| before.distance(at) < MOVED_M) {
            return;
        }
        self.halted.insert(index, at);
        desk.outbox.say(Topic::Robot(robot.id), &[Command::Target(at), Command::Uuid]);
    }

    /// When something is due.
    pub fn due(&self) -> Instant {
        self.check_at
    }

    /// Whether it is over. Robots that still say they drive are told by name.
    pub fn tick(&mut self, desk: &mut Desk, now: Instant) -> bool {
        if now < self.check_at {
            return false;
        }
        self.check_at = now + CHECK;
        let waited = now - self.since;
        let moving: Vec<usize> = (0..desk.fleet.robots().len())
            .filter(|&index| desk.fleet.robot(index).is_fit() && desk.fleet.robot(index).may_move())
            .collect();
        if waited >= MOST || waited >= LEAST && moving.is_empty() {
            return true;
        }
        for index in moving {
            desk.outbox.say(Topic::Robot(desk.fleet.robot(index).id), &[Command::Stop]);
        }
        false
    }
}
