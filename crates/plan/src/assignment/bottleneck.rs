//! The assignment whose longest line is shortest: an exact bottleneck matching of places in the plane. Rows are matched
//! with columns.
//!
//! Augmenting paths decide whether a matching of all rows with edges up to a given length, the reach, exists. They are
//! found by breadth-first searches from all open rows at once (Azad, Buluç & Pothen 2017). Edges are not stored: a k-d
//! tree yields columns within reach that the search has not seen yet (Efrat, Itai & Katz 2001). The reach is bisected
//! between a lower and an upper bound. A failed search raises the lower bound, a found matching lowers the upper bound,
//! each to a distance that occurs between places.

use super::kdtree::{KdTree, Remaining};
use super::partner::NONE;
use super::within::Within;
use crate::cancel::Cancel;
use lightbots_base::Vec2;

/// Two squared distances count as equal if their ratio is at least this, because rounding alone makes them differ.
const SAME: f64 = 1.0 - 1e-12;

/// Number of rows between two polls of the cancellation.
const POLLED: usize = 256;

/// The matching of all rows whose longest edge is shortest.
pub(super) struct Bottleneck {
    /// Square of the length of the longest edge, square metres.
    pub reach_squared: f64,
    /// `column_of[row]`: the column matched with that row.
    pub column_of: Vec<u32>,
}

/// Finds the bottleneck matching of all rows. `known[row]` is the column in any matching of all rows; one with a
/// shorter longest edge makes the search faster. A cancelled search returns the best matching found until then.
pub(super) fn bottleneck(rows: &[Vec2], columns: &[Vec2], known: &[u32], cancel: Cancel<'_>) -> Bottleneck {
    let mut low = least_thinkable(rows, columns);
    let mut best =
        Bottleneck { reach_squared: longest_squared(rows, columns, known), column_of: known.to_vec() };
    if low >= best.reach_squared * SAME {
        return best;
    }
    let mut matcher = Matcher::new(rows, columns, best.reach_squared, cancel);
    // The matching of the last failed search. Its edges are within every reach that is tried later, because later
    // reaches are longer.
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

/// Lower bound of the squared bottleneck distance, square metres. Every row needs at least its nearest column. If there
/// are equally many, every column needs at least its nearest row.
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
    /// Columns that the current phase has not seen.
    within: Within<'a>,
    column_of: Vec<u32>,
    row_of: Vec<u32>,
    /// `[row]`: how the current phase reached the row.
    reached: Vec<Reached>,
    /// Indices of the rows that the current phase has reached, in order.
    queue: Vec<u32>,
    /// Columns that the current phase has seen.
    seen: Vec<u32>,
}

/// How a search reached a row.
#[derive(Clone, Copy)]
struct Reached {
    /// The open row at which the path begins.
    root: u32,
    /// The row before this row on the path; [`NONE`] at the root.
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

    /// Begins with the edges of `known` that are within reach, or with `partial` if that matches more rows.
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

    /// Extends the matching to all rows, with edges within reach. If that is impossible, returns a greater squared
    /// reach, square metres, that every matching of all rows needs. `before[row]` is a matching of all rows that may
    /// have longer edges. A cancelled search returns `Ok` too early.
    fn complete(&mut self, before: &[u32], reach_squared: f64) -> Result<(), f64> {
        let mut open: Vec<u32> = (0..self.rows.len() as u32).collect();
        open.retain(|&row| self.column_of[row as usize] == NONE);
        let length = |row: u32| self.squared(row as usize, before[row as usize]);
        open.sort_by(|&a, &b| length(b).total_cmp(&length(a)));
        while let Some(&hardest) = open.first().filter(|_| !self.cancel.is_wanted()) {
            // If there is no matching, the row with the longest edge in `before` most likely has no path. Then one
            // search decides.
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

    /// Searches breadth first from all rows of `open` at once, and flips one augmenting path for each row for which the
    /// search finds one. Returns the number of flipped paths. Columns seen are left out of further searches until
    /// [`Self::forget_seen`].
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

    /// Flips the augmenting path that ends at `row`. Matches `row` with the free column `column`, and each row before
    /// it on the path with the column of the next row.
    fn flip(&mut self, mut row: u32, mut column: u32) {
        self.seen.push(column);
        while row != NONE {
            let before = core::mem::replace(&mut self.column_of[row as usize], column);
            self.row_of[column as usize] = row;
            (row, column) = (self.reached[row as usize].from, before);
        }
    }

    /// Prepares a new phase: every matched column counts as unseen again.
    fn forget_seen(&mut self) {
        for column in self.seen.drain(..) {
            self.within.put(column);
        }
        self.queue.clear();
    }

    /// Returns the least squared distance from a seen row to an unseen column, square metres, after a phase without a
    /// path. The seen rows outnumber the columns within their reach (Hall), so every matching of all rows needs an edge
    /// at least that long.
    fn needed(&mut self) -> f64 {
        let least = |least, &row: &u32| self.within.nearest_squared(row, least);
        let least = self.queue.iter().fold(f64::INFINITY, least);
        self.seen.clear();
        self.queue.clear();
        least
    }
}
