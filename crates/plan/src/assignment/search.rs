//! Shortest augmenting paths over listed edges, with duals (Jonker & Volgenant 1987, sparse). Rows are matched with
//! columns; an edge is a pair of a row and a column.

use super::partner::NONE;
use crate::cancel::Cancel;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A partial assignment that is optimal for its matched rows. A row without a column is open. The reduced cost of an
/// edge is cost − row dual − column dual. But for rounding, it is zero for matched edges, and not below zero for any
/// listed edge. If there are more columns than rows, columns never used have a dual of zero. After edges were added or
/// removed, this holds again once rows are reopened.
#[derive(Clone, Debug)]
pub(super) struct Search {
    /// `edges[row]`: the listed edges of that row.
    edges: Vec<Edges>,
    row_duals: Vec<f64>,
    column_duals: Vec<f64>,
    column_of: Vec<u32>,
    row_of: Vec<u32>,
    scratch: Scratch,
}

/// The listed edges of a row, and a bound on all others.
#[derive(Clone, Debug)]
pub(super) struct Edges {
    /// Columns and costs of the edges, in no order.
    pub list: Vec<(u32, f64)>,
    /// Lower bound on cost − column dual of all allowed edges of the row that are not listed. The bound stays true
    /// while column duals fall.
    pub complete_below: f64,
}

/// The state of one search for a path. It is cleared through `touched`.
#[derive(Clone, Debug)]
struct Scratch {
    /// `distance[column]`: length of the shortest known path to that column, in reduced costs; infinite if there is
    /// none.
    distance: Vec<f64>,
    /// `from[column]`: the last row on the shortest known path to that column.
    from: Vec<u32>,
    /// Columns with a finite distance.
    touched: Vec<u32>,
    /// Columns whose shortest path is known, in ascending order of its length.
    settled: Vec<u32>,
    /// Columns to be settled next, because they are as far as the column settled last.
    level: Vec<u32>,
    /// The other columns to be settled, by path length, then by index. Lengths are the bits of a float; these order
    /// like the floats, because no length is negative.
    heap: BinaryHeap<Reverse<(u64, u32)>>,
}

impl Scratch {
    /// Returns the nearest column that is not settled yet; the caller must settle it. `None` if no column is nearer
    /// than `below`.
    fn next(&mut self, below: f64) -> Option<u32> {
        if let Some(column) = self.level.pop() {
            return Some(column);
        }
        loop {
            let Reverse((bits, column)) = self.heap.pop()?;
            let distance = f64::from_bits(bits);
            if distance >= below {
                return None;
            }
            if distance == self.distance[column as usize] {
                return Some(column);
            }
        }
    }
}

impl Search {
    pub fn new(edges: Vec<Edges>, column_duals: Vec<f64>) -> Self {
        let (rows, columns) = (edges.len(), column_duals.len());
        let scratch = Scratch {
            distance: vec![f64::INFINITY; columns],
            from: vec![NONE; columns],
            touched: Vec::new(),
            settled: Vec::new(),
            level: Vec::new(),
            heap: BinaryHeap::new(),
        };
        let mut search = Self {
            edges,
            row_duals: vec![0.0; rows],
            column_duals,
            column_of: vec![NONE; rows],
            row_of: vec![NONE; columns],
            scratch,
        };
        (0..rows).for_each(|row| search.lift(row));
        search
    }

    pub fn column_of(&self) -> &[u32] {
        &self.column_of
    }

    pub fn row_duals(&self) -> &[f64] {
        &self.row_duals
    }

    pub fn column_duals(&self) -> &[f64] {
        &self.column_duals
    }

    /// Adds those of `edges`, as (column, cost), that a row does not have yet. Returns whether an added edge is so
    /// cheap that the row must be reopened.
    pub fn add(&mut self, row: usize, edges: impl Iterator<Item = (u32, f64)>) -> bool {
        let (list, dual) = (&mut self.edges[row].list, self.row_duals[row]);
        let before = list.len();
        let mut undercuts = false;
        for (column, cost) in edges {
            if !list[..before].iter().any(|known| known.0 == column) {
                list.push((column, cost));
                undercuts |= cost - self.column_duals[column as usize] < dual;
            }
        }
        undercuts
    }

