//! One leg of a run: what each robot drives between two moments at which all stand.

use crate::frame_cursor::FrameCursor;
use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::Path;
use lightbots_plan::unsynchronised::StraightDrive;
use lightbots_wire::Neighbours;
use std::sync::Arc;

/// The drives of all robots between two moments at which all stand. A frame takes one leg, or several if TARGET-only
/// robots and others have to go one after the other. TARGET-only robots have the original firmware, which understands
/// TARGET and COLOR but no routes.
#[derive(Clone, Debug)]
pub(crate) struct Leg {
    /// The frame it leads to, counted from 0.
    pub frame: usize,
    /// How many times the show started again before that frame.
    pub round: u32,
    /// How many times the frames of its loop were played before; 0 outside of loops.
    pub pass: u32,
    /// Number of the routes of this leg; 0 until the leg is queued.
    pub seq: u32,
    /// Whether robots drive routes or by TARGET.
    pub kind: LegKind,
    /// What each robot does, by participant number; participants that joined later have no entry.
    pub robots: Vec<RobotLeg>,
    /// The straight drives of TARGET-only robots. Each yields to earlier ones in the list only; see [`StraightDrive`].
    pub drives: Vec<StraightDrive>,
    /// Number of robots that have to arrive.
    pub drivers: usize,
    /// Time from the START to the planned end.
    pub duration: Span,
    /// Whether the frame is reached at the end of this leg.
    pub reaches_frame: bool,
    /// Planned clearance of the closest two robots, metres; 0 if it is not known.
    pub room_m: f64,
    /// Places at which the plan had robots that dropped out, stage metres.
    pub around: Arc<[Vec2]>,
}

/// Whether robots drive routes or by TARGET.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LegKind {
    /// Robots drive timed paths after a common START.
    Routes,
    /// Robots get TARGETs one after the other, so that no robot is in another's way at any speed.
    Targets,
}

/// One robot's part in a leg.
#[derive(Clone, Debug)]
pub(crate) struct RobotLeg {
    /// What the robot does.
    pub task: Task,
    /// Planned clearance of the robot, metres; infinite if no other comes near.
    pub room_m: f64,
    /// The neighbours that come into sight on its path; `None` if they were not computed.
    pub neighbours: Option<Arc<Neighbours>>,
    /// Where the robot stands after the leg, stage metres.
    pub goal: Vec2,
    /// Whether the robot's place in the frame is this goal, and not reached by a later leg.
    pub settles: bool,
    /// The pixel that the robot shows in the leg's frame.
    pub pixel: Option<u32>,
    /// The light of that pixel; black for spares.
    pub color: Rgb,
}

/// What a robot does in a leg.
#[derive(Clone, Debug)]
pub(crate) enum Task {
    /// It stands.
    Stay,
    /// It drives a timed path.
    Path(Path),
    /// It drives its straight drives in [`Leg::drives`].
    Drives,
}

impl RobotLeg {
    /// Returns the part of a robot that stands at a place, dark.
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
    /// Returns the frame that the leg leads to, with its round and pass.
    pub fn cursor(&self) -> FrameCursor {
        FrameCursor { frame: self.frame, round: self.round, pass: self.pass }
    }

    /// Returns the path of a participant; `None` if it drives none.
    pub fn path(&self, participant: usize) -> Option<&Path> {
        match self.robots.get(participant).map(|robot| &robot.task) {
            Some(Task::Path(path)) => Some(path),
            _ => None,
        }
    }

    /// Whether a participant drives in this leg and has to arrive.
    pub fn is_driven_by(&self, participant: usize) -> bool {
        self.robots.get(participant).is_some_and(|robot| !matches!(robot.task, Task::Stay))
    }

    /// Returns where a participant stands at the begin, stage metres; `None` if it joined later.
    pub fn begin(&self, participant: usize) -> Option<Vec2> {
        let robot = self.robots.get(participant)?;
        match &robot.task {
            Task::Stay => Some(robot.goal),
            Task::Path(path) => Some(path.start),
            Task::Drives => {
                self.drives.iter().find(|drive| drive.robot == participant).map(|drive| drive.from)
            }
        }
    }

    /// Returns where a participant stands at the end, stage metres; `None` if it joined later.
    pub fn goal(&self, participant: usize) -> Option<Vec2> {
        self.robots.get(participant).map(|robot| robot.goal)
    }
}
