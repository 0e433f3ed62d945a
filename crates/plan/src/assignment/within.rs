//! Columns within reach of a row that a search for a matching has not seen yet. Columns are places that are matched
//! with rows.

use super::kdtree::{KdTree, Remaining};
use super::partner::NONE;
use lightbots_base::Vec2;

/// Most columns within reach of a row, on average, with which the columns near each row are listed in advance. With
/// more, the k-d tree is searched whenever columns are needed.
const LISTED_MOST: usize = 64;

/// Yields columns near rows. Each column is yielded once, until it is put back.
pub(super) enum Within<'a> {
    /// The columns within reach of each row are listed.
    Listed(Listed),
    /// Columns are looked up in a k-d tree.
    Tree(InTree<'a>),
}

impl<'a> Within<'a> {
    /// Prepares for searches with a squared reach of at most `reach_squared`, square metres.
    pub fn new(rows: &'a [Vec2], columns: &[Vec2], reach_squared: f64) -> Self {
        let tree = KdTree::new(columns);
        match Listed::new(rows, &tree, reach_squared) {
            Some(listed) => Self::Listed(listed),
            None => Self::Tree(InTree::new(rows, tree)),
        }
    }

    /// Starts again with a new matching `row_of[column]`: unmatched columns are free, matched columns unseen.
    pub fn reset(&mut self, row_of: &[u32]) {
        match self {
            Self::Listed(listed) => {
                let state = row_of.iter().map(|&row| if row == NONE { State::Free } else { State::Unseen });
                listed.states = state.collect();
            }
            Self::Tree(tree) => {
                tree.free.reset(&tree.tree, |column| row_of[column] == NONE);
                tree.unseen.reset(&tree.tree, |column| row_of[column] != NONE);
            }
        }
    }

    /// Takes a free column whose squared distance from a row is at most `reach_squared`; `None` if there is none.
    pub fn take_free(&mut self, row: u32, reach_squared: f64) -> Option<u32> {
        match self {
            Self::Listed(listed) => {
                let states = &mut listed.states;
                let near = listed.near.within(row, reach_squared).iter();
                let column = near.copied().find(|&column| states[column as usize] == State::Free)?;
                states[column as usize] = State::Gone;
                Some(column)
            }
            Self::Tree(InTree { rows, tree, free, .. }) => free.take(tree, rows[row as usize], reach_squared),
        }
    }

    /// Takes all unseen matched columns whose squared distance from a row is at most `reach_squared`, and adds them to
    /// `seen`.
    pub fn drain(&mut self, row: u32, reach_squared: f64, seen: &mut Vec<u32>) {
        match self {
            Self::Listed(listed) => {
                for &column in listed.near.within(row, reach_squared) {
                    if listed.states[column as usize] == State::Unseen {
                        listed.states[column as usize] = State::Gone;
                        seen.push(column);
                    }
                }
            }
            Self::Tree(InTree { rows, tree, unseen, .. }) => {
                unseen.drain(tree, rows[row as usize], reach_squared, seen);
            }
        }
    }

    /// Marks a matched column, which was taken, as unseen again.
    pub fn put(&mut self, column: u32) {
        match self {
            Self::Listed(listed) => listed.states[column as usize] = State::Unseen,
            Self::Tree(tree) => tree.unseen.put(&tree.tree, column as usize),
        }
    }

    /// Returns the squared distance from a row to the nearest column that is not taken, or `bound` if no column is
    /// nearer. Lists only contain columns within the reach of the search, so `bound` may be returned for columns beyond
    /// it.
    pub fn nearest_squared(&self, row: u32, bound: f64) -> f64 {
        match self {
            Self::Listed(listed) => {
                let (columns, squares) = listed.near.of(row);
                let is_there = |column: &u32| listed.states[*column as usize] != State::Gone;
                columns.iter().position(is_there).map_or(bound, |rank| squares[rank].min(bound))
            }
            Self::Tree(InTree { rows, tree, free, unseen }) => {
                let at = rows[row as usize];
                free.nearest_squared(tree, at, unseen.nearest_squared(tree, at, bound))
            }
        }
    }
}

/// State of a column: not matched, matched but not seen by the search, or taken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Free,
    Unseen,
    Gone,
}

