//! The change of phase that a phase requests. A phase never changes the phase of its run: it returns a [`Next`].

use crate::event::{RunOutcome, Trouble};
use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};

/// When robots may leave the frame in which they stand. Air time is how long the show keeps robots in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct AirTime {
    /// When the phase Standing began.
    pub since: Instant,
    /// The earliest moment at which robots leave the frame.
    pub until: Instant,
    /// Air time that remains; `Some` only while the run is paused. When the pause ends, `until` is set from it.
    pub left: Option<Span>,
    /// Whether robots stand at the goals of the last drive. `false`: that drive was interrupted, or robots may have
    /// been moved.
    pub is_at_goals: bool,
}

/// Number of a participant that cannot go on in the run, and why.
pub(crate) type Dropout = (usize, Trouble);

/// The change of phase that a phase requests. A leg is the drive of all robots between two moments at which all stand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Next {
    /// The phase goes on.
    Stay,
    /// Robots stand from now on: all have arrived, or all have stopped and reported their places.
    Stand(AirTime),
    /// START is to be sent for the first leg of the queue. START names the moment at which robots begin. That moment is
    /// not before the one that this variant holds.
    Start(Instant),
    /// Robots drive the first leg of the queue. They began it at this moment.
    Drive(Instant),
    /// Robots stop and report where they are, and all is planned again from there.
    Regather,
    /// The link to robots is lost: the run is interrupted until robots report again. Holds the number of silent robots;
    /// `None` if the connection to the broker is lost.
    Interrupt(Option<usize>),
    /// Robots report again after an interruption. They are gathered, and all is planned again from where they stand.
    GoOn,
    /// These participants drop out; the others are planned again without them. Never empty.
    Drop(Vec<Dropout>),
    /// The run is over.
    Over(RunOutcome),
}

impl Next {
    /// Ends the run as failed. `why` is a text for people, without a full stop.
    pub fn failed(why: impl Into<String>) -> Self {
        Self::Over(RunOutcome::Failed(why.into()))
    }

    /// Drops one participant.
    pub fn drop(participant: usize, why: Trouble) -> Self {
        Self::Drop(vec![(participant, why)])
    }

    /// Whether the phase goes on.
    pub fn stays(&self) -> bool {
        *self == Self::Stay
    }

    /// Returns `self`, or what `then` returns if `self` is [`Next::Stay`].
    pub fn or_else(self, then: impl FnOnce() -> Self) -> Self {
        if self.stays() { then() } else { self }
    }
}
