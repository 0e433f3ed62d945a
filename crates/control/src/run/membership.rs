//! Whether a robot takes part in a run, and what a robot that dropped out has to show before it comes back.

use crate::event::Trouble;
use lightbots_base::Instant;
use serde::{Deserialize, Serialize};

/// A robot with more `Membership::dropouts` than this does not come back in the run, because each dropout costs a new
/// plan.
const DROPOUTS_MAX: u8 = 3;

/// Whether a robot that dropped out has to show that it drives, and the state of that test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Probation {
    /// The robot needs no test, or has passed it.
    None,
    /// The robot has yet to be tested.
    Due,
    /// The robot was told to turn. Holds its heading at that time in radians, that time, and how often it was told.
    Turning { from: f64, since: Instant, tries: u8 },
    /// The robot did not turn in any try.
    Failed,
}

/// Whether a robot takes part, and whether it may come back after a dropout.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Membership {
    /// Whether the robot dropped out, and takes no part until it comes back.
    pub excluded: bool,
    /// How often the robot dropped out. A dropout because the robot did not drive as told counts twice.
    pub dropouts: u8,
    /// The robot may come back once the run has played this many frames; 0: at once.
    pub eligible_from_frame: usize,
}

impl Membership {
    /// Excludes the robot after `frames_played` frames. If it did not drive as told, this counts as two dropouts, and
    /// it may come back only after the next frame.
    pub fn exclude(&mut self, why: Trouble, frames_played: usize) {
        let fails = fails_to_drive(why);
        self.excluded = true;
        self.dropouts = self.dropouts.saturating_add(if fails { 2 } else { 1 });
        self.eligible_from_frame = if fails { frames_played + 1 } else { 0 };
    }

    /// Whether the robot may take part again, because `dropouts` is at most `DROPOUTS_MAX`.
    pub fn may_return(&self) -> bool {
        self.dropouts <= DROPOUTS_MAX
    }
}

impl Probation {
    /// The test that a robot needs after it dropped out for this reason.
    pub fn after(why: Trouble) -> Self {
        if fails_to_drive(why) || why == Trouble::Faulty { Self::Due } else { Self::None }
    }
}

/// Whether the reason of a dropout is that the robot did not drive as told, although it could be reached.
fn fails_to_drive(why: Trouble) -> bool {
    matches!(why, Trouble::Late | Trouble::Missed | Trouble::Blocked)
}
