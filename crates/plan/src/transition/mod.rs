//! One transition from question to proven answer.

mod check;
mod parking;

pub(crate) use check::touching;
pub(crate) use parking::distance_to;

use crate::assignment::{Assignment, assign};
use crate::motion::Profile;
use crate::proof::{Proof, ProofInput, prove};
use crate::{Path, Stuck, Transition, TransitionProblem};
use lightbots_base::{Span, Vec2};

/// Least distance between rims that is planned for, metres, where starts and goals leave that much.
pub(crate) const MARGIN_M: f64 = 0.003;

/// The quickest proven transition that can be found, or why there is none.
pub fn transition(problem: &TransitionProblem) -> Result<Transition, Stuck> {
    let attempt = attempt(problem);
    match attempt.stuck {
        None => Ok(attempt.transition),
        Some(stuck) => Err(stuck),
    }
}

/// A transition that can be drawn even where it must not be driven.
pub(crate) struct Attempt {
    /// The best there is; straight lines that conflict if `stuck` says so.
    pub transition: Transition,
    /// Why it must not be driven.
    pub stuck: Option<Stuck>,
}

/// The best transition that can be found, proven or not.
pub(crate) fn attempt(problem: &TransitionProblem) -> Attempt {
    if let Err(stuck) = check::possible(problem) {
        return Attempt { transition: standing_still(problem), stuck: Some(stuck) };
    }
    let goals = problem.goals.len();
    let Some(chosen) = assign(&problem.starts, &problem.goals, &problem.pinned, 0.0) else {
        return Attempt { transition: standing_still(problem), stuck: Some(check::pins(problem)) };
    };
    let whole = parking::with_spares(problem, &chosen);
    let mut last = None;
    for slack in [0.0, 0.01, 0.03, 0.06, 0.1, 0.15] {
        let Some(assignment) = assign(&whole.starts, &whole.goals, &whole.pinned, slack) else { break };
        let (transition, proof) = straight(&whole, &assignment, goals, chosen.bottleneck_m);
        if proof.holds() {
            return Attempt { transition, stuck: None };
        }
        last = Some((transition, proof));
    }
    match last {
        Some((transition, proof)) => {
            let stuck = Some(check::conflict(problem, &transition, &proof));
            Attempt { transition, stuck }
        }
        None => Attempt { transition: standing_still(problem), stuck: Some(check::pins(problem)) },
    }
}

/// The proof of some paths for a problem.
fn judge(problem: &TransitionProblem, paths: &[Path]) -> Proof {
    prove(&ProofInput {
        paths,
        standing: &problem.standing,
        obstacles: &problem.obstacles,
        half_floor: problem.half_floor,
        limits: &problem.limits,
        gap_m: problem.limits.contact_m() + MARGIN_M,
    })
}

/// Straight synchronised lines for an assignment; of the goals only the first `shown` are real.
fn straight(
    problem: &TransitionProblem,
    assignment: &Assignment,
    shown: usize,
    bottleneck_m: f64,
) -> (Transition, Proof) {
    let mut ends: Vec<(Vec2, Option<usize>)> = problem.starts.iter().map(|&at| (at, None)).collect();
    for (goal, &start) in assignment.start_of.iter().enumerate() {
        ends[start] = (problem.goals[goal], Some(goal));
    }
    let longest = problem.starts.iter().zip(&ends).map(|(from, to)| from.distance(to.0)).fold(0.0, f64::max);
    let profile = Profile::quickest(longest, problem.easing, &problem.limits);
    let least = profile.duration();
    let profile = profile.stretched(problem.duration.unwrap_or(Span::ZERO));
    let paths: Vec<Path> =
        problem.starts.iter().zip(&ends).map(|(&from, to)| profile.path(from, to.0)).collect();
    let proof = judge(problem, &paths);
    let transition = Transition {
        goal_of: ends.iter().map(|end| end.1.filter(|&goal| goal < shown)).collect(),
        paths,
        duration: profile.duration(),
        least,
        lower_bound_s: bottleneck_m / problem.limits.speed_mps.max(1e-3),
        closest: proof.closest,
    };
    (transition, proof)
}

/// Everybody stays where they are.
fn standing_still(problem: &TransitionProblem) -> Transition {
    let total = problem.duration.unwrap_or(Span::ZERO);
    let profile = Profile::quickest(0.0, problem.easing, &problem.limits).stretched(total);
    let paths: Vec<Path> = problem.starts.iter().map(|&at| profile.path(at, at)).collect();
    let closest = judge(problem, &paths).closest;
    Transition {
        goal_of: vec![None; problem.starts.len()],
        paths,
        duration: profile.duration(),
        least: Span::ZERO,
        lower_bound_s: 0.0,
        closest,
    }
}
