//! Many numbers in three.

use lightbots_base::statistics::nearest_rank;
use serde::Serialize;

/// Median, 99th percentile (nearest rank) and maximum of numbers; all 0 without numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ThreeFigures {
    /// Half of the numbers are at most this.
    pub median: f64,
    /// 99 of 100 numbers are at most this.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
    /// How many numbers there are.
    pub count: usize,
}

impl ThreeFigures {
    /// Of these numbers, in any order, rounded to `decimals`.
    pub fn of(numbers: &[f64], decimals: i32) -> Self {
        let mut sorted = numbers.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let rank = |percent: usize| {
            let rank = nearest_rank(sorted.len(), percent);
            round(sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0), decimals)
        };
        Self { median: rank(50), p99: rank(99), max: rank(100), count: sorted.len() }
    }
}

/// A number with `decimals` digits after the point, never −0.
pub(crate) fn round(number: f64, decimals: i32) -> f64 {
    let scale = 10f64.powi(decimals);
    (number * scale).round() / scale + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_counted_from_the_least() {
        let numbers: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        assert_eq!(
            ThreeFigures::of(&numbers, 3),
            ThreeFigures { median: 100.0, p99: 198.0, max: 200.0, count: 200 }
        );
        assert_eq!(ThreeFigures::of(&[], 3), ThreeFigures::default());
        assert_eq!(round(-0.0004, 3).to_bits(), 0);
    }
}
