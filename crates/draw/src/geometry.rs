//! Bounding boxes, winding numbers and hexagonal grids.

use lightbots_base::Vec2;

/// Which points count as inside where rings overlap, as in SVG.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FillRule {
    /// Points around which the rings wind at least once in total: the winding number is not 0.
    #[default]
    NonZero,
    /// Points from which a ray crosses the rings an odd number of times.
    EvenOdd,
}

/// Returns the smallest rectangle with sides along the axes around points: its corners with the smaller and the larger
/// x and y. `None` if there are no points.
pub fn bounds<'a>(points: impl IntoIterator<Item = &'a Vec2>) -> Option<(Vec2, Vec2)> {
    points.into_iter().map(|point| (*point, *point)).reduce(|(low, high), (point, _)| {
        let low = Vec2::new(low.x.min(point.x), low.y.min(point.y));
        (low, Vec2::new(high.x.max(point.x), high.y.max(point.y)))
    })
}

/// Edges of closed rings: pairs of successive points. The last pair joins a ring's last point with its first.
pub(crate) fn edges(rings: &[Vec<Vec2>]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    rings.iter().flat_map(|ring| ring.iter().copied().zip(ring.iter().copied().cycle().skip(1)))
}

/// Whether a point is inside rings, which may overlap.
pub(crate) fn contains(rings: &[Vec<Vec2>], rule: FillRule, point: Vec2) -> bool {
    let winding: i32 = edges(rings).map(|(a, b)| winding(a, b, point)).sum();
    match rule {
        FillRule::NonZero => winding != 0,
        FillRule::EvenOdd => winding % 2 != 0,
    }
}

/// Returns what the edge from `a` to `b` adds to the winding number of a point. It is 1 if the edge passes upwards on
/// the right of the point, −1 if it passes downwards there, else 0.
fn winding(a: Vec2, b: Vec2, point: Vec2) -> i32 {
    let left = (b - a).cross(point - a);
    match (a.y <= point.y, b.y <= point.y) {
        (true, false) if left > 0.0 => 1,
        (false, true) if left < 0.0 => -1,
        _ => 0,
    }
}

/// Distance between neighbours in a hexagonal grid of `count` places that fills an area: the most even way of filling.
pub(crate) fn hexagonal_spacing(area: f64, count: usize) -> f64 {
    (2.0 * area / (3.0_f64.sqrt() * count.max(1) as f64)).sqrt()
}

/// Area that a hexagonal grid of `count` places takes at this spacing.
pub(crate) fn hexagonal_area(count: usize, spacing: f64) -> f64 {
    3.0_f64.sqrt() / 2.0 * spacing * spacing * count as f64
}

/// Number of places of a hexagonal grid with this spacing in an area, may be fractional; 0 for a negative area.
pub(crate) fn hexagonal_count(area: f64, spacing: f64) -> f64 {
    area.max(0.0) / hexagonal_area(1, spacing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_in_a_ring_is_a_hole_by_the_even_odd_rule_only() {
        let square = |low: f64, high: f64| {
            [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Vec2::new(x, y)).to_vec()
        };
        let rings = [square(0.0, 4.0), square(1.0, 3.0)];
        let inside = |x: f64, rule| contains(&rings, rule, Vec2::new(x, 2.0));
        assert!(inside(2.0, FillRule::NonZero) && !inside(2.0, FillRule::EvenOdd));
        assert!(inside(0.5, FillRule::NonZero) && inside(0.5, FillRule::EvenOdd));
        assert!(!inside(5.0, FillRule::NonZero) && !inside(-1.0, FillRule::EvenOdd));
        assert_eq!(bounds(rings.iter().flatten()), Some((Vec2::ZERO, Vec2::new(4.0, 4.0))));
    }

    #[test]
    fn spacing_and_count_of_a_hexagonal_grid_agree() {
        assert!((hexagonal_count(3.0, hexagonal_spacing(3.0, 70)) - 70.0).abs() < 1e-9);
    }
}
