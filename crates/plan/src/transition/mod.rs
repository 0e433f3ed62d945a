//! Plans one transition: assignment, straight lines, and the schedule of solvers if robots on straight lines would
//! touch.

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

use crate::assignment::Choice;
use crate::cancel::{Cancel, Cancelled, unless};
use crate::prescribed::{self, Stagger};
use crate::proof::prove_unless;
use crate::solve::{self, Solution};
use crate::{
    Explanation, Infeasible, Meeting, Prescribed, Repaired, RowOutcome, Transition, TransitionProblem,
};
use candidate::Candidate;
use lightbots_base::Span;
use reachability::Walls;
use straight::straight_lines;

/// Plans a transition. Takes the drive that the show prescribes, if it applies, or else straight lines, slightly
/// displaced where robots pass too close. If robots would still touch, runs the schedule of solvers, and the order on
/// candidate plans (`order.rs`) chooses among its plans. Returns the proven plan, or why there is none.
pub fn transition(problem: &TransitionProblem) -> Result<Transition, Infeasible> {
    attempt(problem, Cancel::NEVER).into_result()
}

/// [`transition`], cancelled once `is_wanted` returns `true`. `is_wanted` is called at least about every tenth of a
/// second, mostly far more often, on the calling thread. It must be cheap.
pub fn transition_unless(
    problem: &TransitionProblem,
    is_wanted: &dyn Fn() -> bool,
) -> Result<Result<Transition, Infeasible>, Cancelled> {
    unless(is_wanted, |cancel| attempt(problem, cancel).into_result())
}

/// The result of planning a transition. It always has paths that can be drawn, even if they must not be driven.
pub(crate) struct Attempt {
    /// The best transition. If `infeasible` is set, its paths are only for drawing, mostly straight lines with
    /// conflicts.
    pub transition: Transition,
    /// Why the transition must not be driven; `None` if it may be driven.
    pub infeasible: Option<Infeasible>,
    /// The solvers that ran, and the reason for the choice.
    pub explanation: Explanation,
    /// Why the transition is not the drive that the show prescribes. `None` if it is, or if the show prescribes none.
    /// `None` also if the reason is in `infeasible`.
    pub not_as_prescribed: Option<&'static str>,
}

impl Attempt {
    /// An attempt whose transition may be drawn, but must not be driven, for the reason `why`.
    fn infeasible(transition: Transition, why: Infeasible) -> Self {
        Self { infeasible: Some(why), ..Self::feasible(transition, Explanation::default()) }
    }

    fn feasible(transition: Transition, explanation: Explanation) -> Self {
        Self { transition, infeasible: None, explanation, not_as_prescribed: None }
    }

    fn into_result(self) -> Result<Transition, Infeasible> {
        match self.infeasible {
            None => Ok(self.transition),
            Some(infeasible) => Err(infeasible),
        }
    }
}

/// Plans the best transition, proven or not: the drive that the show prescribes, or else an ordinary drive by the
/// planner.
pub(crate) fn attempt(problem: &TransitionProblem, cancel: Cancel<'_>) -> Attempt {
    if let Err(infeasible) = feasibility::measurable(problem) {
        return Attempt::infeasible(candidate::unmoved(problem), infeasible);
    }
    let Some(prescribed) = &problem.prescribed else { return ordinary(problem, cancel) };
    let impossible = feasibility::possible(problem).err();
    match (prescribed.stagger, impossible) {
        (_, Some(_)) => ordinary(problem, cancel),
        (Some(stagger), None) => one_after_another(problem, stagger, cancel),
        (None, None) => as_prescribed(problem, prescribed, cancel),
    }
}

/// Plans the drive that the show prescribes. If robots or pixels are not where it begins and ends, plans an ordinary
/// drive instead, with the reason. If the prescribed drive must not be driven, the ordinary drive is only drawn.
fn as_prescribed(problem: &TransitionProblem, prescribed: &Prescribed, cancel: Cancel<'_>) -> Attempt {
    match prescribed::attempt(problem, prescribed, cancel) {
        Ok(transition) => {
            let mut explanation = Explanation::default();
            let solved = RowOutcome::Solved { duration: transition.least, stop_safe_percent: None };
            explanation.add(format!("the {} of the show", prescribed.name), solved);
            explanation.choose("the show prescribes it");
            Attempt::feasible(transition, explanation)
        }
        Err(Some(infeasible)) => {
            let drawing = ordinary(problem, cancel);
            Attempt { infeasible: Some(infeasible), ..drawing }
        }
        Err(None) => {
            let why = "robots or pixels are not where its motion begins and ends; place the pixels anew";
            Attempt { not_as_prescribed: Some(why), ..ordinary(problem, cancel) }
        }
    }
}

