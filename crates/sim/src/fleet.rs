//! Simulated robots in real time: whoever has a clock and a network drives them.

use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;

use lightbots_base::{Instant, Pose, Rgb, RobotId, Vec2};
use lightbots_show::Stage;
use lightbots_wire::Topic;

use crate::conditions::Conditions;
use crate::robot_set::RobotSet;
use crate::world::STEP;

/// The most steps that are caught up on at once: half a second. What a machine too slow falls behind further is left
/// out: bodies stand for that time while all clocks go on, so that robots are late together and do not disagree.
const CATCH_UP_STEPS: i64 = 32;
/// The most messages that wait to be taken, for each robot and for all together on top; more are dropped.
const WAITING_PER_ROBOT: usize = 64;
const WAITING: usize = 1024;

/// What a fleet is made of.
#[derive(Clone, Debug)]
pub struct FleetConfig {
    /// The floor, and what a robot is.
    pub stage: Stage,
    /// Where robots stand at power-on, stage metres; one each.
    pub starts: Vec<Vec2>,
    /// Names, clocks, slip and noise follow from it. A robot's name is the same however many there are.
    pub seed: u64,
    /// WheelSlip, sensors and clocks. Links and breakdowns are left to the real network.
    pub conditions: Conditions,
}

/// Something a robot says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FleetMessage {
    /// Which robot, counted from 0 in starting order.
    pub robot: usize,
    /// What to publish it on.
    pub topic: Topic,
    /// UTF-8 text.
    pub payload: Vec<u8>,
}

/// Simulated robots. Ways in, each with `now`, the microseconds since the fleet was made: [`link`](Self::link),
/// [`receive`](Self::receive), [`advance`](Self::advance). After each of them drain
/// [`next_message`](Self::next_message).
pub struct Fleet {
    robots: RobotSet,
    by_id: BTreeMap<RobotId, usize>,
    /// Until when the world has run.
    world_at: Instant,
    left_out: u64,
    waiting: Waiting,
}

/// Messages that wait to be taken.
struct Waiting {
    messages: VecDeque<FleetMessage>,
    most: usize,
    dropped: u64,
}

impl Fleet {
    /// Robots that were just switched on and have no link yet.
    pub fn new(config: &FleetConfig) -> Self {
        let robots = RobotSet::new(&config.stage, &config.starts, &[], &config.conditions, config.seed, true);
        let by_id = (0..robots.len()).map(|robot| (robots.id(robot), robot)).collect();
        Self {
            waiting: Waiting {
                messages: VecDeque::new(),
                most: WAITING + WAITING_PER_ROBOT * robots.len(),
                dropped: 0,
            },
            robots,
            by_id,
            world_at: Instant::ZERO,
            left_out: 0,
        }
    }

    /// The robots' names, in starting order.
    pub fn ids(&self) -> Vec<RobotId> {
        (0..self.robots.len()).map(|robot| self.robots.id(robot)).collect()
    }

    /// Where robots really are, in starting order.
    pub fn poses(&self) -> Vec<Pose> {
        (0..self.robots.len()).map(|robot| self.robots.world.pose(robot)).collect()
    }

    /// What lights show, in starting order.
    pub fn lights(&self) -> Vec<Rgb> {
        (0..self.robots.len()).map(|robot| self.robots.light(robot)).collect()
    }

    /// How often two robots came to touch so far.
    pub fn contacts(&self) -> u64 {
        self.robots.world.contacts().count()
    }

    /// How many steps were left out because `advance` came too late.
    pub fn steps_left_out(&self) -> u64 {
        self.left_out
    }

    /// Everybody's link comes up or breaks.
    pub fn link(&mut self, now: Instant, up: bool) {
        for robot in 0..self.robots.len() {
            self.link_of(now, robot, up);
        }
    }

    /// One robot's link comes up or breaks, where each has a connection of its own.
    pub fn link_of(&mut self, now: Instant, robot: usize, up: bool) {
        if robot < self.robots.len() {
            self.robots.link(now, robot, up);
            self.robots.listen(robot, &mut |robot, topic, text| self.waiting.push(robot, topic, text));
        }
    }

    /// A message was published: whom its topic names hears it, and everybody a broadcast. Whether it was for anybody.
    pub fn receive(&mut self, now: Instant, topic: &str, payload: &[u8]) -> bool {
        self.receive_on(now, 0..self.robots.len(), topic, payload)
    }

    /// A message came on the connection that `sharing` have in common: a broadcast is heard by these robots.
    pub fn receive_on(&mut self, now: Instant, sharing: Range<usize>, topic: &str, payload: &[u8]) -> bool {
        let Some(topic) = Topic::parse(topic) else { return false };
        let robots = match topic {
            Topic::Broadcast => sharing.start.min(self.robots.len())..sharing.end.min(self.robots.len()),
            Topic::Robot(id) => self.by_id.get(&id).map_or(0..0, |&robot| robot..robot + 1),
            _ => 0..0,
        };
        let heard = !robots.is_empty();
        for robot in robots {
            self.robots.receive(now, robot, topic, payload);
            self.robots.listen(robot, &mut |robot, topic, text| self.waiting.push(robot, topic, text));
        }
        heard
    }

    /// Runs the world up to `to` in whole steps of 16 ms. How many steps it ran.
    pub fn advance(&mut self, to: Instant) -> u64 {
        let due = ((to - self.world_at).0 / STEP.0).max(0);
        let run = due.min(CATCH_UP_STEPS);
        self.world_at += STEP * (due - run);
        self.left_out += (due - run) as u64;
        for _ in 0..run {
            self.world_at += STEP;
            self.robots.step(self.world_at, &mut |robot, topic, text| self.waiting.push(robot, topic, text));
        }
        run as u64
    }

    /// When to call [`advance`](Self::advance) next.
    pub fn advance_at(&self) -> Instant {
        self.world_at + STEP
    }

    /// The next thing a robot says.
    pub fn next_message(&mut self) -> Option<FleetMessage> {
        self.waiting.messages.pop_front()
    }

    /// How many messages were dropped because nobody took them.
    pub fn messages_dropped(&self) -> u64 {
        self.waiting.dropped
    }
}

impl Waiting {
    fn push(&mut self, robot: usize, topic: Topic, text: &[u8]) {
        if self.messages.len() < self.most {
            self.messages.push_back(FleetMessage { robot, topic, payload: text.to_vec() });
        } else {
            self.dropped += 1;
        }
    }
}
