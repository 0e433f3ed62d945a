//! What a journal says of a run, and what changes it.

use super::LegEntry;
use crate::frame_cursor::FrameCursor;
use crate::operation::MissingPolicy;
use crate::run::{AirTime, Membership, PathClock, Probation, RunPurpose, StopTimes, Whereabouts};
use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_show::Show;
use lightbots_wire::Abilities;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What one step of the controller changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// When, show clock.
    pub at: Instant,
    /// The shell's clock then, microseconds since 1970: how long the controller was away is measured by it.
    pub wall_us: u64,
    /// In order; empty: the controller is alive.
    pub changes: Vec<Change>,
}

/// A part of the state that is new.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Change {
    /// Everything.
    State(Box<JournalState>),
    /// A participant joined, dropped out or came back.
    Participant { number: u32, entry: ParticipantEntry },
    /// Robots are about to drive this.
    Leg(LegEntry),
    /// What the operator bound.
    Pins(Vec<(u32, RobotId)>),
    /// Which robot showed a pixel in frames with fixed identity.
    Owners(Vec<(u32, RobotId)>),
    /// What was found on the floor, and what is ignored there.
    Obstacles { found: Vec<Vec2>, ignores_strangers: bool },
    /// How far the run is.
    Progress(RunProgress),
    /// The operator asked for something; a word for it.
    Operated(String),
    /// The run is over: how it ended, for people.
    Ended(String),
}

/// How a run began.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunBegun {
    /// When; this also names the run.
    pub at: Instant,
    /// The show that is played.
    #[serde(with = "crate::shared_show")]
    pub show: Arc<Show>,
    /// Whether all frames are played.
    pub purpose: RunPurpose,
    /// What happens to pixels without a robot.
    pub missing: MissingPolicy,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunProgress {
    /// The frame that is reached next.
    pub next: FrameCursor,
    /// The last frame of a loop that GO was given for.
    pub leaves_loop: Option<FrameCursor>,
    /// The show starts again after its last frame.
    pub looping: bool,
    /// The operator paused.
    pub paused: bool,
    /// The run pauses again at the next frame.
    pub stepping: bool,
    /// The frame that was reached last waits for GO.
    pub waits_for_go: bool,
    /// Frames reached.
    pub frames_played: u32,
    /// Robots that dropped out; a robot that dropped out twice counts twice.
    pub dropouts: u32,
    /// How often the run was taken up by another controller.
    pub taken_up: u32,
    /// What robots do.
    pub position: Position,
}

/// What robots do, or did when they were stopped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Position {
    /// They drive the leg, or are about to: a silent robot may stand anywhere along it.
    pub drive: Option<PathClock>,
    /// When those on the drive stopped, once it is broken off. It holds until they drive again, through any number of
    /// outages.
    pub stops: Option<StopTimes>,
    /// They stand, in a frame or where a drive was broken off.
    pub stood: Option<AirTime>,
}

impl Position {
    /// Whether robots stand at the goals of the leg.
    pub fn is_at_goals(&self) -> bool {
        self.stood.is_some_and(|air| air.is_at_goals)
    }

    /// Whether the leg says where robots are: on their way, or at its goals.
    pub fn is_in_leg(&self) -> bool {
        self.drive.is_some() || self.is_at_goals()
    }
}

/// A participant of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ParticipantEntry {
    /// The robot.
    pub id: RobotId,
    pub abilities: Abilities,
    /// Where the robot reported to be when this was written, stage metres.
    pub at: Option<Vec2>,
    pub membership: Membership,
    pub probation: Probation,
    /// Where the robot may stand, if it fell silent.
    pub last_seen: Whereabouts,
}

/// Everything that a journal says of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JournalState {
    pub begun: RunBegun,
    /// `[participant]`.
    pub participants: Vec<ParticipantEntry>,
    /// The leg that is driven, was driven last, or is about to be.
    pub leg: Option<LegEntry>,
    /// By pixel.
    pub pins: Vec<(u32, RobotId)>,
    /// The oldest first.
    pub owners: Vec<(u32, RobotId)>,
    /// Where robots met something that no robot explains; stage metres.
    pub found: Vec<Vec2>,
    /// Robots that came during the run are not driven around.
    pub ignores_strangers: bool,
    pub progress: RunProgress,
    /// How the run ended; `None`: it has not.
    pub ended: Option<String>,
}

impl JournalState {
    /// Takes over a change. `None`: it does not fit this state.
    pub fn apply(&mut self, change: Change) -> Option<()> {
        match change {
            Change::State(state) => *self = *state,
            Change::Participant { number, entry } => {
                let number = number as usize;
                if number == self.participants.len() {
                    self.participants.push(entry);
                } else {
                    *self.participants.get_mut(number)? = entry;
                }
            }
            Change::Leg(leg) => self.leg = Some(leg),
            Change::Pins(pins) => self.pins = pins,
            Change::Owners(owners) => self.owners = owners,
            Change::Obstacles { found, ignores_strangers } => {
                (self.found, self.ignores_strangers) = (found, ignores_strangers);
            }
            Change::Progress(progress) => self.progress = progress,
            Change::Operated(_) => {}
            Change::Ended(how) => self.ended = Some(how),
        }
        Some(())
    }
}
