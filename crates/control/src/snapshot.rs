//! The controller's state as plain data, for screens and reports.

use crate::operation::ControllerState;
use crate::preflight::PreflightReport;
use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Blocked, Firmware, RobotState};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Everything a screen shows, at one moment. What happened is told by [`crate::Event`]s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// When, show clock.
    pub at: Instant,
    /// What the controller is doing.
    pub state: ControllerState,
    /// Whether there is a broker.
    pub connected: bool,
    /// Name of the open show.
    pub show: Option<String>,
    /// Whether a played show starts again.
    pub looping: bool,
    /// Speed of drives, percent of the usual one.
    pub speed_percent: u32,
    /// The run, if there is one.
    pub run: Option<RunView>,
    /// Where and why the last run failed: a sentence for people. It stays until the operator dismisses it or starts again.
    pub failure: Option<String>,
    /// The frame in which the last run of a show ended before its end; `None` as in `failure`, and while a show of another
    /// name is open.
    pub stopped_in: Option<usize>,
    /// What the last preflight found; `None`: there was none since the controller's start, or one is under way.
    pub preflight: Option<Arc<PreflightReport>>,
    /// Every known robot, in the order they were found.
    pub robots: Vec<RobotView>,
    /// What came and went.
    pub counters: Counters,
}

/// Where a run is on the timeline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShowPosition {
    /// Seconds from the start of the first frame's air time; negative during the drive there.
    pub show_s: f64,
    /// Whether it moves on with the show clock. It stands while robots are held, are waited for, or wait for GO.
    pub runs: bool,
}

/// A run at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RunView {
    /// The frame that is driven to or stands, counted from 0.
    pub frame: usize,
    /// The frame after it, counted from 0; `None`: the run ends then.
    pub next: Option<usize>,
    /// Whether robots can be sent to another frame, or the next one be skipped: they stand, or are held.
    pub may_jump: bool,
    /// Robots drive to their starting places; `frame` says nothing then.
    pub home: bool,
    /// How far a preflight is; `frame` says nothing then. `None`: the run is none.
    pub preflight: Option<PreflightProgress>,
    /// What it is doing, for people: `planning`, `uploading routes`, `driving`, `holding`, `showing`, …
    pub doing: &'static str,
    /// How far its drive or air time is.
    pub progress: LegProgress,
    /// Where it is on the timeline; `None`: no show is played, or its first drive has not begun.
    pub position: Option<ShowPosition>,
    /// What it waits for.
    pub wait: RunWait,
    /// Names of the layers of live light that are on.
    pub live_light: Vec<String>,
    /// The frames that repeat until GO; `None`: no loop is under way.
    pub repeats: Option<RepeatView>,
    /// Number of dropouts.
    pub dropouts: usize,
}

/// How far a drive or an air time is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegProgress {
    /// Share of the drive or of the air time that is over, 0 to 1. Where robots drive by TARGET it is the share of their
    /// paths' length.
    pub share: f64,
    /// How long the drive is planned to take, seconds.
    pub drive_s: f64,
}

/// What a run waits for.
#[derive(Clone, Debug, PartialEq)]
pub struct RunWait {
    /// Name of the cue at which it waits for GO; it may be empty. `None`: it does not wait for GO.
    pub cue: Option<String>,
    /// Whether the operator can let a run go on that was interrupted, without robots that do not report.
    pub may_go_on: bool,
    /// Robots of the run that others wait for, because they make no progress, are silent, or are not ready to set off; at
    /// most 20.
    pub robots: Vec<RobotId>,
}

/// A preflight at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreflightProgress {
    /// The round under way, counted from 0. Robots in each other's way take turns.
    pub round: usize,
    /// Number of rounds.
    pub rounds: usize,
    /// What robots do, for people: `driving out`, `driving back`, `blinking`, …
    pub doing: &'static str,
}

/// Frames that repeat until GO, at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RepeatView {
    /// The first of them, counted from 0.
    pub first: usize,
    /// The last of them, counted from 0.
    pub last: usize,
    /// Which time they are played, counted from 1.
    pub round: u32,
    /// GO was given: the show goes on after the last of them.
    pub leaves: bool,
}

/// A robot at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotView {
    /// Its name.
    pub id: RobotId,
    /// What its last report said.
    pub reported: Reported,
    /// When it reported, and how fresh that is.
    pub contact: LastContact,
    /// Where its path says it is now; only while it drives one.
    pub planned: Option<Vec2>,
    /// Where it goes or stands in the run.
    pub goal: Option<Vec2>,
    /// The pixel it shows in the run.
    pub pixel: Option<u32>,
    /// The light it was told to show.
    pub light: Rgb,
    /// Time from its last report until its battery is empty at the measured slope; `None`: no slope is known yet.
    pub battery_left: Option<Span>,
    /// Whether it takes part in the run.
    pub takes_part: bool,
    /// Whether it may take part in runs.
    pub is_admitted: bool,
}

/// What a robot's last report said.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reported {
    /// Its place, stage metres.
    pub at: Option<Vec2>,
    /// Its heading, radians in the stage.
    pub heading: Option<f64>,
    /// Its battery, percent.
    pub battery: Option<u8>,
    /// What it does; `None`: the original firmware, which does not say.
    pub state: Option<RobotState>,
    /// How far it is off its path, metres.
    pub off_m: Option<f64>,
    /// What stands in its path.
    pub blocked: Option<Blocked>,
    /// How far its clock may be off, microseconds; `None`: not synchronised.
    pub clock_us: Option<u32>,
    /// Number of the route it keeps; 0: none.
    pub route: u32,
    /// Its firmware; may be empty.
    pub firmware: Firmware,
    /// What it can do.
    pub abilities: Abilities,
    /// Whether it is simulated. Every other robot is real.
    pub simulated: bool,
}

/// When a robot reported.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LastContact {
    /// When it was found, show clock.
    pub found: Instant,
    /// When it reported last, show clock.
    pub heard: Instant,
    /// How fresh that is.
    pub age: Age,
}

/// How lately a robot reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
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
    /// Of them, those that could not be read.
    pub junk: u64,
    /// Messages that went out.
    pub sent: u64,
    /// Routes sent more than once.
    pub resent: u64,
    /// Messages not sent because the queue was full or there was no broker.
    pub unsent: u64,
    /// Reports of robots beyond the most that are remembered.
    pub overflow: u64,
    /// Messages that did not count, because their robots sent too many.
    pub flooded: u64,
    /// Arrivals of robots that were sent nowhere.
    pub unexpected: u64,
}
