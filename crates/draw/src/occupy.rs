//! Places lights along lines: first at ends, crossings and corners, then evenly in between.

use std::collections::BTreeMap;

use lightbots_base::Vec2;

use crate::apart::Freedom;
use crate::lines::{LineSet, Polyline};
use crate::pins::{self, Pin};
use crate::symmetry::Mirror;

/// A pin is an end, crossing or corner of a line. One closer than this share of the spacing to a pin of higher rank is
/// dropped, because both would look like one light.
const PIN_GAP: f64 = 0.6;

/// A light closer than this share of the spacing to another line counts as a light of both lines.
const BESIDE: f64 = 0.45;

/// Pins closer to each other than this share of the spacing become one light that several lines share.
const SAME: f64 = 0.08;

/// A piece of a line between two successive places that have a light already, or between one and an end. `from`: length
/// from the line's start.
#[derive(Clone, Copy, Debug)]
struct Edge {
    line: usize,
    from: f64,
    length: f64,
    /// Whether a light is already at the start, and at the end, of the piece.
    pinned: [bool; 2],
    /// Whether the piece is a whole closed line without pins.
    round: bool,
    /// Number of lights on the piece, without those at its start and end.
    lights: usize,
}

/// A place on a line, and how it may move.
pub(crate) type LinePlace = (Vec2, Freedom);

/// Returns `count` places along lines, at ends, crossings and corners first and then evenly between them. The list is
/// empty without lines. `height`: larger side of the drawing. If the lines are symmetric about `mirror`, so are the
/// places, as far as `count` allows.
pub(crate) fn occupy(track: &LineSet, count: usize, height: f64, mirror: Option<Mirror>) -> Vec<LinePlace> {
    if count == 0 || track.lines.is_empty() {
        return Vec::new();
    }
    let spacing = track.length() / count as f64;
    let (nodes, cuts) = nodes(track, &pins::find(track, height), count, spacing);
    let mut edges = edges(track, &cuts, mirror);
    let orbits = orbits(track, &edges, mirror, spacing);
    fill(track, &mut edges, &orbits, count - nodes.len());
    let mut places: Vec<LinePlace> = nodes.into_iter().map(|at| (at, Freedom::Fixed)).collect();
    for edge in &edges {
        places.extend(edge.places(&track.lines[edge.line]).map(|at| (at, Freedom::Line)));
    }
    places
}

/// Returns at most `count` places of lights at pins. Also returns, for each line, the lengths from its start at which
/// these lights cut the line.
fn nodes(
    track: &LineSet,
    pins: &[Pin],
    count: usize,
    spacing: f64,
) -> (Vec<Vec2>, BTreeMap<usize, Vec<f64>>) {
    let mut nodes: Vec<Vec2> = Vec::new();
    let mut cuts: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for pin in pins {
        let nearest = nodes.iter().map(|node| node.distance(pin.at)).fold(f64::INFINITY, f64::min);
        let is_new = nearest >= PIN_GAP * spacing && nodes.len() < count;
        if is_new {
            nodes.push(pin.at);
        }
        if is_new || nearest <= SAME * spacing {
            cuts.entry(pin.line).or_default().push(pin.arc);
        }
    }
    cut_by_others(track, &nodes, spacing, &mut cuts);
    for arcs in cuts.values_mut() {
        arcs.sort_by(f64::total_cmp);
        arcs.dedup_by(|a, b| (*a - *b).abs() < SAME * spacing);
    }
    (nodes, cuts)
}

