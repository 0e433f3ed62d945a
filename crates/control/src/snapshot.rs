//! The controller's state as plain data, for screens and reports.

use crate::operation::ControllerState;
use crate::preflight::PreflightReport;
use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Blocked, Firmware, RobotState};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The state of the controller, its run and its robots at one moment. [`crate::Event`]s say what happened before.
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
    /// Whether the show is to start again after its last frame.
    pub looping: bool,
    /// Speed of drives of all later runs except preflights, percent of the usual speed.
    pub speed_percent: u32,
    /// The run; `None` if there is none.
    pub run: Option<RunView>,
    /// Where and why the last run failed: a sentence for people. `None` if it did not fail, and once the operator
    /// dismisses the message or begins another run.
    pub failure: Option<String>,
    /// Frame in which the last run failed or was aborted, counted from 0. `None` if the run played no show or did not
    /// end so. Also `None` once the operator dismisses the message, begins a run, or opens a show of another name.
    pub stopped_in: Option<usize>,
    /// What the last preflight found. `None` if the controller has made none since its start, and while one is under
    /// way.
    pub preflight: Option<Arc<PreflightReport>>,
    /// All known robots, in the order in which they were found.
    pub robots: Vec<RobotView>,
    /// Counts of messages and reports.
    pub counters: Counters,
}

/// Where a run is on the timeline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShowPosition {
    /// Position on the timeline, seconds. The air time of the show's first frame begins at 0, so the drive to that
    /// frame has negative positions.
    pub show_s: f64,
    /// Whether the position moves on with the show clock. It stands during a pause or an interruption, and while the
    /// run waits for GO after the air time. Without music it also stands while robots are held, late or stopped.
    pub runs: bool,
}

/// A run at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RunView {
    /// The frame that robots drive to or stand in, counted from 0.
    pub frame: usize,
    /// The frame that follows `frame`, counted from 0; `None` if the run ends with `frame`.
    pub next: Option<usize>,
    /// Whether the operator can now send robots to another frame or skip the next one. `true` if a show is played and
    /// is not interrupted, and robots stand, are being stopped, are held, or the run is paused.
    pub may_jump: bool,
    /// Whether this run is the drive to the starting places. If so, `frame` has no meaning.
    pub home: bool,
    /// Progress of the preflight; `None` if the run is no preflight. During a preflight `frame` has no meaning.
    pub preflight: Option<PreflightProgress>,
    /// What the run is doing, for people: `planning`, `uploading routes`, `driving`, `holding`, `showing`, …
    pub doing: &'static str,
    /// Progress of the drive or of the air time.
    pub progress: LegProgress,
    /// Position on the timeline. `None` if no show is played, and before the run's first drive begins. For a run that
    /// was taken up: before its first drive since then.
    pub position: Option<ShowPosition>,
    /// What the run waits for.
    pub wait: RunWait,
    /// Names of the layers of live light that are on.
    pub live_light: Vec<String>,
    /// The loop under way: the frames that repeat until GO; `None` if no frames repeat.
    pub repeats: Option<RepeatView>,
    /// Number of dropouts in this run; a robot that dropped out twice counts twice.
    pub dropouts: usize,
}

/// Progress of a drive or of an air time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegProgress {
    /// Share of the drive's or air time's duration that is over, 0 to 1. If robots drive by TARGET: share of the length
    /// of their paths that they have driven. 0 in all other phases, and while a run that stands is paused.
    pub share: f64,
    /// Planned duration of the drive that is under way or ended last, seconds; 0 before the first drive.
    pub drive_s: f64,
}

/// What a run waits for.
#[derive(Clone, Debug, PartialEq)]
pub struct RunWait {
    /// Name of the cue at which the run waits for GO; it may be empty. `None` if the run does not wait for GO.
    pub cue: Option<String>,
    /// Whether the run is interrupted and the operator can let it go on now, without the robots that do not report.
    pub may_go_on: bool,
    /// Robots for which the other robots wait; at most 20. On a drive such a robot is late. After all were stopped, it
    /// has not yet reported that it is ready, or its clock is not precise.
    pub robots: Vec<RobotId>,
}

