//! The firmware that a simulated robot runs.

use lightbots_robot::{Message, Robot, RouteStorage};
use lightbots_wire::Topic;

use crate::original::Original;

/// Our firmware, with its route storage in a place of its own on the heap. A step hardly reads that storage. The other
/// state of all robots then lies close together in memory, which helps the cache.
pub(crate) type Ours = Robot<Box<RouteStorage>>;

/// The firmware of a robot.
#[expect(clippy::large_enum_variant, reason = "nearly all robots are ours, and looked at in order")]
#[repr(u8)]
pub(crate) enum RobotFirmware {
    /// Our firmware.
    Ours(Ours),
    /// An original robot, which understands only TARGET, COLOR and UUID.
    Original(Original),
}

impl RobotFirmware {
    /// Writes the robot's next message to `payload`. Returns its topic; `None` if there is no message.
    #[inline]
    pub fn outgoing(&mut self, payload: &mut Message) -> Option<Topic> {
        match self {
            Self::Ours(robot) => robot.outgoing(payload),
            Self::Original(robot) => robot.outgoing(payload),
        }
    }
}
