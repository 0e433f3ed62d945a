//! What stands on the timeline besides frames: light layers, sections, markers, beats, cues, prescribed trajectories.
//!
//! Unless stated otherwise, seconds count from the start of the first frame's air time. Music begins at that moment
//! too, so that times do not depend on how long the drive to the first frame takes.

use lightbots_base::Vec2;
use serde::{Deserialize, Serialize};

use crate::setting::NamedSettings;

/// An effect of light over time, laid over the colours of pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layer {
    /// Name for people; may be empty.
    pub name: String,
    /// Name of the effect, such as `rainbow`.
    pub kind: String,
    /// When the layer shines.
    pub span: LayerSpan,
    /// Settings of the effect.
    #[serde(with = "crate::setting_tokens")]
    pub settings: NamedSettings,
}

/// When a layer shines.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum LayerSpan {
    /// Over the whole show.
    #[default]
    Show,
    /// From one frame to another, in playing order.
    Frames {
        /// Id of the first frame.
        first: String,
        /// Id of the last frame, included; equal to `first` for a single frame.
        last: String,
        /// The part of each frame's time in which the layer shines.
        phase: FramePhase,
    },
    /// A stretch of time.
    Seconds {
        /// Start, seconds from the start of the first frame's air time.
        from_s: f64,
        /// End, seconds from the start of the first frame's air time.
        to_s: f64,
    },
}

/// Part of a frame's time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FramePhase {
    /// The transition to the frame and its air time.
    #[default]
    Whole,
    /// The transition to the frame.
    Transition,
    /// The air time of the frame.
    Picture,
}

/// A named stretch of the show, such as a verse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Name for people.
    pub name: String,
    /// Start, seconds from the start of the first frame's air time.
    pub from_s: f64,
    /// End, seconds from the start of the first frame's air time.
    pub to_s: f64,
}

/// A named moment of the show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Marker {
    /// Name for people.
    pub name: String,
    /// Moment, seconds from the start of the first frame's air time.
    pub at_s: f64,
}

/// A place where the show waits for the operator's GO, or repeats frames until GO.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cue {
    /// Name for people; may be empty.
    pub name: String,
    /// Where the show waits, or where the loop ends.
    pub at: CuePlace,
    /// Id of the first frame of a loop: the cue's own frame or an earlier one. The show repeats the frames from this
    /// one to the cue's frame until GO, instead of waiting. `None`: the show waits. Only for a cue at a frame.
    pub loop_from: Option<String>,
}

/// Where a cue is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CuePlace {
    /// At the end of the air time of a frame, which is given by its id.
    Frame(String),
    /// At a moment, seconds from the start of the first frame's air time.
    Seconds(f64),
}

/// The beats of the music.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beats {
    /// Where the beats are.
    pub grid: BeatGrid,
    /// Number of beats in a bar. The first beat begins a bar.
    pub per_bar: u32,
}

/// Where beats are, in seconds from the start of the music file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BeatGrid {
    /// A steady tempo.
    Steady {
        /// Beats per minute.
        bpm: f64,
        /// Time of the first beat, seconds from the start of the music file.
        offset_s: f64,
    },
    /// Time of every beat, seconds from the start of the music file, increasing.
    Times(Vec<f64>),
}

/// A timed path that the show prescribes for the robot of a pixel, instead of a path from the planner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    /// Id of the frame to which the trajectory leads; `None`: the trajectory is for the whole show.
    pub frame: Option<String>,
    /// Id of the pixel whose robot drives the path.
    pub pixel: u32,
    /// Start of the path: seconds from the start of the transition to `frame`. Without a frame, seconds from the start
    /// of the show.
    pub at_s: f64,
    /// Place at the start, stage metres.
    pub start: Vec2,
    /// Pieces of the path in order; may be empty.
    pub pieces: Vec<TrajectoryPiece>,
}

/// A piece of a trajectory: a straight line or a cubic Bézier curve, whose parameter is proportional to time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryPiece {
    /// End of the piece, seconds from the start of the path; larger than `end_s` of the previous piece, or than 0 for
    /// the first.
    pub end_s: f64,
    /// Control points of a cubic Bézier curve, stage metres; `None`: a straight line.
    pub controls: Option<[Vec2; 2]>,
    /// Place at the end, stage metres.
    pub end: Vec2,
}
