//! Prepares a part for placing: samples of its areas, its lines, its mirror axis.

use lightbots_base::Vec2;

use crate::apart::Room;
use crate::buckets::Buckets;
use crate::coverage::{Sample, samples};
use crate::drawing::{DrawingPart, Stroke};
use crate::geometry::{bounds, hexagonal_spacing};
use crate::lines::{LineSet, Polyline};
use crate::symmetry::Mirror;
use crate::unique::unique;

/// Largest number of samples of a part. Ten thousand places on them take about a second.
const MOST_SAMPLES: f64 = 1_000_000.0;

/// How much work goes into places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// Fewer samples and rounds, for a preview while a setting is changed.
    Quick,
    /// The result that is saved.
    #[default]
    Full,
}

impl Quality {
    /// Number of samples for each place. With fewer than 30 the centroid of a cell is coarse (measured).
    fn samples(self, count: usize) -> f64 {
        match self {
            Self::Quick => 30.0,
            Self::Full if count <= 300 => 100.0,
            Self::Full => 50.0,
        }
    }

    /// Least number of samples of a part. With fewer, small details of a letter are coarse.
    fn least(self) -> f64 {
        match self {
            Self::Quick => 1_200.0,
            Self::Full => 4_000.0,
        }
    }

    /// Number of rounds of relaxation.
    pub(crate) fn rounds(self) -> usize {
        match self {
            Self::Quick => 12,
            Self::Full => 60,
        }
    }
}

/// A part with all data that its places depend on.
pub(crate) struct Ground {
    /// Samples of the areas or of the picture.
    pub samples: Vec<Sample>,
    /// Places of the samples.
    pub inside: Vec<Vec2>,
    /// Distance between samples.
    pub pitch: f64,
    /// Sum of the samples' masses.
    pub mass: f64,
    /// Outlines of the areas.
    pub outline: LineSet,
    /// Strokes of the part, or the lines that replace its areas, each stretch only once.
    pub lines: LineSet,
    /// Larger side of the box around the part.
    pub size: f64,
    /// Mirror axis of the areas, else of the lines.
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

    /// Buckets of the samples' places, to find near ones.
    pub fn buckets(&self) -> Buckets<'_> {
        Buckets::new(&self.inside, 2.0 * self.pitch)
    }

    /// Returns where places of this part may go. `inside` are the buckets of its samples, `on_track` those of `track`.
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

    /// Ideal distance between `count` places that fill the areas.
    pub fn spacing(&self, count: usize) -> f64 {
        hexagonal_spacing(self.mass, count)
    }
}

/// Returns the distance between samples that gives the wanted number of them. The area is measured with coarse samples
/// first.
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

/// Returns the pieces of strokes at whose points `allowed` is true.
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
