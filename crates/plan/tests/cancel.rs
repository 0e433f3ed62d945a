//! Plans that are cancelled. Whenever that happens, there is no plan and no panic.

use std::cell::Cell;

use lightbots_base::{Limits, Vec2};
use lightbots_plan::{Cancelled, TransitionProblem, transition, transition_unless};
use lightbots_show::Obstacle;

/// A square grid of robots. Goal g is the start of robot `order(g)`.
fn grid(side: usize, apart_m: f64, half_m: f64, order: impl Fn(usize) -> usize) -> TransitionProblem {
    let at = |i: usize| (i as f64 - (side as f64 - 1.0) / 2.0) * apart_m;
    let starts: Vec<Vec2> = (0..side * side).map(|i| Vec2::new(at(i % side), at(i / side))).collect();
    TransitionProblem {
        goals: (0..starts.len()).map(|goal| starts[order(goal)]).collect(),
        starts,
        ..TransitionProblem::on_floor(Vec2::new(half_m, half_m), Limits::default())
    }
}

fn bound(problem: TransitionProblem) -> TransitionProblem {
    TransitionProblem { pinned: (0..problem.goals.len()).map(Some).collect(), ..problem }
}

fn problems() -> Vec<(&'static str, TransitionProblem)> {
    let turned = |count: usize| move |goal: usize| count - 1 - goal;
    let free = TransitionProblem {
        goals: (0..40)
            .map(|i| Vec2::new(f64::from(i % 8) * 0.3 - 1.0, f64::from(i / 8) * 0.2 - 0.9))
            .collect(),
        ..grid(7, 0.09, 1.5, |goal| goal)
    };
    let wall =
        |left: f64, right: f64| Obstacle::Rect { min: Vec2::new(left, -0.02), max: Vec2::new(right, 0.02) };
    let gate = TransitionProblem {
        starts: (0..4).map(|i| Vec2::new(f64::from(i) * 0.1 - 0.15, 0.25)).collect(),
        goals: (0..4).map(|i| Vec2::new(0.15 - f64::from(i) * 0.1, -0.25)).collect(),
        obstacles: vec![wall(-0.45, -0.034), wall(0.034, 0.45)],
        ..TransitionProblem::on_floor(Vec2::new(0.45, 0.45), Limits::default())
    };
    let corridor = TransitionProblem {
        starts: vec![Vec2::new(-0.2, 0.0), Vec2::new(0.2, 0.0)],
        goals: vec![Vec2::new(0.2, 0.0), Vec2::new(-0.2, 0.0)],
        ..TransitionProblem::on_floor(Vec2::new(0.3, 0.05), Limits::default())
    };
    vec![
        ("with spares", free),
        ("crossing", bound(grid(6, 0.12, 0.6, turned(36)))),
        ("through a gate", bound(gate)),
        ("without a way", bound(corridor)),
    ]
}

#[test]
fn whenever_a_plan_is_given_up_there_is_none() {
    for (name, problem) in problems() {
        let asked = Cell::new(0u64);
        let count = || {
            asked.set(asked.get() + 1);
            false
        };
        let whole = transition_unless(&problem, &count).unwrap();
        assert_eq!(whole, transition(&problem), "{name}: asking changes the plan");
        let questions = asked.get();
        assert!(questions > 20, "{name} asks {questions} times");
        let every = (questions / 40).max(1) as usize;
        for last in (1..20).chain((20..=questions).step_by(every)) {
            let left = Cell::new(last);
            // The answer is yes only once, so callers must remember it.
            let is_wanted = || {
                left.set(left.get().saturating_sub(1));
                left.get() == 0 && asked.replace(0) != 0
            };
            asked.set(1);
            assert_eq!(transition_unless(&problem, &is_wanted), Err(Cancelled), "{name} at question {last}");
        }
    }
}
