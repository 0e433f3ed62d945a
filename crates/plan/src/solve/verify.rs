//! Checks splines with the proof, and slows all robots down a little if the proof then holds.

use lightbots_base::Span;

use crate::TransitionProblem;
use crate::instance::Instance;
use crate::motion::quarter_turn;
use crate::proof::{FaultKind, Proof, faults, prove_unless};
use crate::spline::set::SplineSet;

/// Factors on the duration with which the proof is tried. All robots drive more slowly if one robot's turn is a little
/// too sharp.
const SLOWDOWNS: [f64; 3] = [1.0, 1.02, 1.05];

/// Splines that the proof rejects.
pub(super) struct Rejected {
    pub splines: SplineSet,
    /// Pairs of a robot and one of its spans with illegal motion; empty if slower driving cannot help.
    pub faulty_spans: Vec<(usize, usize)>,
}

/// Returns the splines, slowed down by the least of [`SLOWDOWNS`] with which the proof holds. It must hold at full
/// speed and, if that is longer, in the asked duration. `Err` if it holds with none, or the fault is one that slower
/// driving cannot mend.
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
    // Most rejected splines turn too fast. The check of each robot alone shows this, and it takes less time than the
    // check of pairs.
    let alone = Proof { faults: faults(&input, instance.cancel), ..Proof::default() };
    let proof = if alone.holds() { prove_unless(&input, instance.cancel) } else { alone };
    (!proof.holds()).then_some(proof)
}

/// The least duration of a span within the robots' limits, rounded up to microseconds.
pub(super) fn least_span(instance: &Instance, splines: &SplineSet) -> Span {
    Span((splines.least_span_s(&instance.limits) * 1e6).ceil() as i64)
}

/// The duration of a span: `least`, or longer if the problem asks for a longer duration of the drive.
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
