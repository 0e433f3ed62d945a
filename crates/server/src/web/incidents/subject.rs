//! What incidents are about.

use lightbots_base::RobotId;
use lightbots_control::Trouble;

/// What an incident is about. Events with the same subject change the same incident until it is over. Dropouts and wishes to
/// join also begin another incident once the operator has read theirs.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    Dropouts {
        why: Trouble,
        frame: Option<usize>,
    },
    Joining,
    Link,
    Broker,
    Names(RobotId),
    Flood(RobotId),
    Fleet,
    Plan(usize),
    Controller,
    Run,
    Place(RobotId),
    Music,
    /// The entry of the playlist with this number.
    Playlist(u32),
}
