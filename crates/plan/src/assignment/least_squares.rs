//! The least sum of squared ways among edges within reach.
//!
//! It begins with the best assignment without a limit, from which edges beyond the reach are taken.

use super::costs::Costs;
use super::partner::NONE;
use super::search::Search;
use lightbots_base::Vec2;

/// An assignment with limited ways.
pub(super) struct LeastSquares<'a> {
    /// True places, metres: they decide what is within reach.
    rows: &'a [Vec2],
    columns: &'a [Vec2],
    costs: &'a Costs<'a>,
    search: Search,
    /// Row duals of the best assignment without limit: no edge of a row, however long, costs less after column duals,
    /// which only fall; where columns are left over, they begin anew, and nothing is known.
    unlimited_duals: Vec<f64>,
    reach_squared: f64,
}

impl<'a> LeastSquares<'a> {
    /// Limits `unlimited`, the best assignment, to ways within reach; `feasible[row]` is a matching of such ways.
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

    /// The best assignment within `reach_squared`, which must not be less than before: `column_of[row]`. `None` where
    /// there is none, which a feasible matching rules out.
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
