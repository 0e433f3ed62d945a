//! Traces the border of the thing that a mask marks, as smooth rings.

use lightbots_base::Vec2;

use crate::picture::bitmap::BitMask;

/// Number of rounds in which the mask is smoothed before its border is traced. Each round averages over three pixels.
/// Smoothing removes the steps of slanted edges.
const SMOOTHINGS: usize = 2;
/// Largest distance of a dropped point from the simplified ring, pixels.
const TOLERANCE: f64 = 0.5;
/// Rings with fewer points than this are dropped.
const POINTS_MIN: usize = 3;

/// Returns the border of a mask as rings. Unit: pixels; origin at the lower left, y upwards. Outer rings run
/// counter-clockwise, rings around holes clockwise.
pub fn rings(mask: &BitMask) -> Vec<Vec<Vec2>> {
    let field = Field::new(mask);
    let top = mask.rows() as f64;
    let upright = |point: Vec2| Vec2::new(point.x, top - point.y);
    field
        .rings()
        .into_iter()
        .map(|ring| simplified(&ring).into_iter().rev().map(upright).collect::<Vec<Vec2>>())
        .filter(|ring| ring.len() >= POINTS_MIN)
        .collect()
}

/// Width of the empty frame around the picture, pixels: one pixel wider than smoothing spreads.
const FRAME: usize = SMOOTHINGS + 1;

/// Share of each pixel that belongs to the thing, 0 to 1, with an empty frame around the picture.
struct Field {
    columns: usize,
    rows: usize,
    values: Vec<f32>,
}

impl Field {
    fn new(mask: &BitMask) -> Self {
        let (columns, rows) = (mask.columns + 2 * FRAME, mask.rows() + 2 * FRAME);
        let mut values = vec![0.0; columns * rows];
        for (index, inside) in mask.inside.iter().enumerate() {
            let (x, y) = (index % mask.columns, index / mask.columns);
            values[(y + FRAME) * columns + x + FRAME] = if *inside { 1.0 } else { 0.0 };
        }
        let mut field = Self { columns, rows, values };
        for _ in 0..SMOOTHINGS {
            field.smooth(1);
            field.smooth(columns);
        }
        field
    }

    /// Mixes each inner pixel with its two neighbours `step` away; the outermost pixels stay empty.
    fn smooth(&mut self, step: usize) {
        let before = self.values.clone();
        for row in 1..self.rows - 1 {
            for index in row * self.columns + 1..(row + 1) * self.columns - 1 {
                let sides = before[index - step] + before[index + step];
                self.values[index] = 0.5 * before[index] + 0.25 * sides;
            }
        }
    }

    /// Finds rings by marching squares: each cell of four pixels adds the segments of the border within it. The border
    /// crosses an edge between two pixels at most once, so the edge's number identifies the crossing.
    fn rings(&self) -> Vec<Vec<Vec2>> {
        const NONE: u32 = u32::MAX;
        let mut next = vec![NONE; self.values.len() * 2];
        for row in 0..self.rows - 1 {
            for column in 0..self.columns - 1 {
                let corner = row * self.columns + column;
                for (from, to) in self.pieces(corner) {
                    next[from] = to as u32;
                }
            }
        }
        let mut rings = Vec::new();
        for start in 0..next.len() {
            let mut ring = Vec::new();
            let mut edge = start;
            while next[edge] != NONE {
                ring.push(self.crossing(edge));
                edge = std::mem::replace(&mut next[edge], NONE) as usize;
            }
            if ring.len() >= POINTS_MIN {
                rings.push(ring);
            }
        }
        rings
    }

    fn is_inside(&self, index: usize) -> bool {
        self.values[index] >= 0.5
    }

    /// Returns the segments of the border in the cell whose upper left pixel is `corner`, each from one edge of the
    /// cell to another. The number of an edge is twice the index of its upper or left pixel, plus one if the edge is
    /// vertical.
    fn pieces(&self, corner: usize) -> Vec<(usize, usize)> {
        let below = corner + self.columns;
        let [a, b, c, d] = [corner, corner + 1, below + 1, below].map(|index| self.is_inside(index));
        let [top, right, bottom, left] = [corner * 2, corner * 2 + 3, below * 2, corner * 2 + 1];
        // Seen with y downwards, the thing is on the left of each segment.
        match (a, b, c, d) {
            (false, false, false, false) | (true, true, true, true) => vec![],
            (true, false, false, false) => vec![(top, left)],
            (false, true, false, false) => vec![(right, top)],
            (false, false, true, false) => vec![(bottom, right)],
            (false, false, false, true) => vec![(left, bottom)],
            (true, true, false, false) => vec![(right, left)],
            (false, true, true, false) => vec![(bottom, top)],
            (false, false, true, true) => vec![(left, right)],
            (true, false, false, true) => vec![(top, bottom)],
            (true, false, true, false) => vec![(top, left), (bottom, right)],
            (false, true, false, true) => vec![(right, top), (left, bottom)],
            (false, true, true, true) => vec![(left, top)],
            (true, false, true, true) => vec![(top, right)],
            (true, true, false, true) => vec![(right, bottom)],
            (true, true, true, false) => vec![(bottom, left)],
        }
    }

