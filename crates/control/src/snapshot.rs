//! The controller's state as plain data, for screens and reports.

use crate::operation::State;
use lightbots_base::{Instant, Rgb, RobotId, Vec2};
use lightbots_wire::{Abilities, Firmware, RobotState};

/// Everything a screen shows, at one moment. What happened is told by [`crate::Event`]s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// When, show clock.
    pub at: Instant,
    /// What the controller is doing.
    pub state: State,
    /// Whether there is a broker.
    pub connected: bool,
    /// Name of the open show.
    pub show: Option<String>,
    /// Frames of the open show.
    pub frames: usize,
    /// Whether a played show starts again.
    pub looping: bool,
    /// The run, if there is one.
    pub run: Option<RunView>,
    /// Where and why the last run failed: a sentence for people. It stays until the operator dismisses it or starts again.
    pub failure: Option<String>,
    /// Every known robot, in the order they were found.
    pub robots: Vec<RobotView>,
    /// What came and went.
    pub counters: Counters,
}

/// A run at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RunView {
    /// The frame that is driven to or stands, counted from 0.
    pub frame: usize,
    /// What it is doing, for people: `planning`, `handing out routes`, `driving`, `holding`, `showing`, …
    pub doing: &'static str,
    /// Share of the drive or of the air time that is over, 0 to 1; of all ways, where robots drive by TARGET.
    pub progress: f64,
    /// How long the drive is planned to take, seconds.
    pub drive_s: f64,
    /// When the drive began, show clock; `None` before.
    pub began: Option<Instant>,
    /// Robots of the run that others wait for because they do not get on or are not heard, at most 8.
    pub waiting_for: Vec<RobotId>,
    /// Frames reached so far.
    pub frames_played: usize,
    /// Robots lost so far.
    pub dropouts: usize,
}

/// A robot at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotView {
    /// Its name.
    pub id: RobotId,
    /// Where it said it is, stage metres.
    pub at: Option<Vec2>,
    /// Heading it said, radians in the stage.
    pub heading: Option<f64>,
    /// Where its path says it is now; only while it drives one.
    pub planned: Option<Vec2>,
    /// Where it goes or stands in the run.
    pub goal: Option<Vec2>,
    /// The pixel it shows in the run.
    pub pixel: Option<u32>,
    /// The light it was told to show.
    pub light: Rgb,
    /// How fresh all this is.
    pub age: Age,
    /// When it was heard last, show clock.
    pub heard: Instant,
    /// When it was found, show clock.
    pub found: Instant,
    /// Percent.
    pub battery: Option<u8>,
    /// What it says it does; `None`: an original robot.
    pub state: Option<RobotState>,
    /// How far it says it is off its path, metres.
    pub off_m: Option<f64>,
    /// How far its clock may be off, microseconds; `None`: not synchronised.
    pub clock_us: Option<u32>,
    /// Its firmware; may be empty.
    pub firmware: Firmware,
    /// What it can do.
    pub abilities: Abilities,
    /// Whether its last report said that it is simulated. Every other robot is real.
    pub simulated: bool,
    /// Whether it takes part in the run.
    pub takes_part: bool,
}

/// How lately a robot was heard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Age {
    /// Lately.
    #[default]
    Active,
    /// Not for a while.
    Stale,
    /// Not for long.
    Gone,
}

/// What came and went since the controller's start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Messages that came in.
    pub received: u64,
    /// Of them, those that made no sense.
    pub junk: u64,
    /// Messages that went out.
    pub sent: u64,
    /// Routes sent more than once.
    pub resent: u64,
    /// Messages not sent because the queue was full or there was no broker.
    pub unsent: u64,
    /// Reports of robots that were too many to remember.
    pub overflow: u64,
    /// Arrivals nobody expected.
    pub unexpected: u64,
}
