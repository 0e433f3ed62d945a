//! What the controller says: commands, one or many in a payload.

use lightbots_base::{Instant, Piece, Rgb, Span, Vec2};

use crate::Neighbours;

/// The most pieces a route has. The controller refuses a frame whose plan has a longer path; it never cuts a path.
pub const MAX_PIECES: usize = 128;

/// The pieces of a route.
pub type Pieces = heapless::Vec<Piece, MAX_PIECES>;

/// One command of a payload. `Target`, `Color` and `Uuid` are the original's.
// The large variant is decoded into place and moved once into the robot: boxing it would allocate.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// `TARGET x y`: drive there at once, stage metres.
    Target(Vec2),
    /// `COLOR n`: show this colour at once.
    Color(Rgb),
    /// `UUID`: introduce yourself on `T/LightBot/UUID`.
    Uuid,
    /// `PATH …`: keep this timed path until a `START` names it. Replaces a kept one that was not started.
    Route(Route),
    /// `START seq at`: the kept route `seq` begins at this moment of the show clock.
    Start {
        /// Which route.
        seq: u32,
        /// When, show clock.
        at: Instant,
    },
    /// `HOLD at`: from this moment of the show clock on, progress along the route slows to rest within
    /// [`Route::EASE`], the same for every robot.
    Hold {
        /// When, show clock.
        at: Instant,
    },
    /// `RESUME at`: progress picks up again within [`Route::EASE`].
    Resume {
        /// When, show clock.
        at: Instant,
    },
    /// `STOP`: wheels stop at once; target and route are forgotten.
    Stop,
    /// `TIME asked received sent`: the answer to a [`crate::TimeQuestion`].
    Time(TimeAnswer),
    /// `FADE n at over`: the light changes evenly to this colour.
    Fade(Fade),
    /// `BLINK over`: the light flashes white so that people find the robot.
    Blink(Blink),
    /// `STATUS`: report on `T/LightBot/Status` at once.
    Status,
}

/// A timed path to be kept by a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Its number, chosen by the controller, never 0; a robot names it in its reports.
    pub seq: u32,
    /// Where it starts, stage metres.
    pub start: Vec2,
    /// Its pieces in order.
    pub pieces: Pieces,
    /// How far other rims stay from its own by plan, whole millimetres; `None`: not said.
    pub room_mm: Option<u16>,
    /// Which neighbours come into sight, where and when, by plan.
    pub neighbours: Neighbours,
}

impl Route {
    /// How long a hold takes to bring progress to rest, and a resume to bring it back to full: progress per time
    /// falls and rises linearly.
    pub const EASE: Span = Span::from_millis(300);
}

/// Two-way time transfer: what the controller answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeAnswer {
    /// When the robot asked, by the robot's own clock.
    pub asked: Instant,
    /// When the question came in, by the show clock.
    pub received: Instant,
    /// When this answer left, by the show clock.
    pub sent: Instant,
}

/// A change of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fade {
    /// The colour it ends with.
    pub to: Rgb,
    /// When it begins, show clock.
    pub at: Instant,
    /// How long it takes; zero is a switch.
    pub over: Span,
}

/// Flashing to be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blink {
    /// For how long; at most a minute.
    pub over: Span,
}
