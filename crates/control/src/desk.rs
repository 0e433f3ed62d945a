//! The desk: what every run works with, and what outlives it.

use crate::config::Config;
use crate::drafting::Job;
use crate::fleet::Fleet;
use crate::log::Log;
use crate::mapping::Mapping;
use crate::outbox::Outbox;
use lightbots_base::Rgb;

/// What a run works with, and what outlives it.
#[derive(Clone, Debug)]
pub(crate) struct Desk {
    pub config: Config,
    pub fleet: Fleet,
    pub outbox: Outbox,
    pub log: Log,
    pub mapping: Mapping,
    /// A plan to be made; a newer one replaces an older one.
    pub job: Option<Job>,
    pub job_number: u64,
    next_seq: u32,
    /// Arrivals nobody expected.
    pub unexpected: u64,
    /// Routes sent more than once.
    pub resent: u64,
}

impl Desk {
    pub fn new(config: Config) -> Self {
        Self {
            next_seq: config.seq_base.max(1),
            config,
            fleet: Fleet::default(),
            outbox: Outbox::default(),
            log: Log::default(),
            mapping: Mapping::default(),
            job: None,
            job_number: 0,
            unexpected: 0,
            resent: 0,
        }
    }

    /// A route number that was not used before; never 0.
    pub fn take_seq(&mut self) -> u32 {
        let seq = self.next_seq;
        self.next_seq = seq.checked_add(1).unwrap_or(1);
        seq
    }

    /// The light a robot is told to show from now on, if it is another one.
    pub fn relight(&mut self, robot: usize, color: Rgb) -> bool {
        let robot = self.fleet.robot_mut(robot);
        std::mem::replace(&mut robot.light, color) != color
    }
}
