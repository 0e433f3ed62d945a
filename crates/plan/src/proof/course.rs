//! Velocity and acceleration along one piece of a path, with bounds that hold everywhere on the piece.

use lightbots_base::Vec2;

/// Speed below which the direction of a robot hardly matters, m/s. Below it, a robot that needs 0.35 s for a quarter
/// turn gets at most 3 mm off its path.
pub(super) const CREEP_MPS: f64 = 20e-3;

/// A piece's velocity, m/s, and acceleration, m/s², as Bézier control values.
pub(super) struct Course {
    pub velocity: [Vec2; 3],
    pub acceleration: [Vec2; 2],
}

impl Course {
    /// The course of a piece with these control points, stage metres, that is driven in `seconds`.
    pub fn new(curve: [Vec2; 4], seconds: f64) -> Self {
        let step = |from: usize| (curve[from + 1] - curve[from]) * (3.0 / seconds);
        let velocity = [step(0), step(1), step(2)];
        let acceleration =
            [(velocity[1] - velocity[0]) * (2.0 / seconds), (velocity[2] - velocity[1]) * (2.0 / seconds)];
        Self { velocity, acceleration }
    }

    /// Splits the course into the two halves of its time.
    pub fn halves(&self) -> (Self, Self) {
        let [a, b, c] = self.velocity;
        let (ab, bc) = (a.lerp(b, 0.5), b.lerp(c, 0.5));
        let middle = ab.lerp(bc, 0.5);
        let [p, q] = self.acceleration;
        let pq = p.lerp(q, 0.5);
        (
            Self { velocity: [a, ab, middle], acceleration: [p, pq] },
            Self { velocity: [middle, bc, c], acceleration: [pq, q] },
        )
    }

    /// Upper bound of the speed everywhere on the piece, m/s.
    pub fn speed_bound(&self) -> f64 {
        self.velocity.iter().map(|velocity| velocity.length()).fold(0.0, f64::max)
    }

    /// Upper bound of the turn rate times the squared speed, rad/s · m²/s², by the control values of velocity ×
    /// acceleration.
    pub fn swing_bound(&self) -> f64 {
        let cross = |v: usize, a: usize| self.velocity[v].cross(self.acceleration[a]);
        let middle = [(cross(0, 1) + 2.0 * cross(1, 0)) / 3.0, (cross(2, 0) + 2.0 * cross(1, 1)) / 3.0];
        [cross(0, 0), middle[0], middle[1], cross(2, 1)].iter().fold(0.0, |most, value| value.abs().max(most))
    }

    /// Lower bound of the speed everywhere on the piece, m/s.
    pub fn speed_floor(&self) -> f64 {
        let Some(direction) = (self.velocity[0] + self.velocity[2]).normalized() else { return 0.0 };
        self.velocity.iter().map(|velocity| velocity.dot(direction)).fold(f64::INFINITY, f64::min).max(0.0)
    }
}
