//! Distances of points, segments and axis-parallel rectangles, metres.

use crate::Vec2;

/// The point of a rectangle that is nearest to `point`; `point` itself if it lies inside.
#[inline]
pub fn nearest_in_rect(point: Vec2, min: Vec2, max: Vec2) -> Vec2 {
    Vec2::new(point.x.max(min.x).min(max.x), point.y.max(min.y).min(max.y))
}

/// Distance of a point from the segment `a`–`b`.
#[inline]
pub fn point_to_segment(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    libm::sqrt(point_to_segment_squared(point, a, b))
}

/// Square of the distance of a point from the segment `a`–`b`.
#[inline]
pub fn point_to_segment_squared(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * share - point).length_squared()
}

/// Distance of two segments; 0 where they cross or touch.
pub fn segment_to_segment(a: (Vec2, Vec2), b: (Vec2, Vec2)) -> f64 {
    let side = |segment: (Vec2, Vec2), point: Vec2| (segment.1 - segment.0).cross(point - segment.0);
    let crosses = side(a, b.0) * side(a, b.1) < 0.0 && side(b, a.0) * side(b, a.1) < 0.0;
    if crosses {
        return 0.0;
    }
    let nearest = point_to_segment_squared(b.0, a.0, a.1)
        .min(point_to_segment_squared(b.1, a.0, a.1))
        .min(point_to_segment_squared(a.0, b.0, b.1))
        .min(point_to_segment_squared(a.1, b.0, b.1));
    libm::sqrt(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn at(x: f64, y: f64) -> Vec2 {
        Vec2 { x, y }
    }

    #[test]
    fn points_are_as_far_as_the_nearest_of_a_segment() {
        let (a, b) = (at(0.0, 0.0), at(2.0, 0.0));
        assert_eq!(point_to_segment(at(1.0, 3.0), a, b), 3.0);
        assert_eq!(point_to_segment(at(5.0, 4.0), a, b), 5.0);
        assert_eq!(point_to_segment(at(3.0, 4.0), a, a), 5.0);
    }

    #[test]
    fn segments_that_cross_touch() {
        let cross = (at(-1.0, -1.0), at(1.0, 1.0));
        assert_eq!(segment_to_segment(cross, (at(-1.0, 1.0), at(1.0, -1.0))), 0.0);
        assert_eq!(segment_to_segment((at(0.0, 0.0), at(1.0, 0.0)), (at(0.0, 2.0), at(5.0, 2.0))), 2.0);
    }

    #[test]
    fn the_nearest_point_of_a_rectangle_is_on_its_rim_or_the_point_itself() {
        let (min, max) = (at(0.0, 0.0), at(2.0, 1.0));
        assert_eq!(nearest_in_rect(at(3.0, 0.5), min, max), at(2.0, 0.5));
        assert_eq!(nearest_in_rect(at(1.0, 0.5), min, max), at(1.0, 0.5));
        assert_eq!(nearest_in_rect(at(-1.0, -1.0), min, max), min);
    }
}
