//! Checks splines with the proof, and slows them down a little if that makes the proof hold.

use lightbots_base::Span;

use crate::TransitionProblem;
use crate::instance::Instance;
use crate::motion::quarter_turn;
use crate::proof::{FaultKind, Proof, faults, prove_unless};
use crate::spline::set::SplineSet;

/// Time scales in which the proof is tried: a turn that is a little too sharp for one robot is driven more slowly by
/// all.
const SLOWDOWNS: [f64; 3] = [1.0, 1.02, 1.05];

/// Splines that the proof rejects.
pub(super) struct Rejected {
    pub splines: SplineSet,
    /// Robots and spans whose motion is not legal; empty where slower driving cannot help.
    pub faulty_spans: Vec<(usize, usize)>,
}

/// Returns the splines with the least of [`SLOWDOWNS`] with which the proof holds, both at full speed and in the asked
/// duration.
pub(super) fn verified(
    problem: &TransitionProblem,
    instance: &Instance,
    mut splines: SplineSet,
) -> Result<SplineSet, Rejected> {
    let mut faulty_spans = Vec::new();
    for slowdown in SLOWDOWNS {
        splines.slowdown = slowdown;
        let least = least_span(instance, &splines);
        let asked = span_of(problem, instance, &splines, least);
        let spans = [least, asked];
        let rejection = spans[..if asked > least { 2 } else { 1 }]
            .iter()
            .find_map(|&span| rejection(problem, instance, &splines, span).map(|proof| (span, proof)));
        let Some((span, proof)) = rejection else { return Ok(splines) };
        let in_place = |kind| matches!(kind, FaultKind::Floor | FaultKind::Obstacle | FaultKind::Malformed);
        if !proof.conflicts.is_empty() || proof.faults.iter().any(|fault| in_place(fault.kind)) {
            return Err(Rejected { splines, faulty_spans: Vec::new() });
        }
        let number = |at: Span| ((at - quarter_turn(&instance.limits)).as_secs() / span.as_secs()) as usize;
        faulty_spans = proof.faults.iter().map(|fault| (fault.robot, number(fault.at))).collect();
    }
    splines.slowdown = 1.0;
    Err(Rejected { splines, faulty_spans })
}

/// Returns the failed proof of splines with spans of this length; `None` if the proof holds.
fn rejection(
    problem: &TransitionProblem,
    instance: &Instance,
    splines: &SplineSet,
    span: Span,
) -> Option<Proof> {
    let paths = splines.paths(quarter_turn(&problem.limits), span);
    let input = problem.to_prove(&paths);
    // Most rejected splines turn too fast, which shows without checking pairs.
    let alone = Proof { faults: faults(&input, instance.cancel), ..Proof::default() };
    let proof = if alone.holds() { prove_unless(&input, instance.cancel) } else { alone };
    (!proof.holds()).then_some(proof)
}

/// The least time of a span within the limits.
pub(super) fn least_span(instance: &Instance, splines: &SplineSet) -> Span {
    Span((splines.least_span_s(&instance.limits) * 1e6).ceil() as i64)
}

/// The time of a span: `least`, or more where the problem asks for a longer duration.
pub(super) fn span_of(
    problem: &TransitionProblem,
    instance: &Instance,
    splines: &SplineSet,
    least: Span,
) -> Span {
    let asked_s = problem
        .duration
        .map_or(0.0, |whole| (whole - quarter_turn(&instance.limits)).as_secs() / splines.spans as f64);
    // Subtracts a little first, so that rounding errors do not lift a whole number of microseconds to the next.
    least.max(Span((asked_s * 1e6 - 1e-3).ceil() as i64))
}
