//! Limits that shows must keep.

/// Largest number of frames in a show. Bounds memory and the time of validation for hostile files; 10,000 frames play
/// for hours.
pub const MAX_FRAMES: usize = 10_000;
/// Largest number of pixels in a frame, and of robots in a fleet: twice the 10,000 robots with which the simulator is
/// measured. Bounds memory and the time of planning.
pub const MAX_PIXELS: usize = 20_000;
/// Largest number of no-go areas on a stage. Bounds the time to compare each pixel with each area: at most 20 million
/// comparisons per frame.
pub const MAX_OBSTACLES: usize = 1_000;
/// Largest number of characters in a name, an id or a word, in the fields that version 2 of the file format added.
/// Bounds messages and lists on screens.
pub const MAX_LABEL_CHARS: usize = 200;
/// Largest number of assets in a show. With the document, these are the 1,000 files that a `.lightbots.zip` may hold.
pub const MAX_ASSETS: usize = 999;
/// Largest number of sources in a frame. Frames with several words and shapes have about ten.
pub const MAX_SOURCES: usize = 100;
/// Largest number of sources in all frames: two for each of [`MAX_FRAMES`]. Bounds memory for hostile files: a source
/// takes 200 bytes.
pub const MAX_SOURCES_OF_SHOW: usize = 20_000;
/// Largest number of values in the settings of one source or layer: a freehand line of 5,000 points has 15,000 values.
pub const MAX_SETTING_VALUES: usize = 20_000;
/// Largest number of values in all settings of a show. Bounds memory for hostile files: a value takes 64 bytes of memory,
/// and as little as 2 bytes in a file.
pub const MAX_SETTINGS_OF_SHOW: usize = 500_000;
/// Deepest nesting of lists and objects in settings; palettes and curves nest 3 deep. Bounds the stack, because the
/// reader is recursive.
pub const MAX_SETTING_DEPTH: usize = 8;
/// Largest number of layers of light. Each layer costs time whenever colours are computed.
pub const MAX_LAYERS: usize = 1_000;
/// Largest number of sections, of markers, and of cues: enough for one per second over nearly three hours.
pub const MAX_MARKS: usize = 10_000;
/// Largest number of beats in a list of times: enough for 120 per minute over nearly fourteen hours.
pub const MAX_BEATS: usize = 100_000;
/// Largest number of trajectories in a show: five for each of [`MAX_PIXELS`] robots.
pub const MAX_TRAJECTORIES: usize = 100_000;
/// Largest number of pieces in all trajectories. Bounds memory for hostile files: a piece takes 72 bytes.
pub const MAX_TRAJECTORY_PIECES: usize = 1_000_000;
/// Largest number of places of the curve of a motion. More would not help: a robot stores at most 128 pieces of a path.
pub const MAX_MOTION_PLACES: usize = 200;
/// Largest number of pictures of a [`PictureMotion::Morph`](crate::PictureMotion::Morph), through which robots drive
/// without a stop.
pub const MAX_PICTURES_BETWEEN: usize = 20;
/// Smallest clearance between rims at which plans can be proven free of contact despite noise, metres. Robots that touch
/// at 54 mm need pixels 57 mm apart. With a smaller value, valid shows would fail the proof. With a larger value, shows
/// that could be played would be refused.
pub const PROVABLE_GAP_M: f64 = 0.003;
/// Tolerance of limits on places and distances, metres, because files round places to a tenth of a millimetre. Without
/// this tolerance, saving a valid show could make it invalid.
pub(super) const ROUNDING_M: f64 = 1e-4;
