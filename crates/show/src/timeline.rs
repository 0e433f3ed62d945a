//! What stands on the timeline besides frames: light layers, sections, markers, beats, cues, prescribed trajectories.
//!
//! Seconds count from the start of the first frame's air time. A frame, its cue and the music then agree, however long
//! the drive to the first frame takes.

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
        /// Id of the last frame; the same id for one frame.
        last: String,
        /// The part of each frame's time in which the layer shines.
        phase: FramePhase,
    },
    /// A stretch of time.
    Seconds {
        /// Start, seconds.
        from_s: f64,
        /// End, seconds.
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
    /// Start, seconds.
    pub from_s: f64,
    /// End, seconds.
    pub to_s: f64,
}

/// A named moment of the show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Marker {
    /// Name for people.
    pub name: String,
    /// Moment, seconds.
    pub at_s: f64,
}

/// A place where the show waits for the operator's GO.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cue {
    /// Name for people; may be empty.
    pub name: String,
    /// Where the show waits.
    pub at: CuePlace,
    /// Id of the frame where a loop begins, for a cue at that frame or a later one. The show then does not wait, but
    /// repeats all frames from there to the cue until GO. `None`: it waits.
    pub loop_from: Option<String>,
}

/// Where the show waits for a cue.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CuePlace {
    /// At the end of the air time of the frame with this id.
    Frame(String),
    /// At a moment, seconds.
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

/// Where beats are, in seconds of the music file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BeatGrid {
    /// A steady tempo.
    Steady {
        /// Beats per minute.
        bpm: f64,
        /// The first beat, seconds.
        offset_s: f64,
    },
    /// Every beat, seconds, increasing.
    Times(Vec<f64>),
}

/// A timed path that the show prescribes for the robot of a pixel, in place of a planned one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    /// Id of the frame that the robot shows the pixel in; `None`: the trajectory is for the whole show.
    pub frame: Option<String>,
    /// Id of the pixel.
    pub pixel: u32,
    /// Start of the path: seconds after the transition to the frame begins. For the whole show, seconds after the show
    /// begins.
    pub at_s: f64,
    /// Place at the start, stage metres.
    pub start: Vec2,
    /// Pieces of the path in order; may be empty.
    pub pieces: Vec<TrajectoryPiece>,
}

/// A piece of a trajectory. Its parameter is proportional to time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryPiece {
    /// End of the piece, seconds after the start of the path; larger than that of the piece before.
    pub end_s: f64,
    /// Control points of a cubic Bézier curve, stage metres; `None`: a straight line.
    pub controls: Option<[Vec2; 2]>,
    /// Place at the end, stage metres.
    pub end: Vec2,
}