/// A preflight at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreflightProgress {
    /// The round under way, counted from 0. Robots with test drives that would meet drive in different rounds.
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
    /// Number of the pass through these frames that is under way, counted from 1.
    pub round: u32,
    /// Whether the operator gave GO. If so, the show goes on after the last of these frames.
    pub leaves: bool,
}

/// A robot at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotView {
    /// Its name.
    pub id: RobotId,
    /// What its last report said.
    pub reported: Reported,
    /// When the robot was found, when it reported last, and the age of that report.
    pub contact: LastContact,
    /// Planned place of the robot on its path at this moment, stage metres. `None` unless a drive by routes is under
    /// way in which the robot has a path.
    pub planned: Option<Vec2>,
    /// Where the robot is to stand after the drive that is under way or ended last, stage metres. If the robot takes no
    /// part in a run now: its goal when the last of its runs ended. `None` if it had none then.
    pub goal: Option<Vec2>,
    /// Id of the pixel that the robot shows in the run, or showed at the end of its last run. `None` if it showed none.
    pub pixel: Option<u32>,
    /// Colour that the robot should show.
    pub light: Rgb,
    /// Time from the robot's last report until its battery is empty, if the charge falls on as measured. `None` before
    /// the charge has fallen three times, or if it does not fall.
    pub battery_left: Option<Span>,
    /// Whether the robot takes part in the run that is under way.
    pub takes_part: bool,
    /// Whether the operator admits the robot to runs (see [`Config::admitted`](crate::Config::admitted)).
    pub is_admitted: bool,
}

/// What a robot's last report said. Where a report has no details, earlier values stay.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reported {
    /// Position, stage metres; `None` if not known.
    pub at: Option<Vec2>,
    /// Its heading, radians counter-clockwise from the stage's x axis; `None` if not known.
    pub heading: Option<f64>,
    /// Charge of its battery, percent; `None` if not known.
    pub battery: Option<u8>,
    /// State of the robot; `None` for the original firmware, which does not report its state.
    pub state: Option<RobotState>,
    /// Distance between the robot and its planned place, metres; `None` if it reports none, because no route is under
    /// way.
    pub off_m: Option<f64>,
    /// Obstacle in sight, for which the robot stands or brakes; `None` if there is none.
    pub blocked: Option<Blocked>,
    /// Error of the robot's show clock, 2 sigma, microseconds; `None` if the clock is not synchronised.
    pub clock_us: Option<u32>,
    /// Number of the route that the robot keeps for later. If there is none, number of the route that it drives, else
    /// of the one that it finished last. 0 if there is none of these.
    pub route: u32,
    /// Name and version of its firmware; may be empty.
    pub firmware: Firmware,
    /// Commands that it supports besides those of the original firmware.
    pub abilities: Abilities,
    /// Whether it reports that it is simulated. Without such a report, it counts as real.
    pub simulated: bool,
}

/// When a robot was found, and when it reported last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LastContact {
    /// When the robot was found, show clock.
    pub found: Instant,
    /// When the robot reported last, show clock.
    pub heard: Instant,
    /// Age of its last report.
    pub age: Age,
}

/// Age of a robot's last report, when it was last checked. It is checked about every 2 s at the latest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Age {
    /// Younger than [`Ageing::stale_after`](crate::Ageing::stale_after).
    #[default]
    Active,
    /// At least as old as [`Ageing::stale_after`](crate::Ageing::stale_after), and younger than
    /// [`Ageing::gone_after`](crate::Ageing::gone_after).
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
    /// How many times routes were sent again, because robots did not acknowledge them.
    pub resent: u64,
    /// Messages that were not sent, because the queue was full or the broker was not connected.
    pub unsent: u64,
    /// Reports of unknown robots that were dropped, because the fleet already has the largest number of robots.
    pub overflow: u64,
    /// Messages that were ignored because their robots sent too many.
    pub flooded: u64,
    /// Arrivals reported by robots that were sent nowhere, or by unknown ones. Also counts how many times a robot was
    /// found standing away from its planned place.
    pub unexpected: u64,
}
