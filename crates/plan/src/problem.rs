//! One transition: what is asked and what is answered.

use lightbots_base::{Limits, PathRef, Piece, Span, Vec2};
use lightbots_show::{Easing, Obstacle};

use crate::margins::MARGIN_M;
use crate::proof::ProofInput;

/// A drive from one set of places to another.
#[derive(Clone, Debug)]
pub struct TransitionProblem {
    /// Where the robots stand, stage metres; one entry a robot.
    pub starts: Vec<Vec2>,
    /// Where they shall stand, stage metres. At most as many as `starts`: robots left over are spare and may stay
    /// where they are or step aside.
    pub goals: Vec<Vec2>,
    /// `pinned[goal]`: the start that must go there; shorter than `goals` means none for the rest.
    pub pinned: Vec<Option<usize>>,
    /// Discs on the floor that do not move: dead robots and those that do not take part. Stage metres.
    pub standing: Vec<Vec2>,
    /// Things on the floor.
    pub obstacles: Vec<Obstacle>,
    /// Half the floor's width and depth, metres; centres stay a radius inside.
    pub half_floor: Vec2,
    /// What the robots can do.
    pub limits: Limits,
    /// How long it shall take; `None` or less than is legal: as fast as legal.
    pub duration: Option<Span>,
    /// How speed changes.
    pub easing: Easing,
}

impl TransitionProblem {
    /// A problem without robots on an empty floor: what most problems begin with.
    pub fn on_floor(half_floor: Vec2, limits: Limits) -> Self {
        Self {
            starts: Vec::new(),
            goals: Vec::new(),
            pinned: Vec::new(),
            standing: Vec::new(),
            obstacles: Vec::new(),
            half_floor,
            limits,
            duration: None,
            easing: Easing::Swift,
        }
    }

    /// What the proof is asked of paths that solve it: the least distances that may be driven.
    pub fn to_prove<'a>(&'a self, paths: &'a [Path]) -> ProofInput<'a> {
        ProofInput {
            paths,
            standing: &self.standing,
            obstacles: &self.obstacles,
            half_floor: self.half_floor,
            limits: &self.limits,
            gap_m: self.limits.contact_m() + MARGIN_M,
            obstacle_gap_m: MARGIN_M,
        }
    }
}

/// A solved and proven transition.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// `goal_of[start]`: the goal that robot shows; `None`: it is spare.
    pub goal_of: Vec<Option<usize>>,
    /// `paths[start]`: all last exactly `duration`, and begin with the rest in which robots turn.
    pub paths: Vec<Path>,
    /// How long it takes.
    pub duration: Span,
    /// The least duration the limits allow.
    pub least: Span,
    /// Bottleneck distance (longest way where identity is fixed) over the speed limit, seconds.
    pub lower_bound_s: f64,
    /// The two centres that come closest; `None` with fewer than two robots.
    pub closest: Option<Closest>,
}

/// The closest two centres of a transition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// How far apart, metres.
    pub distance_m: f64,
    /// When, after the transition's start.
    pub at: Span,
    /// Which two: indices into `starts`, or into `standing` counted on from there.
    pub pair: (usize, usize),
    /// Half way between the two, stage metres.
    pub place: Vec2,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// Goals (indices) that stand in each other's way; may be empty.
    pub goals: Vec<usize>,
    /// Starts (indices) that stand in each other's way; may be empty.
    pub starts: Vec<usize>,
    /// One line for people: who, and what distance would do.
    pub message: String,
}

/// A repaired transition.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// `paths[start]` all last equally long, at least the problem's duration, and begin with the rest in which robots
    /// turn.
    pub paths: Vec<Path>,
    /// The least they may last.
    pub least: Span,
}

/// Two robots that do not get past each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Which two: indices into `starts`.
    pub pair: (usize, usize),
    /// Half way between the two, stage metres.
    pub place: Vec2,
}

/// A path that owns its pieces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// Where it starts, stage metres.
    pub start: Vec2,
    /// Its pieces in order.
    pub pieces: Vec<Piece>,
}

impl Path {
    /// The most pieces of a path: what a robot can keep.
    pub(crate) const MOST_PIECES: usize = 128;

    /// The path as others read it.
    pub fn as_ref(&self) -> PathRef<'_> {
        PathRef::new(self.start, &self.pieces)
    }
}
