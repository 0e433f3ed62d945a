//! Limits that shows must keep.

/// Most frames of a show. Bounds memory and the time of validation for hostile files; 10,000 frames play for hours.
pub const MAX_FRAMES: usize = 10_000;
/// Most pixels of a frame, and robots of a fleet: twice the fleet of 10,000 that the simulator is measured with. Bounds
/// memory and the time of planning.
pub const MAX_PIXELS: usize = 20_000;
/// Most no-go areas of a stage. Bounds the time to compare each pixel with each area, at most 20 million times a frame.
pub const MAX_OBSTACLES: usize = 1_000;
/// Smallest clearance at which a plan can be proven against noise, metres: robots that touch at 54 mm need pixels 57 mm
/// apart. With less, valid shows would fail the proof; with more, shows that could be played would be refused.
pub const PROVABLE_GAP_M: f64 = 0.003;
/// Tolerance of limits on places, metres: files round places to a tenth of a millimetre. Without it a show that was valid
/// before it was saved would fail.
pub(super) const ROUNDING_M: f64 = 1e-4;
