//! One leg of a run: everybody's errand between two moments at which all stand.

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::Path;
use lightbots_plan::unsynchronised::StraightDrive;
use lightbots_wire::Neighbours;
use std::sync::Arc;

/// What everybody does between two moments at which all stand. A frame takes one leg, or several where original
/// robots and others have to go one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Leg {
    /// The frame it leads to, counted from 0.
    pub frame: usize,
    /// Which time round, where the show loops.
    pub round: u32,
    /// Number of its routes; 0 until it is queued.
    pub seq: u32,
    pub kind: Kind,
    /// `[seat]`; seats taken later have none.
    pub moves: Vec<Move>,
    /// The straight drives of original robots, by seat; see [`StraightDrive`].
    pub hops: Vec<StraightDrive>,
    /// How many moves are no rests.
    pub movers: usize,
    pub duration: Span,
    /// The frame stands at its end.
    pub airs: bool,
    /// How far the closest two rims stay apart by plan, metres.
    pub room_m: f64,
}

/// How robots are told to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Timed paths and a common START.
    Routes,
    /// TARGETs, said by and by so that nobody is in anybody's way at any speed.
    Targets,
}

/// One robot's part in a leg.
#[derive(Clone, Debug)]
pub(crate) struct Move {
    pub errand: Errand,
    /// How far others stay from its rim by plan, metres; infinite where that is far.
    pub room_m: f64,
    /// Which neighbours come into sight on its path.
    pub neighbours: Option<Arc<Neighbours>>,
    /// Where it stands afterwards, stage metres.
    pub goal: Vec2,
    /// It stands there in the frame too.
    pub settles: bool,
    /// The pixel it shows in the leg's frame.
    pub pixel: Option<u32>,
    /// The light of that pixel; black for spares.
    pub color: Rgb,
}

/// What a robot is told.
#[derive(Clone, Debug)]
pub(crate) enum Errand {
    /// Nothing: it stands.
    Stay,
    /// A timed path.
    Path(Path),
    /// Hops of its leg.
    Hops,
}

impl Move {
    /// Standing at a place, dark.
    pub fn stay(at: Vec2) -> Self {
        Self {
            errand: Errand::Stay,
            room_m: f64::INFINITY,
            neighbours: None,
            goal: at,
            settles: true,
            pixel: None,
            color: Rgb::BLACK,
        }
    }
}

impl Leg {
    /// The path of a seat, if it drives one.
    pub fn path(&self, seat: usize) -> Option<&Path> {
        match self.moves.get(seat).map(|m| &m.errand) {
            Some(Errand::Path(path)) => Some(path),
            _ => None,
        }
    }

    /// Whether a seat has to arrive.
    pub fn moves(&self, seat: usize) -> bool {
        self.moves.get(seat).is_some_and(|m| !matches!(m.errand, Errand::Stay))
    }
}
