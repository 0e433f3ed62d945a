//! Raises the stop-safety of a transition by delayed starts. Stop-safety is the share of moments at which a robot may
//! stop dead without a contact. A delayed robot falls back behind a robot that it follows closely, or crosses later
//! behind a robot that it would cross just behind.

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

/// Largest share of the planned duration by which delays may lengthen a transition; the design allows 5 %. With a
/// larger share, more robots can fall back, and shows take longer.
const SHARE: f64 = 0.05;

/// Measures the stop-safety of a transition, and raises it by delays that lengthen the transition by at most 5 %.
/// Returns the stop-safety of the paths that `transition` has afterwards. These paths are proven. The order on
/// candidate plans (`order.rs`) chooses between the paths with and without delays.
///
/// Transitions with an asked duration or a prescribed drive, and those of more than 500 s, are only measured.
pub fn raise(problem: &TransitionProblem, transition: &mut Transition) -> StopSafety {
    raised(problem, transition, Cancel::NEVER)
}

/// [`raise`], cancelled once `is_wanted` returns `true`. After a cancellation too, the paths of `transition` are
/// proven.
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
    // Delays would lengthen an asked duration, or take robots out of step with their formation.
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
