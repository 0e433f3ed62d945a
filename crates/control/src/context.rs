//! The state that a run uses and that outlives the run: settings, fleet, messages, events and mapping.

use crate::config::Config;
use crate::event::EventKind;
use crate::fleet::KnownRobots;
use crate::log::EventQueue;
use crate::mapping::Mapping;
use crate::outbox::SendQueue;
use crate::plan_request::PlanRequest;
use crate::robot::ToldLight;
use lightbots_base::{Instant, Rgb};
use lightbots_wire::{Command, Report, Topic};
use serde::{Deserialize, Serialize};

/// The state that a run uses and that outlives the run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Context {
    /// Bounds and tolerances.
    pub config: Config,
    /// All known robots.
    pub fleet: KnownRobots,
    /// Messages to be sent.
    pub outbox: SendQueue,
    /// Events to be read.
    pub log: EventQueue,
    /// Which robot shows which pixel.
    pub mapping: Mapping,
    /// The plan request that was not taken yet; `None` if there is none. A newer request replaces it.
    #[serde(skip)]
    pub plan_request: Option<PlanRequest>,
    /// Number of the last plan request.
    pub plan_number: u64,
    /// Number of the next route or stretch of light.
    next_route: u32,
    /// Number of arrivals that were reported by robots that were sent nowhere, or by unknown ones. Also counts how many
    /// times a robot was found standing away from its planned place.
    pub unexpected: u64,
    /// Number of times that a route was sent again.
    pub resent: u64,
}

impl Context {
    /// Returns the state of a new controller, which knows no robot yet.
    pub fn new(config: Config) -> Self {
        Self {
            next_route: config.seq_base.max(1),
            fleet: KnownRobots::default(),
            outbox: SendQueue::new(config.lamp),
            config,
            log: EventQueue::default(),
            mapping: Mapping::default(),
            plan_request: None,
            plan_number: 0,
            unexpected: 0,
            resent: 0,
        }
    }

    /// Returns the number for the next route or stretch of light, which is never 0. After the largest number, numbers
    /// begin again at 1.
    pub fn number_route(&mut self) -> u32 {
        let number = self.next_route;
        self.next_route = number.checked_add(1).unwrap_or(1);
        number
    }

    /// Queues commands as one message to a robot. `robot`: index into the fleet.
    pub fn send(&mut self, robot: usize, commands: &[Command]) {
        self.outbox.send(Topic::Robot(self.fleet.robot(robot).id), commands);
    }

    /// Notes the colour that a robot is told to show from now on. `robot`: index into the fleet. Returns `false` if the
    /// robot is known to show this colour already, so that no command is needed.
    pub fn set_light(&mut self, robot: usize, color: Rgb) -> bool {
        let robot = self.fleet.robot_mut(robot);
        let is_other = !robot.shows(color);
        robot.light = ToldLight { color, is_sure: true };
        is_other
    }

    /// Counts a reported arrival of a robot that was sent nowhere or was unknown before, and records an event at a
    /// bounded rate.
    pub fn report_unexpected(&mut self, now: Instant, report: &Report) {
        self.unexpected += 1;
        self.log.record_limited(now, EventKind::UnexpectedArrival(report.id));
    }
}
