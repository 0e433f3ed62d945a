//! Chooses places for the relaxation to begin with, by weighted sample elimination (Yuksel, Sample Elimination for
//! Generating Poisson Disk Sample Sets, 2015).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use lightbots_base::Vec2;
use lightbots_base::random::split_mix;

use crate::buckets::Buckets;
use crate::coverage::Sample;

/// Number of random candidates that are drawn for each place.
const CANDIDATES: usize = 5;

/// Exponent in the weight between two candidates, as in the paper.
const EXPONENT: i32 = 8;

/// Returns a random number from 0 up to, but not including, 1.
pub(crate) fn unit(state: &mut u64) -> f64 {
    (split_mix(state) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Returns `count` new places in the samples, evenly spread, about `spacing` apart from each other and from the places
/// `kept`. Empty if there are no samples.
pub(crate) fn seeds(samples: &[Sample], kept: &[Vec2], count: usize, spacing: f64, seed: u64) -> Vec<Vec2> {
    if samples.is_empty() || count == 0 {
        return Vec::new();
    }
    let mut state = seed;
    let mut candidates = kept.to_vec();
    candidates.extend(drawn(samples, count * CANDIDATES, spacing, &mut state));
    let left = eliminate(&candidates, kept.len(), count, spacing);
    left.into_iter().map(|index| candidates[index]).collect()
}

/// Draws random candidates whose density follows the samples' mass. Small random shifts hide the grid of the samples.
fn drawn(samples: &[Sample], count: usize, spacing: f64, state: &mut u64) -> Vec<Vec2> {
    let mut total = 0.0;
    let sums: Vec<f64> = samples
        .iter()
        .map(|sample| {
            total += sample.mass;
            total
        })
        .collect();
    // Each candidate comes from an equal share of the mass, because independent draws could leave a large gap.
    let pick = |index: usize, state: &mut u64| {
        let target = (index as f64 + unit(state)) / count as f64 * total;
        let at = samples[sums.partition_point(|sum| *sum < target).min(samples.len() - 1)].at;
        at + Vec2::new(unit(state) - 0.5, unit(state) - 0.5) * (0.02 * spacing)
    };
    (0..count).map(|index| pick(index, state)).collect()
}

#[derive(PartialEq)]
struct Crowded {
    weight: f64,
    index: usize,
}

impl Eq for Crowded {}

impl Ord for Crowded {
    fn cmp(&self, other: &Self) -> Ordering {
        self.weight.total_cmp(&other.weight).then(other.index.cmp(&self.index))
    }
}

impl PartialOrd for Crowded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Removes the most crowded candidate again and again, until `count` are left, and returns the indices of those. The
/// first `kept` candidates are never removed, are not in the result, and do not count.
pub(crate) fn eliminate(candidates: &[Vec2], kept: usize, count: usize, spacing: f64) -> Vec<usize> {
    let reach = 1.3 * spacing;
    let mut near: Vec<Vec<(u32, f64)>> = vec![Vec::new(); candidates.len()];
    let mut weights = vec![0.0; candidates.len()];
    Buckets::new(candidates, reach / 2.0).pairs(reach, |a, b, length| {
        let weight = (1.0 - length / reach).powi(EXPONENT);
        near[a].push((b as u32, weight));
        near[b].push((a as u32, weight));
        weights[a] += weight;
        weights[b] += weight;
    });
    let mut heap: BinaryHeap<Crowded> =
        (kept..candidates.len()).map(|index| Crowded { weight: weights[index], index }).collect();
    let mut alive = vec![true; candidates.len()];
    let mut left = candidates.len() - kept;
    while left > count {
        let Some(Crowded { weight, index }) = heap.pop() else { break };
        if !alive[index] || weight > weights[index] {
            if alive[index] {
                heap.push(Crowded { weight: weights[index], index });
            }
            continue;
        }
        alive[index] = false;
        left -= 1;
        for (other, weight) in &near[index] {
            weights[*other as usize] -= weight;
        }
    }
    (kept..candidates.len()).filter(|index| alive[*index]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buckets::nearest_distances;

    fn field() -> Vec<Sample> {
        (0..2_500)
            .map(|i| Sample { at: Vec2::new(f64::from(i % 50), f64::from(i / 50)) * 0.02, mass: 0.0004 })
            .collect()
    }

    #[test]
    fn seeds_keep_their_distance_and_leave_the_kept_places_free() {
        let spacing = (2.0 / (3.0_f64.sqrt() * 101.0)).sqrt();
        let kept = [Vec2::new(0.5, 0.5)];
        let places = seeds(&field(), &kept, 100, spacing, 7);
        assert_eq!(places.len(), 100);
        let all: Vec<Vec2> = kept.iter().chain(&places).copied().collect();
        let least = nearest_distances(&all, spacing).into_iter().fold(f64::MAX, f64::min);
        assert!(least > 0.6 * spacing, "{least} of {spacing}");
    }
}
