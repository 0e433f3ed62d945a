//! Reports and time questions from robots. `R10` and the like are rules of docs/protocol.md.

use lightbots_base::{Instant, RobotId, Vec2};

/// A robot's report on `T/LightBot/UUID`, `Arrival` or `Status`: `<uuid> <x> <y>`, then the fields of [`Details`].
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Name of the robot.
    pub id: RobotId,
    /// Position, stage metres; `None`: not known (NaN on the wire, or a coordinate beyond ±10⁶ m).
    pub at: Option<Vec2>,
    /// Fields after the position; `None` if there is no known field, as from an original robot.
    pub details: Option<Details>,
}

/// The fields `key=value` after the position, in any order, all optional on the wire (R10). A field that is missing or
/// invalid has its default value: `None`, 0, `false`, empty or [`RobotState::Idle`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Details {
    /// Heading, radians counter-clockwise from the x axis of the stage; `None` if it is not known.
    pub heading: Option<f64>,
    /// Charge of the battery, percent, 0 to 100; `None` if it is not known.
    pub battery: Option<u8>,
    /// What the robot does (R12).
    pub state: RobotState,
    /// Number of the kept route. Without one, that of the route under way, or else of the route finished last; 0 if
    /// there is none.
    pub route: u32,
    /// When the kept route begins, or else when the route under way began, show clock. `None` if there is neither, or
    /// its moment is not known.
    pub starts: Option<Instant>,
    /// Number of the stretch of light that the robot received last; 0 if there is none (R55).
    pub light: u32,
    /// Number by which messages of live light address the robot; `None` if it was given none (R59).
    pub slot: Option<u16>,
    /// Distance between the robot and its planned place at this moment, metres; `None` if no route is under way.
    pub off_m: Option<f64>,
    /// Standard deviation (1 sigma) of each coordinate of the position, metres. While position fixes are missing on a
    /// route, it is the value predicted for half a second later.
    pub err_m: Option<f64>,
    /// Uncertainty (2 sigma) of the robot's show clock, microseconds; `None` if the clock is not synchronised.
    pub clock_us: Option<u32>,
    /// Name and version of its firmware.
    pub firmware: Firmware,
    /// Commands that the robot supports beyond TARGET, COLOR and UUID.
    pub abilities: Abilities,
    /// Number of unknown or invalid commands that the robot has ignored since power-on (R7).
    pub unknown: u32,
    /// Obstacle for which the robot stands, or for which it brakes hard although the obstacle is not in its plan (R49).
    /// `None` if there is none.
    pub blocked: Option<Blocked>,
    /// Whether it reports itself as simulated (R52).
    pub simulated: bool,
    /// Number of times since power-on that the robot's safety layer began to slow it (R53).
    pub brakes: u32,
    /// Least gap to the rim of another robot that the robot estimated from its sensors since its latest route began,
    /// metres (R53). `None` if the sensors saw no robot since.
    pub near_m: Option<f64>,
}

/// An obstacle that blocks a robot, or an unplanned one for which a robot brakes hard (R49).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Blocked {
    /// Distance from the robot's rim to the obstacle, metres.
    pub gap_m: f64,
    /// Direction in which the obstacle is seen, radians counter-clockwise from the x axis of the stage, accurate to
    /// about 15°.
    pub towards: f64,
}

/// Name and version of a firmware, at most 24 bytes of printable ASCII without space.
pub type Firmware = heapless::String<24>;

/// State of a robot (R12).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum RobotState {
    /// Stands, with nothing to drive.
    #[default]
    Idle,
    /// Keeps a route that has not begun.
    Ready,
    /// Drives to a target or along a route, or rolls to rest.
    Driving,
    /// Has a route under way that is held: it slows down or stands until RESUME.
    Held,
    /// Does not drive, or stops, because its position is not known well enough.
    Lost,
    /// Stands because its link was lost during a drive, or was silent for too long on a route.
    Cut,
    /// Stands because its sensors give impossible values, a wheel is stuck, or it is too far from its route.
    Faulty,
}

/// Commands that a robot supports beyond TARGET, COLOR and UUID.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Abilities {
    /// Routes: PATH, START, HOLD, RESUME, STOP, STATUS and TIME.
    pub route: bool,
    /// FADE.
    pub fade: bool,
    /// BLINK.
    pub blink: bool,
    /// `G` in PATH: the planned clearance.
    pub room: bool,
    /// `N` in PATH: the planned neighbours in sight.
    pub neighbours: bool,
    /// LIGHT.
    pub light: bool,
    /// SLOT, LIVE and RELEASE.
    pub live: bool,
}

/// `<uuid> <now>` on `T/LightBot/Time`: a question for the show clock (R25).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeQuestion {
    /// Name of the robot.
    pub id: RobotId,
    /// Moment of the question, robot's own clock.
    pub asked: Instant,
}
