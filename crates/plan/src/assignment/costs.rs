//! The costs of edges, and the assignment with the least sum of them: exact and sparse.
//!
//! Shortest augmenting paths with duals (Jonker & Volgenant 1987) over a few edges of each row, those that good duals
//! call cheapest; the duals then price all edges that were left out, through a k-d tree that prunes whole regions, and
//! those that would improve the sum are added until there are none.

use super::kdtree::{KdTree, Most, Weights};
use super::search::{Edges, Search};
use crate::cancel::Cancel;
use lightbots_base::Vec2;

/// Edges each row begins with.
const FIRST: usize = 12;
/// At most this many edges are added to a row in one round of pricing.
const ADDED: usize = 6;
/// Rounds of pricing; at ten thousand robots a dozen is the most seen. What is left after this many is not quite exact.
const ROUNDS: usize = 200;
/// Reduced costs above minus this are not improvements, square metres.
const EPSILON: f64 = 1e-11;

/// Rows and columns in the space of the costs, and first column duals.
#[derive(Clone, Debug)]
pub(super) struct Costs<'a> {
    cancel: Cancel<'a>,
    rows: Vec<Vec2>,
    tree: KdTree,
    duals: Vec<f64>,
}

impl<'a> Costs<'a> {
    /// The squared ways themselves, with column duals to begin with: all 0 where there are fewer rows than columns.
    pub fn plain(rows: &[Vec2], columns: &[Vec2], duals: Vec<f64>, cancel: Cancel<'a>) -> Self {
        Self { cancel, rows: rows.to_vec(), tree: KdTree::new(columns), duals }
    }

    /// Takes these column duals to begin with, where the sum of all duals is greater with them.
    pub fn with_better_duals(mut self, duals: Vec<f64>) -> Self {
        if self.dual_sum(&duals) > self.dual_sum(&self.duals) {
            self.duals = duals;
        }
        self
    }

    /// The sum of all duals when column duals are these: no assignment costs less.
    fn dual_sum(&self, duals: &[f64]) -> f64 {
        let mut sum = duals.iter().sum();
        let most = Most { count: 1, below: f64::INFINITY };
        self.cheapest(duals, most, |found| sum += found.first().map_or(0.0, |cheapest| cheapest.0));
        sum
    }

    /// Calls `each` with every row's cheapest edges less column duals, as [`KdTree::cheapest`] finds them.
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

    /// The cheapest edges of every row, and one that all can have together.
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

    /// The best assignment without any limit to ways.
    pub fn solve(&self) -> Search {
        let mut search = Search::new(self.first_edges(), self.duals.clone());
        self.improve(&mut search, |_, _| true);
        search
    }

    /// Completes an assignment, and prices edges among those `allowed(row, column)` until it is the best.
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

    /// Adds edges that would improve the sum, and returns their rows. Only rows whose dual rose above the known bound
    /// are looked at.
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

/// Below which reduced cost all edges are among those that [`KdTree::cheapest`] found.
fn complete_below(found: &[(f64, f64, u32)], most: Most) -> f64 {
    if found.len() < most.count { most.below } else { found[most.count - 1].0 }
}
