//! The paths of all robots as uniform cubic B-splines over time (de Boor, A Practical Guide to Splines). The paths are
//! smooth without stops, and changes are local: a control point moves only four spans.
//!
//! A spline of `spans` spans has `spans + 3` control points; points `i..i + 4` determine span `i`. Points 2 to `spans`
//! are free. The two points at either end follow from the free points, so that the robot rests at its start and its
//! end. A spare robot has no given end, and comes to rest at its last free point.

use lightbots_base::{Limits, Piece, Span, Vec2};

use crate::Path;
use crate::instance::Instance;
use crate::spline::turn_rate::{DirtySpans, TurnRate};
use crate::spline::weights::{basis, blend, fold};

/// Most spans of a spline. Each span becomes a piece of a path, which holds 128 pieces; the rests at both ends need
/// some of them.
pub(crate) const MOST_SPANS: usize = 124;
/// Number of smoothing passes around a span with illegal motion.
const SMOOTHING: usize = 4;

/// The splines of all robots, on one clock.
#[derive(Clone)]
pub(crate) struct SplineSet {
    /// Number of spans of each spline; at least 4.
    pub spans: usize,
    /// Duration of a span, seconds.
    pub span_s: f64,
    /// Factor by which the splines last longer than the limits demand; 1 if they do not.
    pub slowdown: f64,
    /// `[robot]`: start and end of its spline, stage metres; no end for a spare robot.
    ends: Vec<(Vec2, Option<Vec2>)>,
    /// `[robot][point]`: control points, `spans + 3` for each robot, stage metres.
    points: Vec<Vec2>,
}

/// Returns the free control points of a spline from `start` to `end` that passes through `places` between its spans.
/// Each place is a sixth of one point, two thirds of the next and a sixth of the one after. The Thomas algorithm solves
/// this tridiagonal system.
fn through(places: impl ExactSizeIterator<Item = Vec2>, start: Vec2, end: Option<Vec2>) -> Vec<Vec2> {
    let last = places.len() - 1;
    let (mut points, mut shares) = (Vec::with_capacity(last + 1), Vec::with_capacity(last + 1));
    let (mut share, mut so_far) = (0.0, Vec2::ZERO);
    for (number, place) in places.enumerate() {
        let (mut sum, mut own) = (place * 6.0 - so_far, 4.0 - share);
        if number == 0 {
            sum -= start * 1.5;
            own -= 0.5;
        }
        if number == last {
            sum -= end.map_or(Vec2::ZERO, |end| end * 1.5);
            own += if end.is_some() { -0.5 } else { 1.0 };
        }
        (share, so_far) = (1.0 / own, sum / own);
        shares.push(share);
        points.push(so_far);
    }
    for number in (0..last).rev() {
        let next = points[number + 1];
        points[number] -= next * shares[number];
    }
    points
}

impl SplineSet {
    /// Makes splines with the free control points `place(robot, step)` for steps 1 to `spans - 1`, so that corners of a
    /// path become round. Step 0 is the start and step `spans` the end. The outer points follow from each robot's start
    /// and end. Makes at least 4 spans. Panics if there are more than [`MOST_SPANS`].
    pub fn new(instance: &Instance, spans: usize, span_s: f64, place: impl Fn(usize, usize) -> Vec2) -> Self {
        let spans = spans.max(4);
        assert!(spans <= MOST_SPANS, "a path holds at most {MOST_SPANS} spans, not {spans}");
        let ends = instance.starts.iter().copied().zip(instance.ends.iter().copied()).collect::<Vec<_>>();
        let mut points = Vec::with_capacity(ends.len() * (spans + 3));
        for robot in 0..ends.len() {
            points.extend((0..spans + 3).map(|j| place(robot, j.saturating_sub(1).min(spans))));
        }
        let mut splines = Self { spans, span_s, slowdown: 1.0, ends, points };
        (0..splines.robots()).for_each(|robot| splines.tie_ends(robot));
        splines
    }

    /// Number of robots.
    pub fn robots(&self) -> usize {
        self.ends.len()
    }

    /// Duration of all spans, seconds.
    pub fn lasts_s(&self) -> f64 {
        self.span_s * self.spans as f64
    }

    /// The control points of a robot's spline.
    pub fn spline(&self, robot: usize) -> &[Vec2] {
        let width = self.spans + 3;
        &self.points[robot * width..(robot + 1) * width]
    }

    /// The control points of a robot's spline, to be changed; call [`Self::tie_ends`] afterwards.
    pub fn spline_mut(&mut self, robot: usize) -> &mut [Vec2] {
        let width = self.spans + 3;
        &mut self.points[robot * width..(robot + 1) * width]
    }

