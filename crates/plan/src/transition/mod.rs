//! One transition from question to proven answer.

mod candidate;
mod conflict;
mod deform;
mod feasibility;
mod following;
mod reachability;
mod spares;
mod straight;
#[cfg(test)]
mod tests;

pub(crate) use feasibility::touching;
pub(crate) use spares::distance_to;

use crate::assignment::Choice;
use crate::cancel::{Cancel, Cancelled, unless};
use crate::proof::{Proof, prove_unless};
use crate::solve::repair_unless;
use crate::{Infeasible, Repaired, Transition, TransitionProblem};
use candidate::Candidate;
use reachability::Walls;
use straight::straight_lines;

/// The quickest proven transition that can be found, or why there is none.
pub fn transition(problem: &TransitionProblem) -> Result<Transition, Infeasible> {
    attempt(problem, Cancel::NEVER).into_result()
}

/// The same, given up as soon as `is_wanted` says so: it is asked at least every tenth of a second or so, from this
/// thread, and must be cheap.
pub fn transition_unless(
    problem: &TransitionProblem,
    is_wanted: &dyn Fn() -> bool,
) -> Result<Result<Transition, Infeasible>, Cancelled> {
    unless(is_wanted, |cancel| attempt(problem, cancel).into_result())
}

/// A transition that can be drawn even where it must not be driven.
pub(crate) struct Attempt {
    /// The best there is; straight lines that conflict if `infeasible` says so.
    pub transition: Transition,
    /// Why it must not be driven.
    pub infeasible: Option<Infeasible>,
}

impl Attempt {
    fn into_result(self) -> Result<Transition, Infeasible> {
        match self.infeasible {
            None => Ok(self.transition),
            Some(infeasible) => Err(infeasible),
        }
    }
}

/// The best transition that can be found, proven or not.
pub(crate) fn attempt(problem: &TransitionProblem, cancel: Cancel<'_>) -> Attempt {
    if let Err(infeasible) = feasibility::measurable(problem) {
        return Attempt { transition: candidate::unmoved(problem), infeasible: Some(infeasible) };
    }
    let impossible = feasibility::possible(problem).err();
    let Some(choice) = Choice::unless(cancel, &problem.starts, &problem.goals, &problem.pinned) else {
        let infeasible = impossible.unwrap_or_else(|| feasibility::pins(problem));
        return Attempt { transition: candidate::standing_still(problem), infeasible: Some(infeasible) };
    };
    let lower_bound_s = choice.bottleneck_m() / problem.limits.speed_mps.max(1e-3);
    let mut attempt = match reachability::look(problem, cancel) {
        Walls::Open => solve(problem, &choice, cancel),
        Walls::Apart(pinned) => {
            let sent = TransitionProblem { pinned, ..problem.clone() };
            let choice = Choice::unless(cancel, &sent.starts, &sent.goals, &sent.pinned).unwrap_or(choice);
            solve(&sent, &choice, cancel)
        }
        Walls::Closed(infeasible) => {
            let transition = choice.least_squares().solve(0.0).map_or_else(
                || candidate::standing_still(problem),
                |start_of| Candidate::straight(problem, &start_of, cancel).transition,
            );
            Attempt { transition, infeasible: Some(infeasible) }
        }
    };
    // Where spare robots wait is nobody's goal.
    for goal in &mut attempt.transition.goal_of {
        *goal = goal.filter(|&goal| goal < problem.goals.len());
    }
    attempt.transition.lower_bound_s = lower_bound_s;
    attempt.infeasible = impossible.or(attempt.infeasible);
    attempt
}

/// The best transition between places that ways lead between.
fn solve(problem: &TransitionProblem, choice: &Choice, cancel: Cancel<'_>) -> Attempt {
    if choice.spares() == 0 {
        return settle(problem, choice, cancel);
    }
    with_spares(problem, choice, cancel).unwrap_or_else(|| Attempt {
        transition: candidate::standing_still(problem),
        infeasible: Some(feasibility::pins(problem)),
    })
}

/// With more robots than goals: gives the spare ones places to wait first.
fn with_spares(problem: &TransitionProblem, choice: &Choice, cancel: Cancel<'_>) -> Option<Attempt> {
    let start_of = choice.least_squares().solve(0.0)?;
    let (whole, start_of) = spares::with_spares(problem, start_of, cancel);
    let choice = Choice::containing(cancel, &whole.starts, &whole.goals, &whole.pinned, &start_of)?;
    Some(settle(&whole, &choice, cancel))
}

/// Straight lines if the proof can be made to hold, else what repair makes of them. Every robot has a goal here.
fn settle(problem: &TransitionProblem, choice: &Choice, cancel: Cancel<'_>) -> Attempt {
    match straight_lines(problem, choice, cancel) {
        Some(candidate) if candidate.holds() => {
            Attempt { transition: candidate.transition, infeasible: None }
        }
        Some(candidate) if feasibility::possible(problem).is_ok() => mend(problem, candidate, cancel),
        Some(Candidate { transition, proof, .. }) => {
            let infeasible = Some(conflict::infeasible(problem, &transition, &proof, Vec::new()));
            Attempt { transition, infeasible }
        }
        None => Attempt {
            transition: candidate::standing_still(problem),
            infeasible: Some(feasibility::pins(problem)),
        },
    }
}

/// What repair makes of straight lines that conflict.
fn mend(problem: &TransitionProblem, conflicting: Candidate, cancel: Cancel<'_>) -> Attempt {
    let goal_of = &conflicting.transition.goal_of;
    let repaired = repair_unless(problem, goal_of, cancel).and_then(|Repaired { paths, least }| {
        let proof = Some(prove_unless(&problem.to_prove(&paths), cancel))
            .filter(Proof::holds)
            .ok_or_else(Vec::new)?;
        let duration = paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(least);
        let (goal_of, closest) = (goal_of.clone(), proof.closest);
        Ok(Transition { goal_of, paths, duration, least, lower_bound_s: 0.0, closest })
    });
    match repaired {
        Ok(transition) => Attempt { transition, infeasible: None },
        Err(left) => {
            let infeasible =
                Some(conflict::infeasible(problem, &conflicting.transition, &conflicting.proof, left));
            Attempt { transition: conflicting.transition, infeasible }
        }
    }
}
