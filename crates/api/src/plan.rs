//! The plan of a show, and what is wrong with it.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Who shows which pixel, how they get there, and what is in the way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct Plan {
    /// Revision of the open show it was made for; 0 for a check of another document.
    pub revision: u32,
    /// Whether the server is still planning that revision; what follows is then empty.
    pub planning: bool,
    /// Whether the show can be played.
    pub ok: bool,
    /// The whole show's running time, seconds: drives and air times.
    pub duration_s: f64,
    /// No show with these frames is shorter, seconds.
    pub lower_bound_s: f64,
    /// The least distance of two centres, metres; null with fewer than two robots.
    pub closest_m: Option<f64>,
    /// The share of all moments at which any one robot may stop dead without a contact, 0 to 1.
    pub stop_safe: f64,
    /// How long planning took, milliseconds.
    pub plan_ms: f64,
    /// What is wrong or worth knowing, in the order of frames.
    pub issues: Vec<Issue>,
    /// One entry a frame: `transitions[k]` is the drive to frame `k`. Shorter where planning failed.
    pub transitions: Vec<Transition>,
}

/// The drive to one frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct Transition {
    /// The frame before, counted from 0; null for the drive from the starting places.
    pub from: Option<usize>,
    /// The frame it leads to, counted from 0.
    pub to: usize,
    /// How long it takes, seconds.
    pub duration_s: f64,
    /// The least duration that is legal, seconds.
    pub least_s: f64,
    /// Bottleneck distance over top speed, seconds.
    pub lower_bound_s: f64,
    /// The least distance of two centres, metres.
    pub closest_m: Option<f64>,
    /// The share of its moments at which any one robot may stop dead without a contact, 0 to 1.
    pub stop_safe: f64,
    /// `pixels[robot]`: the pixel a robot shows afterwards; null: it stands by. Empty in the `plan` message of the
    /// WebSocket, full over HTTP.
    pub pixels: Vec<Option<u32>>,
    /// `paths[robot]`, each lasting `duration_s`. Empty in the `plan` message of the WebSocket, full over HTTP.
    pub paths: Vec<Path>,
}

/// A timed path: cubic Bézier pieces whose parameter is proportional to time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct Path {
    /// Where it starts: x and y, stage metres.
    pub start: [f64; 2],
    /// `[seconds, c1x, c1y, c2x, c2y, end x, end y]`: duration, two control points and end, stage metres. A piece
    /// starts where the one before ends.
    pub pieces: Vec<[f64; 7]>,
}

/// One thing that is wrong or worth knowing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Issue {
    /// What it is, for programs, such as `pixel-off-floor`.
    pub code: String,
    /// How bad it is.
    pub severity: Severity,
    /// Which frame, counted from 0.
    pub frame: Option<usize>,
    /// Ids of the pixels it is about; may be empty.
    pub pixels: Vec<u32>,
    /// One line for people; frames are named and counted from 1.
    pub message: String,
}

/// How bad an issue is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Good to know.
    Note,
    /// The show plays, but not as well as it could.
    Warning,
    /// The show must not be played like this.
    Error,
}
