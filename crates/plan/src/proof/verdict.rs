//! What the proof finds.

use lightbots_base::{Span, Vec2};

/// The verdict of the proof.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pairs that come closer than allowed, each at its closest moment, sorted by the indices of the pair. Standing
    /// discs have the indices after those of the robots.
    pub conflicts: Vec<Closest>,
    /// Illegal motion of single robots, sorted by robot.
    pub faults: Vec<Fault>,
    /// The closest approach of all pairs of which at least one is a robot. `None` if there is no pair of that kind, or
    /// a path is malformed.
    pub closest: Option<Closest>,
}

/// Illegal motion of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Index of the robot.
    pub robot: usize,
    /// Kind of the fault.
    pub kind: FaultKind,
    /// Begin of the faulty piece, counted from the start of the transition. It is 0 for a malformed path, and the end
    /// of the path if the robot does not end at rest.
    pub at: Span,
}

/// Kinds of illegal motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// A coordinate is not finite or beyond 1,000 km, a duration is not positive, or the path does not end when the
    /// longest path ends.
    Malformed,
    /// The robot is faster than its speed limit.
    Speed,
    /// The acceleration is above its limit.
    Acceleration,
    /// The velocity has a step, or the robot does not begin and end at rest.
    Jump,
    /// A turn faster than its limit, while the robot drives or between two drives.
    Turn,
    /// A wheel turns faster than its limit.
    Wheel,
    /// The rim of the robot leaves the floor by more than at the start and the end of the path.
    Floor,
    /// The robot comes nearer to a no-go area than it must stay; see [`ProofInput::obstacle_gap_m`](super::ProofInput).
    Obstacle,
}

impl Proof {
    /// Whether the paths may be driven: there are no conflicts and no faults.
    pub fn holds(&self) -> bool {
        self.conflicts.is_empty() && self.faults.is_empty()
    }
}

/// The closest approach of two centres in a transition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance of the centres, metres.
    pub distance_m: f64,
    /// Moment of the closest approach, counted from the start of the transition.
    pub at: Span,
    /// Indices of the two robots, the smaller first. Standing discs have the indices after those of the robots.
    pub pair: (usize, usize),
    /// Point half way between the two centres, stage metres.
    pub place: Vec2,
}
