//! Weights of the four control points that determine a span of a uniform cubic B-spline.

use lightbots_base::Vec2;

/// Weights of a span's four control points at the share `u` of the span, 0 to 1.
pub(crate) fn basis(u: f64) -> [f64; 4] {
    let w = 1.0 - u;
    let (u2, u3) = (u * u, u * u * u);
    [
        w * w * w / 6.0,
        (3.0 * u3 - 6.0 * u2 + 4.0) / 6.0,
        (-3.0 * u3 + 3.0 * u2 + 3.0 * u + 1.0) / 6.0,
        u3 / 6.0,
    ]
}

/// Weighted sum of a span's four control points.
#[inline]
pub(crate) fn blend(points: &[Vec2], weights: &[f64; 4]) -> Vec2 {
    points[0] * weights[0] + points[1] * weights[1] + points[2] * weights[2] + points[3] * weights[3]
}

/// Adds the weights of the control points at the ends of a spline, which follow free points, to the weights of those
/// free points. Points 2 to `last` are free. `spare`: whether the robot is spare and comes to rest at its last free
/// point.
pub(crate) fn fold(weights: &[f64; 4], span: usize, last: usize, spare: bool) -> [f64; 4] {
    if span >= 2 && span + 3 <= last {
        return *weights;
    }
    let mut folded = [0.0; 4];
    for (i, &weight) in weights.iter().enumerate() {
        let point = span + i;
        let (to, share) = match point {
            0 => (2, 1.0),
            1 => (2, -0.5),
            _ if point == last + 1 => (last, if spare { 1.0 } else { -0.5 }),
            _ if point == last + 2 => (last, 1.0),
            _ => (point, 1.0),
        };
        folded[to - span] += weight * share;
    }
    folded
}
