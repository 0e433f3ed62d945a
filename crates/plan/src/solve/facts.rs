//! Facts that decide which groups and rows of the schedule run.

/// Factor on the least duration: an acceptable solution takes less than this many times the least plus
/// [`ACCEPTABLE_MORE_S`].
const ACCEPTABLE: f64 = 4.0;
/// Time that an acceptable solution may take in addition, seconds.
const ACCEPTABLE_MORE_S: f64 = 4.0;
/// Factor on the least duration: a slow solution takes more than this many times the least plus [`SLOW_MORE_S`]. An
/// order from a lattice may then be faster.
const SLOW: f64 = 1.8;
/// Time that a solution that is not slow may take in addition, seconds.
const SLOW_MORE_S: f64 = 1.5;

/// Facts on which the schedule's conditions depend.
pub(super) struct Facts {
    pub is_large: bool,
    pub promises_little: bool,
    pub has_walls: bool,
    pub is_hopeless: bool,
    pub is_solved: bool,
    /// Whether the best solution has less than the usual clearance between walls.
    pub is_close: bool,
    /// Duration of the best solution with its penalty, seconds; infinite where there is none.
    pub lasts_s: f64,
    /// Duration of the longest path at full speed, seconds.
    pub least_s: f64,
    /// Work that is left.
    pub work: usize,
    /// Rows of the group that have run.
    pub tries: usize,
    /// Whether a row of the group made the best solution faster.
    pub is_faster: bool,
    /// Whether a row of the group before its last one made the best solution faster.
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
