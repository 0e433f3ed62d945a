//! Whether one robot can drive its path: speed, acceleration, wheels, turns, and no steps.

use super::FaultKind;
use super::facing::Facing;
use crate::Path;
use lightbots_base::{Limits, Span, Vec2};

/// Share by which limits may be exceeded: rounding to whole microseconds.
const SHARE: f64 = 1e-3;
/// A smaller step in velocity is none, m/s.
const STEP_MPS: f64 = 1e-3;
/// Below this speed the direction of a robot hardly matters, m/s: during a quarter turn of 0.35 s it gets at most 3 mm
/// off its path.
pub(super) const CREEP_MPS: f64 = 20e-3;
/// Velocity times turning rate below which a piece is straight, m/s · rad/s · m/s.
const STRAIGHT: f64 = 1e-12;
/// Places farther out are on no floor, metres; their squares are not exact.
const FARTHEST_M: f64 = 1e6;
/// Bisections after which an undecided stretch is judged by its middle.
const HALVINGS: u32 = 8;

/// Reports illegal motion of a robot; the first of each kind.
pub(super) fn judge(path: &Path, horizon: Span, limits: &Limits, mut fault: impl FnMut(FaultKind, Span)) {
    if !is_well_formed(path, horizon) {
        return fault(FaultKind::Malformed, Span::ZERO);
    }
    let mut known = [false; 8];
    let mut report = |kind: FaultKind, at: Span| {
        if !core::mem::replace(&mut known[kind as usize], true) {
            fault(kind, at);
        }
    };
    let (mut velocity, mut facing) = (Vec2::ZERO, Facing::new(limits));
    for (from, at, piece) in path.as_ref().timed() {
        let course = Course::new([from, piece.c1, piece.c2, piece.end], piece.duration.as_secs());
        if course.exceeds_speed(limits.speed_mps * (1.0 + SHARE)) {
            report(FaultKind::Speed, at);
        }
        let hardest = course.acceleration[0].length().max(course.acceleration[1].length());
        if hardest > limits.accel_mps2 * (1.0 + SHARE) {
            report(FaultKind::Acceleration, at);
        }
        course.judge_turning(limits, HALVINGS, &mut |kind| report(kind, at));
        if (course.velocity[0] - velocity).length() > STEP_MPS {
            report(FaultKind::Jump, at);
        }
        velocity = course.velocity[2];
        if !facing.follow(&course, piece.duration.as_secs()) {
            report(FaultKind::Turn, at);
        }
    }
    if velocity.length() > STEP_MPS {
        report(FaultKind::Jump, horizon);
    }
}

fn is_well_formed(path: &Path, horizon: Span) -> bool {
    // Comparisons with NaN are false.
    let is_place = |at: &Vec2| at.x.abs() <= FARTHEST_M && at.y.abs() <= FARTHEST_M;
    let are_places = path
        .pieces
        .iter()
        .all(|piece| piece.duration > Span::ZERO && [piece.c1, piece.c2, piece.end].iter().all(is_place));
    are_places && is_place(&path.start) && path.as_ref().duration() == horizon
}

/// A piece's velocity and acceleration as Bézier control values.
pub(super) struct Course {
    pub velocity: [Vec2; 3],
    acceleration: [Vec2; 2],
}

impl Course {
    fn new(curve: [Vec2; 4], seconds: f64) -> Self {
        let step = |from: usize| (curve[from + 1] - curve[from]) * (3.0 / seconds);
        let velocity = [step(0), step(1), step(2)];
        let acceleration =
            [(velocity[1] - velocity[0]) * (2.0 / seconds), (velocity[2] - velocity[1]) * (2.0 / seconds)];
        Self { velocity, acceleration }
    }

    /// Both halves.
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

    /// No speed in it is greater.
    pub fn speed_bound(&self) -> f64 {
        self.velocity.iter().map(|velocity| velocity.length()).fold(0.0, f64::max)
    }

    fn exceeds_speed(&self, limit: f64) -> bool {
        fn exceeds(course: &Course, limit: f64, halvings: u32) -> bool {
            if course.speed_bound() <= limit {
                return false;
            }
            if halvings == 0 || course.velocity[0].length().max(course.velocity[2].length()) > limit {
                return true;
            }
            let (left, right) = course.halves();
            exceeds(&left, limit, halvings - 1) || exceeds(&right, limit, halvings - 1)
        }
        exceeds(self, limit, 2 * HALVINGS)
    }

    /// No turning rate times squared speed in it is greater: velocity × acceleration by its own control values.
    fn swing_bound(&self) -> f64 {
        let cross = |v: usize, a: usize| self.velocity[v].cross(self.acceleration[a]);
        let middle = [(cross(0, 1) + 2.0 * cross(1, 0)) / 3.0, (cross(2, 0) + 2.0 * cross(1, 1)) / 3.0];
        [cross(0, 0), middle[0], middle[1], cross(2, 1)].iter().fold(0.0, |most, value| value.abs().max(most))
    }

    /// No speed in it is less.
    pub fn speed_floor(&self) -> f64 {
        let Some(direction) = (self.velocity[0] + self.velocity[2]).normalized() else { return 0.0 };
        self.velocity.iter().map(|velocity| velocity.dot(direction)).fold(f64::INFINITY, f64::min).max(0.0)
    }

    fn judge_turning(&self, limits: &Limits, halvings: u32, report: &mut dyn FnMut(FaultKind)) {
        let (swing, top) = (self.swing_bound(), self.speed_bound());
        if swing <= STRAIGHT || top < CREEP_MPS {
            return;
        }
        let wheel_mps = limits.wheel_radps * limits.wheel_radius_m * (1.0 + SHARE);
        let most = limits.turn_radps * (1.0 + SHARE);
        let floor = self.speed_floor().max(if halvings == 0 { CREEP_MPS } else { 0.0 });
        let turn = swing / (floor * floor);
        if turn <= most && top + turn * limits.track_m / 2.0 <= wheel_mps {
            return;
        }
        if halvings > 0 {
            let (left, right) = self.halves();
            left.judge_turning(limits, halvings - 1, report);
            right.judge_turning(limits, halvings - 1, report);
        } else {
            report(if turn > most { FaultKind::Turn } else { FaultKind::Wheel });
        }
    }
}
