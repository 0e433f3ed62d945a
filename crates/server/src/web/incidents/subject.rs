//! What incidents are about.

use lightbots_base::RobotId;
use lightbots_control::Trouble;

/// What an incident is about. An event changes the incident with its subject if there is one that is not over. For
/// dropouts and wishes to join, an incident that the operator has read is not changed any more: a new one begins. For
/// dropouts, a new one also begins after a pause.
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
