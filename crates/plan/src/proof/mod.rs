//! The proof: whether timed paths keep all robots apart and within their limits, at every moment of continuous time.
//!
//! **Invariant:** the proof shares nothing with the planner but the path type and the cancellation. Otherwise a mistake
//! of the planner could repeat in its proof. The proof reads only the pieces of paths. Distances and speeds are bounded
//! by convex hulls of Bézier control points. Pieces are divided until the bounds decide, or until a bound on divisions
//! is reached. Only [`stop_safe`] uses samples.

mod course;
mod curve;
mod drive;
mod facing;
#[cfg(test)]
mod facing_tests;
mod grid;
mod input;
#[cfg(test)]
mod mutants;
mod pairs;
pub mod stop_safe;
mod surroundings;
#[cfg(test)]
mod tests;
mod timeline;
mod verdict;

pub use input::ProofInput;
pub use verdict::{Closest, Fault, FaultKind, Proof};

use crate::Path;
use crate::cancel::Cancel;
use lightbots_base::Span;

/// Checks paths. Returns all conflicts (pairs that come too close), the faults (illegal motion) of each robot, and the
/// closest pair. A robot has at most one fault of each kind. If a path is malformed, pairs are not checked.
pub fn prove(input: &ProofInput<'_>) -> Proof {
    prove_unless(input, Cancel::NEVER)
}

/// [`prove`] with a cancellation; the result of a cancelled proof means nothing.
pub(crate) fn prove_unless(input: &ProofInput<'_>, cancel: Cancel<'_>) -> Proof {
    let mut proof = Proof { faults: faults(input, cancel), ..Proof::default() };
    if !proof.faults.iter().any(|fault| fault.kind == FaultKind::Malformed) {
        (proof.conflicts, proof.closest) = pairs::judge(input, horizon(input), cancel);
    }
    proof
}

/// Checks each path alone, without pairs of robots, and returns the faults, at most one of each kind for each robot.
pub(crate) fn faults(input: &ProofInput<'_>, cancel: Cancel<'_>) -> Vec<Fault> {
    let (horizon, mut faults) = (horizon(input), Vec::<Fault>::new());
    for (robot, path) in input.paths.iter().enumerate() {
        if cancel.is_wanted() {
            break;
        }
        let before = faults.len();
        drive::judge(path, horizon, input.limits, |kind, at| faults.push(Fault { robot, kind, at }));
        if faults[before..].iter().any(|fault| fault.kind == FaultKind::Malformed) {
            continue;
        }
        surroundings::judge(path, input, |kind, at| faults.push(Fault { robot, kind, at }));
    }
    faults
}

/// Duration of the longest path.
fn horizon(input: &ProofInput<'_>) -> Span {
    Path::longest(input.paths)
}
