//! The fleet table: everything about robots that does not change twenty times a second.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Every robot the controller knows, sent when something in it changed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct Fleet {
    /// Counts up whenever robots are added or removed; a `State` with the same number lists robots in this order.
    pub revision: u32,
    /// One row a robot, in the order of `State`.
    pub rows: Vec<FleetRow>,
}

/// One robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct FleetRow {
    /// Its name on the wire, usually a UUID.
    pub id: String,
    /// What it says it is doing.
    pub status: RobotStatus,
    /// Whether it can be counted on.
    pub presence: Presence,
    /// How long ago it was last heard, seconds.
    pub age_s: f64,
    /// Charge, percent; null: it does not say.
    pub battery: Option<u8>,
    /// Id of the pixel it shows, or shall show next; null: it stands by.
    pub pixel: Option<u32>,
    /// Name and version of its firmware; null: it does not say, as original robots do not.
    pub firmware: Option<String>,
    /// What it can do beyond the original protocol.
    pub abilities: Abilities,
    /// How far its clock may be off, microseconds; null: not synchronised.
    pub clock_us: Option<u32>,
    /// Whether it says that it is simulated. Every other robot is real, and a fleet with one such robot is a real fleet.
    pub simulated: bool,
}

/// What a robot is doing. In `State` it is the index in this order, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum RobotStatus {
    /// It stands and waits.
    Idle,
    /// It keeps a route that has not begun.
    Ready,
    /// It drives.
    Driving,
    /// Its route is held.
    Held,
    /// It does not know where it is.
    Lost,
    /// It lost the link during a run.
    Cut,
    /// Its sensors or motors make no sense.
    Faulty,
}

/// How long a robot has been silent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Presence {
    /// Heard of lately.
    Active,
    /// Silent for longer than it should be: drawn faded.
    Stale,
    /// Not counted on any more.
    Gone,
}

/// What a robot can do beyond TARGET, COLOR and UUID.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Abilities {
    /// It follows timed paths.
    pub route: bool,
    /// It fades its light.
    pub fade: bool,
    /// It blinks to be found.
    pub blink: bool,
}

impl RobotStatus {
    /// Every status, in the order `State` counts them.
    pub const ALL: [Self; 7] =
        [Self::Idle, Self::Ready, Self::Driving, Self::Held, Self::Lost, Self::Cut, Self::Faulty];
}
