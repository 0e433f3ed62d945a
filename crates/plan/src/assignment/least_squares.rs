//! The least sum of squared ways among edges within reach: an exact sparse assignment.
//!
//! Shortest augmenting paths with duals (Jonker & Volgenant 1987) over a few nearest-neighbour edges; the duals then
//! price all edges that were left out, through a k-d tree that prunes whole regions, and those that would improve the
//! sum are added until there are none.

use super::bottleneck::NONE;
use super::kdtree::KdTree;
use super::search::Search;
use super::space;
use lightbots_base::Vec2;

/// Nearest neighbours each row begins with.
const NEIGHBOURS: usize = 6;
/// At most this many edges are added to a row in one round of pricing.
const ADDED: usize = 6;
/// Rounds of pricing; random floors need 3 to 8, the worst seen 40. What is left after this many is not quite exact.
const ROUNDS: usize = 200;
/// Reduced costs above minus this are not improvements, square metres.
const EPSILON: f64 = 1e-11;

/// A matching that leaves some rows out (`NONE`) but is close to the least sum of squares, quickly.
pub(super) fn guess(rows: &[Vec2], columns: &[Vec2]) -> Vec<u32> {
    let (rows_in_space, columns_in_space) = space::common(rows, columns);
    let tree = KdTree::new(&columns_in_space);
    let nearest = |&row: &Vec2| {
        tree.nearest(row, NEIGHBOURS, |_| true).into_iter().map(|(cost, column)| (column, cost))
    };
    let edges = rows_in_space.iter().map(|row| nearest(row).collect()).collect();
    let mut search = Search::new(edges, columns.len());
    search.bid_for_all();
    search.column_of().to_vec()
}

/// An assignment being improved.
pub(super) struct LeastSquares<'a> {
    /// True places, metres: they decide what is within reach.
    rows: &'a [Vec2],
    columns: &'a [Vec2],
    /// Places in the space of [`space::common`], where edges have their costs; the tree holds the columns.
    rows_in_space: Vec<Vec2>,
    tree: KdTree,
    reach_squared: f64,
    search: Search,
}

impl<'a> LeastSquares<'a> {
    /// Prepares the problem; `feasible[row]` is a matching within reach.
    pub fn new(rows: &'a [Vec2], columns: &'a [Vec2], feasible: &[u32], reach_squared: f64) -> Self {
        let (rows_in_space, columns_in_space) = space::common(rows, columns);
        let tree = KdTree::new(&columns_in_space);
        let mut edges = Vec::with_capacity(rows.len());
        for (row, &partner) in feasible.iter().enumerate() {
            let within =
                |column: u32| (columns[column as usize] - rows[row]).length_squared() <= reach_squared;
            let mut list: Vec<(u32, f64)> = tree
                .nearest(rows_in_space[row], NEIGHBOURS, within)
                .into_iter()
                .map(|(cost, column)| (column, cost))
                .collect();
            if !list.iter().any(|edge| edge.0 == partner) {
                list.push((
                    partner,
                    (columns_in_space[partner as usize] - rows_in_space[row]).length_squared(),
                ));
            }
            edges.push(list);
        }
        let search = Search::new(edges, columns.len());
        Self { rows, columns, rows_in_space, tree, reach_squared, search }
    }

    /// The best assignment within `reach_squared`, which must not be less than before: `column_of[row]`. `None` where
    /// there is none, which a feasible matching rules out.
    pub fn solve(&mut self, reach_squared: f64) -> Option<&[u32]> {
        self.reach_squared = reach_squared;
        self.search.complete();
        let square = self.rows.len() == self.columns.len();
        for _ in 0..ROUNDS {
            let improved = self.price();
            if improved.is_empty() {
                break;
            }
            if square {
                improved.iter().for_each(|&row| self.search.release(row));
            } else {
                // A column left free must cost nothing, which holds only for those never used: start again.
                self.search.restart();
            }
            self.search.complete();
        }
        let column_of = self.search.column_of();
        (!column_of.contains(&NONE)).then_some(column_of)
    }

    /// Adds edges that would improve the sum; the rows that got some.
    fn price(&mut self) -> Vec<u32> {
        let mut improved = Vec::new();
        let mut found: Vec<(f64, u32, f64)> = Vec::new();
        let greatest = self.tree.greatest(self.search.column_duals());
        for row in 0..self.rows.len() {
            found.clear();
            let (at, true_at) = (self.rows_in_space[row], self.rows[row]);
            let limit = self.search.row_dual(row) - EPSILON;
            let duals = self.search.column_duals();
            self.tree.cheaper(at, limit, duals, &greatest, |column, cost| {
                let way = self.columns[column as usize] - true_at;
                if way.length_squared() <= self.reach_squared {
                    found.push((cost - duals[column as usize], column, cost));
                }
            });
            if found.is_empty() {
                continue;
            }
            found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let added = found.iter().take(ADDED).map(|&(_, column, cost)| (column, cost));
            if self.search.add(row, added) {
                improved.push(row as u32);
            }
        }
        improved
    }
}
