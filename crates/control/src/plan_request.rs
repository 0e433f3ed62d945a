//! A request for a plan, and its result. Any thread may make the plan.

use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::mapping::Mapping;
use lightbots_base::{RobotId, Span, StateHash, Vec2};
use lightbots_show::Show;
use std::sync::Arc;

/// Longest duration of planning while robots wait, for up to [`FEW`] robots. After it the plan is cancelled.
const BUDGET: Span = Span::from_millis(1_000);
/// Time added to [`BUDGET`] for each robot above [`FEW`]; it makes 5 s in all for 1,000 robots.
const BUDGET_PER_ROBOT: Span = Span(4_445);
/// Number of robots up to which [`BUDGET`] is enough.
const FEW: usize = 100;

/// A request for a plan. Equal requests give equal results on any thread, unless planning is cancelled.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    pub(crate) number: u64,
    pub(crate) problem: PlanProblem,
}

/// What is to be planned.
#[derive(Clone, Debug)]
pub(crate) struct PlanProblem {
    pub show: Arc<Show>,
    /// Frames to plan, in the order in which they are played.
    pub frames: Vec<FrameCursor>,
    pub robots: Vec<PlannedRobot>,
    /// Number of participants of the run, including those without a part in this plan.
    pub participants: usize,
    /// Centres of all discs that stand during the plan and must be avoided, stage metres.
    pub standing: Vec<Vec2>,
    /// The centres in `standing` that no robot reported: assumed places of silent robots, and obstacles that blocked
    /// robots. Stage metres.
    pub inferred: Vec<Vec2>,
    pub mapping: Mapping,
    /// Whether pixels that make a frame infeasible may be left out. Otherwise planning of the frame fails.
    pub lenient: bool,
    /// Whether all plans were dropped before, so that robots wait for this plan. It begins where robots stand. They may
    /// have been stopped on their paths, closer to each other than plans have them.
    pub stopped: bool,
}

impl PlanProblem {
    /// Whether TARGET-only robots take part: robots that understand TARGET and COLOR, but no routes.
    pub fn has_originals(&self) -> bool {
        self.robots.iter().any(|robot| robot.original)
    }
}

/// A robot that takes part in a plan.
#[derive(Clone, Debug)]
pub(crate) struct PlannedRobot {
    pub participant: usize,
    pub id: RobotId,
    /// Where the robot stands when the plan begins, stage metres.
    pub at: Vec2,
    pub original: bool,
}

/// The result of a request; give it to [`crate::Controller::planned`].
#[derive(Clone, Debug)]
pub struct PlanResult {
    pub(crate) number: u64,
    /// Number of the planner's check at which planning was cancelled, counted from 1; `None` if it was not. A replay
    /// cancels at the same check.
    pub(crate) cancelled_at: Option<u64>,
    pub(crate) legs: Vec<Leg>,
    /// Whether all plans were dropped before this one, and robots wait for it.
    pub(crate) stopped: bool,
    /// Number of frames that were planned.
    pub(crate) frames: usize,
    /// Frames, counted from 0, with the ids of their pixels that no robot shows.
    pub(crate) dark: Vec<(usize, Vec<u32>)>,
    /// The first frame without a plan, counted from 0, and the reason for people; `None` if all frames were planned.
    pub(crate) failed: Option<(usize, String)>,
    pub(crate) mapping: Mapping,
}

impl PlanResult {
    /// Returns an empty result, for a request whose plan is not wanted any more.
    pub(crate) fn unwanted(number: u64) -> Self {
        Self {
            number,
            cancelled_at: None,
            legs: Vec::new(),
            stopped: false,
            frames: 0,
            dark: Vec::new(),
            failed: None,
            mapping: Mapping::default(),
        }
    }
}

impl PlanRequest {
    /// Adds everything that the plan depends on to a hash, except the show and the pins.
    pub(crate) fn imprint(&self, hash: &mut StateHash) {
        let PlanProblem {
            frames, robots, participants, standing, inferred, mapping, lenient, stopped, ..
        } = &self.problem;
        hash.word(self.number);
        hash.word(*participants as u64);
        hash.word(u64::from(*lenient) | u64::from(*stopped) << 1);
        for &FrameCursor { frame, round, pass } in frames {
            hash.word((frame as u64) << 32 | u64::from(round));
            hash.word(pass.into());
        }
        for robot in robots {
            hash.bytes(robot.id.as_bytes());
            hash.word((robot.participant as u64) << 1 | u64::from(robot.original));
        }
        for at in robots.iter().map(|robot| &robot.at).chain(standing).chain(inferred) {
            hash.number(at.x);
            hash.number(at.y);
        }
        for (pixel, robot) in [mapping.owners.oldest_first(), mapping.shown.oldest_first()].concat() {
            hash.word(pixel.into());
            hash.bytes(robot.as_bytes());
        }
    }

    /// Returns the longest time that planning may take while robots wait for it, because all plans were dropped before.
    /// `None` if they were not dropped. The caller measures the time, because this crate reads no clock. After it, the
    /// caller cancels planning by [`run_unless`](Self::run_unless).
    pub fn budget(&self) -> Option<Span> {
        let more = self.problem.robots.len().saturating_sub(FEW);
        self.problem.stopped.then_some(BUDGET + BUDGET_PER_ROBOT * more as i64)
    }
}
