//! Turns animations into drawings with times: GIF, animated WebP, or a list of pictures.

mod gif_file;
mod moments;
mod still;
mod webp_file;

pub use moments::{KeyMoments, key_moments};
pub use still::Still;

use crate::animation::still::{STILLS_MAX, Stills, damaged};
use crate::drawing::Drawing;
use crate::error::{DrawError, Note};
use crate::picture::{self, BitMask, Bitmap, PictureSettings, Separation};
use crate::sniff::{FileKind, sniff, unsupported};

/// A picture of an animation with its time.
#[derive(Clone, Debug, PartialEq)]
pub struct AnimationFrame {
    /// Time at which the picture begins, seconds from the start of the animation.
    pub at_s: f64,
    /// Duration of the picture, seconds.
    pub lasts_s: f64,
    /// What the picture shows. Unit: pixels of the reduced picture, y upwards. All frames have the same origin.
    pub drawing: Drawing,
    /// Mean density of lights in each cell of a coarse grid, 0 to 1, row by row from the top. It is compared between
    /// pictures.
    shade: Vec<f32>,
}

/// An animation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// The frames in order of time. An animation that was read has at least one.
    pub frames: Vec<AnimationFrame>,
    /// Notes about pictures that are missing from the animation.
    pub notes: Vec<Note>,
}

/// Number of cells along each side of the coarse grid.
const GRID: usize = 24;

impl Animation {
    /// Returns how much the frames with indices `a` and `b` differ, from 0 for equal frames to 1 for opposite frames.
    /// The value is half of 1 minus the correlation of their densities of lights.
    pub fn change(&self, a: usize, b: usize) -> f64 {
        let shade = |n: usize| self.frames.get(n).map_or(&[][..], |frame| frame.shade.as_slice());
        (1.0 - correlation(shade(a), shade(b))) / 2.0
    }

    /// Returns the times at which the frames begin, seconds from the start.
    pub fn times_s(&self) -> Vec<f64> {
        self.frames.iter().map(|frame| frame.at_s).collect()
    }
}

/// Reads the only picture of a PNG, JPEG or WebP file, or the pictures of a GIF or animated WebP file, at most 300.
/// Returns at least one picture; an only picture lasts 1 s.
///
/// # Errors
/// Other kinds of files, and damaged or too large files.
pub fn stills(bytes: &[u8]) -> Result<Vec<Still>, DrawError> {
    let alone = |bitmap| vec![Still { bitmap, lasts_s: 1.0 }];
    match sniff(bytes) {
        Some(FileKind::Gif) => Ok(gif_file::stills(bytes)?.stills),
        Some(FileKind::Webp) if webp_moves(bytes) => Ok(webp_file::stills(bytes)?.stills),
        Some(FileKind::Png | FileKind::Jpeg | FileKind::Webp) => picture::bitmap(bytes).map(alone),
        Some(FileKind::Svg | FileKind::Csv) => {
            let message = "The file is a drawing or a list, which has no pixels. Save it as PNG.";
            Err(DrawError::new("picture-format", message))
        }
        None => Err(unsupported(bytes)),
    }
}

/// Whether a WebP file is an animation. Bit 1 of a byte in its header says so.
pub fn webp_moves(bytes: &[u8]) -> bool {
    bytes.get(12..16) == Some(b"VP8X") && bytes.get(20).is_some_and(|flags| flags & 2 != 0)
}

/// Reads the animation of a GIF or WebP file.
///
/// # Errors
/// Other kinds of files, damaged or too large files, and animations that show nothing.
pub fn read(bytes: &[u8], settings: &PictureSettings) -> Result<Animation, DrawError> {
    let stills = match sniff(bytes) {
        Some(FileKind::Gif) => gif_file::stills(bytes)?,
        Some(FileKind::Webp) => webp_file::stills(bytes)?,
        Some(_) => {
            let message = "The file is no animation. Load it as a drawing, picture or list.";
            return Err(DrawError::new("animation-single", message));
        }
        None => return Err(unsupported(bytes)),
    };
    drawn(stills, settings)
}

/// Makes an animation of the first 300 pictures in `files`, without those that show nothing; notes say what is left
/// out. Each picture is shown for `lasts_s` seconds, and all are scaled to the reduced size of the first.
///
/// # Errors
/// A file that is not a picture, a `lasts_s` that is not above 0, and pictures that all show nothing.
pub fn of_pictures(
    files: &[&[u8]],
    lasts_s: f64,
    settings: &PictureSettings,
) -> Result<Animation, DrawError> {
    if !(lasts_s.is_finite() && lasts_s > 0.0) {
        let message = format!("Pictures cannot be shown for {lasts_s} s. Choose a time above 0.");
        return Err(DrawError::new("animation-time", message));
    }
    let mut stills: Vec<Still> = Vec::new();
    for (n, file) in files.iter().take(STILLS_MAX).enumerate() {
        let bitmap = picture::bitmap(file).map_err(|error| {
            DrawError::new(error.code, format!("Picture {} of {}: {}", n + 1, files.len(), error.message))
        })?;
        let size = stills.first().map(|first| (first.bitmap.columns, first.bitmap.rows));
        let (columns, rows) = size.unwrap_or_else(|| still::small(bitmap.columns, bitmap.rows));
        stills.push(Still { bitmap: resized(&bitmap, columns, rows), lasts_s });
    }
    drawn(Stills { cut: files.len() > stills.len(), stills }, settings)
}

