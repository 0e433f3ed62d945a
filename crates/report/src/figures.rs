//! Summary of many numbers by three.

use std::collections::BTreeMap;

use lightbots_base::statistics::nearest_rank;
use schemars::JsonSchema;
use serde::Serialize;

/// Median, 99th percentile (nearest rank) and maximum of numbers; all 0 without numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ThreeFigures {
    /// Half of the numbers are at most this.
    pub median: f64,
    /// 99 of 100 numbers are at most this.
    pub p99: f64,
    /// The largest number.
    pub max: f64,
    /// How many numbers are summarised.
    pub count: usize,
}

impl ThreeFigures {
    /// Summarises numbers, which may be in any order. The figures are rounded to `decimals` decimal places.
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

/// Number of decimal places to which [`CountedNumbers`] rounds.
const COUNTED_DECIMALS: i32 = 5;
/// Largest number in [`CountedNumbers`]. A larger number counts as this, so that implausible numbers need little memory.
const COUNTED_MAX: f64 = 10.0;

/// For each rounded value, how many numbers have it. Millions of numbers thus need little memory, and their median,
/// percentile and maximum are those of a list of rounded numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct CountedNumbers(BTreeMap<u32, usize>);

impl CountedNumbers {
    /// Adds a number. A number below 0 and NaN count as 0, a number above [`COUNTED_MAX`] as that.
    pub fn add(&mut self, number: f64) {
        let value = (number.clamp(0.0, COUNTED_MAX) * 10f64.powi(COUNTED_DECIMALS)).round() as u32;
        *self.0.entry(value).or_default() += 1;
    }

    /// Median, 99th percentile, maximum and count of the numbers.
    pub fn figures(&self) -> ThreeFigures {
        let count = self.0.values().sum();
        let at = |percent: usize| {
            let mut left = nearest_rank(count, percent);
            let found = self.0.iter().find(|(_, counted)| {
                let is_here = left <= **counted;
                left = left.saturating_sub(**counted);
                is_here
            });
            round(
                found.map_or(0.0, |(value, _)| f64::from(*value)) / 10f64.powi(COUNTED_DECIMALS),
                COUNTED_DECIMALS,
            )
        };
        ThreeFigures { median: at(50), p99: at(99), max: at(100), count }
    }
}

/// Rounds a number to `decimals` decimal places. The result is never -0.
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
        let mut counted = CountedNumbers::default();
        assert_eq!(counted.figures(), ThreeFigures::default());
        let small: Vec<f64> = numbers.iter().map(|number| number * number * 3.7e-6).collect();
        small.iter().for_each(|&number| counted.add(number));
        assert_eq!(counted.figures(), ThreeFigures::of(&small, 5));
        counted.add(f64::INFINITY);
        assert_eq!((counted.figures().max, counted.figures().count), (10.0, 201));
        assert_eq!(round(-0.0004, 3).to_bits(), 0);
    }
}
