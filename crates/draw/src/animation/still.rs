//! Pictures of an animation at reduced size, with their durations.

use crate::error::DrawError;
use crate::picture::Bitmap;

/// Largest length of a reduced picture's longer side, pixels. With 300 pictures, masks and colours take 150 MB.
pub const SIDE_MAX: usize = 192;
/// Largest number of pictures that are read from an animation. Further pictures are left out.
pub const STILLS_MAX: usize = 300;
/// Largest number of pixels that are decoded, summed over all pictures of the file. 200 million take about 2 s.
pub const PIXELS_MAX: u64 = 200_000_000;

/// A picture of an animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Still {
    /// What it shows.
    pub bitmap: Bitmap,
    /// How long it is shown, seconds.
    pub lasts_s: f64,
}

/// The pictures of an animation.
#[derive(Default)]
pub struct Stills {
    /// The pictures in order of time.
    pub stills: Vec<Still>,
    /// Whether the file has further pictures that were not read, or is cut off.
    pub cut: bool,
}

/// Returns the number of columns and rows of the reduced picture: at least 1 each, and at most [`SIDE_MAX`].
pub fn small(width: usize, height: usize) -> (usize, usize) {
    let longer = width.max(height).max(1);
    if longer <= SIDE_MAX {
        return (width.max(1), height.max(1));
    }
    let scaled = |side: usize| (side * SIDE_MAX / longer).max(1);
    (scaled(width), scaled(height))
}

/// Returns the index, among `large` pixels, that corresponds to the middle of pixel `at` among `small` pixels.
pub fn sample(at: usize, small: usize, large: usize) -> usize {
    ((2 * at + 1) * large / (2 * small.max(1))).min(large.saturating_sub(1))
}

/// Converts a picture's duration in the file to seconds. As in browsers, durations up to 10 ms become 100 ms.
pub fn lasts_s(milliseconds: u32) -> f64 {
    if milliseconds <= 10 { 0.1 } else { f64::from(milliseconds) / 1000.0 }
}

/// The error for an animation from which nothing can be drawn. `reason` becomes part of the message.
pub fn damaged(reason: &str) -> DrawError {
    let message = format!("The animation is damaged or cut off: {reason}. Copy or download the file again.");
    DrawError::new("animation-cut-off", message)
}

/// The error for an animation whose pictures are too large.
pub fn too_large(width: u32, height: u32, side_max: u32) -> DrawError {
    let message = format!(
        "The animation has {width} × {height} pixels, at most {side_max} × {side_max} are possible. Make it smaller; \
         {SIDE_MAX} pixels are enough."
    );
    DrawError::new("animation-too-large", message)
}
