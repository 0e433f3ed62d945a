//! Shapes with an inside, as closed rings.

use core::f64::consts::{FRAC_PI_2, TAU};

use lightbots_base::Vec2;

use super::kinds::{ShapeKind, ShapeSettings};

/// Number of points of a circle or heart. The chords of a circle are at most 0.03 % of its radius inside it.
const ROUND: usize = 128;

/// Returns the rings of a shape, about one unit in size before `aspect` widens them. `None` for kinds of shapes that
/// are lines or places.
pub(super) fn rings(settings: &ShapeSettings) -> Option<Vec<Vec<Vec2>>> {
    let wide = |ring: Vec<Vec2>| ring.into_iter().map(|at| Vec2::new(at.x * settings.aspect, at.y)).collect();
    let ring = match settings.kind {
        ShapeKind::Rectangle => {
            [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| Vec2::new(x, y)).to_vec()
        }
        ShapeKind::Circle => polygon(ROUND, 0.5),
        ShapeKind::Polygon => polygon(settings.count.max(3), 0.5),
        ShapeKind::Star => star(settings.count.max(2), settings.inner.max(0.05)),
        ShapeKind::Heart => heart(),
        ShapeKind::Arrow => arrow(),
        _ => return None,
    };
    Some(vec![wide(ring)])
}

/// Returns the corners of a regular polygon on a circle, counter-clockwise, the first corner at the top.
pub(super) fn polygon(corners: usize, radius: f64) -> Vec<Vec2> {
    (0..corners).map(|index| Vec2::unit(FRAC_PI_2 + TAU * index as f64 / corners as f64) * radius).collect()
}

fn star(tips: usize, inner: f64) -> Vec<Vec2> {
    let radius = |index: usize| if index.is_multiple_of(2) { 0.5 } else { 0.5 * inner };
    (0..2 * tips)
        .map(|index| Vec2::unit(FRAC_PI_2 + TAU * index as f64 / (2 * tips) as f64) * radius(index))
        .collect()
}

/// Returns the heart curve, one unit wide: x = 16 sin³ t, y = 13 cos t − 5 cos 2t − 2 cos 3t − cos 4t, scaled.
fn heart() -> Vec<Vec2> {
    let point = |index: usize| {
        let t = TAU * index as f64 / ROUND as f64;
        let sin = libm::sin(t);
        let y =
            13.0 * libm::cos(t) - 5.0 * libm::cos(2.0 * t) - 2.0 * libm::cos(3.0 * t) - libm::cos(4.0 * t);
        Vec2::new(16.0 * sin * sin * sin, y) * (1.0 / 32.0)
    };
    (0..ROUND).map(point).collect()
}

/// Returns an arrow that points to the right.
fn arrow() -> Vec<Vec2> {
    [(-0.5, -0.12), (0.1, -0.12), (0.1, -0.35), (0.5, 0.0), (0.1, 0.35), (0.1, 0.12), (-0.5, 0.12)]
        .map(|(x, y)| Vec2::new(x, y))
        .to_vec()
}
