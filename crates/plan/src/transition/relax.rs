//! Makes straight lines hold: other ways for those in conflict, then longer ways for all.

use super::candidate::Candidate;
use crate::TransitionProblem;
use crate::assignment::{Choice, Minimiser};

/// Shares by which the longest way may exceed the bottleneck, tried in turn.
const SLACKS: [f64; 7] = [0.0, 0.01, 0.02, 0.04, 0.07, 0.1, 0.15];
/// Up to this share comfortable distances are looked for; beyond, legal ones will do.
const COMFORT_SLACK: f64 = 0.02;
/// Rounds of other ways for each slack.
const ROUNDS: usize = 6;
/// Robots times rounds that are spent on comfort alone.
const COMFORT_WORK: usize = 30_000;

/// The best straight lines: comfortable ones if they can be had, else legal ones, else those with the fewest
/// conflicts. `None` where there is no assignment at all.
pub(super) fn relax(problem: &TransitionProblem, choice: &Choice) -> Option<Candidate> {
    let mut minimiser = choice.least_squares();
    let mut best: Option<Candidate> = None;
    let mut comfort_left = COMFORT_WORK / problem.starts.len().max(1);
    for slack in SLACKS {
        minimiser.lift_bans();
        for round in 0..ROUNDS {
            let Some(start_of) = minimiser.solve(slack) else { break };
            let candidate = Candidate::straight(problem, &start_of);
            if candidate.is_comfortable() || choice.is_settled() {
                return Some(candidate);
            }
            let legal = candidate.holds() || best.as_ref().is_some_and(Candidate::holds);
            let banned = ban_conflicts(&mut minimiser, &candidate, round);
            if best.as_ref().is_none_or(|best| candidate.is_better_than(best)) {
                best = Some(candidate);
            }
            if legal {
                comfort_left = comfort_left.saturating_sub(1);
            }
            if !banned || legal && comfort_left == 0 {
                break;
            }
        }
        let legal = best.as_ref().is_some_and(Candidate::holds);
        if legal && (slack >= COMFORT_SLACK || comfort_left == 0) {
            break;
        }
    }
    best
}

/// Forbids one way of every pair in conflict: by turns the shorter, which has more other ways to go, and the longer.
/// Whether there is hope: conflicts are few and have other ways.
fn ban_conflicts(minimiser: &mut Minimiser<'_>, candidate: &Candidate, round: usize) -> bool {
    let transition = &candidate.transition;
    if candidate.proof.conflicts.len() > transition.paths.len() / 10 + 4 {
        return false;
    }
    let mut any = false;
    for found in &candidate.proof.conflicts {
        let way_m = |robot: usize| {
            let path = transition.paths.get(robot)?;
            Some((path.start.distance(path.as_ref().end()), robot))
        };
        let (a, b) = (way_m(found.pair.0), way_m(found.pair.1));
        let chosen = match (a, b) {
            (Some(a), Some(b)) => Some(if (a.0 <= b.0) == (round % 2 == 0) { a } else { b }),
            (a, b) => a.or(b),
        };
        if let Some((_, robot)) = chosen
            && let Some(goal) = transition.goal_of[robot]
        {
            any |= minimiser.ban(goal, robot);
        }
    }
    any
}
