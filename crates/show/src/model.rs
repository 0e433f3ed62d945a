//! The show document in memory.

use lightbots_base::{Limits, Rgb, Vec2};
use serde::{Deserialize, Serialize};

use crate::asset::Assets;
use crate::motion::PictureMotion;
use crate::source::{FrameSource, SourcePart};
use crate::timeline::{Beats, Cue, Layer, Marker, Section, Trajectory};

/// A show: frames in playing order, and the stage they play on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Show {
    /// Name for people; may be empty.
    pub name: String,
    /// Floor and robots.
    pub stage: Stage,
    /// Whether a pixel id is shown by the same robot in all frames. A frame's own [`Frame::identity`] overrides it.
    pub identity: Identity,
    /// Places of the robots before the first frame, stage metres; `None`: rows along the back edge, where y is largest.
    pub starts: Option<Vec<Vec2>>,
    /// File name of the music; `None`: the show has no music.
    pub music: Option<String>,
    /// Number of spare robots: robots beyond those with pixels, to replace robots that fail.
    pub spares: u32,
    /// Files that belong to the show, by hash.
    pub assets: Assets,
    /// Beats of the music; `None`: not known.
    pub beats: Option<Beats>,
    /// Named stretches of the show.
    pub sections: Vec<Section>,
    /// Named moments of the show.
    pub markers: Vec<Marker>,
    /// Places where the show waits for GO, or repeats frames until GO.
    pub cues: Vec<Cue>,
    /// Light over time, lowest layer first.
    pub layers: Vec<Layer>,
    /// Timed paths that the show prescribes for robots.
    pub trajectories: Vec<Trajectory>,
    /// Frames in playing order.
    pub frames: Vec<Frame>,
}

/// The floor and the robots on it. The origin of stage metres is the middle of the floor; y is largest at its front
/// edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Extent along x, metres.
    pub width_m: f64,
    /// Extent along y, metres.
    pub depth_m: f64,
    /// No-go areas. Messages number them from 1 in this order.
    pub obstacles: Vec<Obstacle>,
    /// Size and dynamic limits of each robot of the fleet.
    pub limits: Limits,
}

/// A no-go area: robots drive around it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Obstacle {
    /// A disc.
    Disc {
        /// Centre, stage metres.
        at: Vec2,
        /// Radius, metres.
        radius_m: f64,
    },
    /// A rectangle with sides along the axes.
    Rect {
        /// Corner with the smaller x and y, stage metres.
        min: Vec2,
        /// Corner with the larger x and y, stage metres.
        max: Vec2,
    },
}

/// Whether pixels are bound to robots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Identity {
    /// Any robot may show any pixel that names no robot.
    #[default]
    Any,
    /// Pixels with equal ids in different frames are shown by one robot.
    Fixed,
}

/// A picture of the show.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Id by which layers, cues and trajectories name the frame; unique in a valid show. `None`: nothing names the
    /// frame.
    pub id: Option<String>,
    /// Name for people; may be empty.
    pub name: String,
    /// Air time, seconds: how long the frame stays.
    pub air_time_s: f64,
    /// Moment at which the air time should begin, seconds from the start of the first frame's air time. It moves
    /// nothing by itself: the air time begins as soon as the transition is over. `None`: no wish.
    pub at_s: Option<f64>,
    /// Wanted duration of the transition to the frame, seconds; `None`: as short as the planner can make it.
    pub transition_s: Option<f64>,
    /// Speed profile of the transition to the frame.
    pub easing: Easing,
    /// How robots drive from the previous frame's picture to this one. `None`: on the trajectories that the show has to
    /// this frame, or else the shortest drive that the planner finds.
    pub motion: Option<PictureMotion>,
    /// Identity in this frame; `None`: that of the show.
    pub identity: Option<Identity>,
    /// What the pixels were made from; empty if they were drawn by hand.
    pub sources: Vec<FrameSource>,
    /// Pixels, sorted by id; ids are unique in a valid show.
    pub pixels: Vec<Pixel>,
}

/// Speed profile of a transition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Easing {
    /// Trapezoidal: accelerates, cruises and brakes at the limits.
    #[default]
    Swift,
    /// Accelerates over the first half and brakes over the second.
    Gentle,
}

/// A light of a picture, shown by one robot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pixel {
    /// Id, unique in its frame.
    pub id: u32,
    /// Place, stage metres.
    pub at: Vec2,
    /// Colour.
    pub color: Rgb,
    /// Name of the only robot that may show the pixel; `None`: any robot that [`Identity`] allows.
    pub robot: Option<String>,
    /// The part of a source that the pixel belongs to; `None`: it belongs to no source.
    pub part: Option<SourcePart>,
    /// Name of a group of pixels of the frame that are edited as one; `None`: the pixel is in no group.
    pub group: Option<String>,
}

impl Default for Stage {
    fn default() -> Self {
        Self { width_m: 3.0, depth_m: 3.0, obstacles: Vec::new(), limits: Limits::default() }
    }
}

/// Returns the show with a floor of `width_m` by `depth_m` metres, for files without a stage. No-go areas and limits of
/// robots are unchanged.
pub fn with_floor(mut show: Show, width_m: f64, depth_m: f64) -> Show {
    show.stage.width_m = width_m;
    show.stage.depth_m = depth_m;
    show
}
