//! The assignment with the least sum of squared lines, none of them longer than a reach.
//!
//! The search begins with the best assignment without a limit, from which edges beyond the reach are removed.

use super::costs::Costs;
use super::partner::NONE;
use super::search::Search;
use lightbots_base::Vec2;

/// The search for the best assignment whose edges are within a reach.
pub(super) struct LeastSquares<'a> {
    /// True places of rows, metres: distances of true places decide which edges are within reach.
    rows: &'a [Vec2],
    /// True places of columns, metres.
    columns: &'a [Vec2],
    costs: &'a Costs<'a>,
    search: Search,
    /// Lower bound for each row on the cost minus column dual of any edge: its row dual in the best assignment without
    /// a limit. It holds because column duals only fall. With more columns than rows, column duals start again at 0,
    /// and the bound is minus infinity.
    unlimited_duals: Vec<f64>,
    reach_squared: f64,
}

impl<'a> LeastSquares<'a> {
    /// Limits `unlimited`, the best assignment, to edges within reach. `feasible[row]` is a matching with such edges
    /// only.
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

    /// Returns the best assignment within `reach_squared` as `column_of[row]`. `reach_squared` must not shrink from
    /// call to call. `None` if none was found, which only a cancellation can cause, because the feasible matching
    /// exists.
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
