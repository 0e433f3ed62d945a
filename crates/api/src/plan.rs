//! The plan of a show with its issues.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{MakeQuality, MakeRemark};

/// The plan of a show: assignment of pixels, paths, durations and issues.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS, JsonSchema)]
pub struct Plan {
    /// Revision of the open show that was planned; 0 for a check of another document.
    pub revision: u32,
    /// Whether the server is still planning that revision. While it is planning, the fields below are empty.
    pub planning: bool,
    /// Whether the show can be played.
    pub ok: bool,
    /// Duration of the show, seconds: transitions and air times.
    pub duration_s: f64,
    /// Lower bound on `duration_s`, seconds: the sum of the lower bounds of all transitions, and all air times.
    pub lower_bound_s: f64,
    /// Smallest distance between two centres, metres; null with fewer than two robots.
    pub closest_m: Option<f64>,
    /// Share of all moments, 0 to 1, at which any single robot could stop dead without a contact; 1 if not measured.
    pub stop_safe: f64,
    /// Duration of planning, milliseconds; 0 for a plan that the browser made.
    pub plan_ms: f64,
    /// Issues: first those of reading and checking the show, then those of planning.
    pub issues: Vec<Issue>,
    /// `transitions[k]` leads to frame `k`. Shorter than the list of frames if planning failed.
    pub transitions: Vec<Transition>,
}

/// A request for a plan, to the module in the browser.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct PlanningRequest {
    /// A show in the format `lightbots`.
    #[ts(type = "unknown")]
    pub show: serde_json::Value,
    /// With `quick`, stop-safety is neither improved nor measured. Paths are proven to be free of contact with either
    /// quality.
    pub quality: MakeQuality,
}

/// A plan by the module in the browser, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct PlanAnswer {
    /// The plan. With quality `quick`, `stop_safe` of the plan is not measured and is 1. null: there is no plan.
    pub plan: Option<Plan>,
    /// Why there is no plan; null: there is one.
    pub error: Option<MakeRemark>,
}

/// A request for the light of a planned show, to the module in the browser.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct LightRequest {
    /// A show in the format `lightbots`.
    #[ts(type = "unknown")]
    pub show: serde_json::Value,
    /// The drives to the frames of the show, with paths. In a frame without a drive, robots stand on the frame's pixels.
    pub transitions: Vec<Transition>,
}

/// The answer to a [`LightRequest`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct LightAnswer {
    /// Number of robots that colours are given for.
    pub robots: usize,
    /// Why there are no colours; null: there are colours.
    pub error: Option<MakeRemark>,
}

/// The transition to one frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS, JsonSchema)]
pub struct Transition {
    /// The frame before, counted from 0; null: the transition begins at the starting places.
    pub from: Option<usize>,
    /// The frame that the transition leads to, counted from 0.
    pub to: usize,
    /// Duration, seconds.
    pub duration_s: f64,
    /// Shortest duration that the robots' limits allow on these paths, seconds.
    pub least_s: f64,
    /// Lower bound on the duration, seconds: bottleneck distance divided by top speed.
    pub lower_bound_s: f64,
    /// Smallest distance between two centres, metres; null with fewer than two robots.
    pub closest_m: Option<f64>,
    /// Share of the transition's moments, 0 to 1, at which any single robot could stop dead without a contact; 1 if not
    /// measured.
    pub stop_safe: f64,
    /// `pixels[robot]` is the id of the pixel that the robot shows after the transition; null: the robot stands by. The
    /// list is empty in messages on the WebSocket; answers over HTTP have it.
    pub pixels: Vec<Option<u32>>,
    /// `paths[robot]` is the path of the robot, which lasts `duration_s`. The list is empty in messages on the WebSocket;
    /// answers over HTTP have it.
    pub paths: Vec<Path>,
}

/// A timed path: cubic Bézier pieces whose parameter is proportional to time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS, JsonSchema)]
pub struct Path {
    /// Start: x and y, stage metres.
    pub start: [f64; 2],
    /// `[seconds, c1x, c1y, c2x, c2y, end x, end y]`: duration, two control points and end, stage metres. A piece
    /// starts at the end of the piece before.
    pub pieces: Vec<[f64; 7]>,
}

/// A fault or a note about a show or its plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, JsonSchema)]
pub struct Issue {
    /// Kind of issue for programs, such as `pixel-off-floor`.
    pub code: String,
    /// Severity.
    pub severity: Severity,
    /// Index of the frame, counted from 0; null: the issue concerns the whole show.
    pub frame: Option<usize>,
    /// Ids of the pixels concerned; may be empty.
    pub pixels: Vec<u32>,
    /// One line for people with place, cause and remedy. The text counts frames from 1.
    pub message: String,
}

/// Severity of an issue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The show plays well; the note is for information.
    Note,
    /// The show plays, but could play better.
    Warning,
    /// The show must not be played.
    Error,
}
