//! Finds pins: the places on lines where a light matters most, which are ends, crossings and corners.

use core::f64::consts::PI;

use lightbots_base::Vec2;
use lightbots_base::shape::segment_to_segment;

use crate::buckets::Buckets;
use crate::lines::{LineSet, Polyline};

/// A place is a corner if the line's direction changes by more than this there, radians.
pub(crate) const CORNER_RAD: f64 = 35.0 * PI / 180.0;

/// Two lines touch if they are closer than this share of the drawing's larger side.
const TOUCH: f64 = 0.004;

/// A place on a line, with its importance for the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pin {
    /// Index of the line.
    pub line: usize,
    /// Length along the line from its start to the place.
    pub arc: f64,
    /// The place.
    pub at: Vec2,
    /// Importance of a light at this place: 2 at an end, 1 at a crossing, below 1 at a corner. At a corner, it grows
    /// with the turn.
    pub rank: f64,
}

/// Returns all ends, crossings and corners, those of highest rank first. `height`: larger side of the drawing.
pub(crate) fn find(track: &LineSet, height: f64) -> Vec<Pin> {
    let window = 0.04 * height;
    let mut pins = Vec::new();
    for (index, line) in track.lines.iter().enumerate() {
        pins.extend(ends(index, line));
        pins.extend(corners(index, line, window));
    }
    pins.extend(crossings(track, TOUCH * height, window));
    pins.sort_by(|a, b| b.rank.total_cmp(&a.rank).then(a.line.cmp(&b.line)).then(a.arc.total_cmp(&b.arc)));
    pins
}

fn ends(line: usize, polyline: &Polyline) -> Vec<Pin> {
    if polyline.closed {
        return Vec::new();
    }
    let pin = |arc| Pin { line, arc, at: polyline.at(arc), rank: 2.0 };
    vec![pin(0.0), pin(polyline.length())]
}

/// Finds corners of a line: places that turn more than [`CORNER_RAD`], and more than all places within `window` along
/// the line.
fn corners(line: usize, polyline: &Polyline, window: f64) -> Vec<Pin> {
    let turns: Vec<(f64, f64)> =
        polyline.arcs.iter().map(|arc| (*arc, polyline.turn(*arc, window))).collect();
    let mut sharp: Vec<(f64, f64)> = turns.into_iter().filter(|(_, turn)| *turn > CORNER_RAD).collect();
    sharp.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.total_cmp(&b.0)));
    let mut corners: Vec<(f64, f64)> = Vec::new();
    for (arc, turn) in sharp {
        if corners.iter().all(|(other, _)| polyline.apart(arc, *other) > window) {
            corners.push((arc, turn));
        }
    }
    corners
        .into_iter()
        .map(|(arc, turn)| Pin { line, arc, at: polyline.at(arc), rank: turn / (PI + 0.1) })
        .collect()
}

/// Finds places where two lines cross or touch, or where a line crosses itself. Each place gives one pin for each of
/// the two lines. `touch`: largest gap between lines that touch. `window`: least distance between two of these places.
fn crossings(track: &LineSet, touch: f64, window: f64) -> Vec<Pin> {
    let points = track.points();
    let mut found: Vec<(f64, usize, usize)> = Vec::new();
    let reach = touch.max(longest_piece(track));
    Buckets::new(points, reach).pairs(reach, |a, b, length| {
        if are_separate(track, a, b, window) && pieces_touch(track, a, b, touch) {
            found.push((length, a, b));
        }
    });
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut pins: Vec<Pin> = Vec::new();
    for (_, a, b) in found {
        if pins.iter().any(|pin| pin.at.distance(points[a]) < window) {
            continue;
        }
        let at = points[a].lerp(points[b], 0.5);
        for point in [a, b] {
            let (line, arc) = track.arc_of(point);
            pins.push(Pin { line, arc, at, rank: 1.0 });
        }
    }
    pins
}

fn longest_piece(track: &LineSet) -> f64 {
    let pieces = track.lines.iter().flat_map(|line| line.points.windows(2));
    pieces.map(|pair| pair[0].distance(pair[1])).fold(0.0, f64::max) * 1.01
}

/// Whether two points are on different lines, or more than three times `window` apart along one line.
fn are_separate(track: &LineSet, a: usize, b: usize, window: f64) -> bool {
    let ((line_a, arc_a), (line_b, arc_b)) = (track.arc_of(a), track.arc_of(b));
    if line_a != line_b {
        return true;
    }
    track.lines[line_a].apart(arc_a, arc_b) > 3.0 * window
}

/// Whether a segment that meets point `a` comes closer than `touch` to a segment that meets point `b`.
fn pieces_touch(track: &LineSet, a: usize, b: usize, touch: f64) -> bool {
    let pieces = |point: usize| {
        let (line, arc) = track.arc_of(point);
        let line = &track.lines[line];
        let number = line.arcs.partition_point(|other| *other < arc);
        let piece = move |from: usize| line.points.get(from..from + 2).map(|pair| (pair[0], pair[1]));
        number.checked_sub(1).and_then(piece).into_iter().chain(piece(number))
    };
    pieces(a).any(|first| pieces(b).any(|second| segment_to_segment(first, second) < touch))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Stroke;
    use lightbots_base::Rgb;

    fn stroke(points: &[(f64, f64)], closed: bool) -> Stroke {
        let points = points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect();
        Stroke { points, closed, ink: Rgb::BLACK.into(), weight: 1.0 }
    }

    #[test]
    fn a_cross_has_four_ends_and_a_crossing_of_two_lines() {
        let lines = [stroke(&[(0.0, 0.5), (1.0, 0.5)], false), stroke(&[(0.5, 0.0), (0.5, 1.0)], false)];
        let pins = find(&LineSet::new(&lines, 0.03), 1.0);
        let ranks: Vec<f64> = pins.iter().map(|pin| pin.rank).collect();
        assert_eq!(ranks, [2.0, 2.0, 2.0, 2.0, 1.0, 1.0]);
        assert!(pins[4].at.distance(Vec2::new(0.5, 0.5)) < 0.03);
    }

    #[test]
    fn a_square_has_four_corners_and_a_circle_none() {
        let square = stroke(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], true);
        assert_eq!(find(&LineSet::new(&[square], 0.03), 1.0).len(), 4);
        let round: Vec<(f64, f64)> =
            (0..90).map(|i| Vec2::unit(f64::from(i) * PI / 45.0)).map(|at| (at.x, at.y)).collect();
        assert_eq!(find(&LineSet::new(&[stroke(&round, true)], 0.03), 2.0), []);
    }

    #[test]
    fn the_bar_of_a_t_is_touched_in_its_middle() {
        let lines = [stroke(&[(0.0, 1.0), (1.0, 1.0)], false), stroke(&[(0.5, 0.0), (0.5, 1.0)], false)];
        let pins = find(&LineSet::new(&lines, 0.03), 1.0);
        assert!(pins.iter().any(|pin| pin.rank == 1.0 && pin.line == 0 && (pin.arc - 0.5).abs() < 0.05));
    }
}
