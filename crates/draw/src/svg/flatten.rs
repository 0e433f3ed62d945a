//! Approximates curves by points that are joined by straight lines.

use usvg::tiny_skia_path::{Path, PathSegment, Point, Transform};

/// A point, in units of the page, y down.
pub type Spot = [f64; 2];

/// Points joined by straight lines.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatLine {
    /// The points, at least two. A closed line does not repeat its first point at the end.
    pub points: Vec<Spot>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

/// Largest turn between successive chords of a curve, radians. It is smaller than the turn of any corner that robots
/// could show.
const TURN_MAX: f64 = 0.2;
/// Largest number of chords of one curve.
const CHORDS_MAX: f64 = 64.0;

/// If a line has more points than this, each further curve becomes a single chord. This keeps memory in proportion to
/// the size of the file.
const POINTS_FINE: usize = 200_000;

/// Returns the lines of a path on the page. `transform` maps the path to the page. Chords are at most about `tolerance`
/// from their curves, in units of the page.
pub fn polylines(path: &Path, transform: Transform, tolerance: f64) -> Vec<FlatLine> {
    let place = |point: Point| -> Spot {
        let (x, y) = (f64::from(point.x), f64::from(point.y));
        let Transform { sx, kx, ky, sy, tx, ty } = transform;
        [
            f64::from(sx) * x + f64::from(kx) * y + f64::from(tx),
            f64::from(ky) * x + f64::from(sy) * y + f64::from(ty),
        ]
    };
    let mut lines: Vec<FlatLine> = Vec::new();
    let mut current: Vec<Spot> = Vec::new();
    for segment in path.segments() {
        let from = current.last().copied();
        match (segment, from) {
            (PathSegment::MoveTo(to), _) => {
                finish(&mut lines, std::mem::take(&mut current), false, tolerance);
                current.push(place(to));
            }
            (PathSegment::LineTo(to), _) => current.push(place(to)),
            (PathSegment::QuadTo(control, to), Some(from)) => {
                let [control, to] = [place(control), place(to)];
                let [first, second] = [mixed(from, control, 2.0 / 3.0), mixed(to, control, 2.0 / 3.0)];
                curve(&mut current, [from, first, second, to], tolerance);
            }
            (PathSegment::CubicTo(first, second, to), Some(from)) => {
                curve(&mut current, [from, place(first), place(second), place(to)], tolerance);
            }
            (PathSegment::Close, Some(_)) => {
                let start = current.first().copied();
                finish(&mut lines, std::mem::take(&mut current), true, tolerance);
                current.extend(start);
            }
            (_, None) => {}
        }
    }
    finish(&mut lines, current, false, tolerance);
    lines
}

/// Adds a line to `lines`, without points that nearly coincide with the point before. A line of more than three points
/// whose two ends nearly coincide becomes closed. A line with fewer than two points left is dropped.
fn finish(lines: &mut Vec<FlatLine>, mut points: Vec<Spot>, closed: bool, tolerance: f64) {
    let near = |a: &Spot, b: &Spot| distance(*a, *b) < tolerance * 0.1;
    points.dedup_by(|b, a| near(a, b));
    let returns = points.len() > 3 && points.first().zip(points.last()).is_some_and(|(a, b)| near(a, b));
    if points.len() > 2 && points.first().zip(points.last()).is_some_and(|(a, b)| near(a, b)) {
        points.pop();
    }
    if points.len() >= 2 {
        lines.push(FlatLine { points, closed: closed || returns });
    }
}

/// Appends the points of the chords of a cubic curve, without the curve's first point.
fn curve(points: &mut Vec<Spot>, control: [Spot; 4], tolerance: f64) {
    let chords = if points.len() > POINTS_FINE { 1 } else { chords(control, tolerance) };
    points.extend((1..=chords).map(|n| cubic(control, n as f64 / chords as f64)));
}

/// Returns the number of chords for a cubic curve. It is enough to stay within `tolerance` of the curve and to turn by
/// less than [`TURN_MAX`] each time, but at most [`CHORDS_MAX`]. The turn of a curve smaller than `tolerance` does not
/// matter.
fn chords([a, b, c, d]: [Spot; 4], tolerance: f64) -> usize {
    let bend = |p: Spot, q: Spot, r: Spot| libm::hypot(p[0] - 2.0 * q[0] + r[0], p[1] - 2.0 * q[1] + r[1]);
    // The distance of a curve from its chord is at most an eighth of its largest second derivative.
    let by_distance = libm::sqrt(6.0 * bend(a, b, c).max(bend(b, c, d)) / (8.0 * tolerance));
    let turn = |p: Spot, q: Spot, r: Spot| {
        let [u, v] = [[q[0] - p[0], q[1] - p[1]], [r[0] - q[0], r[1] - q[1]]];
        libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]).abs()
    };
    let small = [a, b, c, d].into_iter().all(|point| distance(point, a) < tolerance);
    let by_turn = if small { 1.0 } else { (turn(a, b, c) + turn(b, c, d)) / TURN_MAX };
    libm::ceil(by_distance.max(by_turn)).clamp(1.0, CHORDS_MAX) as usize
}

fn cubic([a, b, c, d]: [Spot; 4], t: f64) -> Spot {
    let [ab, bc, cd] = [mixed(a, b, t), mixed(b, c, t), mixed(c, d, t)];
    mixed(mixed(ab, bc, t), mixed(bc, cd, t), t)
}

fn mixed(a: Spot, b: Spot, share: f64) -> Spot {
    [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share]
}

/// Distance between two points.
pub fn distance(a: Spot, b: Spot) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use usvg::tiny_skia_path::PathBuilder;

    #[test]
    fn chords_of_a_circle_stay_within_the_tolerance() {
        let mut builder = PathBuilder::new();
        builder.move_to(1.0, 0.0);
        // Four cubic curves with this handle deviate from a circle by at most 0.03 %.
        let handle = 0.5523;
        for [x, y] in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0f32]] {
            builder.cubic_to(x - y * handle, y + x * handle, -y + x * handle, x + y * handle, -y, x);
        }
        builder.close();
        let circle = builder.finish().expect("it has curves");
        let lines = polylines(&circle, Transform::from_scale(100.0, 100.0), 0.1);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].closed);
        let middles =
            lines[0].points.iter().zip(lines[0].points.iter().skip(1)).map(|(a, b)| mixed(*a, *b, 0.5));
        let worst = middles.map(|middle| (distance(middle, [0.0, 0.0]) - 100.0).abs()).fold(0.0, f64::max);
        assert!(worst < 0.13, "{worst}");
        assert!((20..80).contains(&lines[0].points.len()), "{}", lines[0].points.len());
    }

    #[test]
    fn open_lines_stay_open_and_closed_ones_begin_anew() {
        let mut builder = PathBuilder::new();
        builder.move_to(0.0, 0.0);
        builder.line_to(1.0, 0.0);
        builder.line_to(1.0, 1.0);
        builder.close();
        builder.line_to(0.0, -1.0);
        let path = builder.finish().expect("it has lines");
        let lines = polylines(&path, Transform::identity(), 0.001);
        let shapes: Vec<(usize, bool)> = lines.iter().map(|line| (line.points.len(), line.closed)).collect();
        assert_eq!(shapes, [(3, true), (2, false)]);
    }
}
