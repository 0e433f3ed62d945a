//! The prescribed way of one robot: its whole path in a prescribed drive.

use lightbots_base::Vec2;

use super::shape::Shape;
use crate::Path;

/// The way of one robot: its whole path in a prescribed drive.
#[derive(Clone, Debug)]
pub(crate) enum PrescribedWay {
    /// Parts in order, which the planner times within one drive.
    Parts(Vec<WayPart>),
    /// A timed path that the show contains.
    Timed(Path),
}

/// A part of a way. The robot is at rest at the beginning and at the end of the part.
#[derive(Clone, Debug)]
pub(crate) struct WayPart {
    /// Begin and end of the part, as shares of the duration of the whole drive.
    pub during: (f64, f64),
    /// The curve of the part.
    pub shape: Shape,
}

impl PrescribedWay {
    /// Returns the place where the way begins; `None` if it has no parts.
    pub(crate) fn start(&self) -> Option<Vec2> {
        match self {
            Self::Parts(parts) => parts.first().map(|part| part.shape.at(0.0)),
            Self::Timed(path) => Some(path.start),
        }
    }

    /// Returns the place where the way ends; `None` if it has no parts.
    pub(crate) fn end(&self) -> Option<Vec2> {
        match self {
            Self::Parts(parts) => parts.last().map(|part| part.shape.at(1.0)),
            Self::Timed(path) => Some(path.as_ref().end()),
        }
    }
}
