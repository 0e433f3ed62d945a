//! Lloyd's relaxation: each place moves to the centroid of the part of the drawing that is nearest to it (Lloyd 1982;
//! weighted as in Secord, Weighted Voronoi Stippling, 2002).

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::coverage::Sample;
use crate::symmetry::Pairing;

/// How far a place moves beyond the way to its centroid: 1.8 needs about a quarter of the rounds.
const OVER: f64 = 1.8;

/// How a relaxation runs.
pub(crate) struct Lloyd<'a> {
    /// What is to be covered.
    pub samples: &'a [Sample],
    /// Number of places at the beginning of the list that stay where they are.
    pub kept: usize,
    /// Ideal distance between neighbours, same units as places.
    pub spacing: f64,
    /// Most rounds.
    pub rounds: usize,
    /// Which places mirror each other, for drawings with a mirror axis.
    pub pairing: Option<&'a Pairing>,
}

impl Lloyd<'_> {
    /// Moves places until the largest move is below 1 % of the spacing or the rounds are over.
    pub fn run(&self, places: &mut [Vec2]) {
        for round in 0..self.rounds {
            // The last rounds go to the centroids themselves: over-relaxed places swing about them.
            let over = if round + 4 < self.rounds { OVER } else { 1.0 };
            let moved = self.round(places, over);
            if moved < 0.01 * self.spacing && over == OVER {
                self.round(places, 1.0);
                break;
            }
        }
    }

    /// One round; returns the longest move.
    fn round(&self, places: &mut [Vec2], over: f64) -> f64 {
        let centroids = self.centroids(places);
        self.recall_strays(places, &centroids);
        let mut longest: f64 = 0.0;
        for (index, centroid) in centroids.into_iter().enumerate().skip(self.kept) {
            let Some(centroid) = centroid else { continue };
            let step = (centroid - places[index]) * over;
            // A long over-relaxed step may leave the drawing.
            let step = if step.length() > self.spacing { centroid - places[index] } else { step };
            longest = longest.max(step.length());
            places[index] += step;
        }
        if let Some(pairing) = self.pairing {
            pairing.apply(places);
        }
        longest
    }

    /// Moves places without a cell, which are off the drawing or on one point with another, to where places are missing
    /// most.
    fn recall_strays(&self, places: &mut [Vec2], centroids: &[Option<Vec2>]) {
        for index in (self.kept..places.len()).filter(|index| centroids[*index].is_none()) {
            let buckets = Buckets::new(places, 0.8 * self.spacing);
            let gap = |sample: &&Sample| buckets.nearest(sample.at).map_or(0.0, |(_, square)| square);
            let lonely = self.samples.iter().max_by(|a, b| gap(a).total_cmp(&gap(b))).map(|sample| sample.at);
            places[index] = lonely.unwrap_or(places[index]);
        }
    }

    /// Centroid of each place's cell; `None` for an empty cell.
    fn centroids(&self, places: &[Vec2]) -> Vec<Option<Vec2>> {
        let mut sums = vec![(0.0, Vec2::ZERO); places.len()];
        let buckets = Buckets::new(places, 0.8 * self.spacing);
        for sample in self.samples {
            if let Some((index, _)) = buckets.nearest(sample.at) {
                sums[index].0 += sample.mass;
                sums[index].1 += sample.at * sample.mass;
            }
        }
        sums.into_iter().map(|(mass, sum)| (mass > 0.0).then(|| sum * (1.0 / mass))).collect()
    }
}

/// Energy of places: mean over the samples of the squared distance from the nearest place. Smaller is more even.
pub(crate) fn energy(samples: &[Sample], places: &[Vec2], spacing: f64) -> f64 {
    let buckets = Buckets::new(places, 0.8 * spacing);
    let (mut sum, mut mass) = (0.0, 0.0);
    for sample in samples {
        sum += sample.mass * buckets.nearest(sample.at).map_or(0.0, |(_, square)| square);
        mass += sample.mass;
    }
    if mass > 0.0 { sum / mass } else { 0.0 }
}
