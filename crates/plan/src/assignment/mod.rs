//! Who goes where: the least possible longest way first, then the least sum of squared ways among those no longer.

mod dense;

use lightbots_base::Vec2;

/// Who shows which goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// `start_of[goal]`: the start that goes there; each start at most once.
    pub start_of: Vec<usize>,
    /// The longest way of the assignment with the least longest way, metres.
    pub bottleneck_m: f64,
}

/// Assigns a start to every goal: `pinned[goal]` where it says so (shorter than `goals`: no pins for the rest), and
/// no way longer than `(1 + slack)` times the bottleneck. `None` where there are fewer starts than goals, or a pin
/// names a start that does not exist or is taken.
pub fn assign(starts: &[Vec2], goals: &[Vec2], pinned: &[Option<usize>], slack: f64) -> Option<Assignment> {
    dense::assign(starts, goals, pinned, slack)
}
