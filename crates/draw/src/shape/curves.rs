//! Shapes that are lines.

use core::f64::consts::{FRAC_PI_2, TAU};

use lightbots_base::Vec2;

use super::closed::polygon;
use super::kinds::{ShapeKind, ShapeSettings};
use crate::geometry::bounds;

/// Number of points of a full turn of an arc, ring or spiral, or of a period of a wave.
const TURN: f64 = 96.0;

/// Number of straight segments between two given points of a curve.
const BETWEEN: usize = 12;

/// Returns the lines of a shape. Each line is its points, and whether its last point is joined to its first.
pub(super) fn lines(settings: &ShapeSettings) -> Vec<(Vec<Vec2>, bool)> {
    let points = &settings.points;
    match settings.kind {
        ShapeKind::Line if points.len() < 2 => vec![(vec![Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0)], false)],
        ShapeKind::Line => vec![(vec![points[0], points[points.len() - 1]], false)],
        ShapeKind::Curve => vec![(curve(points, settings.closed), settings.closed)],
        ShapeKind::Freehand => vec![(curve(&thinned(points), settings.closed), settings.closed)],
        ShapeKind::Arc => vec![(arc(settings.span), false)],
        ShapeKind::Rings => rings(settings),
        ShapeKind::Spiral => vec![(spiral(settings), false)],
        ShapeKind::Wave => vec![(wave(settings), false)],
        _ => vec![(points.clone(), settings.closed)],
    }
}

/// Returns points along a Catmull-Rom spline through `points` (Catmull and Rom 1974).
fn curve(points: &[Vec2], closed: bool) -> Vec<Vec2> {
    let count = points.len();
    if count < 3 {
        return points.to_vec();
    }
    let at = |index: i64| {
        let index = if closed { index.rem_euclid(count as i64) } else { index.clamp(0, count as i64 - 1) };
        points[index as usize]
    };
    let pieces = if closed { count } else { count - 1 };
    let mut line = Vec::with_capacity(pieces * BETWEEN + 1);
    for piece in 0..pieces as i64 {
        let [a, b, c, d] = [at(piece - 1), at(piece), at(piece + 1), at(piece + 2)];
        for step in 0..BETWEEN {
            let t = step as f64 / BETWEEN as f64;
            let linear = (c - a) * (0.5 * t);
            let square = (a * 2.0 - b * 5.0 + c * 4.0 - d) * (0.5 * t * t);
            let cube = (b * 3.0 - a - c * 3.0 + d) * (0.5 * t * t * t);
            line.push(b + linear + square + cube);
        }
    }
    if !closed {
        line.push(points[count - 1]);
    }
    line
}

/// Drops points that are close to the point before, but keeps the last point. Points of a mouse are close together and
/// follow every tremble of the hand.
fn thinned(points: &[Vec2]) -> Vec<Vec2> {
    let (low, high) = bounds(points).unwrap_or_default();
    let least = 0.02 * (high - low).length();
    let mut kept: Vec<Vec2> = Vec::new();
    for point in points {
        if kept.last().is_none_or(|last| last.distance(*point) >= least) {
            kept.push(*point);
        }
    }
    if let (Some(end), Some(last)) = (points.last(), kept.last_mut())
        && last.distance(*end) < least
    {
        *last = *end;
    }
    kept
}

/// Returns an arc of the angle `span`, radians, on a circle of diameter 1. The arc is symmetric about the upward
/// direction.
fn arc(span: f64) -> Vec<Vec2> {
    let pieces = (span / TAU * TURN).ceil().max(2.0) as usize;
    let angle = |index: usize| FRAC_PI_2 + span * (0.5 - index as f64 / pieces as f64);
    (0..=pieces).map(|index| Vec2::unit(angle(index)) * 0.5).collect()
}

fn rings(settings: &ShapeSettings) -> Vec<(Vec<Vec2>, bool)> {
    let count = settings.count;
    let share = |index: usize| if count > 1 { index as f64 / (count - 1) as f64 } else { 1.0 };
    let radius = |index: usize| 0.5 * (settings.inner + (1.0 - settings.inner) * share(index)).max(0.02);
    (0..count).map(|index| (polygon(TURN as usize, radius(index)), true)).collect()
}

/// Returns an Archimedean spiral of diameter 1, from its inner end outwards, clockwise.
fn spiral(settings: &ShapeSettings) -> Vec<Vec2> {
    let pieces = (settings.turns * TURN).ceil().max(8.0) as usize;
    let point = |index: usize| {
        let share = index as f64 / pieces as f64;
        let radius = 0.5 * (settings.inner + (1.0 - settings.inner) * share);
        Vec2::unit(FRAC_PI_2 - TAU * settings.turns * share) * radius
    };
    (0..=pieces).map(point).collect()
}

/// Returns a sine wave, one unit high and `aspect` units wide.
fn wave(settings: &ShapeSettings) -> Vec<Vec2> {
    let pieces = (settings.turns * TURN).ceil().max(8.0) as usize;
    let point = |index: usize| {
        let share = index as f64 / pieces as f64;
        Vec2::new((share - 0.5) * settings.aspect, 0.5 * libm::sin(TAU * settings.turns * share))
    };
    (0..=pieces).map(point).collect()
}
