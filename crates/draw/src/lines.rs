//! Lines as lists of points, each with the length along the line up to it.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::drawing::Stroke;

/// A line cut into short straight segments.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polyline {
    /// Points along the line. A closed line repeats its first point at the end.
    pub points: Vec<Vec2>,
    /// For each point, the length along the line from its start to this point.
    pub arcs: Vec<f64>,
    /// Whether the line ends where it begins.
    pub closed: bool,
    /// How densely lights stand along the line, relative to other lines.
    pub weight: f64,
}

/// Lines along which places slide.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LineSet {
    /// The lines, with segments of at most `pitch`.
    pub lines: Vec<Polyline>,
    /// All points of all lines.
    points: Vec<Vec2>,
    /// For each point, the index of its line and its index within that line.
    owners: Vec<(usize, usize)>,
    pitch: f64,
}

impl Polyline {
    /// Cuts a stroke into segments of at most `pitch`. `None` if the stroke has no length.
    pub fn new(stroke: &Stroke, pitch: f64) -> Option<Self> {
        let mut ends = stroke.points.clone();
        ends.dedup_by(|a, b| a.distance(*b) < 1e-9);
        if stroke.closed && ends.first() != ends.last() {
            ends.extend(stroke.points.first());
        }
        let mut points = vec![*ends.first()?];
        for pair in ends.windows(2) {
            let pieces = (pair[0].distance(pair[1]) / pitch).ceil().max(1.0) as usize;
            points.extend((1..=pieces).map(|piece| pair[0].lerp(pair[1], piece as f64 / pieces as f64)));
        }
        let mut length = 0.0;
        let mut arcs = vec![0.0];
        for pair in points.windows(2) {
            length += pair[0].distance(pair[1]);
            arcs.push(length);
        }
        (length > 1e-9).then_some(Self { points, arcs, closed: stroke.closed, weight: stroke.weight })
    }

    /// Total length of the line.
    pub fn length(&self) -> f64 {
        self.arcs.last().copied().unwrap_or(0.0)
    }

    /// Returns the distance along the line between two positions. Positions are lengths from the line's start. On a
    /// closed line, the distance is the shorter way round.
    pub fn apart(&self, a: f64, b: f64) -> f64 {
        let direct = (a - b).abs();
        if self.closed { direct.min(self.length() - direct) } else { direct }
    }

    /// Returns the place at the length `arc` from the line's start. If `arc` lies beyond an end of an open line,
    /// returns that end. On a closed line, lengths go round.
    pub fn at(&self, arc: f64) -> Vec2 {
        let arc = if self.closed { arc.rem_euclid(self.length()) } else { arc.clamp(0.0, self.length()) };
        let next = self.arcs.partition_point(|end| *end < arc).clamp(1, self.points.len() - 1);
        let (from, to) = (self.arcs[next - 1], self.arcs[next]);
        let share = if to > from { (arc - from) / (to - from) } else { 0.0 };
        self.points[next - 1].lerp(self.points[next], share)
    }

    /// Change of direction at the length `arc` from the line's start, radians, 0 to π. The place there is joined with
    /// the places at the length `window` before and after; the result is the angle between both chords. It is 0 within
    /// `window` of the ends of an open line.
    pub fn turn(&self, arc: f64, window: f64) -> f64 {
        if !self.closed && (arc < window || arc > self.length() - window) {
            return 0.0;
        }
        let at = self.at(arc);
        let (before, after) = (at - self.at(arc - window), self.at(arc + window) - at);
        lightbots_base::difference(after.angle(), before.angle()).abs()
    }
}

impl LineSet {
    /// Cuts strokes into segments of at most `pitch`.
    pub fn new(strokes: &[Stroke], pitch: f64) -> Self {
        let lines: Vec<Polyline> = strokes.iter().filter_map(|stroke| Polyline::new(stroke, pitch)).collect();
        let (mut points, mut owners) = (Vec::new(), Vec::new());
        for (index, line) in lines.iter().enumerate() {
            points.extend(&line.points);
            owners.extend((0..line.points.len()).map(|number| (index, number)));
        }
        Self { lines, points, owners, pitch }
    }

    /// Sum of the lengths of all lines.
    pub fn length(&self) -> f64 {
        self.lines.iter().map(Polyline::length).sum()
    }

    /// Buckets of the points of all lines, to find near points.
    pub fn buckets(&self) -> Buckets<'_> {
        Buckets::new(&self.points, 2.0 * self.pitch)
    }

    /// All points of all lines.
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Returns the index of the line that has point number `point` of [`LineSet::points`], and the length along that
    /// line.
    pub fn arc_of(&self, point: usize) -> (usize, f64) {
        let (line, number) = self.owners[point];
        (line, self.lines[line].arcs[number])
    }

    /// Returns the place on the lines nearest to `at`. It is searched on the two segments that meet at the point
    /// nearest to `at`. Without lines it returns `at`. `buckets`: those of [`Self::buckets`].
    pub fn project(&self, at: Vec2, buckets: &Buckets<'_>) -> Vec2 {
        let Some((nearest, _)) = buckets.nearest(at) else { return at };
        let (line, number) = self.owners[nearest];
        let points = &self.lines[line].points;
        let onto = |from: Option<&Vec2>, to: Option<&Vec2>| {
            let (from, to) = (*from?, *to?);
            let way = to - from;
            let square = way.length_squared();
            let share = if square > 0.0 { ((at - from).dot(way) / square).clamp(0.0, 1.0) } else { 0.0 };
            Some(from.lerp(to, share))
        };
        let before = onto(number.checked_sub(1).and_then(|index| points.get(index)), points.get(number));
        let after = onto(points.get(number), points.get(number + 1));
        let nearer = |a: &Vec2, b: &Vec2| a.distance(at).total_cmp(&b.distance(at));
        before.into_iter().chain(after).min_by(nearer).unwrap_or(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    fn square() -> Stroke {
        let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        Stroke { points, closed: true, ink: Rgb::BLACK.into(), weight: 1.0 }
    }

    #[test]
    fn a_closed_line_goes_round() {
        let line = Polyline::new(&square(), 0.3).unwrap();
        assert!((line.length() - 4.0).abs() < 1e-12);
        assert!(line.at(4.5).distance(Vec2::new(0.5, 0.0)) < 1e-12);
        assert!(line.at(-0.5).distance(Vec2::new(0.0, 0.5)) < 1e-12);
        assert!((line.turn(1.0, 0.1) - core::f64::consts::FRAC_PI_2).abs() < 1e-9);
        assert!(line.turn(0.5, 0.1) < 1e-9);
    }

    #[test]
    fn places_are_projected_onto_the_nearest_line() {
        let track = LineSet::new(&[square()], 0.1);
        let place = track.project(Vec2::new(0.537, -0.3), &track.buckets());
        assert!(place.distance(Vec2::new(0.537, 0.0)) < 1e-12);
    }

    #[test]
    fn a_line_without_length_is_none() {
        let dot = Stroke { points: vec![Vec2::ZERO; 3], closed: false, ink: Rgb::BLACK.into(), weight: 1.0 };
        assert_eq!(Polyline::new(&dot, 0.1), None);
    }
}
