//! What robots of a run do at a moment, as a journal says it.

use crate::journal::Position;
use crate::leg::Leg;
use crate::run::machine::{Run, RunPhase};
use crate::run::path_clock::PathClock;

impl Run {
    /// What robots do. A stated START counts as a drive: robots may have begun it when the journal is read.
    pub fn position(&self) -> Position {
        match &self.phase {
            RunPhase::Starting(starting) => {
                let leg = self.pipeline.queue.front();
                Position { drive: leg.map(|leg| PathClock::new(starting.at, leg.duration)), stood: None }
            }
            _ => self.left(),
        }
    }

    /// The leg that [`position`](Self::position) is about.
    pub fn positioned_leg(&self) -> Option<&Leg> {
        match self.phase {
            RunPhase::Starting(_) => self.pipeline.queue.front(),
            _ => self.pipeline.leg(),
        }
    }
}
