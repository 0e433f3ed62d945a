//! Neighbour list (Verlet, 1967): pairs of discs that may see each other or touch. It is made anew only when a pair
//! could be missing, because a disc has moved.

use lightbots_base::Vec2;

/// How much farther apart than needed a pair may be to get on the list, metres. The list is valid until a disc has moved
/// half of this. A smaller value makes new lists more often. A larger value adds pairs to compare in every step.
const MARGIN_M: f64 = 0.08;

/// The list of near pairs.
#[derive(Clone, Debug)]
pub(crate) struct NeighbourList {
    /// Distance of centres below which a pair gets on the list, metres.
    reach_m: f64,
    /// `[disc]`: place of its centre when the list was made.
    then: Vec<Vec2>,
    /// Pairs of disc indices, the smaller index first, sorted.
    pairs: Vec<(u32, u32)>,
    /// Index in `order` at which each cell of the grid begins. Used only while the list is made.
    cells: Vec<u32>,
    /// Indices of the discs, ordered by cell.
    order: Vec<u32>,
    /// `[disc]`: the cell of the grid that contains it.
    cell_of: Vec<u32>,
}

impl NeighbourList {
    /// An empty list that will hold every pair of discs whose centres are closer than `near_m`, metres.
    pub fn new(near_m: f64) -> Self {
        let reach_m = near_m + MARGIN_M;
        let (then, pairs) = (Vec::new(), Vec::new());
        Self { reach_m, then, pairs, cells: Vec::new(), order: Vec::new(), cell_of: Vec::new() }
    }

    /// The pairs on the list, among them every pair closer than `near_m` of [`Self::new`].
    pub fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// Whether the list is no longer valid, because the disc `index` has moved to `place` or was not there when the
    /// list was made.
    #[inline]
    pub fn outdated_by(&self, index: usize, place: Vec2) -> bool {
        self.then
            .get(index)
            .is_none_or(|&then| (place - then).length_squared() > (0.5 * MARGIN_M) * (0.5 * MARGIN_M))
    }

    /// Makes the list anew for discs with centres at `places`.
    pub fn rebuild(&mut self, places: &[Vec2]) {
        self.then.clear();
        self.then.extend_from_slice(places);
        self.pairs.clear();
        let grid = Grid::around(places, self.reach_m);
        self.sort_into(&grid, places);
        for row in 0..grid.rows {
            for column in 0..grid.columns {
                self.pair_cell(&grid, column, row, places);
            }
        }
        self.pairs.sort_unstable();
    }

    /// Counting sort of the discs by cell.
    fn sort_into(&mut self, grid: &Grid, places: &[Vec2]) {
        let count = (grid.columns * grid.rows) as usize;
        self.cells.clear();
        self.cells.resize(count + 1, 0);
        self.cell_of.clear();
        self.cell_of.extend(places.iter().map(|&place| grid.cell(place)));
        for &cell in &self.cell_of {
            self.cells[cell as usize + 1] += 1;
        }
        for cell in 0..count {
            self.cells[cell + 1] += self.cells[cell];
        }
        self.order.clear();
        self.order.resize(places.len(), 0);
        for (disc, &cell) in self.cell_of.iter().enumerate().rev() {
            self.cells[cell as usize + 1] -= 1;
            self.order[self.cells[cell as usize + 1] as usize] = disc as u32;
        }
        // Every start has moved one place up: cells[c + 1] now is where cell c begins.
        self.cells.push(places.len() as u32);
    }

    fn members(&self, cell: u32) -> core::ops::Range<usize> {
        self.cells[cell as usize + 1] as usize..self.cells[cell as usize + 2] as usize
    }

