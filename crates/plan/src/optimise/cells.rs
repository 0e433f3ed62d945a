//! Pairs of near discs, found by a grid of square cells.

use lightbots_base::Vec2;

/// Most cells along an axis.
const MOST_CELLS: f64 = 256.0;

/// A disc around the places of a robot during a span. `owner` is the index of the robot; lengths are metres.
#[derive(Clone, Copy)]
pub(crate) struct Disc {
    pub at: Vec2,
    pub radius: f64,
    pub owner: u32,
}

/// Sorts discs into square cells. Its buffers are kept between calls.
#[derive(Default)]
pub(crate) struct Cells {
    sorted: Vec<Disc>,
    cell_of: Vec<u32>,
    /// Index of each cell's first disc, row after row, and one entry for the end.
    begins: Vec<u32>,
}

impl Cells {
    /// Calls `near` once for every two discs whose rims are less than `apart` metres from each other.
    pub fn near_pairs(&mut self, discs: &[Disc], apart: f64, mut near: impl FnMut(&Disc, &Disc)) {
        if discs.len() < 2 {
            return;
        }
        let columns = self.sort(discs, apart);
        let rows = (self.begins.len() - 1) / columns;
        for row in 0..rows {
            for column in 0..columns {
                let cell = row * columns + column;
                // The rest of this cell and the next one, then the three cells in the row behind.
                let (left, right) = (column.saturating_sub(1), (column + 2).min(columns));
                let beside = self.begins[row * columns + right] as usize;
                let behind = if row + 1 < rows {
                    self.begins[cell + columns - (column - left)] as usize
                        ..self.begins[(row + 1) * columns + right] as usize
                } else {
                    0..0
                };
                for first in self.begins[cell] as usize..self.begins[cell + 1] as usize {
                    let one = &self.sorted[first];
                    for other in self.sorted[first + 1..beside].iter().chain(&self.sorted[behind.clone()]) {
                        let touch = apart + one.radius + other.radius;
                        if (one.at - other.at).length_squared() < touch * touch {
                            near(one, other);
                        }
                    }
                }
            }
        }
    }

    /// Sorts discs into cells that are at least as wide as the largest distance of two centres in a near pair. Returns
    /// the number of columns.
    fn sort(&mut self, discs: &[Disc], apart: f64) -> usize {
        let (mut least, mut most, mut reach) = (discs[0].at, discs[0].at, 0.0_f64);
        for disc in discs {
            least = Vec2::new(least.x.min(disc.at.x), least.y.min(disc.at.y));
            most = Vec2::new(most.x.max(disc.at.x), most.y.max(disc.at.y));
            reach = reach.max(disc.radius);
        }
        let size = most - least;
        let width = (apart + 2.0 * reach).max(size.x.max(size.y) / MOST_CELLS).max(1e-9);
        let count = |length: f64| (length / width) as usize + 1;
        let (columns, rows) = (count(size.x), count(size.y));
        self.begins.clear();
        self.begins.resize(columns * rows + 1, 0);
        self.cell_of.clear();
        for disc in discs {
            let from = disc.at - least;
            let (column, row) = ((from.x / width) as usize, (from.y / width) as usize);
            let cell = row.min(rows - 1) * columns + column.min(columns - 1);
            self.cell_of.push(cell as u32);
            self.begins[cell + 1] += 1;
        }
        for cell in 1..self.begins.len() {
            self.begins[cell] += self.begins[cell - 1];
        }
        self.sorted.clear();
        self.sorted.resize(discs.len(), discs[0]);
        // From the last to the first, so that discs keep their order within a cell.
        for (disc, &cell) in discs.iter().zip(&self.cell_of).rev() {
            let end = &mut self.begins[cell as usize + 1];
            *end -= 1;
            self.sorted[*end as usize] = *disc;
        }
        // Each entry is now the beginning of the cell before it.
        self.begins.remove(0);
        self.begins.push(discs.len() as u32);
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeded::Seeded;

    #[test]
    fn every_near_pair_is_found_once() {
        let mut seeded = Seeded::new(3);
        let mut cells = Cells::default();
        for case in 0..200 {
            let side = seeded.between(0.1, 3.0);
            let count = seeded.below(60) as u32;
            let disc = |owner| Disc {
                at: Vec2::new(seeded.between(-side, side), seeded.between(-side, side)),
                radius: seeded.between(0.0, 0.1),
                owner,
            };
            let discs: Vec<Disc> = (0..count).map(disc).collect();
            let apart = 0.05 * f64::from(case % 4);
            let is_near = |a: &Disc, b: &Disc| a.at.distance(b.at) < apart + a.radius + b.radius;
            let mut expected = Vec::new();
            for (rank, a) in discs.iter().enumerate() {
                let near = discs[rank + 1..].iter().filter(|b| is_near(a, b));
                expected.extend(near.map(|b| (a.owner, b.owner)));
            }
            let mut found = Vec::new();
            let mut near = |a: &Disc, b: &Disc| found.push((a.owner.min(b.owner), a.owner.max(b.owner)));
            cells.near_pairs(&discs, apart, &mut near);
            found.sort_unstable();
            assert_eq!(found, expected);
        }
    }
}
