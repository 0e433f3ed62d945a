//! The values that decide which groups and rows of the schedule run.

/// A solution is acceptable if its `lasts_s` is less than `ACCEPTABLE` × the least duration + [`ACCEPTABLE_MORE_S`].
const ACCEPTABLE: f64 = 4.0;
/// Seconds added to the bound of [`ACCEPTABLE`], so that short drives are not rejected.
const ACCEPTABLE_MORE_S: f64 = 4.0;
/// A solution is slow if its `lasts_s` is more than `SLOW` × the least duration + [`SLOW_MORE_S`]; a missing solution
/// counts as slow. A solution over a lattice may then be faster.
const SLOW: f64 = 1.8;
/// Seconds added to the bound of [`SLOW`], so that short drives do not count as slow.
const SLOW_MORE_S: f64 = 1.5;

/// The values on which the schedule's conditions and targets depend.
pub(super) struct Facts {
    /// Whether there are too many robots to compare solutions.
    pub is_large: bool,
    /// Whether there are many robots and the best guess needs much additional time.
    pub promises_little: bool,
    /// Whether there are walls, and few enough of them for a visibility graph.
    pub has_walls: bool,
    /// Whether there is no solution, and even the best row left more pairs of robots in contact than additional time is
    /// expected to resolve.
    pub is_hopeless: bool,
    pub is_solved: bool,
    /// Whether the best solution was found between walls with less than the usual clearance of robots.
    pub is_close: bool,
    /// Duration of the best solution, seconds, multiplied by a penalty if it `is_close`; infinite if there is no
    /// solution.
    pub lasts_s: f64,
    /// Duration of the longest of the robots' shortest paths at full speed, seconds; 0 if a robot has no path.
    pub least_s: f64,
    /// Work that is left, in units of [`super::schedule::Budget`].
    pub work: usize,
    /// Number of rows of the current group that have run.
    pub tries: usize,
    /// Whether a row of the current group found a solution faster than all that were known before the group.
    pub is_faster: bool,
    /// The value of `is_faster` before the most recent row of the group ran.
    pub was_faster: bool,
}

impl Facts {
    pub fn is_acceptable(&self) -> bool {
        self.lasts_s < self.least_s * ACCEPTABLE + ACCEPTABLE_MORE_S
    }

    pub fn is_slow(&self) -> bool {
        self.lasts_s > self.least_s * SLOW + SLOW_MORE_S
    }
}