    /// Deforms a robot's spline until it keeps the turn rate limit in the spans of `dirty`, in at most `passes` passes.
    /// Returns the spans that may still exceed it, and whether anything changed.
    pub fn smooth_turns(
        &mut self,
        robot: usize,
        turn_rate: &TurnRate,
        passes: usize,
        mut dirty: DirtySpans,
    ) -> (DirtySpans, bool) {
        let spare = self.ends[robot].1.is_none();
        for pass in 0..passes {
            dirty = turn_rate.smooth_turns(self.spline_mut(robot), spare, dirty);
            if dirty.is_over() {
                return (dirty, pass > 0);
            }
            self.tie_ends(robot);
        }
        (dirty, true)
    }

    /// The four control points of a robot's span.
    pub fn span(&self, robot: usize, span: usize) -> &[Vec2] {
        &self.spline(robot)[span..span + 4]
    }

    /// The place of a robot on its span, stage metres. `weights` are those of the control points at the wanted moment.
    pub fn place(&self, robot: usize, span: usize, weights: &[f64; 4]) -> Vec2 {
        blend(self.span(robot, span), weights)
    }

    /// Start and end of a robot's spline; no end for a spare robot.
    pub fn ends(&self, robot: usize) -> (Vec2, Option<Vec2>) {
        self.ends[robot]
    }

    /// Sets the outer control points of a robot from the free ones, so that its spline is at rest at both ends.
    pub fn tie_ends(&mut self, robot: usize) {
        let (start, end) = self.ends[robot];
        let last = self.spans;
        let spline = self.spline_mut(robot);
        spline[0] = spline[2];
        spline[1] = start * 1.5 - spline[2] * 0.5;
        spline[last + 2] = spline[last];
        spline[last + 1] = end.map_or(spline[last], |end| end * 1.5 - spline[last] * 0.5);
    }

    /// Moves all robots through the same places at other times. After `k` spans, the new splines are where the old ones
    /// were after `was[k]` spans. The new splines have one span less than `was` has entries.
    pub fn retime(&mut self, was: &[f64]) {
        let (before, last) = (self.spans, was.len() - 1);
        let at = |&was: &f64| {
            let span = (was as usize).min(before - 1);
            (span, basis(was - span as f64))
        };
        let moments: Vec<_> = was[1..last].iter().map(at).collect();
        let splines = std::mem::take(&mut self.points);
        for (spline, &(start, end)) in splines.chunks_exact(before + 3).zip(&self.ends) {
            let places = moments.iter().map(|(span, weights)| blend(&spline[*span..*span + 4], weights));
            self.points.extend([start; 2]);
            self.points.extend(through(places, start, end));
            self.points.extend([start; 2]);
        }
        self.spans = last;
        (0..self.robots()).for_each(|robot| self.tie_ends(robot));
    }

    /// Smooths the free control points from `span - 2` to `span + 5` of a robot's spline. Points `span` to `span + 3`
    /// determine the span.
    pub fn smooth(&mut self, robot: usize, span: usize) {
        let last = self.spans;
        for _ in 0..SMOOTHING {
            let spline = self.spline_mut(robot);
            let before = spline.to_vec();
            for point in span.saturating_sub(2).max(2)..=(span + 5).min(last) {
                spline[point] = (before[point - 1] + before[point + 1]) * 0.25 + before[point] * 0.5;
            }
            self.tie_ends(robot);
        }
    }

    /// Weights by which the free control points of a span move a place on the span. `weights` are those of all four
    /// points. Points at the ends of the spline follow free points, so their weights are added to those of the free
    /// points.
    pub fn influence(&self, robot: usize, span: usize, weights: &[f64; 4]) -> [f64; 4] {
        fold(weights, span, self.spans, self.ends[robot].1.is_none())
    }

    /// Moves each of a span's four control points by `shift` times its influence. Points at the ends of the spline then
    /// follow from the free points again.
    pub fn displace(&mut self, robot: usize, span: usize, influence: &[f64; 4], shift: Vec2) {
        let outer = span < 2 || span + 3 > self.spans;
        let spline = &mut self.spline_mut(robot)[span..span + 4];
        for (point, &share) in spline.iter_mut().zip(influence) {
            *point += shift * share;
        }
        if outer {
            self.tie_ends(robot);
        }
    }

