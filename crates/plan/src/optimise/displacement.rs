//! How far control points have moved during a deformation. A pair of robots is checked again only once both together
//! have moved as far as the pair was clear.

use lightbots_base::Vec2;

/// Sum of the lengths of all moves of each control point.
pub(crate) struct Displacement {
    /// Number of control points of a spline.
    width: usize,
    /// `[robot][point]`: upper bound of the sum of the lengths of its moves, metres.
    moved_m: Vec<f64>,
    /// `[robot][point]`: value of `moved_m` when the point was last marked; minus infinity if it never was.
    marked_m: Vec<f64>,
}

impl Displacement {
    /// Begins with points that have not moved. `width`: number of control points of a spline.
    pub fn new(robots: usize, width: usize) -> Self {
        let points = robots * width;
        Self { width, moved_m: vec![0.0; points], marked_m: vec![f64::NEG_INFINITY; points] }
    }

    /// Marks all points that moved farther than `far_m` metres since their last mark.
    pub fn mark(&mut self, far_m: f64) {
        for (marked_m, moved_m) in self.marked_m.iter_mut().zip(&self.moved_m) {
            if moved_m - *marked_m > far_m {
                *marked_m = *moved_m;
            }
        }
    }

    /// Largest displacement of a span's four control points since their last mark, metres; infinite without a mark.
    pub fn since_mark_m(&self, robot: usize, span: usize) -> f64 {
        let at = robot * self.width + span;
        let since = |point: usize| self.moved_m[point] - self.marked_m[point];
        since(at).max(since(at + 1)).max(since(at + 2).max(since(at + 3)))
    }

    /// Largest displacement of all control points since their last mark, metres; infinite if a point was never marked.
    pub fn since_mark(&self) -> f64 {
        let since = self.moved_m.iter().zip(&self.marked_m).map(|(now, then)| now - then);
        since.fold(0.0, f64::max)
    }

    /// Largest displacement of a span's four control points since this record began, metres. If only a point with less
    /// displacement moves, this value does not grow, although places on the span move. The next detection finds
    /// contacts that follow.
    pub fn of(&self, robot: usize, span: usize) -> f64 {
        let at = robot * self.width + span;
        let four = &self.moved_m[at..at + 4];
        four[0].max(four[1]).max(four[2].max(four[3]))
    }

    /// Records that a span's four control points moved by `shift` times their influence.
    pub fn displace(&mut self, robot: usize, span: usize, influence: &[f64; 4], shift: Vec2) {
        let far_m = far(shift);
        let at = robot * self.width + span;
        for (moved_m, share) in self.moved_m[at..at + 4].iter_mut().zip(influence) {
            *moved_m += far_m * share.abs();
        }
        if span < 2 || span + 6 > self.width {
            self.tie_ends(robot);
        }
    }

    /// Records that a robot's control points moved from `before` to `after`.
    pub fn follow(&mut self, robot: usize, before: &[Vec2], after: &[Vec2]) {
        let own = &mut self.moved_m[robot * self.width..(robot + 1) * self.width];
        for ((moved_m, before), after) in own.iter_mut().zip(before).zip(after) {
            *moved_m += far(*after - *before);
        }
    }

    /// Sets the displacement of the outer control points to that of the inner points that they follow. The outer points
    /// move at most as far.
    fn tie_ends(&mut self, robot: usize) {
        let own = &mut self.moved_m[robot * self.width..(robot + 1) * self.width];
        let last = own.len() - 3;
        (own[0], own[1]) = (own[2], own[2]);
        (own[last + 1], own[last + 2]) = (own[last], own[last]);
    }
}

/// Returns an upper bound of the length of a shift, without a square root.
fn far(shift: Vec2) -> f64 {
    shift.x.abs() + shift.y.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::instance::Instance;
    use crate::seeded::Seeded;
    use crate::spline::set::SplineSet;
    use crate::spline::weights::{basis, blend};
    use lightbots_base::Limits;

    /// Number of spans of each spline.
    const SPANS: usize = 9;

    fn splines() -> SplineSet {
        let problem = TransitionProblem {
            starts: vec![Vec2::ZERO, Vec2::new(0.0, 0.5)],
            goals: vec![Vec2::new(1.0, 0.0)],
            ..TransitionProblem::on_floor(Vec2::new(2.0, 2.0), Limits::ELISA_3)
        };
        let instance = Instance::new(&problem, &[Some(0), None]).unwrap();
        SplineSet::new(&instance, SPANS, 0.25, |robot, step| match robot {
            0 => Vec2::new(step as f64 / SPANS as f64, 0.0),
            _ => Vec2::new(0.0, 0.5),
        })
    }

    /// Asserts that no place on any span moved farther than `said(robot, span)`, metres.
    fn assert_bounds(was: &SplineSet, is: &SplineSet, said: impl Fn(usize, usize) -> f64) {
        for robot in 0..2 {
            for span in 0..SPANS {
                let far = (0..=8).map(|i| basis(f64::from(i) / 8.0)).map(|weights| {
                    blend(was.span(robot, span), &weights).distance(blend(is.span(robot, span), &weights))
                });
                let (far, said) = (far.fold(0.0, f64::max), said(robot, span));
                assert!(far <= said + 1e-12, "robot {robot}, span {span}: {far} m, said {said} m");
            }
        }
    }

    #[test]
    fn no_spline_moves_farther_than_its_displacement() {
        let (mut seeded, mut splines) = (Seeded::new(4), splines());
        let (mut displacement, first) = (Displacement::new(2, SPANS + 3), splines.clone());
        for _ in 0..40 {
            displacement.mark(0.0);
            assert!(displacement.since_mark() == 0.0);
            let was = splines.clone();
            for _ in 0..3 {
                let shift = Vec2::new(seeded.between(-0.05, 0.05), seeded.between(-0.05, 0.05));
                let (robot, span) = (seeded.below(2), seeded.below(SPANS));
                let influence = splines.influence(robot, span, &basis(seeded.between(0.0, 1.0)));
                splines.displace(robot, span, &influence, shift);
                displacement.displace(robot, span, &influence, shift);
                let (other, point) = (1 - robot, 2 + seeded.below(SPANS - 1));
                let before = splines.spline(other).to_vec();
                splines.spline_mut(other)[point] += shift;
                splines.tie_ends(other);
                displacement.follow(other, &before, splines.spline(other));
            }
            assert_bounds(&was, &splines, |_, _| displacement.since_mark());
            assert_bounds(&first, &splines, |robot, span| displacement.of(robot, span));
        }
    }

    #[test]
    fn a_spline_that_did_not_move_has_no_displacement() {
        let splines = splines();
        let mut displacement = Displacement::new(2, SPANS + 3);
        let influence = splines.influence(0, 4, &basis(0.5));
        displacement.displace(0, 4, &influence, Vec2::new(0.01, 0.0));
        assert!((0..SPANS).all(|span| displacement.of(1, span) == 0.0));
        assert!(displacement.of(0, 0) == 0.0 && displacement.of(0, 8) == 0.0);
        assert!(displacement.of(0, 4) > 0.004 && displacement.of(0, 4) < 0.01);
        displacement.mark(0.0);
        assert!(displacement.since_mark() == 0.0 && displacement.of(0, 4) > 0.004);
    }
}
