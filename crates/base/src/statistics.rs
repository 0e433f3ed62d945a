//! Summaries of many numbers.

/// The rank, counted from 1, of the number that a share of `count` numbers does not exceed, percent: the nearest-rank
/// method. 0 without numbers.
pub fn nearest_rank(count: usize, percent: usize) -> usize {
    (count * percent).div_ceil(100)
}
