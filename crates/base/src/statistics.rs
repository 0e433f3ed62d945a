//! Summaries of many numbers.

/// The nearest-rank percentile: the rank, counted from 1, of the number that `percent` % of `count` sorted numbers do
/// not exceed. 0 if `count` or `percent` is 0.
pub fn nearest_rank(count: usize, percent: usize) -> usize {
    (count * percent).div_ceil(100)
}
