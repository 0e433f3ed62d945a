//! A robot follows another that stops dead, with noisy sensors: how often they touch, and how often the robot brakes
//! for nothing.

use super::estimator_tests::{Dice, Disc, readings};
use super::scan::Expectation;
use super::{Point, Reflex, Wish};
use crate::config::Config;
use lightbots_base::RobotId;
use lightbots_base::braking::stopping_m;

/// Duration of a step, seconds.
const DT: f32 = 0.016;
/// Speed of both robots, m/s.
const SPEED_MPS: f32 = 0.27;
/// Number of runs for each gap and offset of the two paths.
const RUNS: usize = 2000;
/// How far each of the two is off its route, 1 sigma in each axis, metres. Along the line of sight, 0.5 to 0.9 mm were
/// measured in rehearsals with standard conditions on 2026-11-24.
const OFF_M: f32 = 0.001;
/// Number of steps before the other robot stops dead.
const BEFORE: usize = 45;
/// Number of steps after the other robot stopped.
const AFTER: usize = 40;

/// Results of many runs.
#[derive(Debug, Default)]
struct Tally {
    touched: usize,
    false_brakes: usize,
}

/// Simulates a robot that follows another at a planned gap, `aside_m` beside its path, metres. The other robot stops
/// dead.
fn follow(gap_m: f32, aside_m: f32, off_m: f32, dice: &mut Dice, tally: &mut Tally) {
    let mut reflex = Reflex::new(&Config::new(RobotId::from_random(1)));
    let far_m = 0.054 + gap_m;
    let ahead_m = libm::sqrtf(far_m * far_m - aside_m * aside_m);
    // Both are off their routes, by a constant offset.
    let off = Point::new(off_m * dice.normal(), off_m * dice.normal());
    let (mut x, mut now_mps, mut told_mps) = (0.0f32, SPEED_MPS, SPEED_MPS);
    let mut other = Point::new(ahead_m, aside_m);
    for step in 0..BEFORE + AFTER {
        // The other robot stops within a step.
        let other_mps = match step {
            ..BEFORE => SPEED_MPS,
            BEFORE => SPEED_MPS * dice.uniform(),
            _ => 0.0,
        };
        x += now_mps * DT;
        other.x += other_mps * DT;
        let at = Point::new(other.x - x, other.y);
        if at.length() < 0.054 {
            tally.touched += 1;
            return;
        }
        let due = Point::new(ahead_m + SPEED_MPS * DT * (step + 1) as f32 - x, aside_m);
        let planned = Expectation {
            index: 0,
            at: due.plus(off),
            velocity: Point::new(SPEED_MPS, 0.0),
            acceleration: Point::ZERO,
            clearance_m: gap_m,
        };
        let gaps_m = readings(&[Disc { at, velocity: Point::new(other_mps, 0.0) }], dice);
        reflex.look(
            Some(&gaps_m),
            (f64::from(now_mps * DT), 0.0),
            f64::from(DT),
            &[planned],
            f64::from(0.5 * off_m),
        );
        let limit = reflex.limit(Wish { speed_mps: SPEED_MPS, told_mps, dt: DT }, None);
        let most_mps = limit.map_or(SPEED_MPS, |mps| mps as f32);
        if most_mps < SPEED_MPS - 0.001 && step < BEFORE {
            tally.false_brakes += 1;
        }
        // Tyres lose at most this speed in a step.
        now_mps = told_mps.max(now_mps - 0.188);
        told_mps = most_mps;
    }
}

fn tally(gap_m: f32, aside_m: f32, off_m: f32) -> Tally {
    let (mut dice, mut tally) = (Dice(3), Tally::default());
    (0..RUNS).for_each(|_| follow(gap_m, aside_m, off_m, &mut dice, &mut tally));
    tally
}

#[test]
fn deaths_beyond_the_stopping_distance_are_seen_in_time() {
    let stopping_m = stopping_m(f64::from(SPEED_MPS)) as f32;
    for (gap_m, aside_m) in
        [(stopping_m, 0.0), (stopping_m, 0.03), (0.02, 0.01), (0.022, 0.005), (0.026, 0.0)]
    {
        let tally = tally(gap_m, aside_m, OFF_M);
        assert!(tally.touched * 100 <= 3 * RUNS, "{gap_m} {aside_m}: {tally:?}");
        assert!(tally.false_brakes * 20_000 <= RUNS * BEFORE, "{gap_m} {aside_m}: {tally:?}");
    }
}
