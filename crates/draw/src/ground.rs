//! Prepares a part of a drawing for placing robots: samples of its areas, its lines, and its mirror axis.

use lightbots_base::Vec2;

use crate::apart::Room;
use crate::buckets::Buckets;
use crate::coverage::{Sample, samples};
use crate::drawing::{DrawingPart, Stroke};
use crate::geometry::{bounds, hexagonal_spacing};
use crate::lines::{LineSet, Polyline};
use crate::symmetry::Mirror;
use crate::unique::unique;

/// Largest number of samples of a part. Finding ten thousand places on them takes about a second.
const MOST_SAMPLES: f64 = 1_000_000.0;

/// How much work goes into finding places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// Fewer samples and rounds, for a preview while a setting is changed.
    Quick,
    /// The result that is saved.
    #[default]
    Full,
}

impl Quality {
    /// Number of samples for each place. With fewer than 30 samples, the centroid of a place's cell is too coarse
    /// (measured).
    fn samples(self, count: usize) -> f64 {
        match self {
            Self::Quick => 30.0,
            Self::Full if count <= 300 => 100.0,
            Self::Full => 50.0,
        }
    }

    /// Least number of samples of a part. With fewer samples, small details of a letter would be lost.
    fn least(self) -> f64 {
        match self {
            Self::Quick => 1_200.0,
            Self::Full => 4_000.0,
        }
    }

    /// Largest number of rounds of relaxation.
    pub(crate) fn rounds(self) -> usize {
        match self {
            Self::Quick => 12,
            Self::Full => 60,
        }
    }
}

/// A part of a drawing, with all data that its places depend on.
pub(crate) struct Ground {
    /// Samples of the areas, or of the picture in a part that has neither areas nor strokes.
    pub samples: Vec<Sample>,
    /// Positions of the samples, in the same order.
    pub inside: Vec<Vec2>,
    /// Distance between samples.
    pub pitch: f64,
    /// Sum of the samples' masses.
    pub mass: f64,
    /// Outlines of the areas.
    pub outline: LineSet,
    /// Strokes of the part, or its spine if it has no strokes. Stretches that occur twice are kept once.
    pub lines: LineSet,
    /// Larger side of the rectangle around the part.
    pub size: f64,
    /// Mirror axis of the areas, or of the lines if there are no areas. `None` if they are not symmetric.
    pub mirror: Option<Mirror>,
}

impl Ground {
    /// Prepares a part for `count` places. Points for which `allowed` is false are left out.
    pub fn new(part: &DrawingPart, count: usize, quality: Quality, allowed: &dyn Fn(Vec2) -> bool) -> Self {
        let (low, high) = bounds(part.points()).unwrap_or_default();
        let size = (high.x - low.x).max(high.y - low.y);
        let pitch = pitch(part, count, quality, size);
        let mut samples = samples(part, pitch);
        samples.retain(|sample| allowed(sample.at));
        let spacing = hexagonal_spacing(samples.iter().map(|sample| sample.mass).sum(), count);
        let step = (0.02 * size).min(if spacing > 0.0 { 0.2 * spacing } else { size }).max(0.001 * size);
        let rings: Vec<Stroke> = part.areas.iter().flat_map(rings).collect();
        let strokes = if part.strokes.is_empty() { &part.spine } else { &part.strokes };
        let strokes = unique(strokes, size);
        let mut ground = Self {
            inside: samples.iter().map(|sample| sample.at).collect(),
            mass: samples.iter().map(|sample| sample.mass).sum(),
            outline: LineSet::new(&clipped(&rings, step, allowed), step),
            lines: LineSet::new(&clipped(&strokes, step, allowed), step),
            samples,
            pitch,
            size,
            mirror: None,
        };
        ground.mirror = ground.axis(step);
        ground
    }

    /// Buckets of the samples' positions, to find near samples.
    pub fn buckets(&self) -> Buckets<'_> {
        Buckets::new(&self.inside, 2.0 * self.pitch)
    }

    /// Returns where places of this part may go. `inside`: buckets of [`Self::inside`]. `track`: lines that places
    /// slide along. `on_track`: buckets of the points of `track`.
    pub fn room<'a>(
        &'a self,
        inside: &'a Buckets<'a>,
        track: &'a LineSet,
        on_track: &'a Buckets<'a>,
    ) -> Room<'a> {
        Room { inside, points: &self.inside, slack: 0.75 * self.pitch, track, on_track, pairing: None }
    }

    fn axis(&self, step: f64) -> Option<Mirror> {
        if !self.samples.is_empty() {
            return Mirror::of(&self.samples, self.pitch);
        }
        let points: Vec<Sample> =
            self.lines.points().iter().map(|at| Sample { at: *at, mass: 1.0 }).collect();
        Mirror::of(&points, step)
    }

    /// Distance between neighbours if `count` places fill the areas evenly, in the drawing's units.
    pub fn spacing(&self, count: usize) -> f64 {
        hexagonal_spacing(self.mass, count)
    }
}

/// Returns the distance between samples at which a part has the wanted number of samples. For that, its area is first
/// measured with coarse samples.
fn pitch(part: &DrawingPart, count: usize, quality: Quality, size: f64) -> f64 {
    let coarse = (size / 100.0).max(1e-9);
    let area = samples(part, coarse).len() as f64 * coarse * coarse;
    let wanted = (count as f64 * quality.samples(count)).clamp(quality.least(), MOST_SAMPLES);
    if area > 0.0 { (area / wanted).sqrt() } else { coarse }
}

fn rings(area: &crate::drawing::Area) -> impl Iterator<Item = Stroke> + '_ {
    area.rings.iter().filter(|ring| ring.len() > 2).map(|ring| Stroke {
        points: ring.clone(),
        closed: true,
        ink: area.ink.clone(),
        weight: 1.0,
    })
}

/// Returns the pieces of strokes on which `allowed` is true at all points.
fn clipped(strokes: &[Stroke], step: f64, allowed: &dyn Fn(Vec2) -> bool) -> Vec<Stroke> {
    let mut parts = Vec::new();
    for stroke in strokes {
        let Some(line) = Polyline::new(stroke, step) else { continue };
        if line.points.iter().all(|point| allowed(*point)) {
            parts.push(stroke.clone());
            continue;
        }
        for run in line.points.split(|point| !allowed(*point)).filter(|run| run.len() > 1) {
            parts.push(Stroke { points: run.to_vec(), closed: false, ..stroke.clone() });
        }
    }
    parts
}
