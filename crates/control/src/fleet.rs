//! Who is here, where, since when. Robots age from active to stale to gone; they are found by any report.

use crate::config::Config;
use crate::event::EventKind;
use crate::log::Log;
use crate::snapshot::{Age, RobotView};
use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Blocked, Details, Firmware, Report, RobotState};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, DefaultHasher};

/// Places farther from the stage's centre than this are no places, metres.
const PLACE_MAX_M: f64 = 1_000.0;

/// Places nearer than this to each other are the same for one whose fixes are noisy, metres.
const SAME_M: f64 = 0.012;

/// An original robot is believed to stop so far before its target until it is seen to, metres, …
const SHORT_M: f64 = 0.012;
/// … and never farther than this, …
const SHORT_MAX_M: f64 = 0.02;
/// … as it rolls on by this once it has said that it is there; …
const RUNS_ON_M: f64 = 0.006;
/// … each arrival counts for this share.
const LEARNS: f64 = 0.5;

/// What is known of a robot.
#[derive(Clone, Debug)]
pub(crate) struct Robot {
    pub id: RobotId,
    /// Where it said it is, stage metres.
    pub at: Option<Vec2>,
    pub heading: Option<f64>,
    pub battery: Option<u8>,
    /// `None`: an original robot.
    pub state: Option<RobotState>,
    pub off_m: Option<f64>,
    /// What stands in its way.
    pub blocked: Option<Blocked>,
    pub clock_us: Option<u32>,
    pub route: u32,
    pub firmware: Firmware,
    pub abilities: Abilities,
    /// Whether its last report said that it is simulated.
    pub simulated: bool,
    pub found: Instant,
    pub heard: Instant,
    /// Since when it says that it is where it is now.
    pub stands_since: Instant,
    /// How far before its target an original robot comes to rest, metres: it stops where it is near enough.
    pub short_m: f64,
    /// Where that began, stage metres.
    said_at: Option<Vec2>,
    /// When an original was asked for a sign of life.
    pub asked: Instant,
    pub age: Age,
    /// The light it was told to show.
    pub light: Rgb,
    /// Its seat in the run.
    pub seat: Option<u32>,
    /// The pixel it showed when the last run ended.
    pub pixel: Option<u32>,
    /// Where it stood then, stage metres.
    pub goal: Option<Vec2>,
}

/// What a report changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Heard {
    /// Whose report: index into [`Fleet::robots`].
    pub index: usize,
    /// It was not known before.
    pub found: bool,
    /// It lost what it knew: it has been switched off and on.
    pub restarted: bool,
}

/// All known robots. Indices are stable until a robot is forgotten, which nobody may do during a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fleet {
    robots: Vec<Robot>,
    /// Never iterated; the hasher has fixed keys, so that it is the same everywhere.
    index_of: HashMap<RobotId, u32, BuildHasherDefault<DefaultHasher>>,
    /// Where the patrol goes on.
    patrolled: usize,
    /// Reports of robots that were too many.
    pub overflow: u64,
}

impl Robot {
    fn new(id: RobotId, now: Instant) -> Self {
        Self {
            id,
            at: None,
            heading: None,
            battery: None,
            state: None,
            off_m: None,
            blocked: None,
            clock_us: None,
            route: 0,
            firmware: Firmware::new(),
            abilities: Abilities::default(),
            simulated: false,
            found: now,
            heard: now,
            stands_since: now,
            short_m: SHORT_M,
            said_at: None,
            asked: now,
            age: Age::Active,
            light: Rgb::BLACK,
            seat: None,
            pixel: None,
            goal: None,
        }
    }

    /// Whether it speaks only TARGET and COLOR.
    pub fn is_original(&self) -> bool {
        !self.abilities.route
    }

    /// Whether it is here, well and stands or drives as told.
    pub fn is_fit(&self) -> bool {
        self.age == Age::Active && !matches!(self.state, Some(RobotState::Faulty | RobotState::Lost))
    }

    /// Whether it was heard lately.
    pub fn is_heard(&self) -> bool {
        self.age == Age::Active
    }

    /// What a screen shows of it outside a run.
    pub fn view(&self) -> RobotView {
        RobotView {
            id: self.id,
            at: self.at,
            heading: self.heading,
            planned: None,
            goal: self.goal,
            pixel: self.pixel,
            light: self.light,
            age: self.age,
            heard: self.heard,
            found: self.found,
            battery: self.battery,
            state: self.state,
            off_m: self.off_m,
            clock_us: self.clock_us,
            firmware: self.firmware.clone(),
            abilities: self.abilities,
            simulated: self.simulated,
            takes_part: false,
        }
    }

    /// Whether it could take part in a run now.
    pub fn can_take_part(&self) -> bool {
        self.is_fit() && self.at.is_some()
    }

    /// Whether its last report says that its wheels may turn.
    pub fn may_move(&self) -> bool {
        matches!(self.state, Some(RobotState::Driving))
    }

