//! Column duals to begin with, from coarser and coarser pictures of the same places.
//!
//! Near the best, duals change smoothly over the floor: where a whole crowd has to move, they rise and fall by far more
//! than a neighbour's distance, and shortest augmenting paths would have to find that one path at a time. So places
//! are drawn together into the leaves of their k-d trees, which hold equally many on both sides; the duals of that
//! smaller problem, solved in the same way, tell how dear every place is but for what its neighbours make of it
//! (multiscale transport: Mérigot 2011; the duals spread to single places by the c-transform).

use super::costs::Costs;
use super::kdtree::{KdTree, Most, Weights};
use super::space;
use crate::cancel::Cancel;
use lightbots_base::Vec2;

/// Problems this small need no help.
const SMALL: usize = 60;

/// At most this many places become one. With more, the finer problem begins with duals that are too rough, and its
/// augmenting paths grow long.
const DRAWN_TOGETHER: usize = 3;

/// Squared ways between places on the floor, or costs for which the same assignments are best, with first column duals.
pub(super) fn costs_with_duals<'a>(rows: &[Vec2], columns: &[Vec2], cancel: Cancel<'a>) -> Costs<'a> {
    let (rows, columns) = space::common(rows, columns);
    let costs = Costs::plain(&rows, &columns, vec![0.0; columns.len()], cancel);
    // A column left free must cost nothing: only where all are used may there be better duals than none.
    if rows.len() != columns.len() {
        return costs;
    }
    costs.with_better_duals(duals(&rows, &columns, cancel))
}

/// Duals for the columns of a problem with as many rows as columns.
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
