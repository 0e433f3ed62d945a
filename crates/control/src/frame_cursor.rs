//! A frame in a run whose frames may be played more than once.

use serde::{Deserialize, Serialize};

/// A frame in a run of a show that may begin again, or repeat some of its frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FrameCursor {
    /// Index of the frame, counted from 0; `usize::MAX` after the last one.
    pub frame: usize,
    /// How many times the show started again before.
    pub round: u32,
    /// How many times the frames of the loop that the frame is in were played before; 0 outside of loops.
    pub pass: u32,
}

impl FrameCursor {
    /// Whether this frame is played before the show or a loop goes back to what was played.
    pub fn is_in_pass_of(&self, other: FrameCursor) -> bool {
        (self.round, self.pass) == (other.round, other.pass)
    }
}
