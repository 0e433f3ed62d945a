//! Measures how well lights show a drawing, seen from a distance.
//!
//! Every light is a Gaussian of fixed width, and the drawing is blurred with the same width. The width depends on the
//! drawing's size and not on the spacing of lights. Otherwise three lights would pass for the letter A, because wide
//! lights would fill the gaps between them.

use lightbots_base::Vec2;

use crate::buckets::nearest_distances;
use crate::coverage::{Sample, samples};
use crate::drawing::{Drawing, DrawingPart, Stroke};
use crate::geometry::bounds;
use crate::light_image::LightImage;
use crate::lines::LineSet;
use crate::settings::PlacedLight;
use crate::symmetry::{Mirror, symmetric_share};

/// Standard deviation of a light's Gaussian, as a share of a letter's height, or of the larger side of another drawing.
/// A letter is seen from the distance at which its strokes just stay apart (measured with templates of 36 signs).
pub(crate) const SIGMA: f64 = 0.07;

/// From this correlation on, viewers recognise a picture without being told what it shows.
pub const READABLE: f64 = 0.90;

/// Below this correlation a picture is not recognised.
pub const DOUBTFUL: f64 = 0.85;

/// How well lights show a drawing. Both figures are 1 if nothing can be measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Readability {
    /// Normalised cross-correlation between the blurred lights and the blurred drawing, 0 to 1, in the part in which it
    /// is lowest.
    pub correlation: f64,
    /// Share of the lights that have a mirror image among the lights, in the part with the lowest share. It is 1 for
    /// parts without mirror symmetry.
    pub symmetry: f64,
}

/// Measures how well lights show a drawing. Lights and drawing have the same coordinate system.
pub(crate) fn readability(drawing: &Drawing, lights: &[PlacedLight]) -> Readability {
    let mut worst = Readability { correlation: 1.0, symmetry: 1.0 };
    for (index, part) in drawing.parts.iter().enumerate() {
        let places: Vec<Vec2> =
            lights.iter().filter(|light| light.part == index).map(|light| light.at).collect();
        if let Some(one) = of_group(part, &places) {
            worst.correlation = worst.correlation.min(one.correlation);
            worst.symmetry = worst.symmetry.min(one.symmetry);
        }
    }
    worst
}

/// Measures how well lights at `places` show one part. `None` for a part without extent.
pub(crate) fn of_group(part: &DrawingPart, places: &[Vec2]) -> Option<Readability> {
    let (low, high) = bounds(part.points())?;
    let size = high - low;
    // A dash has almost no height, so half its width counts.
    let sigma = SIGMA * if part.letter.is_some() { size.y.max(0.5 * size.x) } else { size.x.max(size.y) };
    if sigma <= 0.0 {
        return None;
    }
    let pitch = sigma / 4.0;
    let drawn = drawn(part, pitch);
    if drawn.is_empty() {
        return None;
    }
    let image = |points: &mut dyn Iterator<Item = (Vec2, f64)>| LightImage::new(points, low, high, sigma);
    let lights = image(&mut places.iter().map(|at| (*at, 1.0)));
    let likeness = |drawn: &[Sample]| {
        lights.correlation(&image(&mut drawn.iter().map(|sample| (sample.at, sample.mass))))
    };
    // A letter of strokes is as readable as a bold one, and a star's edge as readable as a filled star: the better
    // likeness counts.
    let spine = along(&part.spine, pitch);
    let correlation = likeness(&drawn).max(if spine.is_empty() { 0.0 } else { likeness(&spine) });
    let mut distances = nearest_distances(places, pitch);
    distances.sort_by(f64::total_cmp);
    let reach = 0.3 * distances.get(distances.len() / 2).copied().unwrap_or(0.0);
    let symmetry = Mirror::of(&drawn, pitch).map_or(1.0, |mirror| symmetric_share(mirror, places, reach));
    Some(Readability { correlation, symmetry })
}

/// Returns samples of what a part draws: its areas, its strokes, and a picture's weights if it has neither.
pub(crate) fn drawn(part: &DrawingPart, pitch: f64) -> Vec<Sample> {
    let mut drawn = samples(part, pitch);
    drawn.extend(along(&part.strokes, pitch));
    drawn
}

/// Returns samples along lines. Their mass is that of a line four `pitch` wide, about as wide as a light.
fn along(strokes: &[Stroke], pitch: f64) -> Vec<Sample> {
    let lines = LineSet::new(strokes, pitch);
    lines.points().iter().map(|at| Sample { at: *at, mass: 4.0 * pitch * pitch }).collect()
}
