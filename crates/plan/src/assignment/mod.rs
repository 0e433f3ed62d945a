//! Assignment of goals to starts by the straight lines between them. It minimises the longest line first, then the sum
//! of squared lengths among assignments with no longer line.
//!
//! Both steps are sparse, and exact but for rounding and the bound on rounds in `costs`. With ten thousand robots there
//! are a hundred million edges (pairs of a goal and a start). Of these edges, a few for each robot are examined. The
//! same places give the same assignment, bit for bit.

mod bottleneck;
mod costs;
mod kdtree;
mod least_squares;
mod partner;
mod scales;
mod search;
mod space;
#[cfg(test)]
mod tests;
mod within;

use crate::cancel::Cancel;
use bottleneck::bottleneck;
use costs::Costs;
use least_squares::LeastSquares;
use lightbots_base::Vec2;
use partner::NONE;
use scales::costs_with_duals;
use search::Search;

/// Squared lengths up to this factor × the reach squared count as within reach, because places on a grid differ by
/// rounding.
const ROUNDING: f64 = 1.0 + 1e-11;

/// Goals, the starts that may be assigned to them, and the greatest length of a line (the reach).
#[derive(Clone, Debug)]
pub struct Choice<'a> {
    /// Number of all starts.
    starts: usize,
    /// Number of all goals.
    goals: usize,
    /// Pinned pairs: `(goal, start)`.
    pinned: Vec<(usize, usize)>,
    /// Indices of the goals that are not pinned.
    open_goals: Vec<usize>,
    /// Indices of the starts that no goal is pinned to.
    open_starts: Vec<usize>,
    goal_places: Vec<Vec2>,
    start_places: Vec<Vec2>,
    /// Costs of edges between open goals (rows) and open starts (columns).
    costs: Costs<'a>,
    /// The assignment of open goals with the least sum of costs, without a bound on its longest line.
    shortest: Search,
    /// `[open goal]`: index of its open start, in an assignment without a line beyond the reach.
    feasible: Vec<u32>,
    /// Square of the reach, square metres: of the bottleneck distance, or of the longest line of a known assignment.
    reach_squared: f64,
}

impl<'a> Choice<'a> {
    /// Finds the bottleneck distance: the longest line of the assignment whose longest line is shortest. `pinned[goal]`
    /// is the start that must go there; goals beyond the end of the list are not pinned. `None` if there are fewer
    /// starts than goals, a place is not finite, or a pin names a missing or taken start.
    pub fn new(starts: &[Vec2], goals: &[Vec2], pinned: &[Option<usize>]) -> Option<Self> {
        Choice::unless(Cancel::NEVER, starts, goals, pinned)
    }

    /// [`Choice::new`] with a cancellation; `None` also if it is cancelled.
    pub(crate) fn unless(
        cancel: Cancel<'a>,
        starts: &[Vec2],
        goals: &[Vec2],
        pinned: &[Option<usize>],
    ) -> Option<Self> {
        let mut choice = Self::open(cancel, starts, goals, pinned)?;
        let (rows, columns) = (&choice.goal_places, &choice.start_places);
        let found = bottleneck(rows, columns, choice.shortest.column_of(), cancel);
        choice.reach_squared = choice.reach_squared.max(found.reach_squared);
        choice.feasible = found.column_of;
        Some(choice)
    }

    /// As [`Choice::new`], but the reach is the longest line of a known assignment `start_of[goal]`, instead of the
    /// bottleneck distance. The known assignment must keep the pins. `None` also if cancelled.
    pub(crate) fn containing(
        cancel: Cancel<'a>,
        starts: &[Vec2],
        goals: &[Vec2],
        pinned: &[Option<usize>],
        start_of: &[usize],
    ) -> Option<Self> {
        let mut choice = Self::open(cancel, starts, goals, pinned)?;
        let mut column_of_start = vec![NONE; starts.len()];
        for (column, &start) in choice.open_starts.iter().enumerate() {
            column_of_start[start] = column as u32;
        }
        choice.feasible = choice.open_goals.iter().map(|&goal| column_of_start[start_of[goal]]).collect();
        for (goal, &start) in start_of.iter().enumerate() {
            choice.reach_squared = choice.reach_squared.max((starts[start] - goals[goal]).length_squared());
        }
        Some(choice)
    }

