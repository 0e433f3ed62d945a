//! The least longest way: an exact bottleneck matching of places in the plane.
//!
//! Whether a perfect matching exists within a reach is decided by augmenting paths (phases of depth-first searches
//! with lookahead, Pothen & Fan 1990) over edges that are never listed: a k-d tree hands out places within reach that
//! the phase has not seen yet (Efrat, Itai & Katz 2001). The reach is bisected between bounds that a failed search
//! and a found matching sharpen to distances that really occur.

use super::kdtree::{KdTree, Remaining};
use lightbots_base::Vec2;

/// No partner yet.
pub(super) const NONE: u32 = u32::MAX;

/// A matching of all rows with the least longest edge.
pub(super) struct Bottleneck {
    /// That edge's length squared, square metres.
    pub reach_squared: f64,
    /// `column_of[row]`.
    pub column_of: Vec<u32>,
}

/// Matches every row to its own column; there must be at least as many columns.
pub(super) fn bottleneck(rows: &[Vec2], columns: &[Vec2]) -> Bottleneck {
    let mut matcher = Matcher::new(rows, columns);
    let mut low = matcher.least_thinkable();
    let mut best: Option<Bottleneck> = None;
    loop {
        let high = best.as_ref().map(|best| best.reach_squared);
        // Distances this close are one: they differ by rounding only.
        if let Some(best) = best.take_if(|best| low >= best.reach_squared * (1.0 - 1e-12)) {
            return best;
        }
        let trial = match high {
            None => low,
            Some(high) => {
                let middle = (low.sqrt() + high.sqrt()) / 2.0;
                (middle * middle).clamp(low, high)
            }
        };
        if let Some(best) = &best {
            matcher.keep_within(&best.column_of, trial);
        }
        match matcher.complete(trial) {
            Ok(()) => {
                let found = matcher.longest_squared();
                best = Some(Bottleneck { reach_squared: found, column_of: matcher.column_of.clone() });
            }
            Err(needed) if best.is_none() => low = needed.max(trial * 1.44),
            Err(needed) => low = needed,
        }
        // The growth above may have jumped over the least reach: what lies below is bisected from the last failure.
        if let (Some(_), None) = (&best, high) {
            low = matcher.failed;
        }
    }
}

struct Matcher<'a> {
    rows: &'a [Vec2],
    columns: &'a [Vec2],
    tree: KdTree,
    /// Columns without a row.
    free: Remaining,
    /// Columns with a row that the phase has not seen.
    unseen: Remaining,
    column_of: Vec<u32>,
    row_of: Vec<u32>,
    /// A reach below which there is no perfect matching.
    failed: f64,
}

impl<'a> Matcher<'a> {
    fn new(rows: &'a [Vec2], columns: &'a [Vec2]) -> Self {
        let tree = KdTree::new(columns);
        let free = Remaining::new(&tree, |_| true);
        let unseen = Remaining::new(&tree, |_| false);
        let (column_of, row_of) = (vec![NONE; rows.len()], vec![NONE; columns.len()]);
        Self { rows, columns, tree, free, unseen, column_of, row_of, failed: 0.0 }
    }

    /// Nobody's longest way can be shorter: every row needs some column, and each column a row if there are no more
    /// columns than rows.
    fn least_thinkable(&mut self) -> f64 {
        let farthest = |remaining: &Remaining, tree: &KdTree, from: &[Vec2]| {
            from.iter().map(|&at| remaining.nearest_squared(tree, at, f64::INFINITY)).fold(0.0, f64::max)
        };
        let mut least = farthest(&self.free, &self.tree, self.rows);
        if self.rows.len() == self.columns.len() {
            let tree = KdTree::new(self.rows);
            least = farthest(&Remaining::new(&tree, |_| true), &tree, self.columns).max(least);
        }
        self.failed = least;
        least
    }

    fn squared(&self, row: usize, column: u32) -> f64 {
        (self.columns[column as usize] - self.rows[row]).length_squared()
    }

    fn longest_squared(&self) -> f64 {
        (0..self.rows.len()).map(|row| self.squared(row, self.column_of[row])).fold(0.0, f64::max)
    }

    /// Starts from those edges of a matching that are within reach.
    fn keep_within(&mut self, column_of: &[u32], reach_squared: f64) {
        self.row_of.fill(NONE);
        for (row, &column) in column_of.iter().enumerate() {
            let keep = self.squared(row, column) <= reach_squared;
            self.column_of[row] = if keep { column } else { NONE };
            if keep {
                self.row_of[column as usize] = row as u32;
            }
        }
        let row_of = &self.row_of;
        self.free.reset(&self.tree, |column| row_of[column] == NONE);
    }

    /// Extends the matching to all rows with edges within reach. Where that cannot be: a greater reach (squared) that
    /// any perfect matching needs.
    fn complete(&mut self, reach_squared: f64) -> Result<(), f64> {
        loop {
            let open: Vec<u32> =
                (0..self.rows.len() as u32).filter(|&row| self.column_of[row as usize] == NONE).collect();
            if open.is_empty() {
                return Ok(());
            }
            let row_of = &self.row_of;
            self.unseen.reset(&self.tree, |column| row_of[column] != NONE);
            let mut stack = Vec::new();
            let found = open.iter().filter(|&&row| self.augment(row, reach_squared, &mut stack)).count();
            if found == 0 {
                self.failed = self.needed(&open);
                return Err(self.failed);
            }
        }
    }

    /// Looks for an augmenting path from a free row and flips it. `stack` is scratch: rows on the path, each with the
    /// column it is matched to.
    fn augment(&mut self, root: u32, reach_squared: f64, stack: &mut Vec<u32>) -> bool {
        stack.clear();
        stack.push(root);
        while let Some(&row) = stack.last() {
            let at = self.rows[row as usize];
            if let Some(column) = self.free.take(&self.tree, at, reach_squared) {
                self.flip(stack, column);
                return true;
            }
            match self.unseen.take(&self.tree, at, reach_squared) {
                Some(column) => stack.push(self.row_of[column as usize]),
                None => {
                    stack.pop();
                }
            }
        }
        false
    }

    /// Gives the last row of the path a free column, and every other row the column of the row after it.
    fn flip(&mut self, path: &[u32], mut column: u32) {
        for &row in path.iter().rev() {
            let before = core::mem::replace(&mut self.column_of[row as usize], column);
            self.row_of[column as usize] = row;
            column = before;
        }
    }

    /// After a phase that found nothing: rows seen have more rows than columns within reach (Hall), so one of them
    /// needs a column outside. The nearest such distance, squared.
    fn needed(&self, open: &[u32]) -> f64 {
        let seen = (0..self.columns.len())
            .filter(|&column| self.row_of[column] != NONE && !self.unseen.contains(&self.tree, column))
            .map(|column| self.row_of[column]);
        open.iter().copied().chain(seen).fold(f64::INFINITY, |least, row| {
            let at = self.rows[row as usize];
            let least = self.unseen.nearest_squared(&self.tree, at, least);
            self.free.nearest_squared(&self.tree, at, least)
        })
    }
}
