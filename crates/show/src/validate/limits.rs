//! Limits that shows must keep.

/// Largest number of frames in a show. Bounds memory and the time of validation for hostile files; 10,000 frames play
/// for hours.
pub const MAX_FRAMES: usize = 10_000;
/// Largest number of pixels in a frame, and of robots in a fleet: twice the fleet of 10,000 that the simulator is
/// measured with. Bounds memory and the time of planning.
pub const MAX_PIXELS: usize = 20_000;
/// Largest number of no-go areas on a stage. Bounds the time to compare each pixel with each area, at most 20 million
/// times a frame.
pub const MAX_OBSTACLES: usize = 1_000;
/// Largest number of characters in a name, an id or a word that version 2 of the format added. Bounds messages and
/// lists on screens.
pub const MAX_LABEL_CHARS: usize = 200;
/// Largest number of assets in a show: with the document, the 1,000 files that a `.lightbots.zip` may hold.
pub const MAX_ASSETS: usize = 999;
/// Largest number of sources in a frame. A word of ten letters and a few shapes take about ten.
pub const MAX_SOURCES: usize = 100;
/// Largest number of sources in all frames: two for each of [`MAX_FRAMES`]. Bounds memory for hostile files: a source
/// takes 200 bytes.
pub const MAX_SOURCES_OF_SHOW: usize = 20_000;
/// Largest number of values in one group of settings: a freehand line of 5,000 points has 15,000.
pub const MAX_SETTING_VALUES: usize = 20_000;
/// Largest number of values in all settings. Bounds memory for hostile files: a value takes 64 bytes, and 2 bytes in a
/// file.
pub const MAX_SETTINGS_OF_SHOW: usize = 500_000;
/// Deepest nesting of lists and objects in settings; palettes and curves nest 3 deep. The reader is recursive.
pub const MAX_SETTING_DEPTH: usize = 8;
/// Largest number of layers of light. Each costs time at every moment of a show.
pub const MAX_LAYERS: usize = 1_000;
/// Largest number of sections, of markers and of cues: one a second for nearly three hours.
pub const MAX_MARKS: usize = 10_000;
/// Largest number of beats in a list of times: 120 a minute for nearly fourteen hours.
pub const MAX_BEATS: usize = 100_000;
/// Largest number of trajectories: five for each of [`MAX_PIXELS`] robots.
pub const MAX_TRAJECTORIES: usize = 100_000;
/// Largest number of pieces in all trajectories. Bounds memory for hostile files: a piece takes 72 bytes.
pub const MAX_TRAJECTORY_PIECES: usize = 1_000_000;
/// Largest number of places of a motion's curve. A robot keeps at most 128 pieces of a path.
pub const MAX_MOTION_PLACES: usize = 200;
/// Largest number of pictures that robots drive through without a stop.
pub const MAX_PICTURES_BETWEEN: usize = 20;
/// Smallest clearance at which a plan can be proven against noise, metres: robots that touch at 54 mm need pixels 57 mm
/// apart. With less, valid shows would fail the proof; with more, shows that could be played would be refused.
pub const PROVABLE_GAP_M: f64 = 0.003;
/// Tolerance of limits on places, metres: files round places to a tenth of a millimetre. Without it a show that was valid
/// before it was saved would fail.
pub(super) const ROUNDING_M: f64 = 1e-4;
