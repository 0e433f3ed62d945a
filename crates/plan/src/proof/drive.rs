//! Whether one robot can drive its path: checks speed, acceleration, wheels, turns, and that velocity has no steps.

use super::course::{CREEP_MPS, Course};
use super::facing::Facing;
use super::verdict::FaultKind;
use crate::Path;
use lightbots_base::{Limits, Span, Vec2};

/// Share by which limits may be exceeded, because durations are rounded to whole microseconds.
const SHARE: f64 = 1e-3;
/// Largest step in velocity that does not count as a jump, m/s.
const STEP_MPS: f64 = 1e-3;
/// A piece counts as straight if its squared speed times its turn rate is below this, m²/s² · rad/s.
const STRAIGHT: f64 = 1e-12;
/// Largest coordinate of a place, metres; a path with a larger one is malformed, because squares would not be exact.
const FARTHEST_M: f64 = 1e6;
/// Number of bisections of a piece whose turn rate is undecided. After them, its least speed is taken as [`CREEP_MPS`]
/// or more. An undecided speed gets twice as many bisections, and then counts as too fast.
const HALVINGS: u32 = 8;

/// Calls `fault` once for each kind of illegal motion in a path, with the beginning of the first piece that has it.
/// `fault` gets `horizon` instead if only the end of the path is not at rest. `horizon`: time at which the path must
/// end. A malformed path gets only [`FaultKind::Malformed`].
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
        if exceeds_speed(&course, limits.speed_mps * (1.0 + SHARE), 2 * HALVINGS) {
            report(FaultKind::Speed, at);
        }
        let hardest = course.acceleration[0].length().max(course.acceleration[1].length());
        if hardest > limits.accel_mps2 * (1.0 + SHARE) {
            report(FaultKind::Acceleration, at);
        }
        judge_turning(&course, limits, HALVINGS, &mut |kind| report(kind, at));
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

/// Whether the speed exceeds `limit`, m/s, anywhere on a piece.
fn exceeds_speed(course: &Course, limit: f64, halvings: u32) -> bool {
    if course.speed_bound() <= limit {
        return false;
    }
    if halvings == 0 || course.velocity[0].length().max(course.velocity[2].length()) > limit {
        return true;
    }
    let (left, right) = course.halves();
    exceeds_speed(&left, limit, halvings - 1) || exceeds_speed(&right, limit, halvings - 1)
}

/// Reports a fault if a robot turns too fast on a piece, or one of its wheels is too fast. Parts that are straight, or
/// nowhere faster than [`CREEP_MPS`], are not checked.
fn judge_turning(course: &Course, limits: &Limits, halvings: u32, report: &mut dyn FnMut(FaultKind)) {
    let (swing, top) = (course.swing_bound(), course.speed_bound());
    if swing <= STRAIGHT || top < CREEP_MPS {
        return;
    }
    let wheel_mps = limits.wheel_radps * limits.wheel_radius_m * (1.0 + SHARE);
    let most = limits.turn_radps * (1.0 + SHARE);
    let floor = course.speed_floor().max(if halvings == 0 { CREEP_MPS } else { 0.0 });
    let turn = swing / (floor * floor);
    if turn <= most && top + turn * limits.track_m / 2.0 <= wheel_mps {
        return;
    }
    if halvings > 0 {
        let (left, right) = course.halves();
        judge_turning(&left, limits, halvings - 1, report);
        judge_turning(&right, limits, halvings - 1, report);
    } else {
        report(if turn > most { FaultKind::Turn } else { FaultKind::Wheel });
    }
}
