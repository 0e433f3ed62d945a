//! Compares assignments with a dense library solver on thousands of small floors.

use super::*;
use crate::seeded::Seeded;

fn squared(starts: &[Vec2], goals: &[Vec2], goal: usize, start: usize) -> f64 {
    (starts[start] - goals[goal]).length_squared()
}

/// The least sum of costs by a dense solver; infinite if forbidden edges, which have infinite costs, cannot be avoided.
fn oracle(rows: usize, columns: usize, cost: impl Fn(usize, usize) -> f64) -> f64 {
    let costs: Vec<f64> = (0..rows * columns)
        .map(|edge| cost(edge / columns, edge % columns))
        .map(|cost| if cost.is_finite() { cost } else { 1e6 })
        .collect();
    let (of_row, of_column) = lsap::solve(rows, columns, &costs, false).unwrap();
    let sum: f64 = of_row.iter().zip(&of_column).map(|(&row, &column)| costs[row * columns + column]).sum();
    if sum >= 1e6 { f64::INFINITY } else { sum }
}

/// The bottleneck distance, found by trying every distance that occurs.
fn oracle_bottleneck(starts: &[Vec2], goals: &[Vec2], allowed: &dyn Fn(usize, usize) -> bool) -> f64 {
    let mut all: Vec<f64> = (0..goals.len())
        .flat_map(|goal| (0..starts.len()).map(move |start| (goal, start)))
        .map(|(goal, start)| squared(starts, goals, goal, start))
        .collect();
    all.sort_by(f64::total_cmp);
    let works = |reach: f64| {
        let cost = |goal: usize, start: usize| {
            let within = squared(starts, goals, goal, start) <= reach && allowed(goal, start);
            if within { 0.0 } else { f64::INFINITY }
        };
        oracle(goals.len(), starts.len(), cost).is_finite()
    };
    all[all.partition_point(|&reach| !works(reach))]
}

fn compare(starts: &[Vec2], goals: &[Vec2], pinned: &[Option<usize>]) {
    let choice = Choice::new(starts, goals, pinned).unwrap();
    let pin_of = |goal: usize| pinned.get(goal).copied().flatten();
    let allowed = |goal: usize, start: usize| match pin_of(goal) {
        Some(pin) => pin == start,
        None => !pinned.contains(&Some(start)),
    };
    let reach = oracle_bottleneck(starts, goals, &allowed);
    assert!(
        (choice.bottleneck_m() - reach.sqrt()).abs() < 1e-9,
        "{} {}",
        choice.bottleneck_m(),
        reach.sqrt()
    );
    let mut minimiser = choice.least_squares();
    for slack in [0.0, 0.07, 5.0] {
        let start_of = minimiser.solve(slack).unwrap();
        let limit = reach * (1.0 + slack) * (1.0 + slack) * ROUNDING;
        let cost = |goal: usize, start: usize| {
            let way = squared(starts, goals, goal, start);
            if way <= limit && allowed(goal, start) { way } else { f64::INFINITY }
        };
        let sum: f64 = start_of.iter().enumerate().map(|(goal, &start)| cost(goal, start)).sum();
        let mut used = start_of.clone();
        used.sort_unstable();
        used.dedup();
        assert_eq!(used.len(), goals.len());
        let least = oracle(goals.len(), starts.len(), cost);
        assert!((sum - least).abs() < 1e-8, "{sum} {least} slack {slack}");
    }
}

#[test]
fn thousands_of_small_floors_agree_with_a_dense_solver() {
    let mut seeded = Seeded::new(7);
    for case in 0..1500 {
        let count = 1 + seeded.below(14);
        let spares = if case % 3 == 0 { seeded.below(6) } else { 0 };
        // Every fifth floor is a lattice, full of ties.
        let lattice = case % 5 == 0;
        let mut place = || {
            let at = Vec2::new(seeded.between(-1.5, 1.5), seeded.between(-1.5, 1.5));
            if lattice { Vec2::new((at.x * 3.0).round() / 3.0, (at.y * 3.0).round() / 3.0) } else { at }
        };
        let starts: Vec<Vec2> = (0..count + spares).map(|_| place()).collect();
        let goals: Vec<Vec2> = (0..count).map(|_| place()).collect();
        let mut pinned = Vec::new();
        if case % 4 == 0 {
            pinned = vec![None; count / 2 + 1];
            pinned[0] = Some(seeded.below(count));
        }
        compare(&starts, &goals, &pinned);
    }
}

