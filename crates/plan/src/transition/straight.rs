//! Makes straight lines hold: small bends for those who pass too close, then longer ways for all.

use super::candidate::Candidate;
use super::deform::deform;
use crate::TransitionProblem;
use crate::assignment::Choice;
use crate::cancel::Cancel;
use crate::explain::{Explanation, RowOutcome};

/// Shares by which the longest way may exceed the bottleneck, tried in turn.
const SLACKS: [f64; 7] = [0.0, 0.01, 0.02, 0.04, 0.07, 0.1, 0.15];
/// Robots times rounds of bending that are spent on comfort where distances are legal already.
const COMFORT_WORK: usize = 30_000;

/// The best lines: comfortable ones if they can be had, else legal ones, else those with the fewest conflicts. `None`
/// where there is no assignment at all.
pub(super) fn straight_lines(
    problem: &TransitionProblem,
    choice: &Choice,
    cancel: Cancel<'_>,
    explanation: &mut Explanation,
) -> Option<Candidate> {
    let mut minimiser = choice.least_squares();
    let mut best: Option<Candidate> = None;
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
        if best.as_ref().is_none_or(|best| candidate.improves_on(best)) {
            best = Some(candidate);
        }
    }
    best
}

fn outcome(candidate: &Candidate) -> RowOutcome {
    match candidate.wrong {
        0 => RowOutcome::Solved { duration: candidate.transition.least, stop_safe_percent: None },
        contacts => RowOutcome::Rejected { contacts },
    }
}
