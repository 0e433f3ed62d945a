//! What the proof finds.

use lightbots_base::{Span, Vec2};

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

/// The closest two centres of a transition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Their distance, metres.
    pub distance_m: f64,
    /// When, after the start of the transition.
    pub at: Span,
    /// Indices into `starts`, or into `standing` counted on from there.
    pub pair: (usize, usize),
    /// Half way between the two, stage metres.
    pub place: Vec2,
}