    /// Returns the row's [`Edges::complete_below`].
    pub fn complete_below(&self, row: usize) -> f64 {
        self.edges[row].complete_below
    }

    pub fn set_complete_below(&mut self, row: usize, cost: f64) {
        self.edges[row].complete_below = cost;
    }

    /// Allows further edges. Each row's bound for edges that are not listed becomes `complete_below[row]`.
    pub fn allow_more(&mut self, complete_below: &[f64]) {
        for (edges, &below) in self.edges.iter_mut().zip(complete_below) {
            edges.complete_below = below;
        }
    }

    /// Removes listed edges for which `keep(row, column)` does not hold. Returns the rows whose matched edge was
    /// removed; they must be reopened.
    pub fn retain(&mut self, keep: impl Fn(usize, u32) -> bool) -> Vec<u32> {
        let mut losers = Vec::new();
        for (row, edges) in self.edges.iter_mut().enumerate() {
            edges.list.retain(|edge| keep(row, edge.0));
            let column = self.column_of[row];
            if column != NONE && !keep(row, column) {
                losers.push(row as u32);
            }
        }
        losers
    }

    /// Unmatches rows after their edges changed. If there are more columns than rows, unmatches all rows and resets all
    /// column duals to 0. In this case it also forgets the bounds on edges that are not listed.
    pub fn reopen(&mut self, rows: &[u32]) {
        if self.edges.len() < self.column_duals.len() {
            // An unmatched column must have a dual of 0, which holds only for columns never used. Therefore the search
            // starts again.
            self.column_duals.fill(0.0);
            self.edges.iter_mut().for_each(|edges| edges.complete_below = f64::NEG_INFINITY);
            self.row_of.fill(NONE);
            self.column_of.fill(NONE);
            return (0..self.edges.len()).for_each(|row| self.lift(row));
        }
        for &row in rows {
            let column = core::mem::replace(&mut self.column_of[row as usize], NONE);
            if column != NONE {
                self.row_of[column as usize] = NONE;
            }
            self.lift(row as usize);
        }
    }

    /// Sets a row's dual to the greatest value at which no edge of the row has a reduced cost below zero. The dual of a
    /// row without edges becomes infinite.
    fn lift(&mut self, row: usize) {
        let duals = &self.column_duals;
        let least = self.edges[row].list.iter().map(|&(column, cost)| cost - duals[column as usize]);
        self.row_duals[row] = least.fold(f64::INFINITY, f64::min);
    }

    /// Matches every open row with a column, as far as the listed edges allow.
    pub fn complete(&mut self, cancel: Cancel<'_>) {
        for row in self.bid_for_all() {
            if cancel.is_wanted() {
                return;
            }
            self.augment(row);
        }
    }

    /// Matches most open rows with a column quickly, in two rounds of bids. Returns the rows that are still open.
    fn bid_for_all(&mut self) -> Vec<u32> {
        let is_open = |&row: &u32| self.column_of[row as usize] == NONE;
        let open: Vec<u32> = (0..self.edges.len() as u32).filter(is_open).collect();
        let open = self.bid(&open);
        self.bid(&open)
    }

    /// Every open row takes its cheapest column, and lowers that column's dual until the row's second cheapest column
    /// is as good. A row that loses its column bids next (augmenting row reduction). Returns the rows that are still
    /// open.
    fn bid(&mut self, open: &[u32]) -> Vec<u32> {
        let mut left = Vec::new();
        let mut bids_left = open.len() * 8;
        for &first in open {
            let mut row = first;
            loop {
                let Some(loser) = self.take_cheapest(row) else {
                    if self.column_of[row as usize] == NONE {
                        left.push(row);
                    }
                    break;
                };
                bids_left = bids_left.saturating_sub(1);
                if bids_left == 0 {
                    left.push(loser);
                    break;
                }
                row = loser;
            }
        }
        left
    }

