//! The show document that people draw: the model in memory and its validation.
//!
//! The crate does no IO, and knows nothing of plans, messages and file formats. In reading order: [`Show`] is the
//! document, [`validate()`] gives [`Issues`] of a document, [`back_rows`] gives places where robots wait before the
//! first frame. `lightbots-exchange` reads and writes files.
//!
//! ```
//! use lightbots_show::{Frame, Show, validate};
//! let empty = Show { frames: vec![Frame::default()], ..Show::default() };
//! assert_eq!(validate(&empty)[0].message, "frame 1: it has no pixels; add some or delete the frame");
//! ```

mod asset;
mod frame_loop;
mod issue;
mod label;
mod layer_picture;
mod model;
mod motion;
mod need;
mod setting;
mod setting_tokens;
mod slow;
mod source;
mod spacing;
mod starting_places;
mod timeline;
mod validate;

pub use asset::{Asset, AssetHash, Assets};
pub use frame_loop::{FrameLoop, frame_loops};
pub use issue::{Issue, Issues, Severity};
pub use label::{clock_label, excerpt, frame_label};
pub use layer_picture::LayerPicture;
pub use model::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage, with_floor};
pub use motion::PictureMotion;
pub use need::{most_pixels, robots_asked_for, robots_needed};
pub use setting::{NamedSettings, Setting, setting};
pub use slow::{SPEED_MIN_PERCENT, slowed};
pub use source::{FloorBox, FrameSource, SourceKind, SourcePart};
pub use spacing::{CloseApproach, close_pairs};
pub use starting_places::{back_rows, starting_places};
pub use timeline::{
    BeatGrid, Beats, Cue, CuePlace, FramePhase, Layer, LayerSpan, Marker, Section, Trajectory,
    TrajectoryPiece,
};
pub use validate::{
    MAX_ASSETS, MAX_BEATS, MAX_FRAMES, MAX_LABEL_CHARS, MAX_LAYERS, MAX_MARKS, MAX_MOTION_PLACES,
    MAX_OBSTACLES, MAX_PICTURES_BETWEEN, MAX_PIXELS, MAX_SETTING_DEPTH, MAX_SETTING_VALUES,
    MAX_SETTINGS_OF_SHOW, MAX_SOURCES, MAX_SOURCES_OF_SHOW, MAX_TRAJECTORIES, MAX_TRAJECTORY_PIECES,
    PROVABLE_GAP_M, validate,
};
