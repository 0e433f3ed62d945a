//! What is near what on the floor.

use lightbots_base::Vec2;
use std::collections::BTreeMap;

/// Robots and standing discs by the squares of a grid.
pub(crate) struct FloorCells {
    /// Robots first, then standing discs.
    pub all: Vec<Vec2>,
    side_m: f64,
    cells: BTreeMap<(i64, i64), Vec<usize>>,
}

impl FloorCells {
    /// With squares of this side, metres.
    pub fn new(robots: &[Vec2], standing: &[Vec2], side_m: f64) -> Self {
        let all: Vec<Vec2> = robots.iter().chain(standing).copied().collect();
        let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (index, at) in all.iter().enumerate() {
            cells.entry(cell(*at, side_m)).or_default().push(index);
        }
        Self { all, side_m, cells }
    }

    /// What is in the squares around one, itself left out.
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
