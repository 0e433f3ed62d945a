//! The fleet table: facts about robots that change rarely. `Robots` has the places, which change 20 times a second.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// The fleet table. It is sent at once when a robot is added or removed, and otherwise at most twice a second.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct Fleet {
    /// Number of the table, increased when a robot is added or removed. `State.fleet` names the table of a snapshot.
    pub revision: u32,
    /// Whether only listed robots take part in runs.
    pub only_listed: bool,
    /// One row per robot, in the order of `Robots`.
    pub rows: Vec<FleetRow>,
}

/// A row of the fleet table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct FleetRow {
    /// Name of the robot in messages, usually a UUID.
    pub id: String,
    /// The status of the robot's last report; `idle` for an original robot, whose reports have none.
    pub status: RobotStatus,
    /// How recent the last report is.
    pub presence: Presence,
    /// Age of the last message from the robot, seconds.
    pub age_s: f64,
    /// Battery charge, percent; null: not reported.
    pub battery: Option<u8>,
    /// Time until the battery is empty at the measured slope, seconds; null: no slope is known yet.
    pub battery_left_s: Option<f64>,
    /// Id of the pixel that the robot shows or drives to, or showed at the end of its last run; null: none.
    pub pixel: Option<u32>,
    /// Name and version of the firmware; null: not reported. Original robots report none.
    pub firmware: Option<String>,
    /// Abilities beyond the original protocol.
    pub abilities: Abilities,
    /// Error of the robot's show clock, 2 sigma, microseconds; null: not synchronised.
    pub clock_us: Option<u32>,
    /// Name that people gave the robot; null: none.
    pub called: Option<String>,
    /// Whether the robot may take part in runs.
    pub admitted: bool,
    /// Whether the robot reports that it is simulated. Without such a report, the robot counts as real.
    pub simulated: bool,
    /// Result of the last preflight for the robot; null: the robot was not tested, or a preflight is under way.
    pub preflight: Option<PreflightResult>,
}

/// The result of a preflight for one robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct PreflightResult {
    /// What is wrong with the robot; empty: the robot passed.
    pub faults: Vec<PreflightFault>,
    /// Largest distance between the robot and the planned end of a drive, measured after each drive of the preflight,
    /// millimetres; null: not measured.
    pub off_mm: Option<f64>,
    /// Largest measured error of the robot's heading after a drive of the preflight, degrees; null: not measured.
    pub off_deg: Option<f64>,
    /// Whether Stop, heading and blinking were not tested, because the robot understands only the commands TARGET and
    /// COLOR.
    pub limited: bool,
}

/// Something wrong with a robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct PreflightFault {
    /// The fault, for people: a sentence whose subject is the robot, without a full stop.
    pub cause: String,
    /// What to do about it: a sentence.
    pub remedy: String,
}

/// What a robot does. A number in `Robots.status` is an index into these values, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum RobotStatus {
    /// The robot stands and has no route, or is an original robot, which reports no status.
    Idle,
    /// The robot has a route that has not begun.
    Ready,
    /// The robot drives.
    Driving,
    /// The robot slows down or stands on a route that is held.
    Held,
    /// The robot does not know its place well enough to drive.
    Lost,
    /// The robot stands because its link was lost during a drive, or was silent for too long on a route.
    Cut,
    /// The robot stands, because its sensors give impossible values, a wheel is stuck, or it is too far from its route.
    Faulty,
}

/// How recent the last report of a robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Presence {
    /// The robot reports in time.
    Active,
    /// A report is overdue. The screen draws the robot faded.
    Stale,
    /// The last report is older than the controller allows. Other robots no longer drive around the robot.
    Gone,
}

/// Abilities of a robot beyond TARGET, COLOR and UUID.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Abilities {
    /// The robot follows timed paths.
    pub route: bool,
    /// The robot fades its light.
    pub fade: bool,
    /// The robot blinks on request, so that people find it.
    pub blink: bool,
}

impl RobotStatus {
    /// Every status, in the order of `Robots.status`.
    pub const ALL: [Self; 7] =
        [Self::Idle, Self::Ready, Self::Driving, Self::Held, Self::Lost, Self::Cut, Self::Faulty];
}
