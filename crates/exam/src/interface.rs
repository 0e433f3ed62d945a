//! Types of the inputs and outputs of an exam.

use lightbots_base::{RobotId, Vec2};

use crate::sight::Question;

/// Options of an exam.
#[derive(Clone, Debug)]
pub struct Options {
    /// Name of the robot to examine; `None`: the only robot on the broker.
    pub robot: Option<RobotId>,
    /// Width and depth of the floor, metres, with the origin in its middle. The robot is sent in the direction with the
    /// most free floor. If it first reports a place more than 0.1 m off the floor, it breaks R9 and the exam ends.
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

/// What an exam tells its user.
#[derive(Clone, Debug, PartialEq)]
pub enum ExamEvent {
    /// The robot is about to be driven; the exam waits for [`Exam::go`](crate::Exam::go).
    Ready {
        /// Name of the robot.
        robot: RobotId,
        /// Position of the robot, stage metres. `None`: the robot does not know its position and will not be driven.
        at: Option<Vec2>,
        /// The farthest place to which the robot will be sent, stage metres. The floor must be free for 0.5 m from `at`
        /// towards it.
        towards: Option<Vec2>,
    },
    /// Subject of the rules that are tried from now on, for people.
    Doing(&'static str),
    /// A question about the light; the exam waits for [`Exam::answer`](crate::Exam::answer).
    Look(Question),
}

/// How an exam ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The script has ended; the findings tell what was tried.
    Done,
    /// No robot reports on this broker, or the requested robot does not.
    NoRobot,
    /// Several robots report, and none was requested.
    Several(Vec<RobotId>),
}
