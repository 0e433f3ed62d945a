//! The firmware that a simulated robot runs.

use lightbots_robot::{Message, Robot, RouteStorage};
use lightbots_wire::Topic;

use crate::original::Original;

/// Our firmware with its routes in a box. A step reads next to nothing of them, and the rest of all robots then lies close
/// together.
pub(crate) type Ours = Robot<Box<RouteStorage>>;

/// The firmware of a robot.
#[expect(clippy::large_enum_variant, reason = "nearly all robots are ours, and looked at in order")]
#[repr(u8)]
pub(crate) enum RobotFirmware {
    /// Our firmware.
    Ours(Ours),
    /// A robot that knows only TARGET and COLOR.
    Original(Original),
}

impl RobotFirmware {
    /// Writes its next message.
    #[inline]
    pub fn outgoing(&mut self, payload: &mut Message) -> Option<Topic> {
        match self {
            Self::Ours(robot) => robot.outgoing(payload),
            Self::Original(robot) => robot.outgoing(payload),
        }
    }
}
