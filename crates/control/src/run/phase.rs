//! The phases of a run: what its robots do.
//!
//! A leg is the drive of all robots between two moments at which all stand. START is the message that names the moment
//! at which all robots begin their routes.

use crate::event::RunOutcome;
use crate::journal::Position;
use crate::leg::Leg;
use crate::run::driving::Driving;
use crate::run::gathering::Gathering;
use crate::run::interrupted::Interrupted;
use crate::run::path_clock::PathClock;
use crate::run::pipeline::Pipeline;
use crate::run::roster::Whereabouts;
use crate::run::run_context::RunContext;
use crate::run::standing::Standing;
use crate::run::starting::Starting;

/// The phase of a run.
#[derive(Clone, Debug)]
pub(crate) enum RunPhase {
    /// Robots stop and are asked where they stand.
    Gathering(Gathering),
    /// All robots stand: in a frame, before the first one, or where a drive was broken off. The next leg is planned and
    /// sent to robots meanwhile.
    Standing(Standing),
    /// The START of the next leg was sent, and its moment is still to come.
    Starting(Starting),
    /// Robots drive.
    Driving(Driving),
    /// Robots are out of reach.
    Interrupted(Interrupted),
    /// The run is over, and no other phase follows. Holds how the run ended, and the index of the frame at which it
    /// ended.
    Over(RunOutcome, usize),
}

impl RunPhase {
    /// The drive, or the stay in a frame, that would be interrupted if all robots stopped now. In phases Gathering and
    /// Interrupted: what was interrupted before. In phase Starting: the drive of the first leg in the queue, because
    /// robots may have begun that leg.
    pub fn left(&self, pipeline: &Pipeline) -> Position {
        match self {
            Self::Gathering(gathering) => gathering.left,
            Self::Interrupted(interrupted) => interrupted.left,
            Self::Standing(standing) => Position { stood: Some(standing.air), ..Position::default() },
            Self::Driving(drive) => Position { drive: Some(drive.clock), ..Position::default() },
            Self::Starting(starting) => {
                let leg = pipeline.queue.front();
                let drive = leg.map(|leg| PathClock::new(starting.at, leg.duration));
                Position { drive, ..Position::default() }
            }
            Self::Over(..) => Position::default(),
        }
    }

    /// The leg of the interrupted drive or stay that [`left`](Self::left) describes.
    pub fn left_leg<'a>(&self, pipeline: &'a Pipeline) -> Option<&'a Leg> {
        match self {
            Self::Starting(_) => pipeline.queue.front(),
            _ => pipeline.leg(),
        }
    }

    /// All places where a participant that fell silent may stand. Empty if it stands at the place that it reported
    /// last.
    pub fn whereabouts(&self, cx: &RunContext, participant: usize) -> Whereabouts {
        match self {
            Self::Driving(drive) => drive.whereabouts(cx, participant),
            Self::Gathering(gathering) => gathering.whereabouts(cx, participant),
            Self::Interrupted(interrupted) => interrupted.whereabouts(cx, participant),
            Self::Starting(starting) => starting.whereabouts(cx, participant),
            Self::Standing(_) | Self::Over(..) => Whereabouts::default(),
        }
    }
}