#[test]
fn pins_among_interchangeable_robots_agree_with_a_dense_solver() {
    let mut seeded = Seeded::new(11);
    for case in 0..2500 {
        let (count, spares) = (2 + seeded.below(9), seeded.below(4));
        // Every fourth floor is a lattice, full of ties.
        let cells = if case % 4 == 0 { 2.0 } else { 1e9 };
        let mut place = || {
            let mut along = || (seeded.between(-1.5, 1.5) * cells).round() / cells;
            Vec2::new(along(), along())
        };
        let starts: Vec<Vec2> = (0..count + spares).map(|_| place()).collect();
        let goals: Vec<Vec2> = (0..count).map(|_| place()).collect();
        let mut free: Vec<usize> = (0..starts.len()).collect();
        let mut pinned: Vec<Option<usize>> = (0..seeded.below(count + 1))
            .map(|_| (seeded.below(2) == 0).then(|| free.swap_remove(seeded.below(free.len()))))
            .collect();
        if case % 10 == 0 {
            pinned = (0..count).map(Some).collect();
        }
        compare(&starts, &goals, &pinned);
    }
}

#[test]
fn a_row_at_the_edge_spreads_over_the_floor() {
    let mut seeded = Seeded::new(3);
    for _ in 0..20 {
        let starts: Vec<Vec2> = (0..60).map(|i| Vec2::new(f64::from(i) * 0.05 - 1.5, 1.3)).collect();
        let goals: Vec<Vec2> =
            (0..60).map(|_| Vec2::new(seeded.between(-1.5, 1.5), seeded.between(-1.5, 1.5))).collect();
        compare(&starts, &goals, &[]);
    }
}

#[test]
fn crowds_that_move_far_agree_with_a_dense_solver() {
    let mut seeded = Seeded::new(21);
    for case in 0..10 {
        let count = 70 + seeded.below(60);
        let half_turn = Vec2::unit(seeded.between(0.2, 1.5));
        let starts: Vec<Vec2> = (0..count)
            .map(|i| match case % 2 {
                0 => Vec2::new((i % 12) as f64, (i / 12) as f64) * 0.1,
                _ => Vec2::unit((i % 24) as f64 * 0.2618) * (0.1 + 0.1 * (i / 24) as f64),
            })
            .collect();
        let goals: Vec<Vec2> = starts
            .iter()
            .map(|&at| match case {
                0..4 => Vec2::new(half_turn.dot(at), half_turn.cross(at)),
                4..7 => at.normalized().unwrap_or(half_turn) * (1.5 - at.length()),
                7 => at * 2.5 + half_turn,
                _ => Vec2::new(seeded.between(-1.5, 1.5), seeded.between(1.2, 1.4)),
            })
            .collect();
        compare(&starts, &goals, &[]);
        compare(&starts, &goals[..count - 9], &[]);
    }
}

#[test]
fn ties_are_broken_the_same_way_every_time() {
    let grid: Vec<Vec2> = (0..64).map(|i| Vec2::new(f64::from(i % 8), f64::from(i / 8)) * 0.1).collect();
    let moved: Vec<Vec2> = grid.iter().map(|&at| at + Vec2::new(0.05, 0.05)).collect();
    let solve = || Choice::new(&grid, &moved, &[]).unwrap().least_squares().solve(0.0).unwrap();
    assert_eq!(solve(), solve());
}

#[test]
fn what_cannot_be_is_refused() {
    let (a, b) = (Vec2::ZERO, Vec2::new(1.0, 0.0));
    assert!(Choice::new(&[a], &[a, b], &[]).is_none());
    assert!(Choice::new(&[a, b], &[a, b], &[Some(0), Some(0)]).is_none());
    assert!(Choice::new(&[a, b], &[a, b], &[Some(2)]).is_none());
    assert!(Choice::new(&[Vec2::new(f64::NAN, 0.0)], &[a], &[]).is_none());
    assert!(Choice::new(&[], &[], &[]).unwrap().least_squares().solve(0.0).unwrap().is_empty());
}
