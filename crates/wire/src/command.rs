//! Commands from the controller; a payload holds one or several. `R31` and the like are rules of docs/protocol.md.

use lightbots_base::{Instant, Piece, Rgb, Span, Vec2};

use crate::{LightStretch, LiveColours, LiveRelease, Neighbours};

/// Largest number of pieces of a route (R31). A `PATH` with more pieces is invalid. With a larger value, each robot
/// needs more memory.
pub const MAX_PIECES: usize = 128;

/// The pieces of a route.
pub type Pieces = heapless::Vec<Piece, MAX_PIECES>;

/// One command of a payload. `Target`, `Color` and `Uuid` come from the original protocol, the others are additions.
// The large variant is decoded into place and moved once into the robot: boxing it would allocate.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// `TARGET x y`: drive to this place at once, stage metres. Routes are deleted.
    Target(Vec2),
    /// `COLOR n`: show this colour at once. It ends fades and stretches of light.
    Color(Rgb),
    /// `UUID`: report on the topic `UUID` at once.
    Uuid,
    /// `PATH …`: keep this route until a `START` names its number. The route replaces another one that is kept and has
    /// not begun.
    Route(Route),
    /// `START seq at`: the kept route `seq` begins at this moment of the show clock.
    Start {
        /// Number of the route.
        seq: u32,
        /// Moment on the show clock.
        at: Instant,
    },
    /// `HOLD at`: from this moment of the show clock on, the rate of progress along the route falls to zero within
    /// [`Route::EASE`]. All robots slow down in the same way.
    Hold {
        /// Moment on the show clock.
        at: Instant,
    },
    /// `RESUME at`: from this moment of the show clock on, progress along the route returns to its full rate within
    /// [`Route::EASE`].
    Resume {
        /// Moment on the show clock.
        at: Instant,
    },
    /// `STOP`: wheels stop at once. Target, routes, stretches of light, and fades that have not begun are deleted.
    Stop,
    /// `STOP at`: from this moment of the show clock on slow down as by `HOLD at`, and once at rest stop as by `STOP`.
    StopFrom {
        /// Moment on the show clock.
        at: Instant,
    },
    /// `TIME asked received sent`: the answer to a [`crate::TimeQuestion`].
    Time(TimeAnswer),
    /// `FADE n at over`: from a moment of the show clock on, the light changes evenly to this colour.
    Fade(Fade),
    /// `BLINK over`: the light flashes white for this time, so that people find the robot.
    Blink(Blink),
    /// `LIGHT …`: a stretch of the robot's light, sent ahead of time.
    Light(LightStretch),
    /// `SLOT k`: the robot gets this number, by which `LIVE` and `RELEASE` address it (R59).
    Slot(u16),
    /// `LIVE n first colours`: colours from a lighting desk or another program, for many robots.
    Live(LiveColours),
    /// `RELEASE n first count`: robots show their own light again.
    Release(LiveRelease),
    /// `STATUS`: report on the topic `Status` at once.
    Status,
}

/// A timed path that a robot keeps until its START.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Number chosen by the controller, never 0; a robot repeats it in its reports.
    pub seq: u32,
    /// Place where the route starts, stage metres.
    pub start: Vec2,
    /// Pieces of the route in order.
    pub pieces: Pieces,
    /// Least planned clearance (distance from rim to rim) to other robots, whole millimetres; `None` if it is not sent.
    pub room_mm: Option<u16>,
    /// Other robots that come into sight of this robot's sensors by plan, with their planned places and times. They are
    /// only sent if `room_mm` is `Some`.
    pub neighbours: Neighbours,
}

impl Route {
    /// Time in which a HOLD brings progress along routes to rest, and in which a RESUME brings it back to the full
    /// rate. The rate changes linearly (R38).
    pub const EASE: Span = Span::from_millis(300);
}

/// The controller's answer in two-way time transfer (R26).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeAnswer {
    /// Moment of the question, robot's own clock.
    pub asked: Instant,
    /// Arrival of the question, show clock.
    pub received: Instant,
    /// Departure of the answer, show clock.
    pub sent: Instant,
}

/// A change of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fade {
    /// Final colour.
    pub to: Rgb,
    /// Beginning, show clock.
    pub at: Instant,
    /// Duration; zero switches the colour at the beginning.
    pub over: Span,
}

/// Flashes that let people find a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blink {
    /// Duration. A decoder shortens it to at most a minute (R24).
    pub over: Span,
}
