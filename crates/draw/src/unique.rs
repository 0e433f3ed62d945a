//! Removes stretches of lines that run along other lines. A pen may retrace its path, but two robots in one place would
//! collide.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::drawing::Stroke;
use crate::lines::Polyline;

/// Lines closer to each other than this share of the drawing's size count as one line.
const SAME: f64 = 0.015;

/// A shared stretch shorter than this is a crossing of two lines and stays. Unit: the distance below which lines count
/// as one.
const CROSSING: f64 = 5.0;

/// Returns strokes without the stretches that run along another stretch, so that each is there once. Short shared
/// stretches, as at crossings, stay. `size`: size of the drawing.
pub(crate) fn unique(strokes: &[Stroke], size: f64) -> Vec<Stroke> {
    let distance = SAME * size;
    let mut lines = Vec::new();
    for stroke in strokes {
        lines.extend(Polyline::new(stroke, 0.5 * distance).map(|line| (stroke, line)));
    }
    let points: Vec<Vec2> = lines.iter().flat_map(|(_, line)| line.points.iter().copied()).collect();
    let owners: Vec<(usize, f64)> = lines
        .iter()
        .enumerate()
        .flat_map(|(index, (_, line))| line.arcs.iter().map(move |arc| (index, *arc)))
        .collect();
    let mut covered = vec![false; points.len()];
    Buckets::new(&points, distance).pairs(distance, |a, b, _| {
        let (first, second) = (owners[a], owners[b]);
        let is_other = first.0 != second.0 || lines[first.0].1.apart(first.1, second.1) > 4.0 * distance;
        covered[b] |= is_other;
    });
    let mut kept = Vec::new();
    let mut from = 0;
    for (stroke, line) in lines {
        let to = from + line.points.len();
        kept.extend(runs(stroke, &line.points, &covered[from..to], (CROSSING * 2.0) as usize));
        from = to;
    }
    kept
}

/// Returns the stretches of a line that are not covered by other lines. Each stretch includes the covered points next
/// to it, so that joints stay closed.
fn runs(stroke: &Stroke, points: &[Vec2], covered: &[bool], shortest: usize) -> Vec<Stroke> {
    let long = long_runs(covered, shortest);
    if !long.iter().any(|covered| *covered) {
        return vec![stroke.clone()];
    }
    let mut parts = Vec::new();
    let mut index = 0;
    while index < points.len() {
        if long[index] {
            index += 1;
            continue;
        }
        let from = index.saturating_sub(1);
        while index < points.len() && !long[index] {
            index += 1;
        }
        let run = &points[from..(index + 1).min(points.len())];
        if run.len() > 2 {
            parts.push(Stroke { points: run.to_vec(), closed: false, ..stroke.clone() });
        }
    }
    parts
}

/// Marks the covered points that belong to runs of at least `shortest` covered points.
fn long_runs(covered: &[bool], shortest: usize) -> Vec<bool> {
    let mut long = vec![false; covered.len()];
    let mut from = 0;
    for index in 0..=covered.len() {
        if covered.get(index) == Some(&true) {
            continue;
        }
        if index - from >= shortest {
            long[from..index].fill(true);
        }
        from = index + 1;
    }
    long
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::LineSet;
    use lightbots_base::Rgb;

    fn stroke(points: &[(f64, f64)], closed: bool) -> Stroke {
        let points = points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect();
        Stroke { points, closed, ink: Rgb::BLACK.into(), weight: 1.0 }
    }

    fn length(strokes: &[Stroke]) -> f64 {
        LineSet::new(strokes, 0.01).length()
    }

    #[test]
    fn an_h_in_one_stroke_loses_the_way_back() {
        let h = [(0.0, 0.0), (0.0, 1.0), (0.0, 0.5), (0.7, 0.5), (0.7, 1.0), (0.7, 0.0)];
        let parts = unique(&[stroke(&h, false)], 1.0);
        assert!((length(&parts) - 2.7).abs() < 0.1, "{}", length(&parts));
    }

    #[test]
    fn crossings_and_closed_lines_stay_whole() {
        let cross = [stroke(&[(0.0, 0.0), (1.0, 1.0)], false), stroke(&[(0.0, 1.0), (1.0, 0.0)], false)];
        assert_eq!(unique(&cross, 1.0), cross);
        let ring = [stroke(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], true)];
        assert_eq!(unique(&ring, 1.0), ring);
    }

    #[test]
    fn a_line_that_is_drawn_twice_counts_once() {
        let line = stroke(&[(0.0, 0.0), (1.0, 0.3)], false);
        assert_eq!(unique(&[line.clone(), line.clone()], 1.0).len(), 1);
    }
}
