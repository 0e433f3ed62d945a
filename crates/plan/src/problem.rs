//! The problem of one transition (the drive from one frame to the next), its solution, and reasons for which there is
//! none.

use lightbots_base::{Limits, Span, Vec2};
use lightbots_show::{Easing, Frame, Obstacle, Show, Stage};

use crate::margins::MARGIN_M;
use crate::proof::{Closest, ProofInput};
use crate::{BoundFrame, Path, Prescribed};

/// Tolerance on the asked duration of a drive, seconds: a drive is on time if it lasts at most this much longer than
/// asked. The planner rounds durations to whole milliseconds, which must not make a drive late.
pub(crate) const ASKED_SLACK_S: f64 = 5e-3;

/// The problem of one transition: all robots drive from their starts to the goals.
#[derive(Clone, Debug)]
pub struct TransitionProblem {
    /// `[robot]`: its start, stage metres. A robot's index in this list is its number everywhere in the problem.
    pub starts: Vec<Vec2>,
    /// Places to reach, stage metres. There are at most as many goals as starts. Robots without a goal are spare: they
    /// may stay or step aside.
    pub goals: Vec<Vec2>,
    /// `pinned[goal]`: index of the robot that must go to that goal; `None` if any robot may. Goals beyond the end of
    /// this list are not pinned.
    pub pinned: Vec<Option<usize>>,
    /// Centres of discs that do not move, stage metres: dead robots and robots that do not take part.
    pub standing: Vec<Vec2>,
    /// No-go areas.
    pub obstacles: Vec<Obstacle>,
    /// Half the floor's width and depth, metres. Robots' centres stay at least a robot's radius inside the edge, unless
    /// they start closer to it.
    pub half_floor: Vec2,
    /// Limits of the robots.
    pub limits: Limits,
    /// Asked duration of the drive. If it is `None`, or shorter than the robots can drive, robots drive as fast as
    /// their limits allow. There are two exceptions among prescribed drives. A motion of the picture, other than
    /// staggered starts, is infeasible if this duration is too short for it. Trajectories that the show contains keep
    /// their own durations.
    pub duration: Option<Span>,
    /// Shape of the speed over time: two ramps with a cruise between them if the way is long enough (`Swift`), or no
    /// cruise (`Gentle`).
    pub easing: Easing,
    /// The drive that the show prescribes; `None` if it prescribes none. Prescribed paths apply only if robots stand
    /// where the paths begin and pixels are where the paths end. Otherwise the planner plans an ordinary drive.
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

    /// The problem of the drive to frame `index` of a show. Panics if there is no frame of this index, or if `bound`
    /// does not have one binding for each pixel.
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
    /// `goal_of[robot]`: index of the robot's goal; `None` if the robot is spare.
    pub goal_of: Vec<Option<usize>>,
    /// `paths[robot]`: its timed path. All paths last exactly `duration`. They begin with a rest in which robots turn,
    /// except trajectories that the show contains and drives in which no robot moves.
    pub paths: Vec<Path>,
    /// Duration of all paths, including the rest at the beginning.
    pub duration: Span,
    /// Duration of the same drive at full speed: the least within the limits of the robots, without the delays that
    /// raise stop-safety. 0 for trajectories that the show contains.
    pub least: Span,
    /// Lower bound on the duration, seconds: the bottleneck distance divided by the speed limit. The bottleneck
    /// distance is the longest straight line from a start to its goal, with the assignment that makes this line
    /// shortest. Assignments that break a pin, or the pairs of a prescribed drive, do not count.
    pub lower_bound_s: f64,
    /// The closest approach of two centres: of two robots, or of a robot and a standing disc. `None` if there is no
    /// pair of either kind.
    pub closest: Option<Closest>,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// Indices of the goals that cause the failure; empty if no particular goal does.
    pub goals: Vec<usize>,
    /// Indices of the robots that cause the failure; empty if no particular robot does.
    pub starts: Vec<usize>,
    /// One line for the user: the reason, and what to change.
    pub message: String,
}

/// Paths that a solver found for a given assignment.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// `paths[robot]`: its timed path. All paths last equally long, at least the asked duration, and begin with a rest
    /// in which robots turn.
    pub paths: Vec<Path>,
    /// Duration of the same drive at full speed: the least within the limits of the robots.
    pub least: Span,
}

/// Two robots for which a solver found no paths past each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Indices of the two robots in [`TransitionProblem::starts`].
    pub pair: (usize, usize),
    /// Point half way between the two robots when they come too close, stage metres.
    pub place: Vec2,
}
