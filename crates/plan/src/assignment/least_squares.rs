//! The least sum of squared ways among edges within reach: an exact sparse assignment.
//!
//! Shortest augmenting paths with duals (Jonker & Volgenant 1987) over a few edges of each row, those that good duals
//! call cheapest; the duals then price all edges that were left out, through a k-d tree that prunes whole regions, and
//! those that would improve the sum are added until there are none.

use super::NONE;
use super::kdtree::{KdTree, Most, Weights};
use super::scales;
use super::search::{Edges, Search};
use super::space;
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
    /// Squared ways between places on the floor, or costs for which the same assignments are best.
    pub fn new(rows: &[Vec2], columns: &[Vec2], cancel: Cancel<'a>) -> Self {
        let (rows, columns) = space::common(rows, columns);
        let none = vec![0.0; columns.len()];
        // A column left free must cost nothing: only where all are used may there be better duals than none.
        let is_square = rows.len() == columns.len();
        let from_afar = is_square.then(|| scales::duals(&rows, &columns, cancel));
        let mut costs = Self { cancel, tree: KdTree::new(&columns), rows, duals: none };
        if let Some(duals) = from_afar
            && costs.dual_sum(&duals) > costs.dual_sum(&costs.duals)
        {
            costs.duals = duals;
        }
        costs
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

    /// The squared ways themselves, with known duals; as many rows as columns.
    pub fn plain(rows: &[Vec2], columns: &[Vec2], duals: Vec<f64>, cancel: Cancel<'a>) -> Self {
        Self { cancel, rows: rows.to_vec(), tree: KdTree::new(columns), duals }
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

    fn cost(&self, row: usize, column: u32) -> f64 {
        (self.tree.place(column) - self.rows[row]).length_squared()
    }

    /// The best assignment without any limit to ways.
    pub fn solve(&self) -> Search {
        let mut search = Search::new(self.first_edges(), self.duals.clone());
        self.improve(&mut search, |_, _| true);
        search
    }

    /// Completes an assignment, and prices edges among those `allowed(row, column)` until it is the best.
    fn improve(&self, search: &mut Search, allowed: impl Fn(usize, u32) -> bool) {
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
