//! A frame in a run whose frames may be played more than once.

use serde::{Deserialize, Serialize};

/// A frame in a run of a show that may begin again, or repeat some of its frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FrameCursor {
    /// Index of the frame, counted from 0; `usize::MAX` after the last one.
    pub frame: usize,
    /// How many times the show started again before this frame.
    pub round: u32,
    /// How many times the frames of its loop were played before; 0 outside of loops.
    pub pass: u32,
}

impl FrameCursor {
    /// Whether both frames are in the same round of the show and the same pass of a loop.
    pub fn is_in_pass_of(&self, other: FrameCursor) -> bool {
        (self.round, self.pass) == (other.round, other.pass)
    }
}
