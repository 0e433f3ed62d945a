//! Summaries of many numbers.

/// The rank, counted from 1, of the nearest-rank percentile. Of `count` numbers in ascending order, at least `percent`
/// % do not exceed the number with this rank. `percent` is 0 to 100. Returns 0 if `count` or `percent` is 0.
pub fn nearest_rank(count: usize, percent: usize) -> usize {
    (count * percent).div_ceil(100)
}
