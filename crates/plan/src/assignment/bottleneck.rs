//! The least longest way: an exact bottleneck matching of places in the plane.
//!
//! Whether a perfect matching exists within a reach is decided by augmenting paths (breadth-first searches from all
//! open rows at once, Azad, Buluç & Pothen 2017) over edges that are never listed: a k-d tree hands out places within
//! reach that the search has not seen yet (Efrat, Itai & Katz 2001). The reach is bisected between bounds that a
//! failed search
//! and a found matching sharpen to distances that really occur.

use super::kdtree::{KdTree, Remaining};
use super::partner::NONE;
use super::within::Within;
use crate::cancel::Cancel;
use lightbots_base::Vec2;

/// Squared distances this close are one: they differ by rounding only.
const SAME: f64 = 1.0 - 1e-12;

/// Rows between two polls of the cancellation.
const POLLED: usize = 256;

/// A matching of all rows with the least longest edge.
pub(super) struct Bottleneck {
    /// That edge's length squared, square metres.
    pub reach_squared: f64,
    /// `column_of[row]`.
    pub column_of: Vec<u32>,
}

/// Matches every row to its own column. `known[row]` is some matching of all rows, the better the faster.
pub(super) fn bottleneck(rows: &[Vec2], columns: &[Vec2], known: &[u32], cancel: Cancel<'_>) -> Bottleneck {
    let mut low = least_thinkable(rows, columns);
    let mut best =
        Bottleneck { reach_squared: longest_squared(rows, columns, known), column_of: known.to_vec() };
    if low >= best.reach_squared * SAME {
        return best;
    }
    let mut matcher = Matcher::new(rows, columns, best.reach_squared, cancel);
    // The matching of the last search that failed: it is within any reach that is tried after it.
    let mut partial = vec![NONE; rows.len()];
    while low < best.reach_squared * SAME && !cancel.is_wanted() {
        let middle = (low.sqrt() + best.reach_squared.sqrt()) / 2.0;
        let trial = (middle * middle).clamp(low, best.reach_squared);
        matcher.begin(&best.column_of, &partial, trial);
        match matcher.complete(&best.column_of, trial) {
            _ if cancel.is_wanted() => break,
            Ok(()) => {
                best.reach_squared = longest_squared(rows, columns, &matcher.column_of);
                best.column_of.copy_from_slice(&matcher.column_of);
            }
            Err(needed) => {
                low = needed;
                partial.copy_from_slice(&matcher.column_of);
            }
        }
    }
    best
}

/// A lower bound: every row needs some column, and every column a row if there are no more columns than rows.
fn least_thinkable(rows: &[Vec2], columns: &[Vec2]) -> f64 {
    let farthest = |from: &[Vec2], to: &[Vec2]| {
        let tree = KdTree::new(to);
        let all = Remaining::new(&tree, |_| true);
        let nearest = |&at: &Vec2| all.nearest_squared(&tree, at, f64::INFINITY);
        from.iter().map(nearest).fold(0.0, f64::max)
    };
    let least = farthest(rows, columns);
    if rows.len() == columns.len() { farthest(columns, rows).max(least) } else { least }
}

fn longest_squared(rows: &[Vec2], columns: &[Vec2], column_of: &[u32]) -> f64 {
    let way = |(&row, &column): (&Vec2, &u32)| (columns[column as usize] - row).length_squared();
    rows.iter().zip(column_of).map(way).fold(0.0, f64::max)
}

struct Matcher<'a> {
    cancel: Cancel<'a>,
    rows: &'a [Vec2],
    columns: &'a [Vec2],
    /// Columns the phase has not seen.
    within: Within<'a>,
    column_of: Vec<u32>,
    row_of: Vec<u32>,
    /// How the phase got to each row.
    reached: Vec<Reached>,
    /// Rows seen in this phase, in order.
    queue: Vec<u32>,
    /// Columns the phase has seen.
    seen: Vec<u32>,
}

/// A row's place in a search.
#[derive(Clone, Copy)]
struct Reached {
    /// The open row the path begins at.
    root: u32,
    /// The row before it on the path.
    from: u32,
}

impl<'a> Matcher<'a> {
    fn new(rows: &'a [Vec2], columns: &'a [Vec2], most_squared: f64, cancel: Cancel<'a>) -> Self {
        let within = Within::new(rows, columns, most_squared);
        let (column_of, row_of) = (vec![NONE; rows.len()], vec![NONE; columns.len()]);
        let reached = vec![Reached { root: NONE, from: NONE }; rows.len()];
        let (queue, seen) = (Vec::new(), Vec::new());
        Self { cancel, rows, columns, within, column_of, row_of, reached, queue, seen }
    }

