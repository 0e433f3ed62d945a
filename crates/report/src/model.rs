//! A report as plain data: the JSON of `lightbots report`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::figures::ThreeFigures;

/// What was run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RunKind {
    /// A rehearsal in virtual time.
    Rehearsal,
    /// A run of simulated robots.
    Simulated,
    /// A run with at least one robot that does not report that it is simulated.
    #[default]
    Real,
}

/// What was planned and what happened. Times are seconds after the first departure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ShowReport {
    /// Whether the run finished, all frames were shown, no robot was lost for good, and no contact is known.
    pub ok: bool,
    /// The report in one sentence.
    pub verdict: String,
    /// Name that the author gave the show; may be empty.
    pub show: String,
    /// Whether it was a rehearsal, or a run with or without real robots.
    pub kind: RunKind,
    /// When the run began, milliseconds since 1970; `None` for rehearsals, and if the recording does not say it.
    pub began_unix_ms: Option<u64>,
    /// Notes of the recording: names and values, such as seed and faults.
    pub notes: Vec<(String, String)>,
    /// Number of robots that took part.
    pub robots: usize,
    /// Number of frames that were to be shown.
    pub frames: usize,
    /// Number of frames that were shown. If frames were skipped, chosen or repeated, each frame counts once.
    pub frames_played: usize,
    /// Sum of the planned durations of drives and of the air times, over the frames that were shown, seconds.
    pub planned_s: f64,
    /// Duration from the first departure to the end of the run, seconds.
    pub duration_s: f64,
    /// Number of contacts of two rims; `None`: only rehearsals know it.
    pub contacts: Option<u64>,
    /// Smallest gap between two rims, metres. In a rehearsal the true gap, else the smallest that a robot reported;
    /// `None`: none came near another, or none reported a gap.
    pub closest_m: Option<f64>,
    /// The smallest gaps that robots reported, smallest first: at most one per robot, and at most ten.
    pub approaches: Vec<ClosestApproach>,
    /// How often the robots' safety layer braked.
    pub brakes: ReportBrakes,
    /// Distances between robots and their pixels at the moments when frames were reached, as robots reported them, metres.
    pub position_error_m: ThreeFigures,
    /// All distances that `position_error_m` summarises, metres.
    #[serde(skip)]
    pub errors_m: Vec<f64>,
    /// Times between the first and the last arrival in a frame, seconds.
    pub arrival_spread_s: ThreeFigures,
    /// Distances of robots that drive or are held on a route from where the route has them at that moment, as robots
    /// reported them, metres.
    pub tracking_error_m: ThreeFigures,
    /// Numbers of messages.
    pub messages: MessageFigures,
    /// Robots that were lost, also those that came back.
    pub losses: Vec<Loss>,
    /// What happened, in order of time.
    pub incidents: Vec<ReportedEvent>,
    /// Number of incidents that are not listed, because there were too many.
    pub incidents_left_out: usize,
    /// The frames that were shown, in order of time; at most the first 2,000.
    pub per_frame: Vec<FrameFigures>,
    /// The robots, by name.
    pub per_robot: Vec<RobotFigures>,
    /// Whether the replay shows robots at their true places in a rehearsal. Otherwise, it shows reported places.
    pub has_true_places: bool,
    /// Whether the recording has its end, and replaying it gave the recorded outputs.
    pub is_complete: bool,
}

/// How often the safety layer began to slow a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ReportBrakes {
    /// Number of all brakes.
    pub all: u64,
    /// Number of brakes without a faulty or off-route robot ahead, which were needless; `None`: only rehearsals know it.
    #[serde(rename = "false")]
    pub unfounded: Option<u64>,
}

/// The smallest gap to another robot that a robot reported.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ClosestApproach {
    /// Name of the robot that reported the gap.
    pub robots: Vec<String>,
    /// Gap between the two rims, metres.
    pub gap_m: f64,
    /// When the gap was reported, seconds after the first departure.
    pub at_s: f64,
    /// The frame that robots drove to or had reached, counted from 0.
    pub frame: usize,
}

/// Numbers of messages of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct MessageFigures {
    /// Number of messages that the controller sent.
    pub sent: u64,
    /// Number of messages that the controller received.
    pub received: u64,
    /// Number of routes that were sent again, because their robots did not answer.
    pub resent: u64,
    /// Number of messages that could not be sent, because there was no broker or too many messages waited.
    pub unsent: u64,
    /// Number of received messages that could not be read.
    pub junk: u64,
    /// Number of messages that were lost on the way; `None`: only rehearsals know it.
    pub lost: Option<u64>,
}

/// A robot that was lost.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Loss {
    /// Name of the robot.
    pub robot: String,
    /// When the robot was lost, seconds after the first departure.
    pub at_s: f64,
    /// The frame that robots drove to or had reached, counted from 0.
    pub frame: usize,
    /// Why the robot was lost, such as "does not report".
    pub why: String,
    /// When the robot took part again, seconds after the first departure; `None`: it did not.
    pub back_at_s: Option<f64>,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ReportedEvent {
    /// When the event happened, seconds after the first departure.
    pub at_s: f64,
    /// How much the event matters: `note`, `look` (a warning), `bad` (an error) or `good`.
    pub tone: &'static str,
    /// What happened, in one sentence.
    pub line: String,
    /// Name of the robot that the event is about; `None`: no single robot.
    pub robot: Option<String>,
}

/// A frame that was shown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct FrameFigures {
    /// Index of the frame, counted from 0.
    pub frame: usize,
    /// Name of the frame; may be empty.
    pub name: String,
    /// When robots left for the frame, seconds after the first departure.
    pub left_s: f64,
    /// When all robots had reached the frame, seconds after the first departure.
    pub stood_s: f64,
    /// Planned duration of the drive to the frame, seconds.
    pub planned_s: f64,
    /// Duration from the departure to the last arrival, seconds.
    pub driven_s: f64,
    /// Time between the first and the last arrival, seconds.
    pub arrival_spread_s: f64,
    /// Distances of robots from their pixels when the frame was reached, as robots reported them, metres.
    pub position_error_m: ThreeFigures,
    /// Time of each arrival after the first arrival, seconds, ascending.
    #[serde(skip)]
    pub arrivals_s: Vec<f64>,
}

/// A robot in a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct RobotFigures {
    /// Name of the robot.
    pub name: String,
    /// In how many of the frames that were reached the robot reported its arrival.
    pub arrivals: usize,
    /// Longest time from the first arrival of any robot in a frame to this robot's arrival, seconds.
    pub latest_s: f64,
    /// Distances of the robot from its pixels when frames were reached, as it reported them, metres.
    pub position_error_m: ThreeFigures,
    /// Largest distance from its route that the robot reported, metres.
    pub off_m: f64,
    /// How often the robot's safety layer began to slow it.
    pub brakes: u64,
    /// Smallest gap between its rim and another robot's that the robot reported on a route or on arrival, metres;
    /// `None`: it reported none.
    pub near_m: Option<f64>,
    /// Number of messages from the robot.
    pub messages: u64,
    /// First reported charge of the robot's battery, percent; `None`: not reported.
    pub battery_began: Option<u8>,
    /// Last reported charge of the robot's battery, percent; `None`: not reported.
    pub battery_ended: Option<u8>,
    /// Whether the robot was lost and did not come back.
    pub is_lost: bool,
}