    fn open(cancel: Cancel<'a>, starts: &[Vec2], goals: &[Vec2], pinned: &[Option<usize>]) -> Option<Self> {
        if goals.len() > starts.len() || !starts.iter().chain(goals).all(|place| place.is_finite()) {
            return None;
        }
        let mut taken = vec![false; starts.len()];
        let (mut pairs, mut reach_squared) = (Vec::new(), 0.0f64);
        for (goal, start) in pinned.iter().take(goals.len()).enumerate() {
            let Some(start) = *start else { continue };
            if core::mem::replace(taken.get_mut(start)?, true) {
                return None;
            }
            pairs.push((goal, start));
            reach_squared = reach_squared.max((starts[start] - goals[goal]).length_squared());
        }
        let is_open = |&goal: &usize| pinned.get(goal).copied().flatten().is_none();
        let open_goals: Vec<usize> = (0..goals.len()).filter(is_open).collect();
        let open_starts: Vec<usize> = (0..starts.len()).filter(|&start| !taken[start]).collect();
        let goal_places: Vec<Vec2> = open_goals.iter().map(|&goal| goals[goal]).collect();
        let start_places: Vec<Vec2> = open_starts.iter().map(|&start| starts[start]).collect();
        let costs = costs_with_duals(&goal_places, &start_places, cancel);
        let shortest = costs.solve();
        // A cancelled search has rows without a column.
        if cancel.is_wanted() {
            return None;
        }
        Some(Self {
            starts: starts.len(),
            goals: goals.len(),
            shortest,
            costs,
            goal_places,
            start_places,
            pinned: pairs,
            open_goals,
            open_starts,
            feasible: Vec::new(),
            reach_squared,
        })
    }

    /// The bottleneck distance, metres: every assignment that keeps the pins has a line at least this long. This holds
    /// only for choices made by [`Choice::new`].
    pub fn bottleneck_m(&self) -> f64 {
        self.reach_squared.sqrt()
    }

    /// Whether there is nothing to choose, because every goal is pinned.
    pub fn is_settled(&self) -> bool {
        self.open_goals.is_empty()
    }

    /// Number of starts that get no goal.
    pub fn spares(&self) -> usize {
        self.starts - self.goals
    }

    /// Returns a solver for the assignment with the least sum of squared lengths.
    pub fn least_squares(&self) -> Minimiser<'_> {
        Minimiser::new(self)
    }
}

/// Finds the assignment with the least sum of squared line lengths and no line longer than a limit. Later calls may raise
/// the limit, never lower it.
pub struct Minimiser<'a> {
    choice: &'a Choice<'a>,
    solver: LeastSquares<'a>,
}

impl<'a> Minimiser<'a> {
    fn new(choice: &'a Choice<'a>) -> Self {
        let reach_squared = choice.reach_squared * ROUNDING;
        let places = (&choice.goal_places[..], &choice.start_places[..]);
        let costs = (&choice.costs, &choice.shortest);
        let solver = LeastSquares::new(places, costs, &choice.feasible, reach_squared);
        Self { choice, solver }
    }

    /// Returns `start_of[goal]` with the least sum of squared lengths among assignments without a line longer than
    /// `(1 + slack)` × the reach of the choice. `slack` must not shrink from call to call. `None` if the search was
    /// cancelled.
    pub fn solve(&mut self, slack: f64) -> Option<Vec<usize>> {
        let choice = self.choice;
        let column_of = self.solver.solve(choice.reach_squared * (1.0 + slack) * (1.0 + slack) * ROUNDING)?;
        let mut start_of = vec![0; choice.goals];
        for (&goal, &column) in choice.open_goals.iter().zip(column_of) {
            start_of[goal] = choice.open_starts[column as usize];
        }
        for &(goal, start) in &choice.pinned {
            start_of[goal] = start;
        }
        Some(start_of)
    }
}
