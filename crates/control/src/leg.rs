//! One leg of a run: what each robot drives between two moments at which all robots stand. A participant is a robot of
//! the run; its participant number is its index in the run's list of participants.

use crate::frame_cursor::FrameCursor;
use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::Path;
use lightbots_plan::unsynchronised::StraightDrive;
use lightbots_wire::Neighbours;
use std::sync::Arc;

/// The drives of all robots between two moments at which all robots stand. Robots reach a frame in one leg, or in
/// several. Several are needed if TARGET-only robots and others drive in turn, or if close robots are first moved
/// apart. TARGET-only robots have the original firmware, which understands TARGET and COLOR but no routes.
#[derive(Clone, Debug)]
pub(crate) struct Leg {
    /// The frame that the leg leads to, counted from 0.
    pub frame: usize,
    /// How many times the whole show started again before that frame.
    pub round: u32,
    /// How many times the show has repeated the loop that contains the frame, since it entered that loop; 0 if no loop
    /// contains the frame. A jump within the loop does not count.
    pub pass: u32,
    /// Number of this leg, which all its routes have; 0 until the leg is queued.
    pub seq: u32,
    /// Whether robots drive routes or by TARGET.
    pub kind: LegKind,
    /// What each robot does, by participant number. Participants that joined later have no entry. Those that had
    /// dropped out before stand, with the stage's origin as a goal without meaning.
    pub robots: Vec<RobotLeg>,
    /// The straight drives of TARGET-only robots. A drive yields only to drives that are earlier in the list; see
    /// [`StraightDrive`].
    pub drives: Vec<StraightDrive>,
    /// Number of robots that drive in this leg, and have to arrive before it ends. A path may also keep its robot in
    /// place.
    pub drivers: usize,
    /// Planned time from the start of the drive to its end.
    pub duration: Span,
    /// Whether robots have reached the frame at the end of this leg; `false` if a further leg to it follows.
    pub reaches_frame: bool,
    /// Least planned clearance between any two robots, or a robot and a disc that stands, in this leg, metres; 0 if it
    /// is not known.
    pub room_m: f64,
    /// Places at which the plan had robots that dropped out, stage metres.
    pub around: Arc<[Vec2]>,
}

/// Whether robots drive routes or by TARGET.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LegKind {
    /// Robots drive timed paths after a common START.
    Routes,
    /// Robots get TARGETs one after the other, so that robots of any speed do not meet.
    Targets,
}

/// One robot's part in a leg.
#[derive(Clone, Debug)]
pub(crate) struct RobotLeg {
    /// What the robot does.
    pub task: Task,
    /// Least planned clearance of the robot to others, metres. Infinite if none comes near, or if the robot drives no
    /// path. In very large plans: that of the whole plan, or 0 if not known.
    pub room_m: f64,
    /// The neighbours that come into sight on the robot's path; `None` if they were not computed.
    pub neighbours: Option<Arc<Neighbours>>,
    /// Where the robot stands after the leg by plan, stage metres.
    pub goal: Vec2,
    /// Whether `goal` is the robot's place in the frame. `false` if a later leg takes the robot to that place.
    pub settles: bool,
    /// Id of the pixel that the robot shows in the leg's frame; `None` if it shows none.
    pub pixel: Option<u32>,
    /// The colour of that pixel; black if the robot shows none.
    pub color: Rgb,
}

/// What a robot does in a leg.
#[derive(Clone, Debug)]
pub(crate) enum Task {
    /// It stands, and has no path.
    Stay,
    /// It has a timed path, which may also keep it in place.
    Path(Path),
    /// It drives the entries of [`Leg::drives`] that have its participant number.
    Drives,
}

impl RobotLeg {
    /// Returns the part of a dark robot that stands at `at`, stage metres.
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

    /// Returns the path of a participant; `None` if the participant drives no path in this leg.
    pub fn path(&self, participant: usize) -> Option<&Path> {
        match self.robots.get(participant).map(|robot| &robot.task) {
            Some(Task::Path(path)) => Some(path),
            _ => None,
        }
    }

    /// Whether a participant has a path or a straight drive in this leg, and so has to arrive.
    pub fn is_driven_by(&self, participant: usize) -> bool {
        self.robots.get(participant).is_some_and(|robot| !matches!(robot.task, Task::Stay))
    }

    /// Returns where a participant stands by plan when the leg begins, stage metres; `None` if it joined later. Without
    /// meaning for one that had dropped out before.
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

    /// Returns where a participant stands by plan when the leg ends, stage metres; `None` if it joined later. Without
    /// meaning for one that had dropped out before.
    pub fn goal(&self, participant: usize) -> Option<Vec2> {
        self.robots.get(participant).map(|robot| robot.goal)
    }
}
