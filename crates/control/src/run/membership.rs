//! Whether a robot takes part in a run, and what a robot that dropped out has to show before it comes back.

use crate::event::Trouble;
use lightbots_base::Instant;
use serde::{Deserialize, Serialize};

/// A robot that dropped out more often than this in a run stays excluded: each dropout costs a new plan.
const DROPOUTS_MAX: u8 = 3;

/// Whether a robot that dropped out drives again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Probation {
    /// Nothing speaks against it.
    None,
    /// The robot has to show that.
    Due,
    /// The robot was told to turn when it had this heading, radians; and how often it was told.
    Turning { from: f64, since: Instant, tries: u8 },
    /// The robot did not turn.
    Failed,
}

/// Whether a robot takes part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Membership {
    /// The robot dropped out and stands somewhere.
    pub excluded: bool,
    /// How often the robot dropped out; a robot that did not drive as told counts twice.
    pub dropouts: u8,
    /// The robot may come back once this many frames were played.
    pub eligible_from_frame: usize,
}

impl Membership {
    /// The robot drops out after `frames_played` frames. A robot that does not drive as told may come back once, after
    /// the next frame, to see if it does then.
    pub fn exclude(&mut self, why: Trouble, frames_played: usize) {
        let fails = fails_to_drive(why);
        self.excluded = true;
        self.dropouts = self.dropouts.saturating_add(if fails { 2 } else { 1 });
        self.eligible_from_frame = if fails { frames_played + 1 } else { 0 };
    }

    /// Whether the robot may take part again, as far as its dropouts are concerned.
    pub fn may_return(&self) -> bool {
        self.dropouts <= DROPOUTS_MAX
    }
}

impl Probation {
    /// What a robot has to show that dropped out.
    pub fn after(why: Trouble) -> Self {
        if fails_to_drive(why) || why == Trouble::Faulty { Self::Due } else { Self::None }
    }
}

/// Whether the robot did not drive as told, though it could be reached.
fn fails_to_drive(why: Trouble) -> bool {
    matches!(why, Trouble::Late | Trouble::Missed | Trouble::Blocked)
}
