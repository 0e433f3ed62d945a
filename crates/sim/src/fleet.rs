//! Simulated robots in real time. The caller provides the clock and the network.

use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;

use lightbots_base::{Instant, Pose, Rgb, RobotId, Vec2};
use lightbots_show::Stage;
use lightbots_wire::Topic;

use crate::conditions::Conditions;
use crate::robot_set::RobotSet;
use crate::world::STEP;

/// Largest number of steps in one call of [`Fleet::advance`]: half a second. If more are due, the others are left out:
/// bodies stand still while all clocks go on. All robots are then equally late, and their clocks still agree.
const CATCH_UP_STEPS: i64 = 32;
/// At most this number of messages per robot, and [`WAITING`] more, wait for [`Fleet::next_message`]. Further messages
/// are dropped.
const WAITING_PER_ROBOT: usize = 64;
/// Number of messages that may wait in addition to [`WAITING_PER_ROBOT`] per robot, for all robots together.
const WAITING: usize = 1024;

/// Configuration of a fleet.
#[derive(Clone, Debug)]
pub struct FleetConfig {
    /// The floor, and the dimensions and limits of robots.
    pub stage: Stage,
    /// Places at power-on, stage metres, one for each robot.
    pub starts: Vec<Vec2>,
    /// Seed of names, clocks, slip and noise. A robot's name does not depend on the number of robots.
    pub seed: u64,
    /// Slip, worn wheels, sensors, clocks and original robots. The other conditions have no effect: links, because the
    /// network is real, and breakdowns, outages and mishaps.
    pub conditions: Conditions,
}

/// A message that a robot sends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FleetMessage {
    /// Index of the robot in starting order.
    pub robot: usize,
    /// Topic to publish it on.
    pub topic: Topic,
    /// UTF-8 text.
    pub payload: Vec<u8>,
}

/// Simulated robots in real time. Its timed inputs are [`link`](Self::link), [`receive`](Self::receive), their
/// variants, and [`advance`](Self::advance). Each takes the time since the fleet was made. Call
/// [`next_message`](Self::next_message) after each of them until it returns `None`.
pub struct Fleet {
    robots: RobotSet,
    by_id: BTreeMap<RobotId, usize>,
    /// End of the last step of the world.
    world_at: Instant,
    /// Number of steps that [`Self::advance`] left out.
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
    /// Makes robots that were just switched on and have no link yet.
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

    /// True poses of the robots in stage coordinates, in starting order.
    pub fn poses(&self) -> Vec<Pose> {
        (0..self.robots.len()).map(|robot| self.robots.world.pose(robot)).collect()
    }

    /// Colours of the lights, in starting order.
    pub fn lights(&self) -> Vec<Rgb> {
        (0..self.robots.len()).map(|robot| self.robots.light(robot)).collect()
    }

    /// Makes a robot's power fail.
    pub fn kill(&mut self, robot: usize) {
        if robot < self.robots.len() {
            self.robots.kill(robot);
        }
    }

    /// Number of contacts between robots until now.
    pub fn contacts(&self) -> u64 {
        self.robots.world.contacts().count()
    }

    /// Number of steps left out until now because [`advance`](Self::advance) was called too late.
    pub fn steps_left_out(&self) -> u64 {
        self.left_out
    }

    /// Brings the links of all robots up, or breaks them.
    pub fn link(&mut self, now: Instant, up: bool) {
        for robot in 0..self.robots.len() {
            self.link_of(now, robot, up);
        }
    }

    /// Brings the link of one robot up, or breaks it. For callers in which each robot has its own connection.
    pub fn link_of(&mut self, now: Instant, robot: usize, up: bool) {
        if robot < self.robots.len() {
            self.robots.link(now, robot, up);
            self.robots
                .drain_messages(robot, &mut |robot, topic, text| self.waiting.push(robot, topic, text));
        }
    }

    /// Delivers a published message: to the robot named in its topic, or to all robots if the topic is the broadcast's.
    /// Returns whether the topic addresses any robot, even if that robot has no power.
    pub fn receive(&mut self, now: Instant, topic: &str, payload: &[u8]) -> bool {
        self.receive_on(now, 0..self.robots.len(), topic, payload)
    }

    /// Delivers a message from a connection that the robots with indices `sharing` share. A broadcast reaches only
    /// these robots. A robot's own topic reaches that robot, even if it is not one of them. Returns whether the message
    /// addresses any robot, even if that robot has no power.
    pub fn receive_on(&mut self, now: Instant, sharing: Range<usize>, topic: &str, payload: &[u8]) -> bool {
        let Some(topic) = Topic::parse(topic) else { return false };
        let robots = match topic {
            Topic::Broadcast => sharing.start.min(self.robots.len())..sharing.end.min(self.robots.len()),
            Topic::Robot(id) => self.by_id.get(&id).map_or(0..0, |&robot| robot..robot + 1),
            _ => 0..0,
        };
        let is_received = !robots.is_empty();
        for robot in robots {
            self.robots.receive(now, robot, topic, payload);
            self.robots
                .drain_messages(robot, &mut |robot, topic, text| self.waiting.push(robot, topic, text));
        }
        is_received
    }

    /// Runs the world up to `to` in whole steps of 16 ms, but at most `CATCH_UP_STEPS` of them; the rest is left out.
    /// Returns the number of steps run.
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

    /// Removes and returns the oldest message that waits; `None` if none waits.
    pub fn next_message(&mut self) -> Option<FleetMessage> {
        self.waiting.messages.pop_front()
    }

    /// Number of messages dropped because too many waited.
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
