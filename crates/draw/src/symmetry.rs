//! Keeps the places for mirror-symmetric drawings mirror-symmetric. An H with three lights on the left and four on the
//! right would look wrong.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::coverage::Sample;

/// A drawing is symmetric if at least this share of its mass has a mirror image in the drawing.
const SYMMETRIC: f64 = 0.97;

/// A mirror axis of a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mirror {
    /// Left and right are alike: the axis is vertical, at this x.
    LeftRight(f64),
    /// Top and bottom are alike: the axis is horizontal, at this y.
    UpDown(f64),
}

/// Which places of a list are mirror images of each other, and which are on the axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pairing {
    /// The axis.
    pub mirror: Mirror,
    /// Indices of places on the axis.
    pub single: Vec<usize>,
    /// Indices of a place and of its mirror image, for each pair.
    pub pairs: Vec<(usize, usize)>,
}

impl Mirror {
    /// The mirror image of a point.
    pub fn image(self, at: Vec2) -> Vec2 {
        match self {
            Self::LeftRight(x) => Vec2::new(2.0 * x - at.x, at.y),
            Self::UpDown(y) => Vec2::new(at.x, 2.0 * y - at.y),
        }
    }

    /// Signed distance of a point from the axis: positive to the right of the axis or above it.
    pub fn side(self, at: Vec2) -> f64 {
        match self {
            Self::LeftRight(x) => at.x - x,
            Self::UpDown(y) => at.y - y,
        }
    }

    /// The nearest point of the axis.
    pub fn onto(self, at: Vec2) -> Vec2 {
        match self {
            Self::LeftRight(x) => Vec2::new(x, at.y),
            Self::UpDown(y) => Vec2::new(at.x, y),
        }
    }

    /// Finds the mirror axis of a drawing; a left-right symmetry comes before an up-down symmetry. Only axes through
    /// the centroid are tried. `None` if the drawing has neither symmetry. `pitch`: distance between samples.
    pub fn of(samples: &[Sample], pitch: f64) -> Option<Self> {
        let mass: f64 = samples.iter().map(|sample| sample.mass).sum();
        let sum = samples.iter().fold(Vec2::ZERO, |sum, sample| sum + sample.at * sample.mass);
        let center = sum * (1.0 / mass);
        let places: Vec<Vec2> = samples.iter().map(|sample| sample.at).collect();
        let buckets = Buckets::new(&places, pitch);
        let share = |mirror: Self| {
            let near = |sample: &&Sample| {
                buckets
                    .nearest(mirror.image(sample.at))
                    .is_some_and(|(_, square)| square < 4.0 * pitch * pitch)
            };
            samples.iter().filter(near).map(|sample| sample.mass).sum::<f64>() / mass
        };
        let axes = [Self::LeftRight(center.x), Self::UpDown(center.y)];
        axes.into_iter().find(|mirror| center.is_finite() && share(*mirror) >= SYMMETRIC)
    }
}

impl Pairing {
    /// Makes exactly symmetric places. `side`: places on one side of the axis, which get mirror images. `single`:
    /// places that are moved onto the axis. In the result, each place of `side` is followed by its image; the single
    /// places come last.
    pub fn unfold(mirror: Mirror, side: &[Vec2], single: &[Vec2]) -> (Vec<Vec2>, Self) {
        let mut places = Vec::with_capacity(2 * side.len() + single.len());
        for place in side {
            places.extend([*place, mirror.image(*place)]);
        }
        places.extend(single.iter().map(|place| mirror.onto(*place)));
        let pairs = (0..side.len()).map(|index| (2 * index, 2 * index + 1)).collect();
        let single = (2 * side.len()..places.len()).collect();
        (places, Self { mirror, single, pairs })
    }

    /// Shifts all indices by `count`, for a list in which `count` other places come first.
    pub fn after(mut self, count: usize) -> Self {
        self.single.iter_mut().for_each(|index| *index += count);
        self.pairs.iter_mut().for_each(|(a, b)| (*a, *b) = (*a + count, *b + count));
        self
    }

    /// Makes places symmetric again after they moved independently of each other.
    pub fn apply(&self, places: &mut [Vec2]) {
        for index in &self.single {
            places[*index] = self.mirror.onto(places[*index]);
        }
        for (a, b) in &self.pairs {
            let mean = places[*a].lerp(self.mirror.image(places[*b]), 0.5);
            places[*a] = mean;
            places[*b] = self.mirror.image(mean);
        }
    }
}

/// Returns the share of places whose mirror image has a place within `reach`. That may be the place itself.
pub(crate) fn symmetric_share(mirror: Mirror, places: &[Vec2], reach: f64) -> f64 {
    let buckets = Buckets::new(places, reach);
    let near = |place: &&Vec2| {
        buckets.nearest(mirror.image(**place)).is_some_and(|(_, square)| square < reach * reach)
    };
    places.iter().filter(near).count() as f64 / places.len().max(1) as f64
}
