//! All known robots. The first report of a robot adds it; a silent robot becomes stale, and later gone.

use crate::config::Config;
use crate::event::EventKind;
use crate::log::EventQueue;
use crate::report_rate::Counted;
use crate::robot::KnownRobot;
use crate::snapshot::Age;
use lightbots_base::{Instant, RobotId, Span};
use lightbots_wire::{Report, TimeQuestion};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, DefaultHasher};

/// A reported position is ignored as implausible if it is this far or farther from the stage's centre, along x or along
/// y, metres.
const PLACE_MAX_M: f64 = 1_000.0;

/// What a report changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FleetUpdate {
    /// The robot that reported: index into [`KnownRobots::robots`].
    pub index: usize,
    /// Whether the robot was not known before.
    pub found: bool,
    /// Whether the report shows that the robot was restarted.
    pub restarted: bool,
}

/// All known robots. Indices into the fleet are stable until a robot is forgotten, which is refused during a run, and
/// while robots are being stopped.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct KnownRobots {
    robots: Vec<KnownRobot>,
    /// Index of each robot in `robots`, by name. The map is never iterated, and its hasher has fixed keys: its
    /// behaviour is the same everywhere.
    #[serde(skip)]
    index_of: HashMap<RobotId, u32, BuildHasherDefault<DefaultHasher>>,
    /// Index of the robot at which the next call of [`patrol`](Self::patrol) begins.
    patrolled: usize,
    /// Number of reports of unknown robots that were dropped, because the fleet has the largest number of robots.
    pub overflow: u64,
    /// Number of messages that were ignored because their robots sent too many.
    pub flooded: u64,
}

impl KnownRobots {
    /// Returns all known robots, in the order in which they were found.
    pub fn robots(&self) -> &[KnownRobot] {
        &self.robots
    }

    /// One robot.
    pub fn robot(&self, index: usize) -> &KnownRobot {
        &self.robots[index]
    }

    /// One robot, to be changed.
    pub fn robot_mut(&mut self, index: usize) -> &mut KnownRobot {
        &mut self.robots[index]
    }

    /// Returns the index of a robot; `None` if it is not known.
    pub fn find(&self, id: RobotId) -> Option<usize> {
        self.index_of.get(&id).map(|&index| index as usize)
    }

    /// Counts a message of a robot, and returns whether the message is within the allowed rate. An event names a robot
    /// that sends too many, at a bounded rate. A message of an unknown robot is always within the rate.
    pub fn counts(&mut self, now: Instant, id: RobotId, log: &mut EventQueue) -> bool {
        let Some(index) = self.find(id) else { return true };
        let counted = self.robots[index].rate.count(now);
        if counted == Counted::FloodToName {
            log.record(now, EventKind::Flooding(id));
        }
        self.flooded += u64::from(counted != Counted::Yes);
        counted == Counted::Yes
    }

    /// Stores what a report says, and adds its robot if that is unknown. `None` if the robot is unknown and the fleet
    /// has the largest number of robots.
    pub fn receive(
        &mut self,
        now: Instant,
        report: &Report,
        config: &Config,
        log: &mut EventQueue,
    ) -> Option<FleetUpdate> {
        let (index, found) = match self.find(report.id) {
            Some(index) => (index, false),
            None => (self.add(report.id, now, config, log)?, true),
        };
        let robot = &mut self.robots[index];
        let place = report.at.filter(|at| at.x.abs() < PLACE_MAX_M && at.y.abs() < PLACE_MAX_M);
        let restarted = robot.receive(now, report, place);
        if place.is_some_and(|at| robot.namesakes.observe(now, at)) {
            robot.report_namesakes(now, log);
        }
        if robot.contact.age != Age::Active {
            robot.contact.age = Age::Active;
            log.record_limited(now, EventKind::RobotBack(report.id));
        }
        if restarted {
            log.record_limited(now, EventKind::RobotRestarted(report.id));
        }
        Some(FleetUpdate { index, found, restarted })
    }

