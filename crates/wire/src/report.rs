//! What a robot says: reports and questions.

use lightbots_base::{Instant, RobotId, Vec2};

/// A robot's report, on `T/LightBot/UUID`, `Arrival` and `Status`: `<uuid> <x> <y>`, then our fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Who says it.
    pub id: RobotId,
    /// Where it is, stage metres; `None` where it does not know (NaN on the wire).
    pub at: Option<Vec2>,
    /// What an original robot does not say.
    pub details: Option<Details>,
}

/// The fields after the place, `key=value` each, in any order, all optional on the wire.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Details {
    /// Heading, radians in the stage.
    pub heading: Option<f64>,
    /// Charge of the battery, percent.
    pub battery: Option<u8>,
    /// What it is doing.
    pub state: RobotState,
    /// Number of the route it keeps or drives; 0: none.
    pub route: u32,
    /// When that route starts, show clock, once it knows.
    pub starts: Option<Instant>,
    /// How far it is from where its route says, metres.
    pub off_m: Option<f64>,
    /// How far off its place may be (1 sigma), metres; where fixes stay away, half a second of its route from now.
    pub err_m: Option<f64>,
    /// How far it believes its clock may be off, microseconds; `None`: not synchronised.
    pub clock_us: Option<u32>,
    /// Name and version of its firmware.
    pub firmware: Firmware,
    /// What it can do.
    pub abilities: Abilities,
    /// Commands it did not know, since power-on.
    pub unknown: u32,
    /// What stands in its way; it stands because of that.
    pub blocked: Option<Blocked>,
    /// Whether it says that it is simulated, so that nothing real moves.
    pub simulated: bool,
}

/// Something in a robot's way that should not be there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocked {
    /// From its rim to that, metres.
    pub gap_m: f64,
    /// In which direction it is, radians in the stage, to about 15°.
    pub towards: f64,
}

/// Name and version of a firmware, at most 24 bytes of printable ASCII without space.
pub type Firmware = heapless::String<24>;

/// What a robot is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum RobotState {
    /// It stands and waits.
    #[default]
    Idle,
    /// It keeps a route that has not begun.
    Ready,
    /// It drives, to a target or along a route.
    Driving,
    /// Its route is held.
    Held,
    /// It does not know where it is and stands.
    Lost,
    /// It lost the link during a run and stands.
    Cut,
    /// Its sensors or motors make no sense and it stands.
    Faulty,
}

/// What a robot can do beyond TARGET, COLOR and UUID.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    /// Timed paths: PATH, START, HOLD, RESUME, STOP and the clock.
    pub route: bool,
    /// FADE.
    pub fade: bool,
    /// BLINK.
    pub blink: bool,
    /// Knows how much room a PATH leaves it.
    pub room: bool,
    /// Knows which neighbours come into sight on a PATH.
    pub neighbours: bool,
}

/// `<uuid> <now>` on `T/LightBot/Time`: what is the show clock?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeQuestion {
    /// Who asks.
    pub id: RobotId,
    /// The robot's own clock when it asks.
    pub asked: Instant,
}
