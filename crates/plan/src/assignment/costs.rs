//! The costs of edges, and the exact assignment with the least sum of costs, found on few edges.
//!
//! Shortest augmenting paths with duals (Jonker & Volgenant 1987) run over a few edges of each row: those that are
//! cheapest by good initial duals. The resulting duals then price all edges that were left out. A k-d tree skips whole
//! regions without cheap edges. Edges that would lower the sum are added until there are none.

use super::kdtree::{KdTree, Most, Weights};
use super::search::{Edges, Search};
use crate::cancel::Cancel;
use lightbots_base::Vec2;

/// Number of cheapest edges that each row has at the start. One more edge for each row makes sure that a matching of
/// all rows exists.
const FIRST: usize = 12;
/// Most edges that are added to a row in one round of pricing.
const ADDED: usize = 6;
/// Most rounds of pricing. Ten thousand robots need a dozen at most. If this many rounds do not suffice, the assignment
/// may be slightly worse than the best.
const ROUNDS: usize = 200;
/// Tolerance of reduced costs, square metres: an edge improves the sum only if its reduced cost is below minus this.
const EPSILON: f64 = 1e-11;

/// Rows and columns in a space in which squared distances are the costs, and the initial column duals.
#[derive(Clone, Debug)]
pub(super) struct Costs<'a> {
    cancel: Cancel<'a>,
    rows: Vec<Vec2>,
    tree: KdTree,
    duals: Vec<f64>,
}

impl<'a> Costs<'a> {
    /// Costs that are the squared distances of `rows` and `columns`, with `duals` as initial column duals. With fewer
    /// rows than columns, all duals must be 0.
    pub fn plain(rows: &[Vec2], columns: &[Vec2], duals: Vec<f64>, cancel: Cancel<'a>) -> Self {
        Self { cancel, rows: rows.to_vec(), tree: KdTree::new(columns), duals }
    }

    /// Replaces the initial column duals with `duals` if these give a greater sum of all duals, which is a closer lower
    /// bound of the costs.
    pub fn with_better_duals(mut self, duals: Vec<f64>) -> Self {
        if self.dual_sum(&duals) > self.dual_sum(&self.duals) {
            self.duals = duals;
        }
        self
    }

    /// Returns the sum of all duals, with the greatest legal row duals for these column duals: no assignment costs
    /// less.
    fn dual_sum(&self, duals: &[f64]) -> f64 {
        let mut sum = duals.iter().sum();
        let most = Most { count: 1, below: f64::INFINITY };
        self.cheapest(duals, most, |found| sum += found.first().map_or(0.0, |cheapest| cheapest.0));
        sum
    }

    /// Calls `each` once for every row, with its edges of least cost − column dual, as [`KdTree::cheapest`] finds them.
    /// After a cancellation, the list is empty.
    fn cheapest(&self, duals: &[f64], most: Most, mut each: impl FnMut(&[(f64, f64, u32)])) {
        let greatest = self.tree.greatest(duals);
        let weights = Weights { of: duals, greatest: &greatest };
        let mut found = Vec::new();
        for &at in &self.rows {
            if self.cancel.is_wanted() {
                found.clear();
                each(&found);
                continue;
            }
            self.tree.cheapest(at, most, weights, |_| true, &mut found);
            each(&found);
        }
    }

    /// Returns the cheapest edges of every row by the initial duals, and one more edge for each row. These additional
    /// edges together form a matching of all rows.
    fn first_edges(&self) -> Vec<Edges> {
        let mut edges: Vec<Edges> = Vec::with_capacity(self.rows.len());
        let most = Most { count: FIRST, below: f64::INFINITY };
        self.cheapest(&self.duals, most, |found| {
            let list = found.iter().map(|&(_, cost, column)| (column, cost)).collect();
            edges.push(Edges { list, complete_below: complete_below(found, most) });
        });
        let row_tree = KdTree::new(&self.rows);
        for (row, column) in row_tree.in_step_with(&self.tree) {
            let list = &mut edges[row as usize].list;
            if list.iter().all(|edge| edge.0 != column) {
                list.push((column, self.cost(row as usize, column)));
            }
        }
        edges
    }

    /// The cost of an edge: its squared length in the space of the costs, square metres.
    pub fn cost(&self, row: usize, column: u32) -> f64 {
        (self.tree.place(column) - self.rows[row]).length_squared()
    }

    /// Finds the assignment with the least sum of costs, without a limit on the length of edges.
    pub fn solve(&self) -> Search {
        let mut search = Search::new(self.first_edges(), self.duals.clone());
        self.improve(&mut search, |_, _| true);
        search
    }

    /// Completes an assignment. Then adds edges for which `allowed(row, column)` holds, until no edge would lower the
    /// sum of costs or [`ROUNDS`] are over.
    pub fn improve(&self, search: &mut Search, allowed: impl Fn(usize, u32) -> bool) {
        search.complete(self.cancel);
        for _ in 0..ROUNDS {
            if self.cancel.is_wanted() {
                break;
            }
            let improved = self.price(search, &allowed);
            if improved.is_empty() {
                break;
            }
            search.reopen(&improved);
            search.complete(self.cancel);
        }
    }

    /// Adds allowed edges that would lower the sum of costs, and returns their rows. A row is searched only if its dual
    /// exceeds the bound below which all its edges are listed.
    fn price(&self, search: &mut Search, allowed: &impl Fn(usize, u32) -> bool) -> Vec<u32> {
        let mut improved = Vec::new();
        let mut found = Vec::new();
        let greatest = self.tree.greatest(search.column_duals());
        for (row, &at) in self.rows.iter().enumerate() {
            let most = Most { count: ADDED, below: search.row_duals()[row] - EPSILON };
            if most.below <= search.complete_below(row) || self.cancel.is_wanted() {
                continue;
            }
            let weights = Weights { of: search.column_duals(), greatest: &greatest };
            self.tree.cheapest(at, most, weights, |column| allowed(row, column), &mut found);
            let added = found.iter().map(|&(_, cost, column)| (column, cost));
            if !found.is_empty() && search.add(row, added) {
                improved.push(row as u32);
            }
            search.set_complete_below(row, complete_below(&found, most));
        }
        improved
    }
}

/// Returns the value of cost − column dual below which [`KdTree::cheapest`] found all edges.
fn complete_below(found: &[(f64, f64, u32)], most: Most) -> f64 {
    if found.len() < most.count { most.below } else { found[most.count - 1].0 }
}
