//! Whole repairs, checked by the proof.

use super::*;
use crate::motion::quarter_turn;
use crate::proof::prove;
use crate::seeded::Seeded;
use lightbots_base::{Limits, Span, Vec2};
use lightbots_show::Obstacle;

/// `count` random places at least `apart` metres from each other on a square floor, 2 · `half` metres a side.
fn places(seeded: &mut Seeded, count: usize, half: f64, apart: f64) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = Vec::new();
    let reach = half - 0.027;
    for _ in 0..100_000 {
        let place = Vec2::new(seeded.between(-reach, reach), seeded.between(-reach, reach));
        if places.len() < count && places.iter().all(|other| other.distance(place) >= apart) {
            places.push(place);
        }
    }
    places
}

fn problem(starts: Vec<Vec2>, goals: Vec<Vec2>, half: f64) -> TransitionProblem {
    TransitionProblem { starts, goals, ..TransitionProblem::on_floor(Vec2::new(half, half), Limits::ELISA_3) }
}

fn random(count: usize, half: f64, apart: f64, seed: u64) -> TransitionProblem {
    let mut seeded = Seeded::new(seed);
    let starts = places(&mut seeded, count, half, apart);
    let goals = places(&mut seeded, count, half, apart);
    problem(starts, goals, half)
}

/// Repairs with goal i for start i, and asserts that the proof holds and paths are whole. Returns the duration divided
/// by the least for the longest straight line: at full speed, with 0.62 s for a turn and a ramp.
fn ratio(problem: &TransitionProblem) -> f64 {
    let goal_of: Vec<Option<usize>> =
        (0..problem.starts.len()).map(|i| (i < problem.goals.len()).then_some(i)).collect();
    let paths = repair(problem, &goal_of).expect("a way").paths;
    let proof = prove(&problem.to_prove(&paths));
    assert!(proof.holds(), "{} conflicts, faults {:?}", proof.conflicts.len(), proof.faults);
    for (i, path) in paths.iter().enumerate() {
        assert_eq!(path.start, problem.starts[i]);
        assert!(problem.goals.get(i).is_none_or(|&goal| path.as_ref().end() == goal));
        assert_eq!(path.as_ref().duration(), paths[0].as_ref().duration());
        assert!(path.pieces.len() <= 128 && path.pieces[0].duration >= quarter_turn(&problem.limits));
    }
    let longest = problem.starts.iter().zip(&problem.goals).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    paths[0].as_ref().duration().as_secs() / (longest / 0.27 + 0.62)
}

/// Places in a row, 0.1 m apart.
fn row(count: usize, y: f64) -> Vec<Vec2> {
    let x = |index: usize| (index as f64 - (count as f64 - 1.0) / 2.0) * 0.1;
    (0..count).map(|index| Vec2::new(x(index), y)).collect()
}

#[test]
fn two_robots_that_change_places_pass_each_other() {
    let (a, b) = (Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0));
    assert!(ratio(&problem(vec![a, b], vec![b, a], 1.5)) < 1.1);
}

#[test]
fn thirty_with_fixed_identity_cross_a_floor() {
    for seed in 0..6 {
        let ratio = ratio(&random(30, 1.5, 0.0774, seed));
        assert!(ratio < 1.1, "{seed}: {ratio}");
    }
}

#[test]
fn a_dense_crowd_with_fixed_identity_gets_through() {
    for seed in 0..4 {
        let ratio = ratio(&random(40, 0.42, 0.0774, seed));
        assert!(ratio < 1.5, "{seed}: {ratio}");
    }
}

/// Returns by how much robots come closer to the floor's edge than they may, metres. They may come as close as
/// `wanted_m`, or as their starts and ends.
fn nearer_to_edge_m(problem: &TransitionProblem, wanted_m: f64) -> f64 {
    let goal_of: Vec<Option<usize>> = (0..problem.starts.len()).map(Some).collect();
    let paths = repair(problem, &goal_of).expect("a way").paths;
    let half = problem.half_floor - Vec2::new(1.0, 1.0) * problem.limits.radius_m;
    let off = |at: Vec2| [half.x - at.x, half.x + at.x, half.y - at.y, half.y + at.y];
    let mut most_m = f64::NEG_INFINITY;
    for path in &paths {
        let path = path.as_ref();
        let (start, end) = (off(path.start), off(path.end()));
        for moment in 0..=path.duration().0 / 20_000 {
            let at = off(path.at(Span::from_millis(20 * moment)).position);
            let sides = (0..4).map(|side| wanted_m.min(start[side]).min(end[side]) - at[side]);
            most_m = sides.fold(most_m, f64::max);
        }
    }
    most_m
}