    fn squared(&self, row: usize, column: u32) -> f64 {
        (self.columns[column as usize] - self.rows[row]).length_squared()
    }

    /// Starts from those edges of a matching that are within reach, or from another matching if that has more.
    fn begin(&mut self, known: &[u32], partial: &[u32], reach_squared: f64) {
        for (row, &column) in known.iter().enumerate() {
            let keep = self.squared(row, column) <= reach_squared;
            self.column_of[row] = if keep { column } else { NONE };
        }
        let matched = |of: &[u32]| of.iter().filter(|&&column| column != NONE).count();
        if matched(partial) > matched(&self.column_of) {
            self.column_of.copy_from_slice(partial);
        }
        self.row_of.fill(NONE);
        for (row, &column) in self.column_of.iter().enumerate() {
            if column != NONE {
                self.row_of[column as usize] = row as u32;
            }
        }
        self.within.reset(&self.row_of);
    }

    /// Extends the matching to all rows with edges within reach. Where that cannot be: a greater reach (squared) that
    /// any perfect matching needs. `before[row]` is a matching with longer edges.
    fn complete(&mut self, before: &[u32], reach_squared: f64) -> Result<(), f64> {
        let mut open: Vec<u32> = (0..self.rows.len() as u32).collect();
        open.retain(|&row| self.column_of[row as usize] == NONE);
        let length = |row: u32| self.squared(row as usize, before[row as usize]);
        open.sort_by(|&a, &b| length(b).total_cmp(&length(a)));
        while let Some(&hardest) = open.first().filter(|_| !self.cancel.is_wanted()) {
            // Where there is no matching, the row with the longest edge most likely has no path: that decides.
            if self.phase(&[hardest], reach_squared) == 0 {
                return Err(self.needed());
            }
            self.forget_seen();
            open.retain(|&row| self.column_of[row as usize] == NONE);
            if !open.is_empty() && self.phase(&open, reach_squared) == 0 {
                return Err(self.needed());
            }
            self.forget_seen();
            open.retain(|&row| self.column_of[row as usize] == NONE);
        }
        Ok(())
    }

    /// Searches from all open rows at once, breadth first, and flips one augmenting path for every row that has one
    /// left; how many. What was seen stays in `queue` and out of `within` until [`Self::forget_seen`].
    fn phase(&mut self, open: &[u32], reach_squared: f64) -> usize {
        let mut found = 0;
        for &row in open {
            self.reached[row as usize] = Reached { root: row, from: NONE };
            self.queue.push(row);
        }
        let mut next = 0;
        while let Some(&row) = self.queue.get(next) {
            next += 1;
            if next.is_multiple_of(POLLED) && self.cancel.is_wanted() {
                break;
            }
            let root = self.reached[row as usize].root;
            if self.column_of[root as usize] != NONE {
                continue;
            }
            if let Some(column) = self.within.take_free(row, reach_squared) {
                self.flip(row, column);
                found += 1;
                continue;
            }
            let before = self.seen.len();
            self.within.drain(row, reach_squared, &mut self.seen);
            for &column in &self.seen[before..] {
                let owner = self.row_of[column as usize];
                self.reached[owner as usize] = Reached { root, from: row };
                self.queue.push(owner);
            }
        }
        found
    }

    /// Gives a row a free column, and each row before it on its path the column of the row after it.
    fn flip(&mut self, mut row: u32, mut column: u32) {
        self.seen.push(column);
        while row != NONE {
            let before = core::mem::replace(&mut self.column_of[row as usize], column);
            self.row_of[column as usize] = row;
            (row, column) = (self.reached[row as usize].from, before);
        }
    }

    /// Makes a new phase possible: every column that has a row is unseen again.
    fn forget_seen(&mut self) {
        for column in self.seen.drain(..) {
            self.within.put(column);
        }
        self.queue.clear();
    }

    /// After a phase that found nothing: the rows seen are more than the columns they reach (Hall), so one of them
    /// needs a column not seen. The nearest such distance, squared.
    fn needed(&mut self) -> f64 {
        let least = |least, &row: &u32| self.within.nearest_squared(row, least);
        let least = self.queue.iter().fold(f64::INFINITY, least);
        self.seen.clear();
        self.queue.clear();
        least
    }
}
