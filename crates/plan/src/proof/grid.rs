//! Finds pairs of boxes that are near each other.

use lightbots_base::Vec2;

/// A box with sides along the axes, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub min: Vec2,
    pub max: Vec2,
}

impl Bounds {
    /// A box that contains nothing.
    pub const EMPTY: Self = Self {
        min: Vec2::new(f64::INFINITY, f64::INFINITY),
        max: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    pub fn include(&mut self, place: Vec2) {
        self.min = Vec2::new(self.min.x.min(place.x), self.min.y.min(place.y));
        self.max = Vec2::new(self.max.x.max(place.x), self.max.y.max(place.y));
    }

    /// The least squared distance between two boxes, square metres; 0 if they overlap.
    pub fn distance_squared(&self, other: &Self) -> f64 {
        let x = (self.min.x - other.max.x).max(other.min.x - self.max.x).max(0.0);
        let y = (self.min.y - other.max.y).max(other.min.y - self.max.y).max(0.0);
        x * x + y * y
    }

    fn centre(&self) -> Vec2 {
        self.min.lerp(self.max, 0.5)
    }
}

/// Most cells along one side of the grid.
const MOST_CELLS: f64 = 1024.0;

/// Calls `near(i, j)`, i < j, once for each pair of boxes that are nearer to each other than `reach_m` metres.
pub(super) fn near_pairs(boxes: &[Bounds], reach_m: f64, mut near: impl FnMut(usize, usize)) {
    let mut whole = Bounds::EMPTY;
    let mut side = 0.0f64;
    for bounds in boxes {
        whole.include(bounds.centre());
        side = side.max(bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y);
    }
    let extent = whole.max - whole.min;
    let fewest = extent.x.max(extent.y) / MOST_CELLS.min(2.0 * (boxes.len() as f64).sqrt() + 1.0);
    let cell = (reach_m + side).max(fewest).max(1e-6);
    let columns = if cell.is_finite() { (extent.x / cell) as usize + 1 } else { 1 };
    let rows = if cell.is_finite() { (extent.y / cell) as usize + 1 } else { 1 };
    let cell_of = |bounds: &Bounds| {
        let offset = (bounds.centre() - whole.min) / cell;
        (offset.y as usize).min(rows - 1) * columns + (offset.x as usize).min(columns - 1)
    };
    // Counting sort: `order[first[c]..first[c + 1]]` are the boxes of cell c.
    let cells: Vec<usize> = boxes.iter().map(cell_of).collect();
    let mut first = vec![0usize; rows * columns + 1];
    cells.iter().for_each(|&cell| first[cell + 1] += 1);
    (0..rows * columns).for_each(|cell| first[cell + 1] += first[cell]);
    let mut next = first.clone();
    let mut order = vec![0usize; boxes.len()];
    for (index, &cell) in cells.iter().enumerate() {
        order[next[cell]] = index;
        next[cell] += 1;
    }
    let reach_squared = reach_m * reach_m;
    for row in 0..rows {
        for column in 0..columns {
            let cell = row * columns + column;
            // The cell to the right, and the three above, which follow each other in order.
            let right = if column + 1 < columns { first[cell + 1]..first[cell + 2] } else { 0..0 };
            let above = if row + 1 < rows {
                first[cell + columns - column.min(1)]
                    ..first[cell + columns + 1 + usize::from(column + 1 < columns)]
            } else {
                0..0
            };
            for rank in first[cell]..first[cell + 1] {
                let i = order[rank];
                for other in (rank + 1..first[cell + 1]).chain(right.clone()).chain(above.clone()) {
                    let j = order[other];
                    if boxes[i].distance_squared(&boxes[j]) < reach_squared {
                        near(i.min(j), i.max(j));
                    }
                }
            }
        }
    }
}
