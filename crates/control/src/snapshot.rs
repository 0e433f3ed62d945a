//! The controller's state as plain data, for screens and reports.

use crate::operation::ControllerState;
use crate::preflight::PreflightReport;
use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Blocked, Firmware, RobotState};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Everything that a screen shows, at one moment. [`crate::Event`]s say what happened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Moment of the snapshot, show clock.
    pub at: Instant,
    /// What the controller is doing.
    pub state: ControllerState,
    /// Whether the broker is connected.
    pub connected: bool,
    /// Name of the open show; `None` if no show is open.
    pub show: Option<String>,
    /// Whether a show starts again after its last frame.
    pub looping: bool,
    /// Speed of drives of the next run, percent of the usual speed.
    pub speed_percent: u32,
    /// The run; `None` if there is none.
    pub run: Option<RunView>,
    /// Where and why the last run failed: a sentence for people. It stays until the operator dismisses it or starts again.
    pub failure: Option<String>,
    /// Frame in which the last run of a show ended early, counted from 0. `None` once the operator dismisses that,
    /// begins a run, or opens a show of another name.
    pub stopped_in: Option<usize>,
    /// What the last preflight found; `None`: there was none since the controller's start, or one is under way.
    pub preflight: Option<Arc<PreflightReport>>,
    /// All known robots, in the order in which they were found.
    pub robots: Vec<RobotView>,
    /// Counts of messages and reports.
    pub counters: Counters,
}

/// Where a run is on the timeline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShowPosition {
    /// Position on the timeline, seconds from the start of the first frame's air time; negative during the drive to
    /// that frame.
    pub show_s: f64,
    /// Whether the position moves on with the show clock. It stands during a pause and while the run waits for GO.
    /// Without music it also stands during holds and while robots are late.
    pub runs: bool,
}

/// A run at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RunView {
    /// The frame that robots drive to or have reached, counted from 0.
    pub frame: usize,
    /// The frame after `frame`, counted from 0; `None` if the run ends with `frame`.
    pub next: Option<usize>,
    /// Whether the operator can send robots to another frame or skip the next one: a show is played, and robots stand
    /// or are held.
    pub may_jump: bool,
    /// Whether robots drive to their starting places; `frame` has no meaning then.
    pub home: bool,
    /// Progress of the preflight; `frame` has no meaning then. `None` if the run is no preflight.
    pub preflight: Option<PreflightProgress>,
    /// What the run is doing, for people: `planning`, `uploading routes`, `driving`, `holding`, `showing`, …
    pub doing: &'static str,
    /// Progress of the drive or of the air time.
    pub progress: LegProgress,
    /// Position on the timeline; `None` if no show is played or its first drive has not begun.
    pub position: Option<ShowPosition>,
    /// What the run waits for.
    pub wait: RunWait,
    /// Names of the layers of live light that are on.
    pub live_light: Vec<String>,
    /// The frames that repeat until GO; `None` if no loop is under way.
    pub repeats: Option<RepeatView>,
    /// Number of dropouts.
    pub dropouts: usize,
}

/// Progress of a drive or of an air time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegProgress {
    /// Share of the drive or of the air time that is over, 0 to 1. If robots drive by TARGET: share of the length of
    /// their paths.
    pub share: f64,
    /// Planned duration of the drive, seconds.
    pub drive_s: f64,
}

/// What a run waits for.
#[derive(Clone, Debug, PartialEq)]
pub struct RunWait {
    /// Name of the cue at which the run waits for GO; it may be empty. `None` if the run does not wait for GO.
    pub cue: Option<String>,
    /// Whether the operator can let an interrupted run go on without the robots that do not report.
    pub may_go_on: bool,
    /// Robots for which the others wait, because they make no progress, are silent, or are not ready to leave; at most
    /// 20.
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
    /// First of these frames, counted from 0.
    pub first: usize,
    /// Last of these frames, counted from 0.
    pub last: usize,
    /// Number of the present pass through these frames, counted from 1.
    pub round: u32,
    /// Whether GO was given, so that the show goes on after the last of these frames.
    pub leaves: bool,
}

/// A robot at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotView {
    /// Its name.
    pub id: RobotId,
    /// What its last report said.
    pub reported: Reported,
    /// When the robot was found and reported last, and how long ago that is.
    pub contact: LastContact,
    /// Place where its path has the robot at this moment, stage metres; `None` while it drives no path.
    pub planned: Option<Vec2>,
    /// Goal of its drive, or where it stands after the drive, stage metres. After a run: the last goal of that run.
    pub goal: Option<Vec2>,
    /// Id of the pixel that it shows in the run, or showed at the end of its last run.
    pub pixel: Option<u32>,
    /// Colour that the robot should show.
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
    /// Position, stage metres; `None` if not known.
    pub at: Option<Vec2>,
    /// Its heading, radians in the stage.
    pub heading: Option<f64>,
    /// Its battery, percent.
    pub battery: Option<u8>,
    /// State of the robot; `None` for the original firmware, which does not report it.
    pub state: Option<RobotState>,
    /// Distance from its planned place, metres; `None` if no route is under way.
    pub off_m: Option<f64>,
    /// Obstacle for which it stands or brakes.
    pub blocked: Option<Blocked>,
    /// Uncertainty of its show clock, microseconds; `None` if the clock is not synchronised.
    pub clock_us: Option<u32>,
    /// Number of the route that it keeps, else of the one that it drives or finished last; 0 if there is none.
    pub route: u32,
    /// Name and version of its firmware; may be empty.
    pub firmware: Firmware,
    /// Commands that it supports besides those of the original firmware.
    pub abilities: Abilities,
    /// Whether it is simulated. Every other robot is real.
    pub simulated: bool,
}

/// When a robot was found and reported last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LastContact {
    /// When the robot was found, show clock.
    pub found: Instant,
    /// When the robot reported last, show clock.
    pub heard: Instant,
    /// Age of its last report.
    pub age: Age,
}

/// Age of a robot's last report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Age {
    /// Younger than [`Ageing::stale_after`](crate::Ageing::stale_after).
    #[default]
    Active,
    /// At least that old.
    Stale,
    /// At least as old as [`Ageing::gone_after`](crate::Ageing::gone_after).
    Gone,
}

/// Counts since the controller's start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Messages received.
    pub received: u64,
    /// Messages received that could not be read.
    pub junk: u64,
    /// Messages sent.
    pub sent: u64,
    /// Routes sent more than once.
    pub resent: u64,
    /// Messages not sent because the queue was full or there was no broker.
    pub unsent: u64,
    /// Reports that were dropped because no further robot can be remembered.
    pub overflow: u64,
    /// Messages that were ignored because their robots sent too many.
    pub flooded: u64,
    /// Arrivals reported by robots that were sent nowhere.
    pub unexpected: u64,
}
