//! One transition: problem and solution.

use lightbots_base::{Limits, Span, Vec2};
use lightbots_show::{Easing, Frame, Obstacle, Show, Stage};

use crate::margins::MARGIN_M;
use crate::proof::{Closest, ProofInput};
use crate::{BoundFrame, Path, Prescribed};

/// Tolerance on the asked duration of a drive, seconds: a drive counts as on time if it exceeds that duration by no
/// more. Durations are whole milliseconds.
pub(crate) const ASKED_SLACK_S: f64 = 5e-3;

/// The problem of one transition: all robots drive from their starts to the goals.
#[derive(Clone, Debug)]
pub struct TransitionProblem {
    /// Start of each robot, stage metres.
    pub starts: Vec<Vec2>,
    /// Places to reach, stage metres. There are at most as many goals as starts. Robots without a goal are spare: they
    /// may stay or step aside.
    pub goals: Vec<Vec2>,
    /// `pinned[goal]`: index of the start whose robot must go to that goal; `None` if any robot may. Goals beyond the
    /// end of this list are not pinned.
    pub pinned: Vec<Option<usize>>,
    /// Centres of discs that do not move, stage metres: dead robots and robots that do not take part.
    pub standing: Vec<Vec2>,
    /// No-go areas.
    pub obstacles: Vec<Obstacle>,
    /// Half the floor's width and depth, metres. Robots' centres stay at least a robot's radius inside the edge.
    pub half_floor: Vec2,
    /// Limits of the robots.
    pub limits: Limits,
    /// Asked duration of the drive. If it is `None` or shorter than the limits allow, robots drive as fast as the
    /// limits allow.
    pub duration: Option<Span>,
    /// Shape of the speed over time.
    pub easing: Easing,
    /// The drive that the show prescribes. It applies only if the robots' starts are where that drive begins.
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

    /// A problem without robots on a stage, with the duration and the easing that a frame asks for.
    pub fn timed_as(stage: &Stage, frame: &Frame) -> Self {
        Self {
            duration: frame.transition_s.filter(|seconds| seconds.is_finite()).map(Span::from_secs),
            easing: frame.easing,
            ..Self::on_stage(stage)
        }
    }

    /// The problem of the drive to frame `index` of a show. Panics if there is no such frame, or if `bound` does not
    /// have one binding for each pixel.
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

    /// Returns the input with which the proof checks paths of this problem.
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
    /// `goal_of[start]`: index of the goal of the robot at that start; `None` if the robot is spare.
    pub goal_of: Vec<Option<usize>>,
    /// `paths[start]`: the timed path of the robot at that start. All paths last exactly `duration`, and begin with a
    /// rest in which robots turn.
    pub paths: Vec<Path>,
    /// Duration of all paths.
    pub duration: Span,
    /// Duration of the same drive at full speed: the least within the limits of the robots.
    pub least: Span,
    /// Lower bound on the duration, seconds: the bottleneck distance of the assignment divided by the speed limit.
    /// Where the show fixes the assignment, its longest straight line counts.
    pub lower_bound_s: f64,
    /// The closest approach of two centres, of robots or standing discs; `None` with fewer than two of them.
    pub closest: Option<Closest>,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// Indices of the goals that cause the failure; may be empty.
    pub goals: Vec<usize>,
    /// Indices of the starts whose robots cause the failure; may be empty.
    pub starts: Vec<usize>,
    /// One line for the user: the reason, and what to change.
    pub message: String,
}

/// Paths that a solver found for a given assignment.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// `paths[start]`: the timed path of the robot at that start. All paths last equally long, at least the asked
    /// duration, and begin with a rest in which robots turn.
    pub paths: Vec<Path>,
    /// Duration of the same drive at full speed: the least within the limits of the robots.
    pub least: Span,
}

/// Two robots for which a solver found no paths past each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Indices into `starts`.
    pub pair: (usize, usize),
    /// Point half way between the two robots, stage metres.
    pub place: Vec2,
}
