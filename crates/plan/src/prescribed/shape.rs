//! The curve of a robot without times: a place for each share of the curve, from 0 at its beginning to 1 at its end.

use std::sync::Arc;

use lightbots_base::Vec2;

use super::smooth_line::SmoothLine;

/// Distance from a share to either side at which the numerical derivative is taken, as a share of the curve.
const STEP: f64 = 1e-4;
/// Number of chords whose lengths add up to the length of a shape.
const LENGTH_STEPS: u32 = 64;

/// A curve, displaced a little so that it begins and ends exactly at given places.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    curve: ShapeCurve,
    /// Displacements of the curve at its beginning and at its end, metres. Between them, the displacement changes
    /// smoothly.
    offsets: (Vec2, Vec2),
}

#[derive(Clone, Debug)]
/// The kinds of curves. Places are in stage metres.
pub(crate) enum ShapeCurve {
    /// A straight line.
    Line { from: Vec2, to: Vec2 },
    /// A turn about `center` by `turn` radians, counter-clockwise if positive. It begins at `center + arm`. Meanwhile
    /// the length of the arm changes to `size` times.
    Turn { center: Vec2, arm: Vec2, turn: f64, size: f64 },
    /// The part of a track from `from_m` to `to_m` metres along it, displaced by `offset`, metres.
    Stretch { track: Arc<SmoothLine>, from_m: f64, to_m: f64, offset: Vec2 },
    /// A smooth curve through `places`; place k is at the share `shares[k]` of the curve.
    Through { places: Arc<[Vec2]>, shares: Arc<[f64]> },
    /// `times` circles, counter-clockwise. They begin at `at`, in the direction `begin` from the centre of the circle,
    /// radians.
    Circles { at: Vec2, radius_m: f64, begin: f64, times: f64 },
}

impl From<ShapeCurve> for Shape {
    fn from(curve: ShapeCurve) -> Self {
        Self { curve, offsets: (Vec2::ZERO, Vec2::ZERO) }
    }
}

impl ShapeCurve {
    fn at(&self, share: f64) -> Vec2 {
        match self {
            Self::Line { from, to } => from.lerp(*to, share),
            Self::Turn { center, arm, turn, size } => {
                let factor = 1.0 + (size - 1.0) * share;
                *center + rotated(*arm, turn * share) * factor
            }
            Self::Stretch { track, from_m, to_m, offset } => {
                track.at(from_m + (to_m - from_m) * share) + *offset
            }
            Self::Through { places, shares } => through(places, shares, share),
            Self::Circles { at, radius_m, begin, times } => {
                let angle = begin + core::f64::consts::TAU * times * share;
                *at + (Vec2::unit(angle) - Vec2::unit(*begin)) * *radius_m
            }
        }
    }

    /// Number of path pieces that are needed to follow the curve within a tenth of a millimetre, on floors of up to 20
    /// m.
    fn pieces(&self) -> usize {
        match self {
            Self::Line { .. } => 1,
            Self::Turn { turn, size, .. } => {
                ((turn.abs() / 0.25).ceil() as usize).max(if *size == 1.0 { 1 } else { 4 })
            }
            Self::Stretch { from_m, to_m, .. } => ((to_m - from_m).abs() / 0.05).ceil() as usize,
            Self::Through { places, .. } => 8 * (places.len() - 1),
            Self::Circles { times, .. } => (times * 16.0).ceil() as usize,
        }
        .max(1)
    }
}

impl Shape {
    /// The place at a share of the curve, 0 to 1, stage metres.
    pub(crate) fn at(&self, share: f64) -> Vec2 {
        let (begin, end) = self.offsets;
        self.curve.at(share) + begin * (1.0 - eased(share)) + end * eased(share)
    }

    /// The derivative of the place with respect to the share, metres.
    pub(crate) fn slope(&self, share: f64) -> Vec2 {
        let (from, to) = ((share - STEP).max(0.0), (share + STEP).min(1.0));
        (self.at(to) - self.at(from)) / (to - from)
    }

    /// Number of path pieces that are needed to follow the shape closely.
    pub(crate) fn pieces(&self) -> usize {
        self.curve.pieces()
    }

    /// Length of the shape, metres, as the sum of [`LENGTH_STEPS`] chords.
    pub(crate) fn length_m(&self) -> f64 {
        let at = |step: u32| self.at(f64::from(step) / f64::from(LENGTH_STEPS));
        (0..LENGTH_STEPS).map(|step| at(step).distance(at(step + 1))).sum()
    }

    /// Displaces the shape so that it begins at `start` and ends at `end`. For `None`, the shape begins or ends where
    /// its curve does.
    pub(crate) fn between(mut self, start: Option<Vec2>, end: Option<Vec2>) -> Self {
        let offset = |to: Option<Vec2>, share: f64| to.map_or(Vec2::ZERO, |to| to - self.curve.at(share));
        self.offsets = (offset(start, 0.0), offset(end, 1.0));
        self
    }
}

/// Returns the place at a share of the cubic Hermite spline that passes through `places[k]` at the share `shares[k]`.
fn through(places: &[Vec2], shares: &[f64], share: f64) -> Vec2 {
    let last = places.len() - 1;
    let index = shares.partition_point(|&begin| begin <= share).clamp(1, last) - 1;
    let slope = |at: usize| {
        let (before, after) = (at.saturating_sub(1), (at + 1).min(last));
        (places[after] - places[before]) / (shares[after] - shares[before])
    };
    let span = shares[index + 1] - shares[index];
    let u = (share - shares[index]) / span;
    let (from, to) = (places[index], places[index + 1]);
    let (u2, u3) = (u * u, u * u * u);
    from * (2.0 * u3 - 3.0 * u2 + 1.0)
        + slope(index) * (span * (u3 - 2.0 * u2 + u))
        + to * (3.0 * u2 - 2.0 * u3)
        + slope(index + 1) * (span * (u3 - u2))
}

/// Smooth step from 0 to 1 with a slope of 0 at both ends. With it, displacements do not change the directions at the
/// ends of a curve.
fn eased(share: f64) -> f64 {
    share * share * (3.0 - 2.0 * share)
}

/// `arm` turned counter-clockwise by `angle` radians.
fn rotated(arm: Vec2, angle: f64) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    Vec2::new(arm.x * cos - arm.y * sin, arm.x * sin + arm.y * cos)
}