    /// Checks by a time question, which holds the robot's own clock, whether two robots share the name. Records an
    /// event once this is found. Ignores unknown robots.
    pub fn observe_clock(&mut self, now: Instant, question: TimeQuestion, log: &mut EventQueue) {
        if let Some(index) = self.find(question.id) {
            let robot = &mut self.robots[index];
            if robot.namesakes.observe_clock(now, question.asked) {
                robot.report_namesakes(now, log);
            }
        }
    }

    fn add(&mut self, id: RobotId, now: Instant, config: &Config, log: &mut EventQueue) -> Option<usize> {
        let index = self.robots.len();
        if index >= config.robots_max {
            if self.overflow == 0 {
                log.record(now, EventKind::FleetFull);
            }
            self.overflow += 1;
            return None;
        }
        let is_admitted = config.admits(id);
        self.robots.push(KnownRobot { is_admitted, ..KnownRobot::new(id, now) });
        self.index_of.insert(id, index as u32);
        log.record(now, EventKind::RobotFound(id));
        if !is_admitted {
            log.record(now, EventKind::WantsToJoin(id));
        }
        Some(index)
    }

    /// Updates which robots may take part in runs, after `config.admitted` has changed.
    pub fn admit(&mut self, config: &Config) {
        for robot in &mut self.robots {
            robot.is_admitted = config.admits(robot.id);
        }
    }

    /// Returns the index of a robot of a run that is taken up. An unknown robot is added even to a full fleet, as if
    /// its last report came at `heard` (show clock).
    pub fn expect(&mut self, id: RobotId, heard: Instant, config: &Config) -> usize {
        if let Some(index) = self.find(id) {
            return index;
        }
        let index = self.robots.len();
        let is_admitted = config.admits(id);
        let mut robot = KnownRobot { is_admitted, ..KnownRobot::new(id, heard) };
        robot.light.is_sure = false;
        self.robots.push(robot);
        self.index_of.insert(id, index as u32);
        index
    }

    /// Rebuilds `index_of` after the list of robots was read from bytes. Returns `false` if two robots have the same
    /// name.
    pub fn reindex(&mut self) -> bool {
        let names = self.robots.iter().enumerate().map(|(index, robot)| (robot.id, index as u32));
        self.index_of = names.collect();
        self.index_of.len() == self.robots.len()
    }

    /// Removes the robot at `index`; the indices of all later robots decrease by one.
    pub fn forget(&mut self, index: usize) {
        let robot = self.robots.remove(index);
        self.index_of.remove(&robot.id);
        for (later, robot) in self.robots.iter().enumerate().skip(index) {
            self.index_of.insert(robot.id, later as u32);
        }
    }

    /// Updates the report ages of the next slice of robots, and returns their indices. Events name robots that became
    /// stale or gone, and names that belong to one robot again. From the first robot on, `rounds` calls cover the whole
    /// fleet.
    pub fn patrol(
        &mut self,
        now: Instant,
        rounds: usize,
        config: &Config,
        log: &mut EventQueue,
    ) -> std::ops::Range<usize> {
        let count = self.robots.len();
        if self.patrolled >= count {
            self.patrolled = 0;
        }
        let slice = self.patrolled..(self.patrolled + 64.max(count / rounds.max(1) + 1)).min(count);
        self.patrolled = slice.end;
        for robot in &mut self.robots[slice.clone()] {
            if robot.namesakes.are_gone(now) {
                log.record(now, EventKind::NameUnique(robot.id));
            }
            let silent = now - robot.contact.heard;
            let age = age_after(silent, config);
            if age > robot.contact.age {
                robot.contact.age = age;
                let told = if age == Age::Gone { EventKind::RobotGone } else { EventKind::RobotStale };
                log.record_limited(now, told(robot.id));
            }
        }
        slice
    }
}

fn age_after(silent: Span, config: &Config) -> Age {
    match silent {
        _ if silent >= config.ageing.gone_after => Age::Gone,
        _ if silent >= config.ageing.stale_after => Age::Stale,
        _ => Age::Active,
    }
}
