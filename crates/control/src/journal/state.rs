//! The state of a run in a journal, and the changes of that state.

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
    /// When the last of the changes was made, show clock.
    pub at: Instant,
    /// Time of day when the entry was written, microseconds since 1970. It shows how long the controller was away.
    pub wall_us: u64,
    /// Changes in the order in which they were made.
    pub changes: Vec<Change>,
}

/// A change of the [`JournalState`]; most changes hold the new value of a part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Change {
    /// The whole state.
    State(Box<JournalState>),
    /// A participant joined, dropped out or came back.
    Participant { number: u32, entry: ParticipantEntry },
    /// The leg that robots are about to drive.
    Leg(LegEntry),
    /// All pixels that the operator bound, with their robots.
    Pins(Vec<(u32, RobotId)>),
    /// All pixels that robots showed in frames with fixed identity, with these robots.
    Owners(Vec<(u32, RobotId)>),
    /// Places where something was found on the floor, stage metres, and whether strangers are ignored.
    Obstacles { found: Vec<Vec2>, ignores_strangers: bool },
    /// How far the run is.
    Progress(RunProgress),
    /// The operator requested an operation; its short name.
    Operated(String),
    /// The run is over; the text says how it ended, for people.
    Ended(String),
}

/// How a run began.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunBegun {
    /// When the run began, show clock; this also identifies the run.
    pub at: Instant,
    /// The show that is played.
    #[serde(with = "crate::shared_show")]
    pub show: Arc<Show>,
    /// What the run is for: a show, one frame, the drive home, or a preflight.
    pub purpose: RunPurpose,
    /// What happens to pixels without a robot.
    pub missing: MissingPolicy,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunProgress {
    /// The frame that is reached next.
    pub next: FrameCursor,
    /// Last frame of a loop that the show leaves, because GO was given; `None` if there is none.
    pub leaves_loop: Option<FrameCursor>,
    /// Whether the show starts again after its last frame.
    pub looping: bool,
    /// Whether the operator paused the run.
    pub paused: bool,
    /// Whether the run pauses again at the next frame.
    pub stepping: bool,
    /// Whether the frame that was reached last waits for GO.
    pub waits_for_go: bool,
    /// Number of frames reached.
    pub frames_played: u32,
    /// Number of dropouts; a robot that dropped out twice counts twice.
    pub dropouts: u32,
    /// How often the run was taken up by another controller.
    pub taken_up: u32,
    /// What robots do, or did when they were stopped.
    pub position: Position,
}

/// What robots do, or did when they were stopped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Position {
    /// Path clock of the drive, if robots drive the leg or are about to. A silent robot may then stand anywhere along
    /// its path.
    pub drive: Option<PathClock>,
    /// When robots on the drive stopped, if the drive was broken off. Kept until they drive again, through any number
    /// of outages.
    pub stops: Option<StopTimes>,
    /// Air time, if robots stand in a frame or where a drive was broken off.
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
    /// Name of the robot.
    pub id: RobotId,
    pub abilities: Abilities,
    /// Where the robot reported to be when this was written, stage metres.
    pub at: Option<Vec2>,
    pub membership: Membership,
    pub probation: Probation,
    /// Where the robot may stand, if it fell silent.
    pub last_seen: Whereabouts,
}

/// The state of a run in a journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JournalState {
    pub begun: RunBegun,
    /// Participants by number.
    pub participants: Vec<ParticipantEntry>,
    /// The leg that is driven, was driven last, or is about to be.
    pub leg: Option<LegEntry>,
    /// Pixels that the operator bound, with their robots, sorted by pixel.
    pub pins: Vec<(u32, RobotId)>,
    /// Pixels that robots showed in frames with fixed identity, with these robots; the oldest first.
    pub owners: Vec<(u32, RobotId)>,
    /// Places where robots met something that is no known robot, stage metres.
    pub found: Vec<Vec2>,
    /// Whether robots that came during the run are ignored, and not driven around.
    pub ignores_strangers: bool,
    pub progress: RunProgress,
    /// How the run ended; `None`: it has not.
    pub ended: Option<String>,
}

impl JournalState {
    /// Applies a change; `None` if it does not fit this state.
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
