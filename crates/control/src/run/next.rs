//! What a phase wants to come next. A phase never changes the phase of its run: it returns one of these.

use crate::event::{RunOutcome, Trouble};
use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};

/// When the frame that stands may be left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct AirTime {
    /// Since when robots stand.
    pub since: Instant,
    /// The frame stands at least until then.
    pub until: Instant,
    /// Air time that is left while the run is paused.
    pub left: Option<Span>,
    /// Robots stand at the goals of the last drive, and not where it was broken off.
    pub is_at_goals: bool,
}

/// A participant that can go on no longer, and why.
pub(crate) type Dropout = (usize, Trouble);

/// What comes next, in the eyes of a phase.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Next {
    /// The phase goes on.
    Stay,
    /// All robots stand, or their places are known.
    Stand(AirTime),
    /// START is stated for the first leg of the queue, for this moment at the earliest.
    Start(Instant),
    /// The first leg of the queue is under way since this moment.
    Drive(Instant),
    /// Robots stop, say where they are, and all is planned again from there.
    Regather,
    /// The link to robots is lost: the run stands still until they report again. Number of robots that are silent;
    /// `None`: the broker is lost.
    Interrupt(Option<usize>),
    /// Robots report again: all say where they stand, and all is planned again from there.
    GoOn,
    /// These participants drop out; the others are planned again without them. Never empty.
    Drop(Vec<Dropout>),
    /// The run is over.
    Over(RunOutcome),
}

impl Next {
    /// The run cannot go on; `why` is for people, without a full stop.
    pub fn failed(why: impl Into<String>) -> Self {
        Self::Over(RunOutcome::Failed(why.into()))
    }

    /// One participant drops out.
    pub fn drop(participant: usize, why: Trouble) -> Self {
        Self::Drop(vec![(participant, why)])
    }

    /// Whether the phase goes on.
    pub fn stays(&self) -> bool {
        *self == Self::Stay
    }

    /// This, or what `then` says where the phase goes on.
    pub fn or_else(self, then: impl FnOnce() -> Self) -> Self {
        if self.stays() { then() } else { self }
    }
}