#[test]
fn a_crowd_keeps_off_the_edge_where_its_ends_do() {
    for seed in 0..3 {
        let nearer_m = nearer_to_edge_m(&random(40, 0.42, 0.0774, seed), 0.0035);
        assert!(nearer_m < 1e-6, "{seed}: {nearer_m}");
    }
}

#[test]
fn robots_that_wait_in_front_of_a_narrow_gap_keep_apart() {
    let wall = |from: f64, to: f64| Obstacle::Rect { min: Vec2::new(from, -0.05), max: Vec2::new(to, 0.05) };
    for (robots, wide_m) in [(6, 0.061), (7, 0.061), (8, 0.061), (9, 0.061), (8, 0.064)] {
        let problem = TransitionProblem {
            obstacles: vec![wall(-0.6, wide_m / -2.0), wall(wide_m / 2.0, 0.6)],
            ..problem(row(robots, 0.3), row(robots, -0.3), 0.6)
        };
        let goal_of: Vec<Option<usize>> = (0..robots).map(Some).collect();
        let proof = prove(&problem.to_prove(&repair(&problem, &goal_of).expect("a way").paths));
        let apart_m = proof.closest.expect("a closest pair").distance_m;
        assert!(proof.holds() && apart_m > 0.0615, "{robots}, {wide_m}: {apart_m}");
    }
}

#[test]
fn a_robot_that_drives_from_stop_to_stop_keeps_off_the_edge_too() {
    // A bay in a corridor: one must step aside into it.
    let wall = |from: f64, to: f64| Obstacle::Rect { min: Vec2::new(from, -0.02), max: Vec2::new(to, 0.1) };
    let (a, b) = (Vec2::new(-0.25, -0.06), Vec2::new(0.25, -0.06));
    let floor = TransitionProblem::on_floor(Vec2::new(0.3, 0.1), Limits::ELISA_3);
    let problem = TransitionProblem {
        obstacles: vec![wall(-0.3, -0.07), wall(0.0, 0.3)],
        starts: vec![a, b],
        goals: vec![b, a],
        ..floor
    };
    let nearer_m = nearer_to_edge_m(&problem, 0.003);
    assert!(nearer_m < 1e-6, "{nearer_m}");
}

#[test]
fn a_gap_to_the_edge_that_just_lets_a_robot_through_is_still_used() {
    let wall = Obstacle::Rect { min: Vec2::new(-0.02, -0.3), max: Vec2::new(0.02, 0.3 - 0.0575) };
    let (start, goal) = (vec![Vec2::new(-0.2, 0.0)], vec![Vec2::new(0.2, 0.0)]);
    let problem = TransitionProblem { obstacles: vec![wall], ..problem(start, goal, 0.3) };
    let ratio = ratio(&problem);
    assert!(ratio < 6.0, "{ratio}");
}

/// A square grid, 80 mm apart.
fn grid(side: usize, middle: Vec2) -> Vec<Vec2> {
    let at = |i: usize| (i as f64 - (side as f64 - 1.0) / 2.0) * 0.08;
    (0..side * side).map(|i| middle + Vec2::new(at(i % side), at(i / side))).collect()
}

#[test]
fn a_shuffled_grid_is_sorted() {
    for (side, seed) in [(6, 1), (6, 2), (14, 3)] {
        let (starts, mut seeded) = (grid(side, Vec2::ZERO), Seeded::new(seed));
        let mut goals = starts.clone();
        (1..goals.len()).rev().for_each(|last| goals.swap(last, seeded.below(last + 1)));
        let ratio = ratio(&problem(starts, goals, side as f64 * 0.06));
        assert!(ratio < 2.6, "{side} {seed}: {ratio}");
    }
}

#[test]
fn a_thousand_in_a_shuffled_grid_take_no_longer_than_twice_the_least() {
    let (starts, mut seeded) = (grid(32, Vec2::ZERO), Seeded::new(4));
    let mut goals = starts.clone();
    (1..goals.len()).rev().for_each(|last| goals.swap(last, seeded.below(last + 1)));
    let ratio = ratio(&problem(starts, goals, 32.0 * 0.06 + 0.03));
    assert!(ratio < 2.0, "{ratio}");
}

#[test]
fn a_mirrored_crowd_passes_through_itself() {
    for seed in 0..3 {
        let starts = places(&mut Seeded::new(seed), 60, 0.55, 0.0774);
        let goals = starts.iter().map(|at| Vec2::new(-at.x, at.y)).collect();
        let ratio = ratio(&problem(starts, goals, 0.55));
        assert!(ratio < 1.6, "{seed}: {ratio}");
    }
}

#[test]
fn two_blocks_change_places() {
    let (left, right) = (grid(6, Vec2::new(-0.4, 0.0)), grid(6, Vec2::new(0.4, 0.0)));
    let problem = problem([left.clone(), right.clone()].concat(), [right, left].concat(), 0.9);
    assert!(ratio(&problem) < 1.5);
}

