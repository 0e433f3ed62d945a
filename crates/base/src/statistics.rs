//! Summaries of many numbers.

/// The rank, counted from 1, of the nearest-rank percentile: in `count` sorted numbers, at least `percent` % do not
/// exceed the number with this rank. 0 if `count` or `percent` is 0.
pub fn nearest_rank(count: usize, percent: usize) -> usize {
    (count * percent).div_ceil(100)
}
