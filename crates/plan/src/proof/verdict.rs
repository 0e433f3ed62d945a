//! What the proof finds.

use lightbots_base::{Span, Vec2};

/// The verdict of the proof.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pairs that come closer than allowed, each at its closest moment, sorted by indices. Standing discs have the
    /// indices after those of the robots.
    pub conflicts: Vec<Closest>,
    /// Illegal motion of single robots, sorted by robot.
    pub faults: Vec<Fault>,
    /// The closest approach of all pairs of which at least one is a robot. `None` if there is no pair, or a path is
    /// malformed.
    pub closest: Option<Closest>,
}

/// Illegal motion of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Index of the robot.
    pub robot: usize,
    /// Kind of the fault.
    pub kind: FaultKind,
    /// Begin of the faulty piece, after the start of the transition.
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

/// The closest approach of two centres in a transition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance of the centres, metres.
    pub distance_m: f64,
    /// Moment of the approach, after the start of the transition.
    pub at: Span,
    /// Indices of the two robots. Standing discs have the indices after those of the robots.
    pub pair: (usize, usize),
    /// Point half way between the two centres, stage metres.
    pub place: Vec2,
}