#[test]
fn a_crowd_turns_half_around_its_middle() {
    let starts = grid(7, Vec2::ZERO);
    let goals = starts.iter().map(|&at| -at).collect();
    assert!(ratio(&problem(starts, goals, 0.5)) < 1.6);
}

#[test]
fn a_crowd_gets_through_between_robots_that_stand() {
    for seed in 0..2 {
        let mut seeded = Seeded::new(seed);
        let mut standing = places(&mut seeded, 6, 0.5, 0.25);
        let mut clear = |count: usize| {
            let all = places(&mut seeded, count + 20, 0.6, 0.0774);
            let free = |at: &Vec2| standing.iter().all(|other| other.distance(*at) > 0.08);
            all.into_iter().filter(free).take(count).collect::<Vec<_>>()
        };
        let (starts, goals) = (clear(40), clear(40));
        let mut problem = problem(starts, goals, 0.6);
        problem.standing.append(&mut standing);
        let ratio = ratio(&problem);
        assert!(ratio < 1.6, "{seed}: {ratio}");
    }
}

#[test]
fn close_pixels_are_no_obstacle() {
    for seed in 0..4 {
        let ratio = ratio(&random(24, 0.35, 0.06, seed));
        assert!(ratio < 1.6, "{seed}: {ratio}");
    }
}

/// The places nearest to the middle on a hexagonal grid.
fn blob(count: usize, pitch: f64) -> Vec<Vec2> {
    let row = |y: i32| (-9..=9).map(move |x| Vec2::new(f64::from(x) + f64::from(y % 2) * 0.5, f64::from(y)));
    let mut places: Vec<Vec2> = (-9..=9).flat_map(row).collect();
    places.iter_mut().for_each(|at| *at = Vec2::new(at.x, at.y * 0.75_f64.sqrt()) * pitch);
    places.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    places.truncate(count);
    places
}

#[test]
fn neighbours_in_a_tight_crowd_change_places() {
    for (count, pitch) in [(19, 0.06), (19, 0.07), (37, 0.065)] {
        let starts = blob(count, pitch);
        let mut goals = starts.clone();
        // Nearest neighbours swap places, all over the fleet.
        let mut free: Vec<usize> = (0..count).collect();
        while let Some(one) = free.pop() {
            let beside = |other: &usize| starts[one].distance(starts[*other]) < pitch * 1.1;
            if let Some(at) = free.iter().position(beside) {
                goals.swap(one, free.swap_remove(at));
            }
        }
        let ratio = ratio(&problem(starts, goals, 0.55));
        assert!(ratio < 6.5, "{count} {pitch}: {ratio}");
    }
}

#[test]
fn a_queue_gets_through_a_gap_no_wider_than_it_must_be() {
    let (left, right) = (grid(2, Vec2::new(-0.4, 0.2)), grid(2, Vec2::new(0.4, -0.2)));
    for width in [0.061, 0.066] {
        let mut problem = problem(left.clone(), right.clone(), 0.6);
        problem.obstacles = vec![
            Obstacle::Rect { min: Vec2::new(-0.1, 0.05 + width), max: Vec2::new(0.1, 0.6) },
            Obstacle::Rect { min: Vec2::new(-0.1, -0.6), max: Vec2::new(0.1, 0.05) },
        ];
        let ratio = ratio(&problem);
        assert!(ratio < 6.5, "{width}: {ratio}");
    }
}

/// A corridor of this width along the lower edge of a floor 0.3 m deep, with a bay above it between two walls.
fn bay(width: f64, from: f64, to: f64) -> Vec<Obstacle> {
    let top = width - 0.15;
    vec![
        Obstacle::Rect { min: Vec2::new(-0.6, top), max: Vec2::new(from, 0.15) },
        Obstacle::Rect { min: Vec2::new(to, top), max: Vec2::new(0.6, 0.15) },
    ]
}

#[test]
fn two_change_places_where_one_can_step_aside() {
    for (width, from, to) in [(0.061, -0.04, 0.04), (0.08, 0.1, 0.18), (0.07, -0.3, -0.15)] {
        let (a, b) = (Vec2::new(-0.4, width / 2.0 - 0.15), Vec2::new(0.4, width / 2.0 - 0.15));
        let mut problem = problem(vec![a, b], vec![b, a], 0.6);
        (problem.half_floor.y, problem.obstacles) = (0.15, bay(width, from, to));
        let ratio = ratio(&problem);
        assert!(ratio < 4.0, "{width} {from}: {ratio}");
    }
}

