//! How far control points have moved in all: who was clear of somebody by more than both have moved since then still is.

use lightbots_base::Vec2;

/// The sum of each control point's moves.
pub(super) struct Travel {
    /// Control points of a way.
    width: usize,
    /// `[robot][point]`, metres; at least as far as it really was.
    moved_m: Vec<f64>,
    /// The same when it was marked.
    marked_m: Vec<f64>,
}

impl Travel {
    /// Of ways that have not moved yet.
    pub fn new(robots: usize, width: usize) -> Self {
        Self { width, moved_m: vec![0.0; robots * width], marked_m: vec![0.0; robots * width] }
    }

    /// From now on [`Self::since_mark`] counts anew.
    pub fn mark(&mut self) {
        self.marked_m.copy_from_slice(&self.moved_m);
    }

    /// No place has moved farther than this since the mark, metres.
    pub fn since_mark(&self) -> f64 {
        let since = self.moved_m.iter().zip(&self.marked_m).map(|(now, then)| now - then);
        since.fold(0.0, f64::max)
    }

    /// No place on a robot's span has moved farther than this, metres.
    pub fn of(&self, robot: usize, span: usize) -> f64 {
        let at = robot * self.width + span;
        let four = &self.moved_m[at..at + 4];
        four[0].max(four[1]).max(four[2].max(four[3]))
    }

    /// A span's control points moved by `shift` times their pull.
    pub fn bend(&mut self, robot: usize, span: usize, pull: &[f64; 4], shift: Vec2) {
        let far_m = far(shift);
        let at = robot * self.width + span;
        for (moved_m, share) in self.moved_m[at..at + 4].iter_mut().zip(pull) {
            *moved_m += far_m * share.abs();
        }
        if span < 2 || span + 6 > self.width {
            self.tie_ends(robot);
        }
    }

    /// A way moved from `before` to `after`.
    pub fn follow(&mut self, robot: usize, before: &[Vec2], after: &[Vec2]) {
        let own = &mut self.moved_m[robot * self.width..(robot + 1) * self.width];
        for ((moved_m, before), after) in own.iter_mut().zip(before).zip(after) {
            *moved_m += far(*after - *before);
        }
    }

    /// The outer points follow the inner ones, at most as far.
    fn tie_ends(&mut self, robot: usize) {
        let own = &mut self.moved_m[robot * self.width..(robot + 1) * self.width];
        let last = own.len() - 3;
        (own[0], own[1]) = (own[2], own[2]);
        (own[last + 1], own[last + 2]) = (own[last], own[last]);
    }
}

/// At least as far as a shift goes, and hardly dearer than its parts.
fn far(shift: Vec2) -> f64 {
    shift.x.abs() + shift.y.abs()
}
