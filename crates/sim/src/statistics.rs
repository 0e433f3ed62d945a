//! Summary of many numbers by three numbers.

use lightbots_base::statistics::nearest_rank;
use serde::Serialize;

/// Median, 99th percentile (nearest rank) and maximum of numbers; all 0 without numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// At least half of the numbers are at most this.
    pub median: f64,
    /// At least 99 of 100 numbers are at most this.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
}

impl Spread {
    /// Summarises numbers in any order.
    pub fn of(numbers: &[f64]) -> Self {
        let mut sorted = numbers.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let rank = |percent: usize| {
            let rank = nearest_rank(sorted.len(), percent);
            sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
        };
        Self { median: rank(50), p99: rank(99), max: rank(100) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_counted_from_the_least() {
        let numbers: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        assert_eq!(Spread::of(&numbers), Spread { median: 100.0, p99: 198.0, max: 200.0 });
        assert_eq!(Spread::of(&[7.0]), Spread { median: 7.0, p99: 7.0, max: 7.0 });
        assert_eq!(Spread::of(&[]), Spread::default());
    }
}
