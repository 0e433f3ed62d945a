//! Least distance of a cubic Bézier curve from the origin, proven by convex hulls of its control points.

use lightbots_base::Vec2;

/// The four control points of a cubic Bézier curve.
pub(super) type Cubic = [Vec2; 4];

/// Largest error of distances, metres, unless the search for them is cut short.
const TOLERANCE_M: f64 = 1e-7;
/// Most parts that are divided; curves on a floor need some dozens. All further parts count with the distance of their
/// hulls, which is a lower bound.
const MOST_PARTS: usize = 100_000;
/// Most successive divisions of a part. Parts that are mostly halved become shorter than [`SHORTEST`] long before that.
const DEEPEST: usize = 62;
/// Parts whose range of the parameter is shorter than this are not divided any more.
const SHORTEST: f64 = 1e-7;

/// Returns the curve's least distance from the origin, metres, to [`TOLERANCE_M`], and the parameter there. `None` if
/// the curve is nowhere nearer than `enough`, or nearer by less than the tolerance. If the search is cut short, the
/// distance is a lower bound.
pub(super) fn nearest(curve: &Cubic, enough: f64) -> Option<(f64, f64)> {
    let mut search = Search { best: enough, at: None, parts: 0 };
    search.offer(curve[0].length(), 0.0);
    search.offer(curve[3].length(), 1.0);
    search.divide(curve, (0.0, 1.0), 0);
    search.at.map(|u| (search.best, u))
}

/// Branch and bound over parts of a curve.
struct Search {
    /// The least distance that was found, metres. Before the first find, the distance that it must be below.
    best: f64,
    /// Parameter of the curve's point at that distance; `None` before the first find.
    at: Option<f64>,
    parts: usize,
}

impl Search {
    fn offer(&mut self, distance: f64, u: f64) {
        if distance < self.best {
            (self.best, self.at) = (distance, Some(u));
        }
    }

    /// Searches a part of the curve, from one parameter to another (`between`). The part is the result of `depth`
    /// divisions.
    fn divide(&mut self, part: &Cubic, between: (f64, f64), depth: usize) {
        self.parts += 1;
        let lower = distance_of_hull(part);
        if lower >= self.best - TOLERANCE_M {
            return;
        }
        let (from, to) = between;
        if to - from < SHORTEST || depth > DEEPEST || self.parts > MOST_PARTS {
            self.offer(lower, from);
            return;
        }
        let share = foot(part).clamp(0.02, 0.98);
        let (left, right) = split(part, share);
        let middle = from + (to - from) * share;
        self.offer(left[3].length(), middle);
        // A straight part is done here: its nearest point is as near as its hull.
        if lower >= self.best - TOLERANCE_M {
            return;
        }
        self.divide(&right, (middle, to), depth + 1);
        self.divide(&left, (from, middle), depth + 1);
    }
}

/// Returns a lower bound of the curve's least distance from the origin, metres, by its convex hull.
pub(super) fn distance_of_hull(curve: &Cubic) -> f64 {
    let chord = curve[3] - curve[0];
    let share = share_of_foot(curve[0], chord);
    let Some(direction) = (curve[0] + chord * share).normalized() else { return 0.0 };
    curve.iter().fold(f64::INFINITY, |least, point| least.min(point.dot(direction))).max(0.0)
}

/// Returns the share in 0..=1 at which `start + share · chord` is nearest to the origin.
fn share_of_foot(start: Vec2, chord: Vec2) -> f64 {
    let length_squared = chord.length_squared();
    if length_squared > 0.0 { (-start.dot(chord) / length_squared).clamp(0.0, 1.0) } else { 0.5 }
}

