//! The proof: whether timed paths keep all robots apart and within their limits, at every moment of continuous time.
//!
//! **Invariant:** it shares nothing with the planner but the type of a path, because a mistake of the planner must not
//! repeat in its proof. Only the pieces count. Distances and speeds are bounded by convex hulls of Bézier control
//! points and divided until the bound decides; nothing is sampled.

mod curve;
mod drive;
mod facing;
#[cfg(test)]
mod facing_tests;
mod grid;
#[cfg(test)]
mod mutants;
mod pairs;
pub mod stop_safe;
mod surroundings;
#[cfg(test)]
mod tests;
mod timeline;

use crate::cancel::Cancel;
use crate::{Closest, Path};
use lightbots_base::{Limits, Span, Vec2};
use lightbots_show::Obstacle;

/// Paths to be judged.
#[derive(Clone, Copy, Debug)]
pub struct ProofInput<'a> {
    /// The path of each robot.
    pub paths: &'a [Path],
    /// Discs of a robot's size that do not move, stage metres.
    pub standing: &'a [Vec2],
    /// Things on the floor.
    pub obstacles: &'a [Obstacle],
    /// Half the floor's width and depth, metres.
    pub half_floor: Vec2,
    /// Limits of the robots.
    pub limits: &'a Limits,
    /// Least distance of two centres, metres. A pair that begins or ends closer must only keep the smaller of those
    /// two distances.
    pub gap_m: f64,
    /// Least distance between a robot's rim and an obstacle, metres. A robot that begins or ends closer must only keep
    /// that distance.
    pub obstacle_gap_m: f64,
}

/// The verdict.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pairs that come closer than asked, each at its closest; sorted by indices (robots, then standing discs counted
    /// on).
    pub conflicts: Vec<Closest>,
    /// Illegal motion of single robots, sorted by robot.
    pub faults: Vec<Fault>,
    /// The closest pair of all; `None` with fewer than two discs.
    pub closest: Option<Closest>,
}

/// Illegal motion of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Which robot.
    pub robot: usize,
    /// Its kind.
    pub kind: FaultKind,
    /// Begin of the piece, after the start of the transition.
    pub at: Span,
}

/// Kinds of illegal motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// A number is not finite, a duration not positive, or the path ends at another time than the others.
    Malformed,
    /// Faster than its limit.
    Speed,
    /// More acceleration than its limit.
    Acceleration,
    /// A step in velocity, or no rest at the begin or the end.
    Jump,
    /// A turn faster than its limit, while driving or between two drives.
    Turn,
    /// A wheel faster than its limit.
    Wheel,
    /// Off the floor.
    Floor,
    /// Too near to an obstacle.
    Obstacle,
}

impl Proof {
    /// Whether the paths may be driven.
    pub fn holds(&self) -> bool {
        self.conflicts.is_empty() && self.faults.is_empty()
    }
}

/// Rounding error that a distance may have, metres.
const SLACK_M: f64 = 1e-6;

/// Judges paths.
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

/// The faults alone.
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

/// End of the last path.
fn horizon(input: &ProofInput<'_>) -> Span {
    Path::longest(input.paths)
}
