//! The state of a run in a journal, and the changes of that state.

use super::LegEntry;
use crate::computer_time::ComputerTime;
use crate::frame_cursor::FrameCursor;
use crate::operation::MissingPolicy;
use crate::run::{AirTime, Membership, PathClock, Probation, RunPurpose, StopTimes, Whereabouts};
use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_show::Show;
use lightbots_wire::Abilities;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Changes of a run's state that are written together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// When the last of `changes` was made, show clock.
    pub at: Instant,
    /// The computer's clocks when the entry was written. A later controller computes from them for how long there was
    /// no controller.
    pub clocks: ComputerTime,
    /// Changes in the order in which they were made.
    pub changes: Vec<Change>,
}

/// A change of the [`JournalState`]. Most variants hold the new value of a part of the state, which replaces the old
/// value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Change {
    /// The whole state.
    State(Box<JournalState>),
    /// A participant joined, dropped out or came back, or its place is recorded anew.
    Participant { number: u32, entry: ParticipantEntry },
    /// The leg that robots drive or are about to drive.
    Leg(LegEntry),
    /// All pixels that the operator bound, with their robots.
    Pins(Vec<(u32, RobotId)>),
    /// All pixels that robots showed in frames with fixed identity, with their robots.
    Owners(Vec<(u32, RobotId)>),
    /// `found`: places where robots met an unknown obstacle, stage metres. `ignores_strangers`: whether robots that
    /// came during the run are ignored by plans.
    Obstacles { found: Vec<Vec2>, ignores_strangers: bool },
    /// How far the run is.
    Progress(RunProgress),
    /// The operator requested the operation of this short name.
    Operated(String),
    /// The run is over; the text says how it ended, for people.
    Ended(String),
}

/// How a run began.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunBegun {
    /// When the run began, show clock. The moment also identifies the run.
    pub at: Instant,
    /// The show that is played.
    #[serde(with = "crate::shared_show")]
    pub show: Arc<Show>,
    /// What the run is for: a show, one frame, the drive home, or a preflight.
    pub purpose: RunPurpose,
    /// What happens to pixels that no robot can show.
    pub missing: MissingPolicy,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunProgress {
    /// The frame that is reached next.
    pub next: FrameCursor,
    /// Last frame of the loop that the show leaves after this frame, because the operator gave GO. `None` if GO was not
    /// given.
    pub leaves_loop: Option<FrameCursor>,
    /// Whether the show starts again after its last frame.
    pub looping: bool,
    /// Whether the operator paused the run.
    pub paused: bool,
    /// Whether the run pauses when the next frame is reached.
    pub stepping: bool,
    /// Whether the frame that robots reached last waits for GO.
    pub waits_for_go: bool,
    /// Number of frames reached.
    pub frames_played: u32,
    /// Number of dropouts; a robot that dropped out twice counts twice.
    pub dropouts: u32,
    /// How many times another controller took up this run.
    pub taken_up: u32,
    /// Whether robots drive or stand, and since when.
    pub position: Position,
}

/// Whether robots drive or stand, and since when.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Position {
    /// Path clock of the drive, if robots drive the leg, are about to, or were stopped on it. A robot that has fallen
    /// silent since may stand anywhere along its path.
    pub drive: Option<PathClock>,
    /// When robots stopped, if the drive was broken off. The value is kept until robots drive again, even if the run is
    /// interrupted again meanwhile.
    pub stops: Option<StopTimes>,
    /// The air time that is under way while robots stand, or that was interrupted. `None` otherwise.
    pub stood: Option<AirTime>,
}

impl Position {
    /// Whether robots stand at the goals of the leg in the journal.
    pub fn is_at_goals(&self) -> bool {
        self.stood.is_some_and(|air| air.is_at_goals)
    }

    /// Whether the places of robots follow from the leg in the journal: robots are on its paths or at its goals.
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
    /// Last reported place of the robot when this entry was written, stage metres; `None` if it was not known.
    pub at: Option<Vec2>,
    pub membership: Membership,
    pub probation: Probation,
    /// Where the robot may stand, if it dropped out and its reported place may be outdated.
    pub last_seen: Whereabouts,
}

/// The state of a run in a journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JournalState {
    pub begun: RunBegun,
    /// Participants by number.
    pub participants: Vec<ParticipantEntry>,
    /// The leg that robots drive, are about to drive, or drove last; `None` if there was none yet.
    pub leg: Option<LegEntry>,
    /// Pixels that the operator bound, with their robots, sorted by pixel.
    pub pins: Vec<(u32, RobotId)>,
    /// Pixels that robots showed in frames with fixed identity, with their robots; the pair noted longest ago comes
    /// first.
    pub owners: Vec<(u32, RobotId)>,
    /// Places where robots met an obstacle that is no known robot, stage metres.
    pub found: Vec<Vec2>,
    /// Whether plans ignore robots that came during the run, instead of driving around them.
    pub ignores_strangers: bool,
    pub progress: RunProgress,
    /// How the run ended, for people; `None` if it has not ended.
    pub ended: Option<String>,
}

impl JournalState {
    /// Applies a change to this state; `None` if the change does not fit it.
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