#[test]
fn two_change_places_where_one_must_stop_and_turn_into_a_bay() {
    for (width, wide, deep, at) in [(0.062, 0.0875, 0.0713, -0.1771), (0.0754, 0.0701, 0.1027, -0.1568)] {
        let half = Vec2::new(0.6, width / 2.0 + deep);
        let (top, y) = (width - half.y, width / 2.0 - half.y);
        let (a, b) = (Vec2::new(-0.4, y), Vec2::new(0.4, y));
        let mut problem = problem(vec![a, b], vec![b, a], 0.6);
        problem.half_floor = half;
        problem.obstacles = vec![
            Obstacle::Rect { min: Vec2::new(-0.6, top), max: Vec2::new(at - wide / 2.0, half.y) },
            Obstacle::Rect { min: Vec2::new(at + wide / 2.0, top), max: half },
        ];
        let ratio = ratio(&problem);
        assert!(ratio < 4.0, "{width} {wide}: {ratio}");
    }
}

#[test]
fn a_gap_one_robot_wide_is_passed_both_ways() {
    let (left, right) = (grid(2, Vec2::new(-0.4, 0.2)), grid(2, Vec2::new(0.4, -0.2)));
    let mut problem = problem([left.clone(), right.clone()].concat(), [right, left].concat(), 0.6);
    problem.obstacles = vec![
        Obstacle::Rect { min: Vec2::new(-0.15, 0.117), max: Vec2::new(0.15, 0.6) },
        Obstacle::Rect { min: Vec2::new(-0.15, -0.6), max: Vec2::new(0.15, 0.05) },
    ];
    let ratio = ratio(&problem);
    assert!(ratio < 5.0, "{ratio}");
}

#[test]
fn ways_lead_around_walls_and_robots_that_stand() {
    let column = |x: f64| (0..6).map(|i| Vec2::new(x, f64::from(i) * 0.1 - 0.25)).collect::<Vec<_>>();
    let mut problem = problem(column(-0.8), column(0.8), 1.2);
    problem.obstacles = vec![
        Obstacle::Rect { min: Vec2::new(-0.1, -0.6), max: Vec2::new(0.1, 0.5) },
        Obstacle::Disc { at: Vec2::new(0.5, 0.1), radius_m: 0.1 },
    ];
    problem.standing = vec![Vec2::new(-0.5, 0.0), Vec2::new(-0.4, 0.7)];
    assert!(ratio(&problem) < 1.6);
}

#[test]
fn a_spare_robot_steps_aside() {
    let mut starts = vec![Vec2::new(-0.4, 0.0)];
    starts.extend((-4..=4).map(|i| Vec2::new(0.0, f64::from(i) * 0.06)));
    assert!(ratio(&problem(starts, vec![Vec2::new(0.4, 0.0)], 0.5)) < 1.8);
}

#[test]
fn a_walled_in_robot_gets_no_path() {
    let mut problem = problem(vec![Vec2::ZERO], vec![Vec2::new(1.0, 0.0)], 1.5);
    let side = |min: (f64, f64), max: (f64, f64)| Obstacle::Rect {
        min: Vec2::new(min.0, min.1),
        max: Vec2::new(max.0, max.1),
    };
    problem.obstacles = vec![
        side((-0.3, 0.2), (0.3, 0.3)),
        side((-0.3, -0.3), (0.3, -0.2)),
        side((-0.3, -0.3), (-0.2, 0.3)),
        side((0.2, -0.3), (0.3, 0.3)),
    ];
    assert_eq!(repair(&problem, &[Some(0)]), Err(Vec::new()));
}

#[test]
fn a_wished_for_duration_is_kept() {
    let mut problem = random(10, 0.4, 0.0774, 3);
    problem.duration = Some(Span::from_secs(20.0));
    let goal_of: Vec<Option<usize>> = (0..10).map(Some).collect();
    let Repaired { paths, least } = repair(&problem, &goal_of).unwrap();
    assert!((paths[0].as_ref().duration().as_secs() - 20.0).abs() < 1e-3);
    assert!(prove(&problem.to_prove(&paths)).holds());
    // The least duration is that of the same problem without an asked duration, and it may be asked for.
    for wish in [None, Some(least)] {
        problem.duration = wish;
        let quick = repair(&problem, &goal_of).unwrap();
        assert_eq!((quick.least, quick.paths[0].as_ref().duration()), (least, least));
        assert!(prove(&problem.to_prove(&quick.paths)).holds() && least < Span::from_secs(10.0));
    }
}

#[test]
fn nonsense_is_refused() {
    let problem = problem(vec![Vec2::new(f64::NAN, 0.0)], vec![Vec2::ZERO], 1.5);
    assert_eq!(repair(&problem, &[Some(0)]), Err(Vec::new()));
    assert_eq!(repair(&problem, &[Some(7)]), Err(Vec::new()));
    assert_eq!(repair(&problem, &[]), Err(Vec::new()));
}
