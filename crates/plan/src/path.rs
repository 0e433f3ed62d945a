//! A timed path: the type in which the planner hands its paths to the proof.

use lightbots_base::{PathRef, Piece, Span, Vec2};

/// A timed path that owns its pieces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// The place where it begins, stage metres.
    pub start: Vec2,
    /// Its pieces in order.
    pub pieces: Vec<Piece>,
}

impl Path {
    /// Most pieces of a path: a robot cannot store more.
    pub(crate) const MOST_PIECES: usize = 128;

    /// The greatest duration of these paths; 0 if there are none.
    pub(crate) fn longest(paths: &[Self]) -> Span {
        paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO)
    }

    /// The path as a borrowed value.
    pub fn as_ref(&self) -> PathRef<'_> {
        PathRef::new(self.start, &self.pieces)
    }
}
