//! A grid that finds robots and discs near each other on the floor.

use lightbots_base::Vec2;
use std::collections::BTreeMap;

/// Robots and standing discs, sorted into the squares of a grid.
pub(crate) struct FloorCells {
    /// Centres of all robots, then of all standing discs, stage metres.
    pub all: Vec<Vec2>,
    side_m: f64,
    cells: BTreeMap<(i64, i64), Vec<usize>>,
}

impl FloorCells {
    /// Sorts robots and discs into squares with a side of `side_m` metres.
    pub fn new(robots: &[Vec2], standing: &[Vec2], side_m: f64) -> Self {
        let all: Vec<Vec2> = robots.iter().chain(standing).copied().collect();
        let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (index, at) in all.iter().enumerate() {
            cells.entry(cell(*at, side_m)).or_default().push(index);
        }
        Self { all, side_m, cells }
    }

    /// Returns the indices into `all` of what is in the square of `index` or in the eight squares around it, except
    /// `index` itself.
    pub fn near(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let (x, y) = cell(self.all[index], self.side_m);
        (y - 1..=y + 1)
            .flat_map(move |y| (x - 1..=x + 1).map(move |x| (x, y)))
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .copied()
            .filter(move |other| *other != index)
    }
}

fn cell(at: Vec2, side_m: f64) -> (i64, i64) {
    ((at.x / side_m).floor() as i64, (at.y / side_m).floor() as i64)
}
