//! Initial column duals, found on ever coarser clusterings of the same places. Rows are matched with columns; a dual is
//! the price of a row or column in the linear program of the assignment.
//!
//! Near the optimum, duals change smoothly over the floor. If many robots must move in one direction, duals rise and
//! fall by far more than from neighbour to neighbour. Shortest augmenting paths would have to find this rise one path
//! at a time. Therefore places are clustered by the leaves of their k-d trees, which hold equally many rows and
//! columns. The duals of the smaller problem, solved in the same way, approximate those of single places (multiscale
//! transport: Mérigot 2011). The c-transform carries them over to single places.

use super::costs::Costs;
use super::kdtree::{KdTree, Most, Weights};
use super::space;
use crate::cancel::Cancel;
use lightbots_base::Vec2;

/// Problems with at most this many rows start with duals of 0. Larger ones start with duals of a coarser problem, if
/// they have as many rows as columns.
const SMALL: usize = 60;

/// Most places in a cluster, up to one more by uneven division. With more, the finer problem begins with duals that are
/// too rough, and its augmenting paths grow long.
const DRAWN_TOGETHER: usize = 3;

/// Returns costs with initial column duals. The assignments with the least sum are the same as for squared distances on
/// the floor.
pub(super) fn costs_with_duals<'a>(rows: &[Vec2], columns: &[Vec2], cancel: Cancel<'a>) -> Costs<'a> {
    let (rows, columns) = space::common(rows, columns);
    let costs = Costs::plain(&rows, &columns, vec![0.0; columns.len()], cancel);
    // An unmatched column must have a dual of 0, so other duals than 0 are allowed only if all columns are matched.
    if rows.len() != columns.len() {
        return costs;
    }
    costs.with_better_duals(duals(&rows, &columns, cancel))
}

/// Returns approximate duals for the columns of a problem with as many rows as columns.
fn duals(rows: &[Vec2], columns: &[Vec2], cancel: Cancel<'_>) -> Vec<f64> {
    if rows.len() <= SMALL {
        return vec![0.0; columns.len()];
    }
    let drawn_together = |places: &[Vec2]| KdTree::with_leaves(places, DRAWN_TOGETHER).leaf_centres();
    let (coarse_rows, coarse_columns) = (drawn_together(rows), drawn_together(columns));
    let costs =
        Costs::plain(&coarse_rows, &coarse_columns, duals(&coarse_rows, &coarse_columns, cancel), cancel);
    let solved = costs.solve();
    let tree = KdTree::new(&coarse_rows);
    let greatest = tree.greatest(solved.row_duals());
    let weights = Weights { of: solved.row_duals(), greatest: &greatest };
    let most = Most { count: 1, below: f64::INFINITY };
    let mut found = Vec::new();
    let mut dual = |&column: &Vec2| {
        tree.cheapest(column, most, weights, |_| true, &mut found);
        found.first().map_or(0.0, |cheapest| cheapest.0)
    };
    columns.iter().map(&mut dual).collect()
}