fn resized(bitmap: &Bitmap, columns: usize, rows: usize) -> Bitmap {
    let pixel = |index: usize| {
        let x = still::sample(index % columns, columns, bitmap.columns);
        let y = still::sample(index / columns, rows, bitmap.rows);
        bitmap.pixels.get(y * bitmap.columns + x).copied().unwrap_or([0; 4])
    };
    Bitmap { columns, rows, pixels: (0..columns * rows).map(pixel).collect() }
}

/// Draws all pictures in the same way, with their masks smoothed by [`smoothed`]. Pictures that show nothing are left
/// out. Fails if no picture shows anything.
fn drawn(stills: Stills, settings: &PictureSettings) -> Result<Animation, DrawError> {
    let separations: Vec<Separation> =
        stills.stills.iter().map(|still| picture::separated(&still.bitmap, settings)).collect();
    let clear = separations.iter().filter(|separation| separation.is_clear()).count() * 2 > separations.len();
    let masks: Vec<BitMask> = separations.into_iter().map(|separation| separation.mask).collect();
    let mut animation = Animation::default();
    let (mut at_s, mut empty) = (0.0, 0);
    for (n, still) in stills.stills.iter().enumerate() {
        match picture::drawn(&still.bitmap, smoothed(&masks, n), settings, clear) {
            Ok(made) => {
                let shade = shade(&still.bitmap, &made.drawing);
                let lasts_s = still.lasts_s;
                animation.frames.push(AnimationFrame { at_s, lasts_s, drawing: made.drawing, shade });
            }
            Err(_) => empty += 1,
        }
        at_s += still.lasts_s;
    }
    if animation.frames.is_empty() {
        return Err(damaged("no picture of it shows anything"));
    }
    animation.notes = notes(stills.cut, empty, animation.frames.len());
    Ok(animation)
}

fn notes(cut: bool, empty: usize, frames: usize) -> Vec<Note> {
    let cut = cut.then(|| {
        let message =
            format!("Only the first {frames} pictures are drawn: the animation is longer, or cut off.");
        Note::new("animation-cut", message)
    });
    let empty = (empty > 0).then(|| {
        let message = format!("{empty} pictures show nothing: the pictures before them stay.");
        Note::new("animation-empty", message)
    });
    cut.into_iter().chain(empty).collect()
}

/// Smooths the mask with index `at`. The result has the pixels that are inside in at least two of three masks: this
/// one, the one before and the one after. If that leaves fewer than half of the mask's pixels, or a neighbour is
/// missing, the mask is returned unchanged.
fn smoothed(masks: &[BitMask], at: usize) -> BitMask {
    let own = masks[at].clone();
    let sides = at.checked_sub(1).and_then(|before| masks.get(before)).zip(masks.get(at + 1));
    let Some((before, after)) = sides else { return own };
    let most = |((own, before), after): ((&bool, &bool), &bool)| {
        u8::from(*own) + u8::from(*before) + u8::from(*after) >= 2
    };
    let inside = own.inside.iter().zip(&before.inside).zip(&after.inside).map(most).collect();
    let mixed = BitMask { columns: own.columns, inside };
    if mixed.count() * 2 < own.count() { own } else { mixed }
}

/// Returns the mean weight of the drawing's picture in each cell of a coarse grid. Outside the thing that the picture
/// shows, the weight is 0.
fn shade(bitmap: &Bitmap, drawing: &Drawing) -> Vec<f32> {
    let weights = drawing.parts.first().and_then(|part| part.raster.as_ref()).map(|raster| &raster.weights);
    let mut sums = vec![(0.0f32, 0.0f32); GRID * GRID];
    for index in 0..bitmap.pixels.len() {
        let (x, y) = (index % bitmap.columns, index / bitmap.columns);
        let cell = y * GRID / bitmap.rows * GRID + x * GRID / bitmap.columns;
        let weight = weights.and_then(|weights| weights.get(index)).copied().unwrap_or(0.0);
        if let Some((sum, count)) = sums.get_mut(cell) {
            *sum += weight;
            *count += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count.max(1.0)).collect()
}

/// Correlation coefficient of two pictures' values, −1 to 1. It is 1 if both pictures have no contrast, 0 if only one
/// has none.
fn correlation(a: &[f32], b: &[f32]) -> f64 {
    let mean =
        |values: &[f32]| values.iter().map(|v| f64::from(*v)).sum::<f64>() / values.len().max(1) as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let (a, b) = (f64::from(*a) - mean_a, f64::from(*b) - mean_b);
        ab += a * b;
        aa += a * a;
        bb += b * b;
    }
    match (aa > 1e-9, bb > 1e-9) {
        (true, true) => ab / libm::sqrt(aa * bb),
        (false, false) => 1.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests;