    /// An original robot arrived at `at`, having been sent from `from` to `target`: it may be sent a little farther next
    /// time.
    pub fn learn_short(&mut self, from: Vec2, target: Vec2, at: Vec2) {
        let Some(towards) = (target - from).normalized() else { return };
        let short_m = ((target - at).dot(towards) - RUNS_ON_M).clamp(0.0, SHORT_MAX_M);
        self.short_m += (short_m - self.short_m) * LEARNS;
    }

    /// Takes over details; whether they say that it was restarted.
    fn learn(&mut self, details: &Details) -> bool {
        let restarted = self.clock_us.is_some() && details.clock_us.is_none() && details.route == 0;
        self.heading = details.heading;
        self.battery = details.battery;
        self.state = Some(details.state);
        self.off_m = details.off_m;
        self.blocked = details.blocked;
        self.clock_us = details.clock_us;
        self.route = details.route;
        self.abilities = details.abilities;
        if self.firmware != details.firmware {
            self.firmware = details.firmware.clone();
        }
        restarted
    }
}

impl Fleet {
    /// Every known robot, in the order they were found.
    pub fn robots(&self) -> &[Robot] {
        &self.robots
    }

    /// One robot.
    pub fn robot(&self, index: usize) -> &Robot {
        &self.robots[index]
    }

    /// One robot, to be changed.
    pub fn robot_mut(&mut self, index: usize) -> &mut Robot {
        &mut self.robots[index]
    }

    /// Where in the list a robot is.
    pub fn find(&self, id: RobotId) -> Option<usize> {
        self.index_of.get(&id).map(|&index| index as usize)
    }

    /// Takes over a report. `None` where there is no room for another robot.
    pub fn hear(&mut self, now: Instant, report: &Report, config: &Config, log: &mut Log) -> Option<Heard> {
        let (index, found) = match self.find(report.id) {
            Some(index) => (index, false),
            None => (self.add(report.id, now, config, log)?, true),
        };
        let robot = &mut self.robots[index];
        robot.heard = now;
        let place = report.at.filter(|at| at.x.abs() < PLACE_MAX_M && at.y.abs() < PLACE_MAX_M);
        let same = |(at, place): (Vec2, Vec2)| at.distance(place) < SAME_M;
        if !place.zip(robot.said_at).is_some_and(same) {
            (robot.said_at, robot.stands_since) = (place, now);
        }
        if place.is_some() || report.details.is_some() {
            robot.at = place;
        }
        // An original robot says nothing of it: it is real, even where a simulated one had its name.
        robot.simulated = report.details.as_ref().is_some_and(|details| details.simulated);
        let restarted = report.details.as_ref().is_some_and(|details| robot.learn(details));
        if robot.age != Age::Active {
            robot.age = Age::Active;
            log.tell_limited(now, EventKind::RobotBack(report.id));
        }
        if restarted {
            robot.light = Rgb::BLACK;
            log.tell_limited(now, EventKind::RobotRestarted(report.id));
        }
        Some(Heard { index, found, restarted })
    }

    fn add(&mut self, id: RobotId, now: Instant, config: &Config, log: &mut Log) -> Option<usize> {
        let index = self.robots.len();
        if index >= config.robots_max {
            if self.overflow == 0 {
                log.tell(now, EventKind::FleetFull);
            }
            self.overflow += 1;
            return None;
        }
        self.robots.push(Robot::new(id, now));
        self.index_of.insert(id, index as u32);
        log.tell(now, EventKind::RobotFound(id));
        Some(index)
    }

    /// Forgets a robot.
    pub fn forget(&mut self, index: usize) {
        let robot = self.robots.remove(index);
        self.index_of.remove(&robot.id);
        for (later, robot) in self.robots.iter().enumerate().skip(index) {
            self.index_of.insert(robot.id, later as u32);
        }
    }

    /// Looks at the next slice of robots: who has become stale or gone. All are looked at within `rounds` calls.
    /// Gives the looked at.
    pub fn patrol(
        &mut self,
        now: Instant,
        rounds: usize,
        config: &Config,
        log: &mut Log,
    ) -> std::ops::Range<usize> {
        let count = self.robots.len();
        if self.patrolled >= count {
            self.patrolled = 0;
        }
        let slice = self.patrolled..(self.patrolled + 64.max(count / rounds.max(1) + 1)).min(count);
        self.patrolled = slice.end;
        for robot in &mut self.robots[slice.clone()] {
            let silent = now - robot.heard;
            let age = age_after(silent, config);
            if age > robot.age {
                robot.age = age;
                let told = if age == Age::Gone { EventKind::RobotGone } else { EventKind::RobotStale };
                log.tell_limited(now, told(robot.id));
            }
        }
        slice
    }
}

fn age_after(silent: Span, config: &Config) -> Age {
    match silent {
        _ if silent >= config.gone_after => Age::Gone,
        _ if silent >= config.stale_after => Age::Stale,
        _ => Age::Active,
    }
}