    /// Makes one bid of an open row. Returns the row that lost its column, if any. Takes nothing if the row has no
    /// edges. Takes nothing either if the cheapest column is not free, and the second cheapest is equally cheap or
    /// missing.
    fn take_cheapest(&mut self, row: u32) -> Option<u32> {
        let (mut first, mut second, mut column) = (f64::INFINITY, f64::INFINITY, NONE);
        for &(candidate, cost) in &self.edges[row as usize].list {
            let reduced = cost - self.column_duals[candidate as usize];
            if reduced < first {
                (second, first, column) = (first, reduced, candidate);
            } else if reduced < second {
                second = reduced;
            }
        }
        if column == NONE {
            return None;
        }
        let owner = self.row_of[column as usize];
        let gain = second - first;
        if owner != NONE && !(gain > 0.0 && gain.is_finite()) {
            self.row_duals[row as usize] = first;
            return None;
        }
        // A column's dual may fall only if the column is used, which it is from here on.
        let gain = if gain.is_finite() { gain } else { 0.0 };
        self.row_duals[row as usize] = first + gain;
        self.column_duals[column as usize] -= gain;
        self.column_of[row as usize] = column;
        self.row_of[column as usize] = row;
        if owner == NONE {
            return None;
        }
        self.column_of[owner as usize] = NONE;
        Some(owner)
    }

    /// Finds the shortest augmenting path from the open row `root`, and matches `root` by exchanging matched and
    /// unmatched edges on that path. Without such a path, `root` stays open.
    fn augment(&mut self, root: u32) {
        let Some((last, length)) = self.shortest(root) else {
            self.clear();
            return;
        };
        self.row_duals[root as usize] += length;
        for &column in &self.scratch.settled {
            let change = length - self.scratch.distance[column as usize];
            self.column_duals[column as usize] -= change;
            self.row_duals[self.row_of[column as usize] as usize] += change;
        }
        let mut column = last;
        loop {
            let row = self.scratch.from[column as usize];
            let before = core::mem::replace(&mut self.column_of[row as usize], column);
            self.row_of[column as usize] = row;
            if row == root {
                break;
            }
            column = before;
        }
        self.clear();
    }

    /// Returns the free column that is nearest to the open row `root`, and its distance in reduced costs. Fills the
    /// scratch with the paths. `None` if no free column can be reached.
    fn shortest(&mut self, root: u32) -> Option<(u32, f64)> {
        let scratch = &mut self.scratch;
        let (mut row, mut length) = (root, 0.0);
        // The nearest free column found up to here. Columns farther away need not be remembered.
        let (mut nearest, mut last) = (f64::INFINITY, NONE);
        loop {
            let base = length - self.row_duals[row as usize];
            for &(column, cost) in &self.edges[row as usize].list {
                let place = column as usize;
                // Rounding may leave a reduced cost a hair below zero.
                let distance = (base + cost - self.column_duals[place]).max(length);
                // Settled columns are no farther than `length`.
                if distance >= nearest || distance >= scratch.distance[place] {
                    continue;
                }
                if scratch.distance[place] == f64::INFINITY {
                    scratch.touched.push(column);
                }
                scratch.distance[place] = distance;
                scratch.from[place] = row;
                let owner = self.row_of[place];
                if owner == NONE {
                    (nearest, last) = (distance, column);
                } else if distance == length {
                    scratch.level.push(column);
                } else {
                    scratch.heap.push(Reverse((distance.to_bits(), column)));
                }
            }
            let Some(column) = scratch.next(nearest) else {
                return (last != NONE).then_some((last, nearest));
            };
            length = scratch.distance[column as usize];
            scratch.settled.push(column);
            row = self.row_of[column as usize];
        }
    }

    fn clear(&mut self) {
        let scratch = &mut self.scratch;
        for column in scratch.touched.drain(..) {
            scratch.distance[column as usize] = f64::INFINITY;
        }
        scratch.settled.clear();
        scratch.level.clear();
        scratch.heap.clear();
    }
}