/// Cuts lines where a light of another line is on or beside them, because this light counts for them as well.
fn cut_by_others(track: &LineSet, nodes: &[Vec2], spacing: f64, cuts: &mut BTreeMap<usize, Vec<f64>>) {
    for node in nodes {
        for (line, polyline) in track.lines.iter().enumerate() {
            let distance = |index: &usize| polyline.points[*index].distance(*node);
            let Some(nearest) = (0..polyline.points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
            else {
                continue;
            };
            let arc = polyline.arcs[nearest];
            let arcs = cuts.entry(line).or_default();
            let is_cut = arcs.iter().any(|other| polyline.apart(arc, *other) < BESIDE * spacing);
            if distance(&nearest) < BESIDE * spacing && !is_cut {
                arcs.push(arc);
            }
        }
    }
    cuts.retain(|_, arcs| !arcs.is_empty());
}

/// Pieces of all lines between their cuts.
fn edges(track: &LineSet, cuts: &BTreeMap<usize, Vec<f64>>, mirror: Option<Mirror>) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (line, polyline) in track.lines.iter().enumerate() {
        let length = polyline.length();
        let arcs = cuts.get(&line).map_or(&[][..], Vec::as_slice);
        let edge = |from: f64, to: f64, pinned| Edge {
            line,
            from,
            length: to - from,
            pinned,
            round: false,
            lights: 0,
        };
        match (arcs, polyline.closed) {
            ([], true) => {
                let from = beginning(polyline, mirror);
                edges.push(Edge { round: true, ..edge(from, from + length, [false, false]) });
            }
            ([], false) => edges.push(edge(0.0, length, [false, false])),
            ([first, .., last], closed) | ([first @ last], closed) => {
                edges.extend(arcs.windows(2).map(|pair| edge(pair[0], pair[1], [true, true])));
                if closed {
                    edges.push(edge(*last, first + length, [true, true]));
                } else {
                    edges.push(edge(0.0, *first, [false, true]));
                    edges.push(edge(*last, length, [true, false]));
                }
            }
        }
    }
    edges.retain(|edge| edge.length > 1e-9);
    edges
}

/// Returns where the lights on a closed line begin, as a length from the line's start. This is the top of the line. If
/// there is a mirror axis, it is a point on the axis, so that the lights are symmetric.
fn beginning(line: &Polyline, mirror: Option<Mirror>) -> f64 {
    let high = |at: Vec2| match mirror {
        Some(Mirror::UpDown(_)) => at.x,
        _ => at.y,
    };
    let off = |at: Vec2| mirror.map_or(0.0, |mirror| mirror.side(at).abs());
    let size = line.length();
    let score = |at: Vec2| high(at) - 20.0 * (off(at) - 0.01 * size).max(0.0);
    let best =
        (0..line.points.len()).max_by(|a, b| score(line.points[*a]).total_cmp(&score(line.points[*b])));
    best.map_or(0.0, |index| line.arcs[index])
}

/// Groups pieces that are mirror images of each other into pairs. Every other piece is a group of its own.
fn orbits(track: &LineSet, edges: &[Edge], mirror: Option<Mirror>, spacing: f64) -> Vec<Vec<usize>> {
    let middle = |edge: &Edge| track.lines[edge.line].at(edge.from + edge.length / 2.0);
    let mut orbits = Vec::new();
    let mut taken = vec![false; edges.len()];
    for (index, edge) in edges.iter().enumerate() {
        if taken[index] {
            continue;
        }
        taken[index] = true;
        let twin = mirror.and_then(|mirror| {
            let image = mirror.image(middle(edge));
            if mirror.side(middle(edge)).abs() < 0.1 * spacing {
                return None;
            }
            (index + 1..edges.len()).find(|other| {
                let other_edge = &edges[*other];
                !taken[*other]
                    && middle(other_edge).distance(image) < 0.3 * spacing
                    && (other_edge.length - edge.length).abs() < 0.3 * spacing
            })
        });
        if let Some(twin) = twin {
            taken[twin] = true;
        }
        orbits.push(std::iter::once(index).chain(twin).collect());
    }
    orbits
}