    /// Adds the near pairs of a cell's discs with each other and with the discs of four neighbouring cells. These cells
    /// are the next in the row, and three in the next row.
    fn pair_cell(&mut self, grid: &Grid, column: u32, row: u32, places: &[Vec2]) {
        let mine = self.members(row * grid.columns + column);
        if mine.is_empty() {
            return;
        }
        let ahead = [(1i64, 0i64), (-1, 1), (0, 1), (1, 1)];
        let mut ranges = [0..0, 0..0, 0..0, 0..0];
        for (range, (dx, dy)) in ranges.iter_mut().zip(ahead) {
            let (x, y) = (i64::from(column) + dx, i64::from(row) + dy);
            if x >= 0 && x < i64::from(grid.columns) && y < i64::from(grid.rows) {
                *range = self.members((y * i64::from(grid.columns) + x) as u32);
            }
        }
        let reach_squared = self.reach_m * self.reach_m;
        for first in mine.clone() {
            let a = self.order[first];
            let others = (first + 1..mine.end).chain(ranges.iter().cloned().flatten());
            for other in others {
                let b = self.order[other];
                if (places[a as usize] - places[b as usize]).length_squared() < reach_squared {
                    self.pairs.push((a.min(b), a.max(b)));
                }
            }
        }
    }
}

/// A grid whose cells are at least as wide as the reach of the list. With few discs on a large area the cells are
/// wider, which limits their number.
struct Grid {
    origin: Vec2,
    scale: f64,
    columns: u32,
    rows: u32,
}

impl Grid {
    fn around(places: &[Vec2], reach_m: f64) -> Self {
        let (mut low, mut high) = (Vec2::new(f64::MAX, f64::MAX), Vec2::new(f64::MIN, f64::MIN));
        for place in places {
            low = Vec2::new(low.x.min(place.x), low.y.min(place.y));
            high = Vec2::new(high.x.max(place.x), high.y.max(place.y));
        }
        if places.is_empty() {
            return Self { origin: Vec2::ZERO, scale: 1.0, columns: 1, rows: 1 };
        }
        let (width, depth) = (high.x - low.x, high.y - low.y);
        let most = 4.0 * places.len() as f64 + 64.0;
        let mut cell = reach_m;
        // Each round leaves about a quarter of the cells.
        for _ in 0..64 {
            if (width / cell + 1.0) * (depth / cell + 1.0) <= most {
                break;
            }
            cell *= 2.0;
        }
        let count = |extent: f64| (extent / cell) as u32 + 1;
        Self { origin: low, scale: 1.0 / cell, columns: count(width), rows: count(depth) }
    }

    fn cell(&self, place: Vec2) -> u32 {
        let at = (place - self.origin) * self.scale;
        (at.y as u32).min(self.rows - 1) * self.columns + (at.x as u32).min(self.columns - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dice::{Dice, Purpose};

    fn check(count: usize, half_m: f64) {
        let mut dice = Dice::new(count as u64, Purpose::Robots);
        let places: Vec<Vec2> = (0..count)
            .map(|_| Vec2::new(dice.between(-half_m, half_m), dice.between(-half_m, half_m)))
            .collect();
        let mut near = NeighbourList::new(0.054);
        near.rebuild(&places);
        let mut expected = Vec::new();
        for a in 0..count {
            for b in a + 1..count {
                if places[a].distance(places[b]) < 0.054 + MARGIN_M {
                    expected.push((a as u32, b as u32));
                }
            }
        }
        assert_eq!(near.pairs(), expected, "{count} discs within {half_m} m");
    }

    #[test]
    fn the_grid_finds_what_looking_at_all_pairs_finds() {
        for (count, half_m) in [(0, 1.0), (1, 1.0), (2, 0.01), (300, 1.5), (300, 0.2), (40, 500.0), (3, 1e7)]
        {
            check(count, half_m);
        }
    }

    #[test]
    fn a_list_holds_until_a_disc_moved_half_the_margin() {
        let mut near = NeighbourList::new(0.054);
        assert!(near.outdated_by(0, Vec2::ZERO));
        near.rebuild(&[Vec2::ZERO]);
        assert!(!near.outdated_by(0, Vec2::new(0.5 * MARGIN_M - 0.001, 0.0)));
        assert!(near.outdated_by(0, Vec2::new(0.5 * MARGIN_M + 0.001, 0.0)));
    }
}
