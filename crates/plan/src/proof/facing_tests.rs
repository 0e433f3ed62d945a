//! Compares the proof's verdict on turns with a robot that is simulated step by step.

use super::tests::{LIMITS, REST, kinds};
use super::*;
use crate::seeded::Seeded;
use lightbots_base::{Piece, Vec2};

/// A step of the simulated robot, microseconds.
const STEP_US: i64 = 500;

/// From rest to rest along one cubic.
fn drive(from: Vec2, to: Vec2, millis: i64) -> Piece {
    Piece { duration: Span::from_millis(millis), c1: from, c2: to, end: to }
}

#[test]
fn slow_stretches_of_straight_pieces_give_time_to_turn() {
    let (a, b, c) = (Vec2::ZERO, Vec2::new(0.3, 0.0), Vec2::new(0.3, 0.3));
    // 0.3 m in 20 s: 22.5 mm/s at most, and for seconds less than 20 mm/s at both ends of each piece.
    let slow = Path { start: a, pieces: vec![drive(a, b, 20_000), drive(b, c, 20_000)] };
    assert_eq!(kinds(slow), []);
    // In 2 s it is slow for 45 ms before and after the corner, and lacks 260 of 350 ms.
    let quick = Path { start: a, pieces: vec![Piece::rest(a, REST), drive(a, b, 2_000), drive(b, c, 2_000)] };
    assert_eq!(kinds(quick), [FaultKind::Turn]);
    // At most 19 mm/s all the way: its direction never matters.
    let creeping = Path { start: a, pieces: vec![drive(a, b, 24_000), drive(b, c, 24_000)] };
    assert_eq!(kinds(creeping), []);
}

#[test]
fn many_small_corners_need_the_time_of_all() {
    // Stops of no time, and little driving in between: each corner lacks 45 ms, and the drive makes up for 38.
    let (mut at, mut pieces) = (Vec2::ZERO, vec![Piece::rest(Vec2::ZERO, REST)]);
    for corner in 0..20 {
        let end = at + Vec2::unit(f64::from(corner) * 0.43) * 0.001_3;
        pieces.push(drive(at, end, 89));
        at = end;
    }
    let few = Path { start: Vec2::ZERO, pieces: pieces[..3].to_vec() };
    assert_eq!(kinds(few), []);
    assert_eq!(kinds(Path { start: Vec2::ZERO, pieces }), [FaultKind::Turn]);
}

/// Largest error of the direction of a robot that turns as fast as it can, while its direction matters. It is given as
/// the time to turn by that error, seconds.
fn most_behind_s(path: &Path) -> f64 {
    let most_rad = LIMITS.turn_radps * STEP_US as f64 * 1e-6;
    let steps = path.as_ref().duration().0 / STEP_US;
    let velocity = |step: i64| path.as_ref().at(Span(step * STEP_US)).velocity;
    let velocities: Vec<Vec2> = (0..steps).map(velocity).collect();
    // While it is slow it turns towards where it will be fast next.
    let mut aims: Vec<Option<f64>> = vec![None; velocities.len() + 1];
    for step in (0..velocities.len()).rev() {
        let is_fast = velocities[step].length() >= 0.02;
        aims[step] = if is_fast { Some(velocities[step].angle()) } else { aims[step + 1] };
    }
    // The robot begins at the worst angle to its line.
    let mut facing = aims[0].unwrap_or(0.0) + core::f64::consts::FRAC_PI_2;
    let mut most = 0.0f64;
    for (velocity, aim) in velocities.iter().zip(&aims) {
        let Some(aim) = *aim else { continue };
        let half = core::f64::consts::PI;
        let off = (aim - facing) - ((aim - facing) / half).round() * half;
        facing += off.clamp(-most_rad, most_rad);
        if velocity.length() >= 0.02 {
            most = most.max((off.abs() - most_rad).max(0.0) / LIMITS.turn_radps);
        }
    }
    most
}

#[test]
fn the_proof_agrees_with_a_robot_that_turns_step_by_step() {
    let mut seeded = Seeded::new(41);
    let mut seen = [0; 2];
    for _ in 0..60 {
        let mut at = Vec2::ZERO;
        let mut pieces = vec![Piece::rest(at, Span::from_millis(270 + seeded.below(200) as i64))];
        let mut direction = seeded.between(0.0, 6.0);
        for _ in 0..3 {
            direction += seeded.between(-1.5, 1.5);
            let length_m = seeded.between(0.05, 0.3);
            let end = at + Vec2::unit(direction) * length_m;
            // As quick as 0.95 m/s² and 0.26 m/s allow, or slower.
            let quickest_s = (6.0 * length_m / 0.95).sqrt().max(1.5 * length_m / 0.26);
            pieces.push(drive(at, end, (quickest_s * seeded.between(1.0, 1.8) * 1e3) as i64));
            pieces.push(Piece::rest(end, Span::from_millis(1 + seeded.below(400) as i64)));
            at = end;
        }
        let path = Path { start: Vec2::ZERO, pieces };
        let (behind_s, found) = (most_behind_s(&path), kinds(path));
        if behind_s < 0.045 {
            assert_eq!(found, [], "a false alarm: behind by {behind_s} s");
            seen[0] += 1;
        } else if behind_s > 0.055 {
            assert_eq!(found, [FaultKind::Turn], "missed: behind by {behind_s} s");
            seen[1] += 1;
        }
    }
    assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
}

#[test]
fn pieces_without_end_are_refused_and_not_looked_at_without_end() {
    let far = Vec2::new(0.3, 1e308);
    let all_time = Piece { duration: Span(i64::MAX), c1: Vec2::ZERO, c2: far, end: far };
    assert_eq!(kinds(Path { start: Vec2::ZERO, pieces: vec![all_time] }), [FaultKind::Malformed]);
}
