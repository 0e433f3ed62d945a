//! The assignment with the least sum of squared line lengths, in which no line is longer than a given length, the
//! reach.
//!
//! The search begins with the best assignment without that limit, from which edges beyond the reach are removed.

use super::costs::Costs;
use super::partner::NONE;
use super::search::Search;
use lightbots_base::Vec2;

/// The search for the assignment with the least sum of squared lengths and no edge longer than a reach.
pub(super) struct LeastSquares<'a> {
    /// Places of rows on the floor, stage metres. Their distances decide which edges are within reach; costs use scaled
    /// places.
    rows: &'a [Vec2],
    /// Places of columns on the floor, stage metres.
    columns: &'a [Vec2],
    costs: &'a Costs<'a>,
    search: Search,
    /// `[row]`: lower bound on cost − column dual of any edge of the row. It is the row's dual in the best assignment
    /// without a limit, because column duals only fall. If there are more columns than rows, column duals start again
    /// at 0, and the bound is minus infinity.
    unlimited_duals: Vec<f64>,
    reach_squared: f64,
}

impl<'a> LeastSquares<'a> {
    /// Prepares to limit the best assignment, `unlimited`, to edges within reach. `feasible[row]` is the column in a
    /// matching with edges within reach only. `reach_squared` is in square metres.
    pub fn new(
        (rows, columns): (&'a [Vec2], &'a [Vec2]),
        (costs, unlimited): (&'a Costs<'a>, &Search),
        feasible: &[u32],
        reach_squared: f64,
    ) -> Self {
        let mut search = unlimited.clone();
        let within = |row: usize, column: u32| {
            (columns[column as usize] - rows[row]).length_squared() <= reach_squared
        };
        let mut changed = search.retain(within);
        if !changed.is_empty() {
            for (row, &partner) in feasible.iter().enumerate() {
                if search.add(row, core::iter::once((partner, costs.cost(row, partner)))) {
                    changed.push(row as u32);
                }
            }
            search.reopen(&changed);
        }
        let unlimited_duals = if rows.len() == columns.len() {
            unlimited.row_duals().to_vec()
        } else {
            vec![f64::NEG_INFINITY; rows.len()]
        };
        Self { rows, columns, costs, search, unlimited_duals, reach_squared }
    }

    /// Returns the best assignment without an edge beyond `reach_squared`, as `column_of[row]`. `reach_squared` must
    /// not shrink from call to call. Returns `None` only if cancelled, because a feasible matching exists.
    pub fn solve(&mut self, reach_squared: f64) -> Option<&[u32]> {
        let within = |row: usize, column: u32| {
            (self.columns[column as usize] - self.rows[row]).length_squared() <= reach_squared
        };
        if reach_squared > self.reach_squared {
            self.reach_squared = reach_squared;
            self.search.allow_more(&self.unlimited_duals);
        }
        self.costs.improve(&mut self.search, within);
        let column_of = self.search.column_of();
        (!column_of.contains(&NONE)).then_some(column_of)
    }
}
