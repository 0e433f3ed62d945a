//! A request for a plan and its result. Any thread may make the plan.

use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::mapping::Mapping;
use lightbots_base::{RobotId, Span, StateHash, Vec2};
use lightbots_show::Show;
use std::sync::Arc;

/// Longest duration of a replan of up to [`FEW`] robots, by the promise of 1 s for 100 robots.
const BUDGET: Span = Span::from_millis(1_000);
/// Additional duration for each robot above [`FEW`]: 5 s for 1,000 robots.
const BUDGET_PER_ROBOT: Span = Span(4_445);
/// Number of robots up to which [`BUDGET`] is enough.
const FEW: usize = 100;

/// A request for a plan. Pure: equal requests give equal results on any thread.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    pub(crate) number: u64,
    pub(crate) problem: PlanProblem,
}

/// What is to be planned.
#[derive(Clone, Debug)]
pub(crate) struct PlanProblem {
    pub show: Arc<Show>,
    /// Frames in the order they are played.
    pub frames: Vec<FrameCursor>,
    pub robots: Vec<PlannedRobot>,
    /// Number of participants, planned or not.
    pub participants: usize,
    /// Discs that do not move, stage metres.
    pub standing: Vec<Vec2>,
    /// The discs of `standing` whose places no robot reported: of silent robots, and of what blocked others.
    pub inferred: Vec<Vec2>,
    pub mapping: Mapping,
    /// Whether conflicting pixels are left out, so that the frame is not given up.
    pub lenient: bool,
    /// Whether robots were stopped on their paths, perhaps closer to each other than is ever planned.
    pub stopped: bool,
}

impl PlanProblem {
    /// Whether robots take part that know TARGET only.
    pub fn has_originals(&self) -> bool {
        self.robots.iter().any(|robot| robot.original)
    }
}

/// A robot that takes part in a plan.
#[derive(Clone, Debug)]
pub(crate) struct PlannedRobot {
    pub participant: usize,
    pub id: RobotId,
    /// Where it starts, stage metres.
    pub at: Vec2,
    pub original: bool,
}

/// The result of a request; give it to [`crate::Controller::planned`].
#[derive(Clone, Debug)]
pub struct PlanResult {
    pub(crate) number: u64,
    /// At which question of the planner it was cancelled, counted from 1; `None`: it was not. A replay cancels it there.
    pub(crate) cancelled_at: Option<u64>,
    pub(crate) legs: Vec<Leg>,
    /// Whether it begins where robots were stopped on their paths.
    pub(crate) stopped: bool,
    /// Number of planned frames.
    pub(crate) frames: usize,
    /// Pixels that stay dark, by frame.
    pub(crate) dark: Vec<(usize, Vec<u32>)>,
    /// The first frame without a plan, and why.
    pub(crate) failed: Option<(usize, String)>,
    pub(crate) mapping: Mapping,
}

impl PlanResult {
    /// The result of a request whose answer is not wanted any more.
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
    /// Appends everything that the plan depends on but the show and the pins to a hash.
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

    /// Longest duration while robots wait for the plan; `None`: they do not wait. The caller measures it, because a core
    /// reads no clock, and cancels the request by [`run_unless`](Self::run_unless).
    pub fn budget(&self) -> Option<Span> {
        let more = self.problem.robots.len().saturating_sub(FEW);
        self.problem.stopped.then_some(BUDGET + BUDGET_PER_ROBOT * more as i64)
    }
}
