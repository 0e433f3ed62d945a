//! Turns pictures into drawings: the silhouette of the thing that a picture shows, the outline of the thing, or the
//! tones.

mod bitmap;
mod contour;
mod decode;
mod lit;
mod pieces;
mod separate;

use lightbots_base::{Rgb, Vec2};

pub(crate) use lit::lifted;

use crate::drawing::{Area, Drawing, DrawingPart, FillRule, Stroke};
use crate::error::{DrawError, Made, Note};
pub(crate) use crate::picture::bitmap::BitMask;
pub use crate::picture::bitmap::Bitmap;
pub(crate) use crate::picture::separate::Separation;

/// What robots show of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureWay {
    /// The silhouette of the thing in the picture if a plain background is found, otherwise the tones.
    #[default]
    Auto,
    /// The area of the thing in the picture, in its colours, without the background.
    Silhouette,
    /// The border of the thing.
    Outline,
    /// The whole picture: robots stand densely where it is light.
    Tones,
}

/// How to show a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PictureSettings {
    /// What robots show of the picture.
    pub way: PictureWay,
    /// For a silhouette or an outline: the background is shown instead of the thing. For tones: robots stand densely
    /// where it is dark.
    pub inverted: bool,
}

/// Draws a picture in PNG, JPEG or WebP.
///
/// # Errors
/// Files that cannot be decoded, and pictures in which nothing would be lit.
pub fn draw(bytes: &[u8], settings: &PictureSettings) -> Result<Made, DrawError> {
    let bitmap = decode::decode(bytes)?;
    let separation = separated(&bitmap, settings);
    let clear = separation.is_clear();
    drawn(&bitmap, separation.mask, settings, clear)
}

/// Decodes a picture in PNG, JPEG or WebP into a bitmap of reduced size.
pub(crate) fn bitmap(bytes: &[u8]) -> Result<Bitmap, DrawError> {
    decode::decode(bytes)
}

/// Separates the thing in a bitmap from its background. If the settings are inverted, the returned mask marks the
/// background instead.
pub(crate) fn separated(bitmap: &Bitmap, settings: &PictureSettings) -> Separation {
    let mut separation = separate::separate(bitmap);
    if settings.inverted {
        separation.mask.inside.iter_mut().for_each(|inside| *inside = !*inside);
    }
    separation
}

/// Draws a bitmap in which `mask` marks the thing. `clear`: whether the thing was clearly separated from its
/// background.
pub(crate) fn drawn(
    bitmap: &Bitmap,
    mask: BitMask,
    settings: &PictureSettings,
    clear: bool,
) -> Result<Made, DrawError> {
    match settings.way {
        PictureWay::Tones => tones(bitmap, settings.inverted),
        PictureWay::Auto if !clear => {
            let mut made = tones(bitmap, settings.inverted)?;
            let message = "No plain background was found: robots stand where the picture is light.";
            made.notes.push(Note::new("picture-tones", message));
            Ok(made)
        }
        way => silhouette(bitmap, mask, way == PictureWay::Outline, clear),
    }
}

fn tones(bitmap: &Bitmap, inverted: bool) -> Result<Made, DrawError> {
    let raster = lit::tones(bitmap, inverted);
    if raster.weights.iter().all(|weight| *weight <= 0.0) {
        let message =
            "The picture is evenly dark, so that no light would be on. Invert it, or choose another.";
        return Err(DrawError::new("picture-empty", message));
    }
    let part = DrawingPart { name: "picture".to_owned(), raster: Some(raster), ..DrawingPart::default() };
    Ok(Made { drawing: Drawing { parts: vec![part] }, notes: Vec::new() })
}

fn silhouette(bitmap: &Bitmap, mut mask: BitMask, outline: bool, clear: bool) -> Result<Made, DrawError> {
    let removed = pieces::tidy(&mut mask);
    let rings = contour::rings(&mask);
    if rings.is_empty() {
        let message = "Nothing in the picture differs from its edge. Choose tones, or a picture before a plain background.";
        return Err(DrawError::new("picture-empty", message));
    }
    let raster = lit::painted(bitmap, &mask);
    let color = raster.cell(rings[0].first().copied().unwrap_or(Vec2::ZERO));
    let color = color.and_then(|cell| raster.colors.get(cell)).copied().unwrap_or(Rgb::new(255, 255, 255));
    let stroke = |points: Vec<Vec2>| Stroke { points, closed: true, ink: color.into(), weight: 1.0 };
    let (areas, strokes) = if outline {
        (Vec::new(), rings.into_iter().map(stroke).collect())
    } else {
        (vec![Area { rings, rule: FillRule::NonZero, ink: color.into(), weight: 1.0 }], Vec::new())
    };
    let name = "picture".to_owned();
    let part = DrawingPart { name, areas, strokes, raster: Some(raster), ..DrawingPart::default() };
    let spots = (removed > 0).then(|| {
        let what =
            if removed == 1 { "A small spot is".to_owned() } else { format!("{removed} small spots are") };
        Note::new("picture-spots", format!("{what} left out."))
    });
    let unsure = (!clear).then(|| {
        let message = "The background is not plain, so that the silhouette may be wrong. Choose tones, or cut the thing out.";
        Note::new("picture-background", message)
    });
    let notes = spots.into_iter().chain(unsure).collect();
    Ok(Made { drawing: Drawing { parts: vec![part] }, notes })
}

#[cfg(test)]
mod tests;
