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
    /// A run with at least one real robot.
    #[default]
    Real,
}

/// What was planned and what happened. Times are seconds after the first departure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ShowReport {
    /// All frames were shown, no robot was lost for good, and there was no contact.
    pub ok: bool,
    /// The report in one sentence.
    pub verdict: String,
    /// Name of the show; may be empty.
    pub show: String,
    /// What was run.
    pub kind: RunKind,
    /// When the run began, milliseconds since 1970; `None` for rehearsals.
    pub began_unix_ms: Option<u64>,
    /// Notes of the recording: names and values, such as seed and faults.
    pub notes: Vec<(String, String)>,
    /// Robots that took part.
    pub robots: usize,
    /// Frames that were to be shown.
    pub frames: usize,
    /// Frames that were shown.
    pub frames_played: usize,
    /// Planned drives and air times of the frames that were shown, seconds.
    pub planned_s: f64,
    /// From the first departure to the end, seconds.
    pub duration_s: f64,
    /// Contacts of rims; `None`: the recorded inputs of a controller do not say.
    pub contacts: Option<u64>,
    /// Least gap between two rims, metres: the true one of a rehearsal, else the least that a robot reported.
    pub closest_m: Option<f64>,
    /// The robots that reported the closest approaches.
    pub approaches: Vec<ClosestApproach>,
    /// Brakes of the safety layer.
    pub brakes: ReportBrakes,
    /// Distance of robots from their pixels when a frame stood, by their own reports, metres.
    pub position_error_m: ThreeFigures,
    /// All of these distances, metres.
    #[serde(skip)]
    pub errors_m: Vec<f64>,
    /// Between the first and the last arrival in a frame, seconds.
    pub arrival_spread_s: ThreeFigures,
    /// Distance of driving robots from the place of their routes, by their own reports, metres.
    pub tracking_error_m: ThreeFigures,
    /// Messages.
    pub messages: MessageFigures,
    /// Robots that were lost.
    pub losses: Vec<Loss>,
    /// What happened, in order.
    pub incidents: Vec<ReportedEvent>,
    /// Incidents that are not listed, because there were too many.
    pub incidents_left_out: usize,
    /// The frames that were shown, in order.
    pub per_frame: Vec<FrameFigures>,
    /// The robots, by name.
    pub per_robot: Vec<RobotFigures>,
    /// Whether the places of the replay are the true ones of a rehearsal, not those that robots reported.
    pub has_true_places: bool,
    /// Whether the whole recording was read.
    pub is_complete: bool,
}

/// Times that the safety layer began to slow a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ReportBrakes {
    /// All of them.
    pub all: u64,
    /// Those with no faulty and no off-route robot ahead; `None`: the recorded inputs do not say.
    #[serde(rename = "false")]
    pub unfounded: Option<u64>,
}

/// How near two rims came.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ClosestApproach {
    /// The robot that reported it.
    pub robots: Vec<String>,
    /// Least gap between rims, metres.
    pub gap_m: f64,
    /// When it was reported.
    pub at_s: f64,
    /// The frame that was driven to, counted from 0.
    pub frame: usize,
}

/// Messages of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct MessageFigures {
    /// From the controller.
    pub sent: u64,
    /// Received by the controller.
    pub received: u64,
    /// Routes that were sent again, because their robots did not answer.
    pub resent: u64,
    /// Not sent: no broker, or too many waited.
    pub unsent: u64,
    /// Received, and not readable.
    pub junk: u64,
    /// Lost on the way; `None`: no end of a link knows.
    pub lost: Option<u64>,
}

/// A robot that was lost.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Loss {
    /// Its name.
    pub robot: String,
    /// When.
    pub at_s: f64,
    /// The frame that was driven to or stood, counted from 0.
    pub frame: usize,
    /// Why, such as "does not report".
    pub why: String,
    /// When it took part again.
    pub back_at_s: Option<f64>,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ReportedEvent {
    /// When.
    pub at_s: f64,
    /// `note`, `look`, `bad` or `good`.
    pub tone: &'static str,
    /// What, in one sentence.
    pub line: String,
    /// The robot that it is about.
    pub robot: Option<String>,
}

/// A frame that was shown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct FrameFigures {
    /// Counted from 0.
    pub frame: usize,
    /// Its name; may be empty.
    pub name: String,
    /// When robots left for it.
    pub left_s: f64,
    /// When it stood.
    pub stood_s: f64,
    /// How long its drive was planned to take, seconds.
    pub planned_s: f64,
    /// How long that took, seconds.
    pub driven_s: f64,
    /// Between the first and the last arrival, seconds.
    pub arrival_spread_s: f64,
    /// Distance of robots from their pixels, by their own reports, metres.
    pub position_error_m: ThreeFigures,
    /// Arrivals after the first one, seconds, ascending.
    #[serde(skip)]
    pub arrivals_s: Vec<f64>,
}

/// A robot in a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct RobotFigures {
    /// Its name.
    pub name: String,
    /// Number of its arrivals at pixels.
    pub arrivals: usize,
    /// Its latest arrival after the first robot of a frame, seconds.
    pub latest_s: f64,
    /// Distance from its pixels when frames stood, by its own reports, metres.
    pub position_error_m: ThreeFigures,
    /// Largest distance from its route that it reported, metres.
    pub off_m: f64,
    /// Brakes.
    pub brakes: u64,
    /// Least gap between rims that it reported, metres.
    pub near_m: Option<f64>,
    /// Messages that came from it.
    pub messages: u64,
    /// Charge of its battery at the beginning, percent.
    pub battery_began: Option<u8>,
    /// Charge of its battery at the end, percent.
    pub battery_ended: Option<u8>,
    /// It was lost, and is not back.
    pub is_lost: bool,
}