/// Adds `count` lights, each time to the group with the widest gaps. Both pieces of a pair get a light, unless only one
/// light is left.
fn fill(track: &LineSet, edges: &mut [Edge], orbits: &[Vec<usize>], count: usize) {
    let mut left = count;
    while left > 0 {
        let gap = |orbit: &&Vec<usize>| {
            let edge = &edges[orbit[0]];
            let more = Edge { lights: edge.lights + 1, ..*edge };
            // The geometric mean of the gaps before and after a light is added keeps every gap within twice the
            // narrowest.
            (edge.gap() * more.gap()).sqrt() * track.lines[edge.line].weight
        };
        let fitting = orbits.iter().filter(|orbit| orbit.len() <= left);
        let widest = fitting.max_by(|a, b| gap(a).total_cmp(&gap(b)));
        // If only pairs are left for a single light, one edge of a pair gets it.
        let Some(orbit) = widest.or_else(|| orbits.iter().max_by(|a, b| gap(a).total_cmp(&gap(b)))) else {
            return;
        };
        for index in orbit.iter().take(left) {
            edges[*index].lights += 1;
        }
        left -= orbit.len().min(left);
    }
}

impl Edge {
    /// Returns the distance between successive lights of the piece. At an end without a light, half this distance stays
    /// free.
    fn gap(&self) -> f64 {
        let ends = self.pinned.iter().filter(|pinned| **pinned).count();
        match (self.lights, ends) {
            (0, 0) => 2.0 * self.length,
            (lights, _) if self.round => self.length / lights as f64,
            (lights, ends) => self.length / (lights as f64 + ends as f64 / 2.0),
        }
    }

    fn places<'a>(&'a self, line: &'a Polyline) -> impl Iterator<Item = Vec2> + 'a {
        let gap = self.gap();
        let first = match (self.round, self.pinned[0]) {
            (true, _) => 0.0,
            (_, true) => gap,
            (_, false) => gap / 2.0,
        };
        (0..self.lights).map(move |index| line.at(self.from + first + index as f64 * gap))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Stroke;
    use lightbots_base::Rgb;

    fn track(lines: &[&[(f64, f64)]], closed: bool) -> LineSet {
        let stroke = |points: &&[(f64, f64)]| Stroke {
            points: points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect(),
            closed,
            ink: Rgb::BLACK.into(),
            weight: 1.0,
        };
        LineSet::new(&lines.iter().map(stroke).collect::<Vec<_>>(), 0.02)
    }

    #[test]
    fn lights_on_a_line_stand_at_its_ends_and_evenly_between() {
        let places = occupy(&track(&[&[(0.0, 0.0), (1.0, 0.0)]], false), 5, 1.0, None);
        let mut xs: Vec<f64> = places.iter().map(|(at, _)| at.x).collect();
        xs.sort_by(f64::total_cmp);
        for (index, x) in xs.iter().enumerate() {
            assert!((x - index as f64 / 4.0).abs() < 1e-9, "{xs:?}");
        }
    }

    #[test]
    fn every_count_is_met_exactly() {
        let h =
            track(&[&[(0.0, 0.0), (0.0, 1.0)], &[(0.7, 0.0), (0.7, 1.0)], &[(0.0, 0.5), (0.7, 0.5)]], false);
        let ring = track(&[&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]], true);
        for count in 1..60 {
            for lines in [&h, &ring] {
                assert_eq!(occupy(lines, count, 1.0, None).len(), count);
            }
        }
    }

    #[test]
    fn an_h_has_as_many_lights_left_as_right() {
        let h =
            track(&[&[(0.0, 0.0), (0.0, 1.0)], &[(0.7, 0.0), (0.7, 1.0)], &[(0.0, 0.5), (0.7, 0.5)]], false);
        for count in 9..40 {
            let places = occupy(&h, count, 1.0, Some(Mirror::LeftRight(0.35)));
            let left = places.iter().filter(|(at, _)| at.x < 0.34).count();
            let right = places.iter().filter(|(at, _)| at.x > 0.36).count();
            assert_eq!(left, right, "{count}");
        }
    }
}
