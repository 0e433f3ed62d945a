//! Plans as text, compared with stored snapshots: a change of the planner shows in a diff.
//!
//! `INSTA_UPDATE=always cargo test -p lightbots-plan --test snapshots` stores the new plans.

#[path = "../examples/repair/crowds.rs"]
mod crowds;
#[path = "../examples/common/dice.rs"]
mod dice;
#[path = "../examples/common/places.rs"]
mod places;

use std::fmt::Write as _;

use lightbots_base::{Limits, Vec2};
use lightbots_plan::{Path, Transition, TransitionProblem, transition};
use lightbots_show::{Easing, Obstacle};

/// FNV-1a over the bits of all pieces. Plans that differ in a bit have different fingerprints, but for rare collisions.
fn fingerprint(paths: &[Path]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |word: u64| {
        for byte in word.to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for path in paths {
        [path.start.x, path.start.y].into_iter().for_each(|value| add(value.to_bits()));
        for piece in &path.pieces {
            add(piece.duration.0 as u64);
            for at in [piece.c1, piece.c2, piece.end] {
                [at.x, at.y].into_iter().for_each(|value| add(value.to_bits()));
            }
        }
    }
    hash
}

/// One line about a plan: its duration, the ratio to its bound, its least clearance, its greatest number of pieces and
/// its fingerprint. Without a plan, the line is the planner's message.
fn summary(name: &str, problem: &TransitionProblem) -> String {
    match transition(problem) {
        Ok(plan) => {
            let ratio = plan.duration.as_secs() / (plan.lower_bound_s + 0.62);
            let clearance_mm =
                plan.closest.map_or(f64::INFINITY, |c| c.distance_m - problem.limits.contact_m()) * 1e3;
            let pieces = plan.paths.iter().map(|path| path.pieces.len()).max().unwrap_or(0);
            format!(
                "{name}: {:.3} s, {ratio:.3} of the bound, clearance {clearance_mm:.2} mm, {pieces} pieces, {:016x}\n",
                plan.duration.as_secs(),
                fingerprint(&plan.paths)
            )
        }
        Err(stuck) => format!("{name}: {}\n", stuck.message),
    }
}

/// A whole plan of a few robots as text.
fn text(plan: &Transition) -> String {
    let mut text = format!("{:.3} s, least {:.3} s\n", plan.duration.as_secs(), plan.least.as_secs());
    for (robot, path) in plan.paths.iter().enumerate() {
        let goal = plan.goal_of[robot].map_or("spare".into(), |goal| format!("goal {goal}"));
        let _ = writeln!(text, "robot {robot} to {goal} from ({:.4}, {:.4})", path.start.x, path.start.y);
        for (start, begin, piece) in path.as_ref().timed() {
            let (from, to) = (begin.as_secs(), (begin + piece.duration).as_secs());
            let what = if piece.is_rest(start) {
                "rests".into()
            } else {
                format!("to ({:.4}, {:.4})", piece.end.x, piece.end.y)
            };
            let _ = writeln!(text, "  {from:.3} to {to:.3} s: {what}");
        }
    }
    text
}

fn floor(half_m: f64) -> TransitionProblem {
    TransitionProblem::on_floor(Vec2::new(half_m, half_m), Limits::ELISA_3)
}

fn places(places: &[(f64, f64)]) -> Vec<Vec2> {
    places.iter().map(|&(x, y)| Vec2::new(x, y)).collect()
}

#[test]
fn straight_lines_of_three_robots() {
    let problem = TransitionProblem {
        starts: places(&[(-0.5, 0.0), (0.0, 0.0), (0.5, 0.0)]),
        goals: places(&[(0.5, 0.5), (-0.5, 0.5)]),
        ..floor(1.0)
    };
    insta::assert_snapshot!(text(&transition(&problem).unwrap()));
}

#[test]
fn two_robots_that_change_places() {
    let starts = places(&[(-0.3, 0.0), (0.3, 0.0)]);
    let goals = places(&[(0.3, 0.0), (-0.3, 0.0)]);
    let problem = TransitionProblem { starts, goals, pinned: vec![Some(0), Some(1)], ..floor(0.6) };
    insta::assert_snapshot!(text(&transition(&problem).unwrap()));
}

#[test]
fn crowds_with_fixed_identity() {
    let mut summaries = String::new();
    for (name, build) in crowds::ALL {
        for robots in [12, 40] {
            if name != "hopeless" {
                summaries += &summary(&format!("{name}, {robots} robots"), &build(robots, 1));
            }
        }
    }
    insta::assert_snapshot!(summaries);
}

#[test]
fn crowds_in_which_any_robot_may_show_any_pixel() {
    let mut summaries = String::new();
    for (name, build) in crowds::ALL {
        for robots in [12, 100] {
            let problem = TransitionProblem { pinned: Vec::new(), ..build(robots, 2) };
            summaries += &summary(&format!("{name}, {robots} robots"), &problem);
        }
    }
    insta::assert_snapshot!(summaries);
}

#[test]
fn robots_of_another_size_and_crowds_that_only_stop_and_go_resolves() {
    let large = Limits { radius_m: 0.05, ..Limits::ELISA_3 };
    let starts = places(&[(-0.5, 0.0), (0.5, 0.0), (0.0, 0.5), (0.0, -0.5)]);
    let goals = starts.iter().map(|&at| -at).collect();
    let pinned = (0..4).map(Some).collect();
    let large = TransitionProblem { starts, goals, pinned, limits: large, ..floor(1.0) };
    let grid = |i: usize| Vec2::new((i % 3) as f64 - 1.0, (i / 3) as f64 - 1.0) * 0.06;
    let tight = TransitionProblem {
        starts: (0..8).map(grid).collect(),
        goals: [1, 0, 2, 3, 4, 5, 7, 6].map(grid).to_vec(),
        pinned: (0..8).map(Some).collect(),
        ..floor(0.125)
    };
    insta::assert_snapshot!(summary("large robots", &large) + &summary("tight", &tight));
}

#[test]
fn messages_of_problems_without_a_plan() {
    let wall = |gap_m: f64| {
        let rect = |min, max| Obstacle::Rect { min, max };
        vec![
            rect(Vec2::new(-0.05, -1.0), Vec2::new(0.05, -gap_m / 2.0)),
            rect(Vec2::new(-0.05, gap_m / 2.0), Vec2::new(0.05, 1.0)),
        ]
    };
    let crossing = |gap_m: f64, easing: Easing| TransitionProblem {
        starts: places(&[(-0.5, 0.2), (-0.5, -0.2), (0.5, 0.0)]),
        goals: places(&[(0.5, 0.2), (0.5, -0.2), (-0.5, 0.0)]),
        pinned: (0..3).map(Some).collect(),
        obstacles: wall(gap_m),
        easing,
        ..floor(1.0)
    };
    let mut summaries = String::new();
    for gap_m in [0.2, 0.1, 0.062, 0.055] {
        summaries += &summary(&format!("gap of {:.0} mm", gap_m * 1e3), &crossing(gap_m, Easing::Swift));
    }
    summaries += &summary("gentle", &crossing(0.2, Easing::Gentle));
    insta::assert_snapshot!(summaries);
}
