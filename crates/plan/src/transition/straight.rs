//! Finds straight lines on which no robots touch. Pairs that pass too close are displaced a little. If contacts are
//! left, assignments with longer lines are tried.

use super::candidate::Candidate;
use super::deform::deform;
use crate::TransitionProblem;
use crate::assignment::Choice;
use crate::cancel::Cancel;
use crate::explain::{Explanation, RowOutcome};
use crate::order::{PlanQuality, choose};

/// Shares by which the longest line may exceed the bottleneck distance, in the order in which they are tried.
const SLACKS: [f64; 7] = [0.0, 0.01, 0.02, 0.04, 0.07, 0.1, 0.15];
/// Bound on the number of robots × rounds of deformation, if straight lines have no contacts and only their clearance
/// is improved.
const COMFORT_WORK: usize = 30_000;

/// Returns the first candidate without contacts and faults, else the candidate that the order on candidate plans
/// prefers. If every goal is pinned, only one candidate is tried. `None` if there is no assignment, or the planner is
/// cancelled.
pub(super) fn straight_lines(
    problem: &TransitionProblem,
    choice: &Choice,
    cancel: Cancel<'_>,
    explanation: &mut Explanation,
) -> Option<Candidate> {
    let mut minimiser = choice.least_squares();
    let mut candidates = Vec::new();
    let mut before = None;
    for slack in SLACKS {
        if cancel.is_wanted() {
            return None;
        }
        let start_of = minimiser.solve(slack)?;
        if before.as_ref() == Some(&start_of) {
            continue;
        }
        let straight = Candidate::straight(problem, &start_of, cancel);
        let rounds = if straight.holds() { COMFORT_WORK / problem.starts.len().max(1) } else { usize::MAX };
        let is_fine = straight.is_comfortable();
        let candidate = if is_fine { straight } else { deform(problem, &start_of, straight, rounds, cancel) };
        before = Some(start_of);
        explanation.add(format!("straight lines, slack {:.0} %", slack * 1e2), outcome(&candidate));
        if candidate.holds() {
            explanation.choose("straight lines without contacts");
        }
        if candidate.holds() || choice.is_settled() {
            return Some(candidate);
        }
        candidates.push(candidate);
    }
    let quality = |candidate: &Candidate| PlanQuality {
        contacts: candidate.wrong,
        duration: candidate.transition.duration,
    };
    let qualities: Vec<PlanQuality> = candidates.iter().map(quality).collect();
    // No candidate is contact-free, so stop-safety does not count.
    let chosen = choose(&qualities, |_| 0)?;
    Some(candidates.swap_remove(chosen.index))
}

fn outcome(candidate: &Candidate) -> RowOutcome {
    match candidate.wrong {
        0 => RowOutcome::Solved { duration: candidate.transition.least, stop_safe_percent: None },
        contacts => RowOutcome::Rejected { contacts },
    }
}