/// Estimates the parameter of the curve's point nearest to the origin: a few Newton steps from the chord's point
/// nearest to the origin.
fn foot(curve: &Cubic) -> f64 {
    let mut u = share_of_foot(curve[0], curve[3] - curve[0]);
    for _ in 0..4 {
        let w = 1.0 - u;
        let (d0, d1, d2) = (curve[1] - curve[0], curve[2] - curve[1], curve[3] - curve[2]);
        let place = point(curve, u);
        let slope = (d0 * (w * w) + d1 * (2.0 * w * u) + d2 * (u * u)) * 3.0;
        let bend = ((d1 - d0) * w + (d2 - d1) * u) * 6.0;
        let second = slope.length_squared() + place.dot(bend);
        if second <= 0.0 {
            return 0.5;
        }
        u = (u - place.dot(slope) / second).clamp(0.0, 1.0);
    }
    // At an end, a division would cut nothing off, so the curve is halved.
    if u <= 1e-9 || u >= 1.0 - 1e-9 { 0.5 } else { u }
}

/// The curve's point at the parameter `u`.
pub(super) fn point(curve: &Cubic, u: f64) -> Vec2 {
    let w = 1.0 - u;
    curve[0] * (w * w * w)
        + curve[1] * (3.0 * w * w * u)
        + curve[2] * (3.0 * w * u * u)
        + curve[3] * (u * u * u)
}

/// Splits the curve at the parameter `u` into the curves before and after it (de Casteljau).
pub(super) fn split(curve: &Cubic, u: f64) -> (Cubic, Cubic) {
    let [a, b, c, d] = *curve;
    let (ab, bc, cd) = (a.lerp(b, u), b.lerp(c, u), c.lerp(d, u));
    let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
    let middle = abc.lerp(bcd, u);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

/// The curve between the parameters `from` and `to`, 0 ≤ from < to ≤ 1.
pub(super) fn part(curve: &Cubic, from: f64, to: f64) -> Cubic {
    let left = if to < 1.0 { split(curve, to).0 } else { *curve };
    if from > 0.0 { split(&left, from / to).1 } else { left }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A repeatable number in −1..1.
    fn number(state: &mut u64) -> f64 {
        (lightbots_base::random::congruential(state) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    #[test]
    fn the_nearest_point_is_never_farther_than_any_sample() {
        let mut state = 1;
        for _ in 0..500 {
            let curve = [(); 4].map(|()| Vec2::new(number(&mut state), number(&mut state)));
            let (distance, u) = nearest(&curve, f64::INFINITY).unwrap();
            let sampled = (0..=1000)
                .map(|step| point(&curve, f64::from(step) / 1000.0).length())
                .fold(f64::INFINITY, f64::min);
            assert!(distance <= sampled + 1e-6, "{distance} {sampled}");
            assert!((point(&curve, u).length() - distance).abs() < 1e-5);
        }
    }

    #[test]
    fn a_straight_line_passes_at_its_foot() {
        let from = Vec2::new(-1.0, 0.06);
        let to = Vec2::new(2.0, 0.06);
        let curve = [from, from, from.lerp(to, 1.0 / 3.0), to];
        let (distance, u) = nearest(&curve, 1.0).unwrap();
        assert!((distance - 0.06).abs() < 1e-6);
        assert!(point(&curve, u).x.abs() < 1e-3);
        assert_eq!(nearest(&curve, 0.05), None);
    }

    #[test]
    fn a_curve_through_the_origin_or_at_rest_there_is_at_distance_zero() {
        let line = [-1.0, -0.3, 0.3, 1.0].map(|x| Vec2::new(x, x));
        assert!(nearest(&line, 1.0).unwrap().0 < 1e-6);
        assert_eq!(nearest(&[Vec2::ZERO; 4], 1.0).unwrap().0, 0.0);
    }

    #[test]
    fn a_part_has_the_curves_points() {
        let curve = [Vec2::ZERO, Vec2::new(1.0, 2.0), Vec2::new(3.0, -1.0), Vec2::new(4.0, 0.5)];
        let part = part(&curve, 0.25, 0.75);
        for (own, whole) in [(0.0, 0.25), (0.5, 0.5), (1.0, 0.75)] {
            assert!((point(&part, own) - point(&curve, whole)).length() < 1e-12);
        }
    }
}
