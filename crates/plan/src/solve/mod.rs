//! Timed paths where straight lines conflict: close pixels, fixed identity in a crowd, obstacles, standing robots and
//! spare ones in the way.
//!
//! Everybody's way is a smooth spline in time ([`splines`]). First all take their shortest way ([`around`]) in some manner
//! ([`guess`]): straight or in bows, together or whoever is near first, kept from gathering in the middle or spread out
//! on the way ([`crowd`]); what promises most is tried first. Whoever comes too close is bent aside ([`relax`]), with a
//! little more time at each stage for the moments that need it ([`thick`]), and the last few that do not come past
//! each other are sent elsewhere. Where that does
//! not do, a crowd gets more time, and loosens before anybody goes anywhere ([`attempts`]). Crowds too thick for that
//! first learn their order on a hexagonal lattice ([`lattice`], [`dock`], [`search`], [`steps`]), and the same
//! relaxation makes that smooth and swift; between walls the lattice follows gaps from corner to corner
//! ([`corners`]). The last resort are ways with
//! stops ([`stops`]) over a roadmap ([`roadmap`]): slow, but what the search ([`push`]) finds can be driven as it is.
//! All that is for robots like the Elisa-3; those of other sizes are scaled to them first ([`scale`]).
//! Every loop is bounded, nothing is random, and the proof has the last word; where it only finds a turn too sharp, all
//! drive a little slowdown.

mod from_lattice;
mod guess;
mod path_set;
mod scale;
mod schedule;
mod stop_and_go;
#[cfg(test)]
mod tests;

use lightbots_base::Span;

use crate::cancel::Cancel;
use crate::instance::Instance;
use crate::motion::quarter_turn;
use crate::proof::{FaultKind, Proof, faults, prove_unless};
use crate::roads::visibility::VisibilityGraph;
use crate::spline::set::SplineSet;
use crate::{Meeting, Repaired, TransitionProblem};
use scale::Scale;

/// How many times as long as estimated a way is given until every robot can turn as it asks for.
const SLOWDOWNS: [f64; 3] = [1.0, 1.02, 1.05];

/// Collision-free timed paths for a settled assignment: `goal_of[start]` is the goal that robot drives to, `None` a
/// spare robot that may step aside. Where nothing was found within the bounded work, who did not get past each other
/// in the attempt that left fewest; empty where it failed for something else.
pub fn repair(problem: &TransitionProblem, goal_of: &[Option<usize>]) -> Result<Repaired, Vec<Meeting>> {
    repair_unless(problem, goal_of, Cancel::NEVER)
}

/// The same; means nothing where it is given up.
pub(crate) fn repair_unless(
    problem: &TransitionProblem,
    goal_of: &[Option<usize>],
    cancel: Cancel<'_>,
) -> Result<Repaired, Vec<Meeting>> {
    for scale in Scale::of(&problem.limits) {
        let Ok(found) = of_usual(&scale.problem(problem), goal_of, cancel) else { continue };
        let found = scale.repaired(problem, goal_of, found);
        // Below which speed robots may turn at will does not grow with them.
        if prove_unless(&problem.to_prove(&found.paths), cancel).holds() {
            return Ok(found);
        }
    }
    of_usual(problem, goal_of, cancel)
}

/// The same for robots as large as those that distances here were measured with.
fn of_usual(
    problem: &TransitionProblem,
    goal_of: &[Option<usize>],
    cancel: Cancel<'_>,
) -> Result<Repaired, Vec<Meeting>> {
    let instance = Instance::new(problem, goal_of)
        .map(|instance| Instance { cancel, ..instance })
        .ok_or_else(Vec::new)?;
    match schedule::best(&instance, problem.easing, &|splines| proven(problem, &instance, splines)) {
        Ok(splines) => {
            let (turn, span) = (quarter_turn(&instance.limits), least_span(&instance, &splines));
            let least = turn + Span(span.0 * splines.spans as i64);
            Ok(Repaired { paths: splines.paths(turn, span_of(problem, &instance, &splines, span)), least })
        }
        Err(left) if cancel.is_wanted() => Err(left),
        Err(left) => {
            let visibility = VisibilityGraph::new(&instance);
            let found = stop_and_go::stop_and_go(&instance, &visibility, problem.duration);
            found.filter(|found| prove_unless(&problem.to_prove(&found.paths), cancel).holds()).ok_or(left)
        }
    }
}

/// The splines in the least of some times in which the proof holds, and holds in the wished for time: distances do not
/// depend on time, but a turn that is a little too sharp for one robot is driven by all a little later. Else what is still
/// wrong; empty where more than single robots' driving is.
fn proven(
    problem: &TransitionProblem,
    instance: &Instance,
    mut splines: SplineSet,
) -> Result<SplineSet, Rejected> {
    let mut faulty_spans = Vec::new();
    for slowdown in SLOWDOWNS {
        splines.slowdown = slowdown;
        let least = least_span(instance, &splines);
        let wished = span_of(problem, instance, &splines, least);
        let spans = [least, wished];
        let rejection = spans[..if wished > least { 2 } else { 1 }]
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

/// What the proof says of a splines whose spans take so long, if it does not hold.
fn rejection(
    problem: &TransitionProblem,
    instance: &Instance,
    splines: &SplineSet,
    span: Span,
) -> Option<Proof> {
    let paths = splines.paths(quarter_turn(&problem.limits), span);
    let input = problem.to_prove(&paths);
    // Most that are rejection turn too fast, which is seen without looking at pairs.
    let alone = Proof { faults: faults(&input, instance.cancel), ..Proof::default() };
    let proof = if alone.holds() { prove_unless(&input, instance.cancel) } else { alone };
    (!proof.holds()).then_some(proof)
}

/// A splines that the proof refuses.
struct Rejected {
    splines: SplineSet,
    /// Robots and the spans in which they cannot drive as they should.
    faulty_spans: Vec<(usize, usize)>,
}

/// How long each span of a splines takes at least.
fn least_span(instance: &Instance, splines: &SplineSet) -> Span {
    Span((splines.least_span_s(&instance.limits) * 1e6).ceil() as i64)
}

/// How long each span of a splines takes that takes `least` at least: that, or as long as the wished for duration asks.
fn span_of(problem: &TransitionProblem, instance: &Instance, splines: &SplineSet, least: Span) -> Span {
    let wished_s = problem
        .duration
        .map_or(0.0, |whole| (whole - quarter_turn(&instance.limits)).as_secs() / splines.spans as f64);
    // A hair less, so that what is whole already stays so.
    least.max(Span((wished_s * 1e6 - 1e-3).ceil() as i64))
}
