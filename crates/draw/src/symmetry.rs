//! Mirror-symmetric drawings get mirror-symmetric places: an H with three lights left and four right looks wrong.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::coverage::Sample;

/// Share of the mass that must have its mirror image in the drawing.
const SYMMETRIC: f64 = 0.97;

/// A mirror axis through the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mirror {
    /// Left and right are alike: the axis is at this x.
    LeftRight(f64),
    /// Above and below are alike: the axis is at this y.
    UpDown(f64),
}

/// Which of a list of places mirror each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pairing {
    /// The axis.
    pub mirror: Mirror,
    /// Places on the axis.
    pub single: Vec<usize>,
    /// Places and their mirror images.
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

    /// Distance from the axis, positive to the right of it or above it.
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

    /// The axis of a drawing, left and right before up and down; `None` if it has neither. `pitch` is the samples' distance.
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
    /// Places that mirror each other exactly, made from places on one side of the axis and on it: first both places of
    /// each pair, then the single ones.
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

    /// The same places behind `count` others.
    pub fn after(mut self, count: usize) -> Self {
        self.single.iter_mut().for_each(|index| *index += count);
        self.pairs.iter_mut().for_each(|(a, b)| (*a, *b) = (*a + count, *b + count));
        self
    }

    /// Makes places symmetric again after each has moved by itself.
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

/// Share of the places that have a mirror image within `reach`.
pub(crate) fn symmetric_share(mirror: Mirror, places: &[Vec2], reach: f64) -> f64 {
    let buckets = Buckets::new(places, reach);
    let near = |place: &&Vec2| {
        buckets.nearest(mirror.image(**place)).is_some_and(|(_, square)| square < reach * reach)
    };
    places.iter().filter(near).count() as f64 / places.len().max(1) as f64
}
