//! Topics: which way a message goes.

use lightbots_base::RobotId;

/// Where a message is published, under `T/LightBot/`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Topic {
    /// `UUID`: robots introduce themselves. Original.
    Uuid,
    /// `Arrival`: robots say that they have reached their target or the end of their route. Original.
    Arrival,
    /// `Status`: robots report how they are, while they drive and when something changes. Ours.
    Status,
    /// `Time`: robots ask for the show clock. Ours.
    Time,
    /// `Broadcast`: the controller speaks to all robots. Original.
    Broadcast,
    /// `<uuid>`: the controller speaks to one robot. Original.
    Robot(RobotId),
}
