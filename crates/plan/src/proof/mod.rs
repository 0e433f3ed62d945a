//! The proof: whether timed paths keep everybody apart and legal, at every moment of continuous time.
//!
//! **Invariant:** it shares nothing with the planner but the type of a path. It trusts no assignment, no profile and
//! no repair: only the pieces count. Distances and speeds are bounded by convex hulls of Bézier control points and
//! divided until the bound decides; nothing is sampled.

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

/// What is to be judged.
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
    /// What the robots can do.
    pub limits: &'a Limits,
    /// The least distance wanted between two centres, metres. A pair that begins or ends closer than that must only
    /// keep the smaller of those two distances.
    pub gap_m: f64,
    /// The least distance wanted between a robot's rim and an obstacle, metres; less for who begins or ends closer.
    pub obstacle_gap_m: f64,
}

/// The verdict.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pairs that come closer than wanted, sorted by their indices (robots, then standing discs counted on), each at
    /// its closest.
    pub conflicts: Vec<Closest>,
    /// What single robots do that they must not, sorted by robot.
    pub faults: Vec<Fault>,
    /// The closest pair of all; `None` with fewer than two discs.
    pub closest: Option<Closest>,
}

/// Something a robot must not do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Which robot.
    pub robot: usize,
    /// What it does.
    pub kind: FaultKind,
    /// When the piece in question begins, after the transition's start.
    pub at: Span,
}

/// Kinds of things robots must not do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// Its path is not made of numbers and positive durations, or ends at another time than the others'.
    Malformed,
    /// Drives too fast.
    Speed,
    /// Speeds up, slows down or swings around too hard.
    Acceleration,
    /// Jumps to another speed, or does not begin and end at rest.
    Jump,
    /// Turns faster than it can, while driving or between two drives.
    Turn,
    /// Needs a wheel to turn faster than it can.
    Wheel,
    /// Leaves the floor.
    Floor,
    /// Comes too near to an obstacle.
    Obstacle,
}

impl Proof {
    /// Whether the paths may be driven.
    pub fn holds(&self) -> bool {
        self.conflicts.is_empty() && self.faults.is_empty()
    }
}

/// Distances may fall short by this, metres: what rounding costs.
const SLACK_M: f64 = 1e-6;

/// Judges paths.
pub fn prove(input: &ProofInput<'_>) -> Proof {
    prove_unless(input, Cancel::NEVER)
}

/// The same; means nothing where it is given up.
pub(crate) fn prove_unless(input: &ProofInput<'_>, cancel: Cancel<'_>) -> Proof {
    let mut proof = Proof { faults: faults(input, cancel), ..Proof::default() };
    if !proof.faults.iter().any(|fault| fault.kind == FaultKind::Malformed) {
        (proof.conflicts, proof.closest) = pairs::judge(input, horizon(input), cancel);
    }
    proof
}

/// The proof's faults alone: what single robots do that they must not.
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

/// When the last path ends.
fn horizon(input: &ProofInput<'_>) -> Span {
    input.paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO)
}
