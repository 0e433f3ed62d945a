//! A position in a run: a frame, and how many times it was played before.

use serde::{Deserialize, Serialize};

/// A frame in a run, with counts that tell its repetitions apart. A show may begin again, and may repeat the frames of
/// a loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FrameCursor {
    /// Index of the frame, counted from 0; `usize::MAX` after the last frame.
    pub frame: usize,
    /// How many times the whole show started again before this frame.
    pub round: u32,
    /// How many times the show has repeated the loop that contains the frame, since it entered that loop; 0 if no loop
    /// contains the frame. A jump within the loop does not count.
    pub pass: u32,
}

impl FrameCursor {
    /// Whether both cursors have the same round of the show and the same pass of a loop.
    pub fn is_in_pass_of(&self, other: FrameCursor) -> bool {
        (self.round, self.pass) == (other.round, other.pass)
    }
}
