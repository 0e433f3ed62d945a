//! Timed paths for drives in which robots on straight lines would touch: close pixels, fixed identity, walls, standing
//! and spare robots.
//!
//! [`schedule`] is a table of solvers, and [`run`] goes through it. Most solvers make a first guess, on which robots
//! may touch, and deform it until there is no contact ([`crate::optimise`]). Paths are splines, one for each robot, all
//! on one clock. First guesses are shortest paths in one manner ([`guess`]), or paths of a multi-agent path finding
//! over a lattice ([`from_lattice`]). The last resort is stop-and-go over a roadmap ([`stop_and_go`]): it is slow, but
//! complete on its nodes and needs no deformation.
//!
//! Distances in this module are tuned for the Elisa-3. Problems with robots of other sizes are first scaled to its size
//! ([`scale`]), and solved without scaling only if that fails. Every loop is bounded, nothing is random, and the proof
//! decides whether paths are accepted ([`verify`]).

mod facts;
mod from_lattice;
mod guess;
mod guesses;
mod path_set;
mod run;
mod scale;
mod schedule;
mod stop_and_go;
#[cfg(test)]
mod tests;
mod trajectories;
mod verify;

use crate::cancel::Cancel;
use crate::explain::Explanation;
use crate::instance::Instance;
use crate::proof::prove_unless;
use crate::{Meeting, Repaired, TransitionProblem};
pub(crate) use run::Solution;
use scale::Scale;

/// Finds timed paths that the proof accepts, for a given assignment. `goal_of[robot]` is the index of the robot's goal,
/// or `None` for a spare robot, which may step aside.
///
/// If no solver finds paths, returns the pairs of robots that still touch in the row of the schedule that left the
/// fewest pairs. Rows that left no pair, because they failed for another reason, do not count. The list is empty if no
/// row left a pair, or the assignment does not fit the problem.
pub fn repair(problem: &TransitionProblem, goal_of: &[Option<usize>]) -> Result<Repaired, Vec<Meeting>> {
    solve(problem, goal_of, Cancel::NEVER).result
}

/// [`repair`] with an explanation and a cancellation. The result means nothing if the planner is cancelled.
pub(crate) fn solve(problem: &TransitionProblem, goal_of: &[Option<usize>], cancel: Cancel<'_>) -> Solution {
    let mut explanation = Explanation::default();
    for scale in Scale::of(&problem.limits) {
        let Solution { result, explanation: rows } = unscaled(&scale.problem(problem), goal_of, cancel);
        explanation.append(rows);
        let Ok(found) = result else { continue };
        let found = scale.repaired(problem, goal_of, found);
        // The scaled problem has a proof already. It does not suffice, because the speed below which robots may turn
        // freely does not scale.
        if prove_unless(&problem.to_prove(&found.paths), cancel).holds() {
            return Solution { result: Ok(found), explanation };
        }
    }
    let Solution { result, explanation: rows } = unscaled(problem, goal_of, cancel);
    explanation.append(rows);
    Solution { result, explanation }
}

/// [`solve`] without scaling the problem to the Elisa-3's size.
fn unscaled(problem: &TransitionProblem, goal_of: &[Option<usize>], cancel: Cancel<'_>) -> Solution {
    match Instance::new(problem, goal_of) {
        Some(instance) => run::run(problem, &Instance { cancel, ..instance }),
        None => Solution { result: Err(Vec::new()), explanation: Explanation::default() },
    }
}