    /// Where the border crosses an edge between two pixels. Unit: pixels of the mask; origin at its upper left corner,
    /// y downwards.
    fn crossing(&self, edge: usize) -> Vec2 {
        let from = edge / 2;
        let vertical = edge % 2 == 1;
        let to = if vertical { from + self.columns } else { from + 1 };
        let (low, high) = (self.values[from], self.values[to]);
        let share = f64::from((0.5 - low) / (high - low));
        let place = |index: usize| index as f64 + 0.5 - FRAME as f64;
        let (x, y) = (place(from % self.columns), place(from / self.columns));
        if vertical { Vec2::new(x, y + share) } else { Vec2::new(x + share, y) }
    }
}

/// Returns a ring without the points that are within [`TOLERANCE`] of the segments between the remaining points
/// (Douglas and Peucker 1973).
fn simplified(ring: &[Vec2]) -> Vec<Vec2> {
    let Some(first) = ring.first() else { return Vec::new() };
    let farthest =
        (0..ring.len()).max_by(|a, b| ring[*a].distance(*first).total_cmp(&ring[*b].distance(*first)));
    let middle = farthest.unwrap_or(0);
    let mut closed = ring.to_vec();
    closed.push(*first);
    let mut kept = vec![false; closed.len()];
    kept[0] = true;
    kept[middle] = true;
    let mut spans = vec![(0, middle), (middle, closed.len() - 1)];
    while let Some((from, to)) = spans.pop() {
        let away = |n: usize| lightbots_base::shape::point_to_segment(closed[n], closed[from], closed[to]);
        let worst = (from + 1..to).map(|n| (n, away(n))).max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((n, _)) = worst.filter(|(_, distance)| *distance > TOLERANCE) {
            kept[n] = true;
            spans.extend([(from, n), (n, to)]);
        }
    }
    ring.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(ring: &[Vec2]) -> f64 {
        ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b)).sum::<f64>() / 2.0
    }

    #[test]
    fn rings_run_around_things_and_holes() {
        let inside = |index: usize| {
            let (x, y) = ((index % 60) as f64 + 0.5, (index / 60) as f64 + 0.5);
            (8.0..20.0).contains(&libm::hypot(x - 30.0, y - 22.0))
        };
        let mask = BitMask { columns: 60, inside: (0..60 * 50).map(inside).collect() };
        let rings = rings(&mask);
        assert_eq!(rings.len(), 2);
        for (ring, (radius, sign)) in rings.iter().zip([(20.0, 1.0), (8.0, -1.0)]) {
            let disc = std::f64::consts::PI * radius * radius;
            assert!((area(ring) * sign / disc - 1.0).abs() < 0.05, "{} {disc}", area(ring));
            let worst =
                ring.iter().map(|at| (at.distance(Vec2::new(30.0, 28.0)) - radius).abs()).fold(0.0, f64::max);
            assert!(worst < 0.8, "{worst}");
        }
    }

    #[test]
    fn squares_keep_their_corners_and_the_edge_of_the_picture() {
        let mask = BitMask { columns: 40, inside: vec![true; 1600] };
        let rings = rings(&mask);
        assert_eq!(rings.len(), 1);
        assert!((area(&rings[0]) - 1600.0).abs() < 40.0, "{}", area(&rings[0]));
        assert!(rings[0].iter().all(|at| (-0.01..=40.01).contains(&at.x) && (-0.01..=40.01).contains(&at.y)));
        assert!(rings[0].len() <= 12, "{:?}", rings[0]);
    }

    #[test]
    fn checkers_touching_at_corners_make_closed_rings() {
        let mask = BitMask {
            columns: 8,
            inside: (0..64).map(|index| (index / 16 + index % 8 / 2) % 2 == 0).collect(),
        };
        let all = rings(&mask);
        assert!(all.iter().all(|ring| ring.len() >= POINTS_MIN) && !all.is_empty());
        assert!(rings(&BitMask { columns: 8, inside: vec![false; 64] }).is_empty());
    }
}