/// Plans an ordinary drive in which robots start one after the other, along `stagger.direction`. If the drive takes an
/// asked duration, it is planned for that duration less the delay. If no share of the delay is legal, all robots start
/// together, in that shorter time, and the reason is given.
fn one_after_another(problem: &TransitionProblem, stagger: Stagger, cancel: Cancel<'_>) -> Attempt {
    let delay = Span::from_secs(stagger.delay_s.max(0.0));
    let quicker = problem.duration.map(|asked| (asked - delay).max(Span::ZERO));
    let attempt = ordinary(&TransitionProblem { duration: quicker, ..problem.clone() }, cancel);
    if attempt.infeasible.is_some() {
        return attempt;
    }
    match prescribed::staggered(problem, &attempt.transition, stagger, cancel) {
        Some(transition) => Attempt { transition, ..attempt },
        None => {
            let why = "robots that begin one after the other would touch; leave more room between pixels";
            Attempt { not_as_prescribed: Some(why), ..attempt }
        }
    }
}

/// Plans the best ordinary transition, proven or not, without regard to what the show prescribes.
fn ordinary(problem: &TransitionProblem, cancel: Cancel<'_>) -> Attempt {
    let impossible = feasibility::possible(problem).err();
    let Some(choice) = Choice::unless(cancel, &problem.starts, &problem.goals, &problem.pinned) else {
        let infeasible = impossible.unwrap_or_else(|| feasibility::pins(problem));
        return Attempt::infeasible(candidate::standing_still(problem), infeasible);
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
            Attempt::infeasible(transition, infeasible)
        }
    };
    // A spare robot's waiting place is not a goal of the problem.
    for goal in &mut attempt.transition.goal_of {
        *goal = goal.filter(|&goal| goal < problem.goals.len());
    }
    attempt.transition.lower_bound_s = lower_bound_s;
    attempt.infeasible = impossible.or(attempt.infeasible);
    attempt
}

/// Plans the best transition with an assignment from `choice`, for any number of spare robots.
fn solve(problem: &TransitionProblem, choice: &Choice, cancel: Cancel<'_>) -> Attempt {
    let found = if choice.spares() == 0 {
        settle(problem, choice, cancel)
    } else {
        with_spares(problem, choice, cancel)
    };
    found.unwrap_or_else(|| {
        Attempt::infeasible(candidate::standing_still(problem), feasibility::pins(problem))
    })
}

/// [`settle`] if there are more robots than goals. The spare robots first get places at which they wait.
fn with_spares(problem: &TransitionProblem, choice: &Choice, cancel: Cancel<'_>) -> Option<Attempt> {
    let start_of = choice.least_squares().solve(0.0)?;
    let (whole, start_of) = spares::with_spares(problem, start_of, cancel);
    let choice = Choice::containing(cancel, &whole.starts, &whole.goals, &whole.pinned, &start_of)?;
    settle(&whole, &choice, cancel)
}

/// Returns straight lines, perhaps slightly displaced, if the proof accepts them, else the result of the schedule of
/// solvers. Every robot must have a goal or a waiting place. `None` if there is no assignment.
fn settle(problem: &TransitionProblem, choice: &Choice, cancel: Cancel<'_>) -> Option<Attempt> {
    let mut explanation = Explanation::default();
    let candidate = straight_lines(problem, choice, cancel, &mut explanation)?;
    if candidate.holds() {
        return Some(Attempt::feasible(candidate.transition, explanation));
    }
    let result = if feasibility::possible(problem).is_ok() {
        let Solution { result, explanation: rows } =
            solve::solve(problem, &candidate.transition.goal_of, cancel);
        explanation.append(rows);
        result.and_then(|found| proven(problem, &candidate.transition, found, cancel))
    } else {
        Err(Vec::new())
    };
    Some(match result {
        Ok(transition) => Attempt::feasible(transition, explanation),
        Err(left) => {
            let Candidate { transition, proof, .. } = candidate;
            let infeasible = Some(conflict::infeasible(problem, &transition, &proof, left));
            Attempt { infeasible, ..Attempt::feasible(transition, explanation) }
        }
    })
}

/// Makes a transition of the paths of a solver, with the assignment of `straight`. `Err` without any meeting if the
/// proof rejects the paths.
fn proven(
    problem: &TransitionProblem,
    straight: &Transition,
    Repaired { paths, least }: Repaired,
    cancel: Cancel<'_>,
) -> Result<Transition, Vec<Meeting>> {
    assert_eq!(paths.len(), problem.starts.len(), "each robot has a path");
    let proof = prove_unless(&problem.to_prove(&paths), cancel);
    if !proof.holds() {
        return Err(Vec::new());
    }
    let duration = paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(least);
    let (goal_of, closest) = (straight.goal_of.clone(), proof.closest);
    Ok(Transition { goal_of, paths, duration, least, lower_bound_s: 0.0, closest })
}
