//! Raises the stop-safety of a transition (the share of moments at which a robot may stop dead without a contact) by
//! delayed starts. A robot that follows another closely then falls back, and a robot that crosses just behind another
//! crosses later.

mod delays;
#[cfg(test)]
mod tests;

use crate::cancel::{Cancel, Cancelled, unless};
use crate::motion::delayed;
use crate::order::{PlanQuality, choose, percent};
use crate::proof::stop_safe::{STEP, StopAssumptions, StopSafety, measured};
use crate::proof::{Proof, prove_unless};
use crate::{Infeasible, Path, Transition, TransitionProblem, transition_unless};
use lightbots_base::Span;

/// Largest share of the planned duration by which delays may lengthen a transition; the design allows 5 %.
const SHARE: f64 = 0.05;

/// Measures the stop-safety of a transition, and raises it by delays of at most 5 % of the duration. Transitions with
/// an asked duration, with a prescribed drive or of more than 500 s are only measured. The order on candidate plans
/// chooses between the paths with and without delays. `transition` gets the chosen paths, which are proven, and their
/// stop-safety is returned.
pub fn raise(problem: &TransitionProblem, transition: &mut Transition) -> StopSafety {
    raised(problem, transition, Cancel::NEVER)
}

/// [`raise`], cancelled as soon as `is_wanted` returns `true`. After a cancellation, the paths of `transition` are
/// still proven.
pub fn raise_unless(
    problem: &TransitionProblem,
    transition: &mut Transition,
    is_wanted: &dyn Fn() -> bool,
) -> Result<StopSafety, Cancelled> {
    unless(is_wanted, |cancel| raised(problem, transition, cancel))
}

/// Plans the transition of a problem and raises its stop-safety. The outer `Err` means that planning was cancelled. If
/// cancellation comes later, while stop-safety is raised, the proven plan is returned, mostly without delays.
pub fn planned_unless(
    problem: &TransitionProblem,
    is_wanted: &dyn Fn() -> bool,
) -> Result<Result<Transition, Infeasible>, Cancelled> {
    let mut found = transition_unless(problem, is_wanted)?;
    if let Ok(transition) = &mut found {
        // The transition stays proven even if raising is cancelled.
        let _ = raise_unless(problem, transition, is_wanted);
    }
    Ok(found)
}

pub(crate) fn raised(
    problem: &TransitionProblem,
    transition: &mut Transition,
    cancel: Cancel<'_>,
) -> StopSafety {
    let measure = |paths: &[Path]| measured(paths, &problem.limits, &StopAssumptions::default(), cancel);
    let before = measure(&transition.paths);
    let is_long = before.pace > STEP;
    // Delays would take robots out of step with their formation.
    let is_timed = problem.duration.is_some() || problem.prescribed.is_some();
    if before.unsafe_moments.is_empty() || is_timed || is_long || cancel.is_wanted() {
        return before;
    }
    let most = Span((transition.duration.0 as f64 * SHARE) as i64);
    let delays = delays::delays(&transition.paths, &before, &problem.limits, most, cancel);
    let paths = delayed(&transition.paths, &delays);
    if delays.iter().all(|delay| *delay == Span::ZERO)
        || paths.iter().any(|path| path.pieces.len() > Path::MOST_PIECES)
        || cancel.is_wanted()
    {
        return before;
    }
    let after = measure(&paths);
    let quality = |paths: &[Path]| PlanQuality { contacts: 0, duration: Path::longest(paths) };
    let shares = [before.share(), after.share()];
    let chosen = choose(&[quality(&transition.paths), quality(&paths)], |index| percent(shares[index]));
    if chosen.is_none_or(|chosen| chosen.index == 0) {
        return before;
    }
    let proof = Some(prove_unless(&problem.to_prove(&paths), cancel)).filter(Proof::holds);
    let Some(proof) = proof.filter(|_| !cancel.is_wanted()) else { return before };
    transition.duration = paths.first().map_or(transition.duration, |path| path.as_ref().duration());
    transition.closest = proof.closest;
    transition.paths = paths;
    after
}
