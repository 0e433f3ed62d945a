//! Sorts points into square buckets of a grid, to find the nearest point and all near pairs quickly.

use lightbots_base::Vec2;

/// Largest number of buckets along an axis and, about, in total. Without this bound a thin drawing would have very many
/// empty buckets.
const MOST: f64 = 4e6;

#[cfg(test)]
thread_local! {
    /// Number of buckets and points that searches of this thread have visited. Tests bound the work by it.
    pub(crate) static LOOKED: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

/// Points in buckets. Point indices refer to the list that the buckets were made from.
pub(crate) struct Buckets<'a> {
    points: &'a [Vec2],
    min: Vec2,
    pitch: f64,
    columns: i64,
    rows: i64,
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl<'a> Buckets<'a> {
    /// Sorts points into buckets of side `pitch`, or larger if there would be too many. All coordinates must be finite.
    pub fn new(points: &'a [Vec2], pitch: f64) -> Self {
        let mut min = points.first().copied().unwrap_or_default();
        let mut max = min;
        for point in points {
            min = Vec2::new(min.x.min(point.x), min.y.min(point.y));
            max = Vec2::new(max.x.max(point.x), max.y.max(point.y));
        }
        let size = max - min;
        let pitch = pitch.max((size.x * size.y / MOST).sqrt()).max(size.x.max(size.y) / MOST).max(1e-12);
        let (columns, rows) = ((size.x / pitch) as i64 + 1, (size.y / pitch) as i64 + 1);
        let mut buckets = Self { points, min, pitch, columns, rows, starts: Vec::new(), items: Vec::new() };
        buckets.sort();
        buckets
    }

    fn sort(&mut self) {
        let mut starts = vec![0_u32; (self.columns * self.rows + 1) as usize];
        let bucket = |point: &Vec2| {
            let (column, row) = self.bucket(*point);
            (row * self.columns + column) as usize
        };
        for point in self.points {
            starts[bucket(point) + 1] += 1;
        }
        for index in 1..starts.len() {
            starts[index] += starts[index - 1];
        }
        let mut next = starts.clone();
        let mut items = vec![0; self.points.len()];
        for (index, point) in self.points.iter().enumerate() {
            let slot = &mut next[bucket(point)];
            items[*slot as usize] = index as u32;
            *slot += 1;
        }
        self.items = items;
        self.starts = starts;
    }

    fn bucket(&self, at: Vec2) -> (i64, i64) {
        let index = |value: f64, count: i64| ((value / self.pitch) as i64).clamp(0, count - 1);
        (index(at.x - self.min.x, self.columns), index(at.y - self.min.y, self.rows))
    }

    /// Returns the index of the point nearest to `at`, and the square of its distance. `None` if there are no points.
    pub fn nearest(&self, at: Vec2) -> Option<(usize, f64)> {
        let (column, row) = self.bucket(at);
        let mut best: Option<(usize, f64)> = None;
        for ring in 0..self.columns.max(self.rows) {
            if ring > 0 && best.is_some_and(|(_, square)| self.square_to_ring(at, column, row, ring) > square)
            {
                break;
            }
            self.ring(column, row, ring, &mut |index| {
                let square = (self.points[index] - at).length_squared();
                if best.is_none_or(|(_, least)| square < least) {
                    best = Some((index, square));
                }
            });
        }
        best
    }

    /// Returns a lower bound of the squared distance from `at` to points in far buckets. Far buckets have a Chebyshev
    /// distance of `ring` or more from the bucket (`column`, `row`). The bound is infinite if there are no such
    /// buckets.
    fn square_to_ring(&self, at: Vec2, column: i64, row: i64, ring: i64) -> f64 {
        let gap = |value: f64, index: i64, count: i64| {
            let low = value - (index - ring + 1) as f64 * self.pitch;
            let high = (index + ring) as f64 * self.pitch - value;
            let low = if index >= ring { low } else { f64::INFINITY };
            low.min(if index + ring < count { high } else { f64::INFINITY })
        };
        // A query outside the box around the buckets is at least as far from every point as from the box.
        let outside = |value: f64, count: i64| (-value).max(value - count as f64 * self.pitch).max(0.0);
        let at = at - self.min;
        let (x, y) = (gap(at.x, column, self.columns), gap(at.y, row, self.rows));
        let (out_x, out_y) = (outside(at.x, self.columns), outside(at.y, self.rows));
        (x * x + out_y * out_y).min(y * y + out_x * out_x)
    }

    /// Calls `found` with the index of each point in the buckets at Chebyshev distance `ring` from the bucket
    /// (`column`, `row`).
    fn ring(&self, column: i64, row: i64, ring: i64, found: &mut impl FnMut(usize)) {
        let (first, last) = ((column - ring).max(0), (column + ring).min(self.columns - 1));
        for y in (row - ring).max(0)..=(row + ring).min(self.rows - 1) {
            if (y - row).abs() == ring {
                self.row(first, last, y, found);
                continue;
            }
            for x in [column - ring, column + ring] {
                if (0..self.columns).contains(&x) {
                    self.row(x, x, y, found);
                }
            }
        }
    }

    fn row(&self, first: i64, last: i64, y: i64, found: &mut impl FnMut(usize)) {
        let from = self.starts[(y * self.columns + first) as usize] as usize;
        let to = self.starts[(y * self.columns + last + 1) as usize] as usize;
        #[cfg(test)]
        LOOKED.with(|looked| looked.set(looked.get() + (last - first + 1) as u64 + (to - from) as u64));
        for item in &self.items[from..to] {
            found(*item as usize);
        }
    }

    /// Calls `found` for each pair of points closer than `distance`: both indices, the smaller first, and their
    /// distance.
    pub fn pairs(&self, distance: f64, mut found: impl FnMut(usize, usize, f64)) {
        let reach = (distance / self.pitch).ceil() as i64;
        for (index, point) in self.points.iter().enumerate() {
            let (column, row) = self.bucket(*point);
            let (first, last) = ((column - reach).max(0), (column + reach).min(self.columns - 1));
            for y in (row - reach).max(0)..=(row + reach).min(self.rows - 1) {
                self.row(first, last, y, &mut |other| {
                    let length = self.points[other].distance(*point);
                    if other > index && length < distance {
                        found(index, other, length);
                    }
                });
            }
        }
    }
}

/// `[point]`: distance to the nearest other point; infinite for a single point. `pitch` is the first search radius; the
/// result does not depend on it.
pub(crate) fn nearest_distances(points: &[Vec2], pitch: f64) -> Vec<f64> {
    let mut distances = vec![f64::INFINITY; points.len()];
    let buckets = Buckets::new(points, pitch);
    let mut reach = pitch;
    while distances.iter().any(|distance| distance.is_infinite()) && points.len() > 1 {
        buckets.pairs(reach, |a, b, length| {
            distances[a] = distances[a].min(length);
            distances[b] = distances[b].min(length);
        });
        reach *= 2.0;
    }
    distances
}

/// Distance of the closest pair of points, in the unit of the points; infinite for fewer than two points.
pub fn closest_distance(points: &[Vec2]) -> f64 {
    nearest_distances(points, 0.1).into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::random::split_mix;

    fn random(count: usize, seed: u64) -> Vec<Vec2> {
        let mut state = seed;
        let mut unit = || (split_mix(&mut state) >> 11) as f64 / (1_u64 << 53) as f64;
        (0..count).map(|_| Vec2::new(unit() * 3.0, unit())).collect()
    }

    #[test]
    fn the_nearest_of_all_points_is_found_from_inside_and_outside() {
        let points = random(200, 1);
        for pitch in [0.01, 0.1, 5.0] {
            let buckets = Buckets::new(&points, pitch);
            for query in random(100, 2).iter().map(|at| *at * 2.0 - Vec2::new(1.0, 0.5)) {
                let least =
                    points.iter().map(|point| (*point - query).length_squared()).fold(f64::MAX, f64::min);
                assert_eq!(buckets.nearest(query).unwrap().1, least, "pitch {pitch}");
            }
        }
        assert_eq!(Buckets::new(&[], 1.0).nearest(Vec2::ZERO), None);
    }

    #[test]
    fn a_search_from_outside_looks_at_a_small_part() {
        let points = random(30_000, 4);
        let buckets = Buckets::new(&points, 0.01);
        for query in [Vec2::new(-0.01, 0.5), Vec2::new(1.5, 40.0), Vec2::new(900.0, -900.0)] {
            let before = LOOKED.get();
            buckets.nearest(query);
            let looked = LOOKED.get() - before;
            assert!(looked < 3_000, "{query:?} looked at {looked} buckets and points");
        }
    }

    #[test]
    fn pairs_and_distances_are_those_of_all_pairs() {
        let points = random(150, 3);
        let mut expected = 0;
        for (index, a) in points.iter().enumerate() {
            expected += points[index + 1..].iter().filter(|b| b.distance(*a) < 0.2).count();
        }
        let mut count = 0;
        Buckets::new(&points, 0.07).pairs(0.2, |_, _, _| count += 1);
        assert_eq!(count, expected);
        let distances = nearest_distances(&points, 0.01);
        for (index, distance) in distances.iter().enumerate() {
            let others = points.iter().enumerate().filter(|(other, _)| *other != index);
            let least = others.map(|(_, other)| other.distance(points[index])).fold(f64::MAX, f64::min);
            assert_eq!(*distance, least);
        }
    }
}
