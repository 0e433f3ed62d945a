//! What goes into an exam and what comes out of it.

use lightbots_base::{RobotId, Vec2};

use crate::sight::Question;

/// Options of an exam.
#[derive(Clone, Debug)]
pub struct Options {
    /// Robot to examine; `None`: the only robot on the broker.
    pub robot: Option<RobotId>,
    /// Width and depth of the floor, metres. The robot is not sent off the floor, and reported places off it are errors.
    pub floor: (f64, f64),
    /// Whether a person answers questions about the light.
    pub looks: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { robot: None, floor: (3.0, 3.0), looks: false }
    }
}

/// A message to publish at QoS 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Publish {
    /// Topic.
    pub topic: String,
    /// Payload; some are invalid on purpose.
    pub payload: Vec<u8>,
}

/// What happens in an exam, for its user.
#[derive(Clone, Debug, PartialEq)]
pub enum ExamEvent {
    /// The robot will be driven; the exam waits for [`Exam::go`](crate::Exam::go).
    Ready {
        /// Name of the robot.
        robot: RobotId,
        /// Position, stage metres; `None`: the robot does not know it and will not be driven.
        at: Option<Vec2>,
        /// Place up to which the robot drives, stage metres. The floor must be free for 0.5 m in this direction.
        towards: Option<Vec2>,
    },
    /// Subject of the rules that are tried now.
    Doing(&'static str),
    /// A question about the light; the exam waits for [`Exam::answer`](crate::Exam::answer).
    Look(Question),
}

/// How an exam ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The script has ended; the findings tell what was tried.
    Done,
    /// No robot reports on this broker, or not the requested one.
    NoRobot,
    /// Several robots report, and none was requested.
    Several(Vec<RobotId>),
}