pub(super) struct Listed {
    near: Near,
    /// `[column]`: its state.
    states: Vec<State>,
}

impl Listed {
    /// Lists the columns within reach of each row; `None` if there are more than [`LISTED_MOST`] for each row on
    /// average.
    fn new(rows: &[Vec2], tree: &KdTree, reach_squared: f64) -> Option<Self> {
        let mut near = Near { first: vec![0], columns: Vec::new(), squares: Vec::new() };
        let mut found = Vec::new();
        for &at in rows {
            tree.within(at, reach_squared, &mut found);
            if near.columns.len() + found.len() > rows.len() * LISTED_MOST {
                return None;
            }
            found.sort_unstable_by(|a: &(f64, u32), b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            near.squares.extend(found.iter().map(|entry| entry.0));
            near.columns.extend(found.iter().map(|entry| entry.1));
            near.first.push(near.columns.len());
        }
        Some(Self { near, states: Vec::new() })
    }
}

/// The columns near each row, nearest first.
struct Near {
    /// `first[row]..first[row + 1]`: range of a row's entries in `columns` and `squares`.
    first: Vec<usize>,
    columns: Vec<u32>,
    /// Squared distances of these columns from the row, square metres.
    squares: Vec<f64>,
}

impl Near {
    fn of(&self, row: u32) -> (&[u32], &[f64]) {
        let own = self.first[row as usize]..self.first[row as usize + 1];
        (&self.columns[own.clone()], &self.squares[own])
    }

    fn within(&self, row: u32, reach_squared: f64) -> &[u32] {
        let (columns, squares) = self.of(row);
        &columns[..squares.partition_point(|&squared| squared <= reach_squared)]
    }
}

pub(super) struct InTree<'a> {
    rows: &'a [Vec2],
    tree: KdTree,
    free: Remaining,
    unseen: Remaining,
}

impl<'a> InTree<'a> {
    fn new(rows: &'a [Vec2], tree: KdTree) -> Self {
        let free = Remaining::new(&tree, |_| false);
        let unseen = Remaining::new(&tree, |_| false);
        Self { rows, tree, free, unseen }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeded::Seeded;

    #[test]
    fn lists_and_trees_hand_out_the_same() {
        let mut seeded = Seeded::new(5);
        for _ in 0..40 {
            let count = 1 + seeded.below(150);
            let mut place = || Vec2::new(seeded.between(-1.0, 1.0), seeded.between(-1.0, 1.0));
            let rows: Vec<Vec2> = (0..count).map(|_| place()).collect();
            let columns: Vec<Vec2> = (0..count).map(|_| place()).collect();
            let tree = KdTree::new(&columns);
            let mut listed = Within::Listed(Listed::new(&rows, &tree, 0.5).expect("few are near"));
            let mut in_tree = Within::Tree(InTree::new(&rows, tree));
            let row_of: Vec<u32> = (0..count).map(|_| if seeded.below(4) == 0 { NONE } else { 0 }).collect();
            listed.reset(&row_of);
            in_tree.reset(&row_of);
            for row in 0..count as u32 {
                let reach_squared = seeded.between(0.0, 0.25);
                let drained = |within: &mut Within<'_>| {
                    let mut seen = Vec::new();
                    within.drain(row, reach_squared, &mut seen);
                    // A few of the columns are put back.
                    seen.sort_unstable();
                    seen.iter().step_by(3).for_each(|&column| within.put(column));
                    seen
                };
                assert_eq!(drained(&mut listed), drained(&mut in_tree));
                assert_eq!(listed.nearest_squared(row, 0.5), in_tree.nearest_squared(row, 0.5));
            }
            for row in 0..count as u32 {
                listed.reset(&row_of);
                in_tree.reset(&row_of);
                let (one, other) = (listed.take_free(row, 0.04), in_tree.take_free(row, 0.04));
                assert_eq!(one.is_some(), other.is_some());
                for column in one.into_iter().chain(other) {
                    assert_eq!(row_of[column as usize], NONE);
                    assert!((columns[column as usize] - rows[row as usize]).length_squared() <= 0.04);
                }
            }
        }
    }
}
