//! The prescribed way of one robot.

use lightbots_base::Vec2;

use super::shape::Shape;
use crate::Path;

/// The way of one robot.
#[derive(Clone, Debug)]
pub(crate) enum PrescribedWay {
    /// Parts in order, timed by the planner. They share one drive.
    Parts(Vec<WayPart>),
    /// A timed path of the show.
    Timed(Path),
}

/// A part of a way with a rest at both ends.
#[derive(Clone, Debug)]
pub(crate) struct WayPart {
    /// Begin and end, shares of the duration of the whole drive.
    pub during: (f64, f64),
    /// Its places.
    pub shape: Shape,
}

impl PrescribedWay {
    /// Where the way begins.
    pub(crate) fn start(&self) -> Option<Vec2> {
        match self {
            Self::Parts(parts) => parts.first().map(|part| part.shape.at(0.0)),
            Self::Timed(path) => Some(path.start),
        }
    }

    /// Where the way ends.
    pub(crate) fn end(&self) -> Option<Vec2> {
        match self {
            Self::Parts(parts) => parts.last().map(|part| part.shape.at(1.0)),
            Self::Timed(path) => Some(path.as_ref().end()),
        }
    }
}
