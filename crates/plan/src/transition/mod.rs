//! One transition from question to proven answer.

mod candidate;
mod check;
mod parking;
#[cfg(test)]
mod tests;

pub(crate) use check::touching;
pub(crate) use parking::distance_to;

use crate::assignment::Choice;
use crate::repair::repair;
use crate::{Stuck, Transition, TransitionProblem};
use candidate::Candidate;

/// Least distance between rims that is planned for, metres, where starts and goals leave that much.
pub(crate) const MARGIN_M: f64 = 0.003;
/// Distance between rims that is worth a little time, metres: robots follow their paths within 5 mm.
const COMFORT_M: f64 = 0.008;
/// What that much is worth: the longest way may grow by this share.
const COMFORT_SLACK: f64 = 0.03;
/// Shares by which the longest way may exceed the bottleneck, tried in turn until the proof holds.
const SLACKS: [f64; 6] = [0.0, 0.01, 0.03, 0.06, 0.1, 0.15];

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
    let impossible = check::possible(problem).err();
    let Some(choice) = Choice::new(&problem.starts, &problem.goals, &problem.pinned) else {
        let stuck = impossible.unwrap_or_else(|| check::pins(problem));
        return Attempt { transition: candidate::standing_still(problem), stuck: Some(stuck) };
    };
    let lower_bound_s = choice.bottleneck_m() / problem.limits.speed_mps.max(1e-3);
    let mut attempt = if choice.spares() == 0 {
        relax(problem, &choice)
    } else {
        let start_of = choice.least_squares().solve(0.0);
        let (whole, start_of) = parking::with_spares(problem, start_of);
        match Choice::containing(&whole.starts, &whole.goals, &whole.pinned, &start_of) {
            Some(choice) => relax(&whole, &choice),
            None => {
                Attempt { transition: candidate::standing_still(problem), stuck: Some(check::pins(problem)) }
            }
        }
    };
    // Where spare robots wait is nobody's goal.
    for goal in &mut attempt.transition.goal_of {
        *goal = goal.filter(|&goal| goal < problem.goals.len());
    }
    attempt.transition.lower_bound_s = lower_bound_s;
    attempt.stuck = impossible.or(attempt.stuck);
    attempt
}

/// Straight lines for greater and greater reach until the proof holds; then what repair makes of the rest. Of all
/// that hold the quickest wins. Every robot has a goal here.
fn relax(problem: &TransitionProblem, choice: &Choice) -> Attempt {
    let mut minimiser = choice.least_squares();
    let mut best: Option<Candidate> = None;
    let mut fewest: Option<Candidate> = None;
    let mut before = Vec::new();
    for slack in SLACKS {
        let start_of = minimiser.solve(slack);
        if start_of == before {
            continue;
        }
        let candidate = Candidate::straight(problem, &start_of);
        before = start_of;
        if candidate.proof.holds() {
            let comfortable = candidate.rims_m(problem) >= COMFORT_M;
            if best.as_ref().is_none_or(|best| candidate.rims_m(problem) > best.rims_m(problem)) {
                best = Some(candidate);
            }
            if comfortable || slack >= COMFORT_SLACK {
                break;
            }
        } else if best.is_some() && slack >= COMFORT_SLACK {
            break;
        } else if fewest.as_ref().is_none_or(|known| candidate.conflicts() < known.conflicts()) {
            fewest = Some(candidate);
        }
        if choice.is_settled() {
            break;
        }
    }
    match (best, fewest) {
        (Some(best), _) => Attempt { transition: best.transition, stuck: None },
        (None, Some(conflicting)) => mend(problem, conflicting),
        (None, None) => Attempt { transition: candidate::standing_still(problem), stuck: None },
    }
}

/// What repair makes of straight lines that conflict.
fn mend(problem: &TransitionProblem, conflicting: Candidate) -> Attempt {
    let repaired = repair(problem, &conflicting.transition.goal_of)
        .map(|paths| Candidate::of_paths(problem, paths, conflicting.transition.goal_of.clone()))
        .filter(|candidate| candidate.proof.holds());
    match repaired {
        Some(candidate) => Attempt { transition: candidate.transition, stuck: None },
        None => {
            let stuck = Some(check::conflict(problem, &conflicting.transition, &conflicting.proof));
            Attempt { transition: conflicting.transition, stuck }
        }
    }
}