    /// The factor on the duration with which a robot's spline just keeps the limits of speed, acceleration and turn
    /// rate. Above 1, the spline is too fast.
    pub fn time_scale(&self, robot: usize, limits: &Limits) -> f64 {
        let spline = self.spline(robot);
        let (mut speed, mut accel) = (0.0_f64, 0.0_f64);
        for four in spline.windows(4) {
            let (a, b, c) = (four[1] - four[0], four[2] - four[1], four[3] - four[2]);
            speed = speed.max((a + b).length_squared() / 4.0).max((a + b * 6.0 + c).length_squared() / 64.0);
            speed = speed.max((a * 9.0 + b * 22.0 + c).length_squared() / 1024.0);
            speed = speed.max((a + b * 22.0 + c * 9.0).length_squared() / 1024.0);
            accel = accel.max((b - a).length_squared()).max((c - b).length_squared());
        }
        let speed = speed.sqrt() / self.span_s / limits.speed_mps;
        let accel = accel.sqrt() / (self.span_s * self.span_s) / limits.accel_mps2;
        speed.max(accel.sqrt()).max(TurnRate::new(self.span_s, limits).time_scale(spline))
    }

    /// The greatest [`Self::time_scale`] of all robots.
    pub fn greatest_time_scale(&self, limits: &Limits) -> f64 {
        (0..self.robots()).map(|robot| self.time_scale(robot, limits)).fold(0.0, f64::max)
    }

    /// Least duration of a span with which all robots keep their limits, with a small margin, multiplied by `slowdown`,
    /// seconds.
    pub fn least_span_s(&self, limits: &Limits) -> f64 {
        self.span_s * self.greatest_time_scale(limits) * 1.002 * self.slowdown
    }

    /// The splines as timed paths: a rest that lasts `turn`, then the spans, which last `span` each. Successive rests
    /// become one piece.
    pub fn paths(&self, turn: Span, span: Span) -> Vec<Path> {
        (0..self.robots()).map(|robot| self.path(robot, turn, span)).collect()
    }

    fn path(&self, robot: usize, turn: Span, span: Span) -> Path {
        let (start, end) = self.ends[robot];
        let mut pieces = vec![Piece::rest(start, turn)];
        let (mut at, mut resting) = (start, true);
        for (i, four) in self.spline(robot).windows(4).enumerate() {
            let mut piece = Piece {
                duration: span,
                c1: (four[1] * 2.0 + four[2]) / 3.0,
                c2: (four[1] + four[2] * 2.0) / 3.0,
                end: blend(four, &basis(1.0)),
            };
            // A robot that arrives early rests exactly at its end.
            if let Some(end) = end.filter(|end| i + 1 == self.spans || end.distance(piece.end) < 1e-9) {
                piece.end = end;
            }
            if i + 1 == self.spans {
                piece.c2 = piece.end;
            }
            if i == 0 {
                piece.c1 = start;
            }
            let still = [piece.c1, piece.c2, piece.end].iter().all(|place| place.distance(at) < 1e-9);
            match pieces.last_mut() {
                Some(before) if still && resting => before.duration += span,
                _ if still => pieces.push(Piece::rest(at, span)),
                _ => pieces.push(piece),
            }
            resting = still;
            at = pieces.last().map_or(at, |piece| piece.end);
        }
        Path { start, pieces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;

    #[test]
    fn retimed_ways_lead_through_the_same_places_from_rest_to_rest() {
        let problem = TransitionProblem {
            starts: vec![Vec2::ZERO, Vec2::new(0.0, 0.5)],
            goals: vec![Vec2::new(1.0, 0.0)],
            ..TransitionProblem::on_floor(Vec2::new(2.0, 2.0), Limits::ELISA_3)
        };
        let instance = Instance::new(&problem, &[Some(0), None]).unwrap();
        let mut splines = SplineSet::new(&instance, 8, 0.25, |robot, step| {
            let along = f64::from(step as u32) / 8.0;
            Vec2::new(along, 0.5 * robot as f64 + 0.1 * (9.0 * along).sin())
        });
        let before = splines.clone();
        let place = |splines: &SplineSet, robot: usize, moment: f64| {
            let span = (moment as usize).min(splines.spans - 1);
            blend(splines.span(robot, span), &basis(moment - span as f64))
        };
        let was = [0.0, 1.5, 2.25, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0, 7.0, 8.0];
        splines.retime(&was);
        assert_eq!(splines.spans, 10);
        for robot in 0..2 {
            for (step, &moment) in was.iter().enumerate().take(10) {
                let (now, then) = (place(&splines, robot, step as f64), place(&before, robot, moment));
                assert!(now.distance(then) < 1e-12, "robot {robot}, step {step}: {now:?} {then:?}");
            }
            let spline = splines.spline(robot);
            assert!(spline[0] == spline[2] && spline[10] == spline[12]);
        }
        assert!(place(&splines, 0, 10.0).distance(Vec2::new(1.0, 0.0)) < 1e-12);
    }
}
