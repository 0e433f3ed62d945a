//! One transition: problem and solution.

use lightbots_base::{Limits, Span, Vec2};
use lightbots_show::{Easing, Frame, Obstacle, Show, Stage};

use crate::margins::MARGIN_M;
use crate::proof::{Closest, ProofInput};
use crate::{BoundFrame, Path, Prescribed};

/// A drive may take this much longer than it was asked to, seconds: times are whole milliseconds.
pub(crate) const ASKED_SLACK_S: f64 = 5e-3;

/// A drive from one set of places to another.
#[derive(Clone, Debug)]
pub struct TransitionProblem {
    /// Start of each robot, stage metres.
    pub starts: Vec<Vec2>,
    /// Places to reach, stage metres. At most as many as `starts`: the other robots are spare, and may stay or step
    /// aside.
    pub goals: Vec<Vec2>,
    /// `pinned[goal]`: the start that must go there; goals beyond its end are not pinned.
    pub pinned: Vec<Option<usize>>,
    /// Discs that do not move: dead robots and robots that do not take part. Stage metres.
    pub standing: Vec<Vec2>,
    /// No-go areas.
    pub obstacles: Vec<Obstacle>,
    /// Half the floor's width and depth, metres; centres stay a radius inside.
    pub half_floor: Vec2,
    /// Limits of the robots.
    pub limits: Limits,
    /// Asked duration; `None`, or less than is legal: as fast as legal.
    pub duration: Option<Span>,
    /// Shape of the speed over time.
    pub easing: Easing,
    /// The drive that the show prescribes, for robots that stand where it begins.
    pub prescribed: Option<Prescribed>,
}

impl TransitionProblem {
    /// A problem without robots on an empty floor, to be filled in.
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
            prescribed: None,
        }
    }

    /// A problem without robots on a stage, to be filled in.
    pub fn on_stage(stage: &Stage) -> Self {
        let half_floor = Vec2::new(stage.width_m, stage.depth_m) / 2.0;
        Self { obstacles: stage.obstacles.clone(), ..Self::on_floor(half_floor, stage.limits) }
    }

    /// The same, driven as a frame asks for.
    pub fn timed_as(stage: &Stage, frame: &Frame) -> Self {
        Self {
            duration: frame.transition_s.filter(|seconds| seconds.is_finite()).map(Span::from_secs),
            easing: frame.easing,
            ..Self::on_stage(stage)
        }
    }

    /// The drive to frame `index` of a show: the one place that reads a stage and a frame for the planner.
    pub fn of_frame(show: &Show, index: usize, starts: Vec<Vec2>, bound: &BoundFrame<'_>) -> Self {
        assert_eq!(bound.pixels.len(), bound.pinned.len(), "each pixel of a bound frame has a binding");
        Self {
            starts,
            goals: bound.pixels.iter().map(|pixel| pixel.at).collect(),
            pinned: bound.pinned.clone(),
            prescribed: Prescribed::of_frame(show, index, bound),
            ..Self::timed_as(&show.stage, &show.frames[index])
        }
    }

    /// The proof's input for paths of this problem.
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
    /// `goal_of[start]`: the goal of that robot; `None`: it is spare.
    pub goal_of: Vec<Option<usize>>,
    /// `paths[start]`: all last exactly `duration`, and begin with the rest in which robots turn.
    pub paths: Vec<Path>,
    /// Duration.
    pub duration: Span,
    /// Least duration within the limits.
    pub least: Span,
    /// Bottleneck distance over the speed limit, seconds; the longest straight line where identity is fixed.
    pub lower_bound_s: f64,
    /// The two centres that come closest; `None` with fewer than two robots.
    pub closest: Option<Closest>,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// Goals (indices) in each other's way; may be empty.
    pub goals: Vec<usize>,
    /// Starts (indices) in each other's way; may be empty.
    pub starts: Vec<usize>,
    /// One line for people: the reason, and a distance that would do.
    pub message: String,
}

/// Solved paths of a given assignment.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// `paths[start]`: all last equally long, at least the asked duration, and begin with the rest in which robots
    /// turn.
    pub paths: Vec<Path>,
    /// Least duration within the limits.
    pub least: Span,
}

/// Two robots that do not get past each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Indices into `starts`.
    pub pair: (usize, usize),
    /// Half way between the two, stage metres.
    pub place: Vec2,
}
