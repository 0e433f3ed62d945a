//! One leg of a run: what each robot drives between two moments at which all stand.

use crate::frame_cursor::FrameCursor;
use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::Path;
use lightbots_plan::unsynchronised::StraightDrive;
use lightbots_wire::Neighbours;
use std::sync::Arc;

/// What all robots do between two moments at which all stand. A frame takes one leg, or several where robots that know
/// TARGET only and others have to go one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Leg {
    /// The frame it leads to, counted from 0.
    pub frame: usize,
    /// How many times the show started again before that frame.
    pub round: u32,
    /// How many times the frames of its loop were played before.
    pub pass: u32,
    /// Number of its routes; 0 until it is queued.
    pub seq: u32,
    /// How robots are told to go.
    pub kind: LegKind,
    /// `[participant]`; participants that join later have none.
    pub robots: Vec<RobotLeg>,
    /// The straight drives of robots that know TARGET only, in the order in which each is valid; see [`StraightDrive`].
    pub drives: Vec<StraightDrive>,
    /// Number of robots that have to arrive.
    pub drivers: usize,
    /// From the START to the planned end.
    pub duration: Span,
    /// The frame is reached at its end.
    pub reaches_frame: bool,
    /// Clearance of the closest two robots by plan, metres.
    pub room_m: f64,
    /// Where its plan had robots that dropped out.
    pub around: Arc<[Vec2]>,
}

/// How robots are told to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LegKind {
    /// Timed paths and a common START.
    Routes,
    /// TARGETs, sent one after the other so that no robot is in another's way at any speed.
    Targets,
}

/// One robot's part in a leg.
#[derive(Clone, Debug)]
pub(crate) struct RobotLeg {
    /// What the robot is told.
    pub task: Task,
    /// Clearance of the robot by plan, metres; infinite where that is far.
    pub room_m: f64,
    /// The neighbours that come into sight on its path.
    pub neighbours: Option<Arc<Neighbours>>,
    /// Where the robot stands afterwards, stage metres.
    pub goal: Vec2,
    /// The robot stands there in the frame too.
    pub settles: bool,
    /// The pixel that the robot shows in the leg's frame.
    pub pixel: Option<u32>,
    /// The light of that pixel; black for spares.
    pub color: Rgb,
}

/// What a robot is told.
#[derive(Clone, Debug)]
pub(crate) enum Task {
    /// Nothing: the robot stands.
    Stay,
    /// A timed path.
    Path(Path),
    /// The straight drives of its leg.
    Drives,
}

impl RobotLeg {
    /// A robot that stands at a place, dark.
    pub fn stay(at: Vec2) -> Self {
        Self {
            task: Task::Stay,
            room_m: f64::INFINITY,
            neighbours: None,
            goal: at,
            settles: true,
            pixel: None,
            color: Rgb::BLACK,
        }
    }
}

impl Leg {
    /// The frame it leads to, in its run.
    pub fn cursor(&self) -> FrameCursor {
        FrameCursor { frame: self.frame, round: self.round, pass: self.pass }
    }

    /// The path of a participant, if it drives one.
    pub fn path(&self, participant: usize) -> Option<&Path> {
        match self.robots.get(participant).map(|robot| &robot.task) {
            Some(Task::Path(path)) => Some(path),
            _ => None,
        }
    }

    /// Whether a participant has to arrive.
    pub fn is_driven_by(&self, participant: usize) -> bool {
        self.robots.get(participant).is_some_and(|robot| !matches!(robot.task, Task::Stay))
    }

    /// Where a participant stands at the end; `None` where it joined later.
    pub fn goal(&self, participant: usize) -> Option<Vec2> {
        self.robots.get(participant).map(|robot| robot.goal)
    }
}
