//! Lloyd's relaxation (Lloyd 1982; weighted as in Secord, Weighted Voronoi Stippling, 2002). Each place moves to the
//! centroid of its cell. The cell of a place is the part of the drawing that is nearer to it than to other places.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::coverage::Sample;
use crate::symmetry::Pairing;

/// Over-relaxation: each step is this multiple of the distance to the centroid. With 1.8, about a quarter of the rounds
/// is enough.
const OVER: f64 = 1.8;

/// A relaxation and its settings.
pub(crate) struct Lloyd<'a> {
    /// Samples of the drawing to cover.
    pub samples: &'a [Sample],
    /// Number of places at the beginning of the list that are not moved.
    pub kept: usize,
    /// Ideal distance between neighbouring places, in the unit of the places.
    pub spacing: f64,
    /// Largest number of rounds.
    pub rounds: usize,
    /// Which places are mirror images of each other; `None` if places need not stay symmetric.
    pub pairing: Option<&'a Pairing>,
}

impl Lloyd<'_> {
    /// Moves places until the longest step is below 1 % of the spacing, or the rounds are over.
    pub fn run(&self, places: &mut [Vec2]) {
        for round in 0..self.rounds {
            // The last rounds step to the centroids themselves, because over-relaxed places oscillate about them.
            let over = if round + 4 < self.rounds { OVER } else { 1.0 };
            let moved = self.round(places, over);
            if moved < 0.01 * self.spacing && over == OVER {
                self.round(places, 1.0);
                break;
            }
        }
    }

    /// Runs one round and returns the longest step. It is infinite if places without a cell were moved, because these
    /// places have not reached a centroid yet.
    fn round(&self, places: &mut [Vec2], over: f64) -> f64 {
        let cells = self.cells(places);
        let mut longest: f64 = if self.recall_strays(places, &cells) { f64::INFINITY } else { 0.0 };
        for (index, cell) in cells.iter().enumerate().skip(self.kept) {
            let Some(centroid) = cell.centroid() else { continue };
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

    /// Moves places without a cell: places off the drawing, or at the same point as another place. Each is moved into
    /// one of the cells with the largest distortion, where places are missing most. In the best arrangement all cells
    /// have equal distortion (Gersho 1979). Returns whether there were places without a cell.
    fn recall_strays(&self, places: &mut [Vec2], cells: &[Cell]) -> bool {
        let strays: Vec<usize> =
            (self.kept..places.len()).filter(|index| cells[*index].centroid().is_none()).collect();
        if strays.is_empty() {
            return false;
        }
        let mut worst: Vec<&Cell> = cells.iter().filter(|cell| cell.distortion > 0.0).collect();
        worst.sort_by(|a, b| b.distortion.total_cmp(&a.distortion));
        for (index, cell) in strays.into_iter().zip(worst) {
            places[index] = cell.farthest;
        }
        true
    }

    /// Returns the cell of each place.
    fn cells(&self, places: &[Vec2]) -> Vec<Cell> {
        let mut cells = vec![Cell::default(); places.len()];
        let buckets = Buckets::new(places, 0.8 * self.spacing);
        for sample in self.samples {
            if let Some((index, square)) = buckets.nearest(sample.at) {
                cells[index].add(sample, square);
            }
        }
        cells
    }
}

/// Sums over the samples that are nearer to one place than to all others.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    mass: f64,
    /// Sum of the samples' positions times their masses.
    moment: Vec2,
    /// Sum of the samples' squared distances from the place, times their masses.
    distortion: f64,
    /// Largest contribution of one sample to the distortion.
    most: f64,
    /// Position of the sample with the largest contribution.
    farthest: Vec2,
}

impl Cell {
    /// Adds a sample. `square`: its squared distance from the place.
    fn add(&mut self, sample: &Sample, square: f64) {
        self.mass += sample.mass;
        self.moment += sample.at * sample.mass;
        let distortion = sample.mass * square;
        self.distortion += distortion;
        if distortion > self.most {
            (self.most, self.farthest) = (distortion, sample.at);
        }
    }

    /// Returns the centroid. `None` for an empty cell.
    fn centroid(&self) -> Option<Vec2> {
        (self.mass > 0.0).then(|| self.moment * (1.0 / self.mass))
    }
}

/// Energy of places: mean squared distance of the samples from their nearest places, weighted by mass. With less
/// energy, places are more even.
pub(crate) fn energy(samples: &[Sample], places: &[Vec2], spacing: f64) -> f64 {
    let buckets = Buckets::new(places, 0.8 * spacing);
    let (mut sum, mut mass) = (0.0, 0.0);
    for sample in samples {
        sum += sample.mass * buckets.nearest(sample.at).map_or(0.0, |(_, square)| square);
        mass += sample.mass;
    }
    if mass > 0.0 { sum / mass } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buckets::LOOKED;
    use crate::geometry::hexagonal_spacing;
    use crate::seeds::seeds;

    /// Number of rounds of a relaxation whose work is measured.
    const ROUNDS: usize = 12;

    /// A picture of dark ground below faint sky, with 30 samples for each place.
    fn hills(count: usize) -> Vec<Sample> {
        let side = ((30 * count) as f64).sqrt() as usize;
        let sample = |index: usize| {
            let at = Vec2::new((index % side) as f64, (index / side) as f64) * (1.0 / side as f64);
            let weight = if at.y < 0.3 { 1.0 } else { 0.02 };
            Sample { at, mass: weight * weight / (side * side) as f64 }
        };
        (0..side * side).map(sample).collect()
    }

    /// Samples, and places of which every third is on one point with another.
    fn doubled(count: usize) -> (Vec<Sample>, Vec<Vec2>, f64) {
        let samples = hills(count);
        let spacing = hexagonal_spacing(samples.iter().map(|sample| sample.mass).sum(), count);
        let mut places = seeds(&samples, &[], count, spacing, 1);
        (2..count).step_by(3).for_each(|index| places[index] = places[index - 1]);
        (samples, places, spacing)
    }

    /// Buckets and points looked at for each sample and round.
    fn work(count: usize) -> f64 {
        let (samples, mut places, spacing) = doubled(count);
        let before = LOOKED.get();
        Lloyd { samples: &samples, kept: 0, spacing, rounds: ROUNDS, pairing: None }.run(&mut places);
        (LOOKED.get() - before) as f64 / (samples.len() * ROUNDS) as f64
    }

    #[test]
    fn sixteen_times_the_places_are_at_most_five_times_the_work_for_a_sample() {
        let (few, many) = (work(200), work(3_200));
        assert!(many < 5.0 * few, "{few} and {many}");
    }

    #[test]
    fn places_on_one_point_part_and_cover_the_picture() {
        let (samples, mut places, spacing) = doubled(600);
        let task = Lloyd { samples: &samples, kept: 0, spacing, rounds: 60, pairing: None };
        task.run(&mut places);
        assert!(task.cells(&places).iter().all(|cell| cell.centroid().is_some()));
        let mut even = seeds(&samples, &[], 600, spacing, 1);
        task.run(&mut even);
        let (doubled, even) = (energy(&samples, &places, spacing), energy(&samples, &even, spacing));
        assert!(doubled < 1.05 * even, "{doubled} instead of {even}");
    }
}
