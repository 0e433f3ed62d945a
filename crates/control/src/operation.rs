//! Operations of the operator, and why they may be refused.

use core::fmt;
use lightbots_base::RobotId;
use lightbots_show::{Layer, SPEED_MIN_PERCENT, Show};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::sync::Arc;

/// One operation of the operator.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Operation {
    /// Open a show. Refused during a run.
    Open(#[serde(with = "crate::shared_show")] Arc<Show>),
    /// Play from a frame (counted from 0) to the end. It begins with the drive to that frame from where robots are.
    Play {
        /// The first frame played.
        from: usize,
        /// What happens to pixels no robot can show.
        missing: MissingPolicy,
    },
    /// Drive to one frame (counted from 0), and stay there.
    Preview {
        /// The frame.
        frame: usize,
        /// What happens to pixels no robot can show.
        missing: MissingPolicy,
    },
    /// All robots slow down together and stand; while a frame stands, its air time stops.
    Pause,
    /// Go on from where Pause stopped.
    Resume,
    /// From a pause to the next frame, and pause there.
    Step,
    /// The run ends. Robots on a drive come to rest together, then all wheels stop.
    Abort,
    /// Every robot stops, also one that this controller did not start; at once if it is asked for again. Possible whenever
    /// there is a broker.
    StopAll,
    /// The operator has read why the last run failed, or that it was stopped.
    DismissFailure,
    /// Ask all robots to report.
    Refresh,
    /// This robot flashes for five seconds.
    Identify(RobotId),
    /// Forget a robot. Refused during a run.
    Forget(RobotId),
    /// Whether a played show starts again after its last frame.
    Loop(bool),
    /// Bind a pixel id to a robot in all frames, or free it.
    Pin {
        /// The pixel's id.
        pixel: u32,
        /// The only robot that may show it; `None`: any.
        robot: Option<RobotId>,
    },
    /// A run whose robots were out of reach goes on from where they stand, without robots that do not report.
    GoOn,
    /// GO: the frame that waits for it at its cue is left at once, also before its air time is over.
    Go,
    /// Drives of the next run take place at this share of the usual speed, percent. Refused during a run.
    Speed(u32),
    /// Drive all robots that can to the starting places of the open show, and stay there.
    Home,
    /// Only these robots may take part in runs that begin from now on; `None`: any.
    Admit(Option<BTreeSet<RobotId>>),
    /// Drive to this frame (counted from 0) in place of the next one, and play on from there. Only while robots stand or are
    /// held; a pause, and waiting for GO, end with it.
    GoTo(usize),
    /// Leave out the frame that comes next. No robot moves: the show goes on as it would have, to the frame after it.
    Skip,
    /// Put a layer of light over the show that plays, in place of one of the same name; `None`: take that layer off.
    LiveLight {
        /// Its name.
        name: String,
        /// The layer; its span does not count.
        layer: Option<Layer>,
    },
    /// Test all robots that can take part: each drives 50 mm out and back, is stopped on its way, and blinks. Refused during
    /// a run, and until a failure or a stop was dismissed.
    Preflight,
}

/// What happens to pixels no robot can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum MissingPolicy {
    /// The run does not begin.
    #[default]
    Refuse,
    /// They stay dark.
    LeaveOut,
}

/// What the controller is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ControllerState {
    /// There is no broker.
    #[default]
    Idle,
    /// There is a broker and no run.
    Ready,
    /// A run is being planned and handed to the robots.
    Preparing,
    /// A show plays.
    Playing,
    /// A run waits for the operator.
    Paused,
    /// Robots drive to one frame.
    Preview,
    /// Robots are being stopped.
    Aborting,
    /// A run stands still because its robots are out of reach, or were and wait for the operator.
    LinkLost,
}

/// Why an operation was not done. Its text says so to people, with what they can do.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// There is no broker.
    NotConnected,
    /// No show is open.
    NoShow,
    /// The show is not fit to be played.
    Unfit {
        /// What is wrong with it and what to do: the first error that validation finds, one line.
        issue: String,
    },
    /// The show has no such frame.
    NoSuchFrame {
        /// Asked for, counted from 0.
        frame: usize,
        /// How many there are.
        frames: usize,
    },
    /// Not while the controller is in this state.
    Busy(ControllerState),
    /// There is no run to pause, resume or abort.
    NoRun,
    /// The run is not paused.
    NotPaused,
    /// There is no robot that can take part.
    NoRobot,
    /// There is no such speed.
    NoSuchSpeed,
    /// No frame waits for GO.
    NoCue,
    /// The run is paused.
    Paused,
    /// Robots are not out of reach, or none has reported since.
    NothingToGoOn,
    /// Robots drive: they are sent to another frame once they stand.
    Driving,
    /// No frame comes next.
    NothingToSkip,
    /// No show plays that live light could be put over.
    NoShowPlays,
    /// The layer of live light is wrong.
    WrongLayer {
        /// What is wrong with it and what to do, one line.
        issue: String,
    },
    /// There are too many layers of live light.
    TooMuchLight {
        /// The most that are possible.
        most: usize,
    },
    /// There are not enough robots; [`MissingPolicy::LeaveOut`] plays without the missing ones.
    TooFewRobots {
        /// Most pixels in a frame.
        pixels: usize,
        /// Robots that can take part.
        robots: usize,
        /// Robots that are here but do not know where they are.
        without_place: usize,
        /// Robots that have not reported lately or report a fault.
        unfit: usize,
    },
    /// Pixels are bound to robots that are not here.
    PinnedMissing {
        /// The pixels' ids, at most 16.
        pixels: Vec<u32>,
    },
    /// No robot of that name is known.
    UnknownRobot(RobotId),
    /// That robot takes part in the run.
    TakesPart(RobotId),
    /// The last run failed or was stopped, and the operator has not read it.
    NotDismissed,
    /// No robot has room to drive out.
    NoRoom,
}

impl Operation {
    /// A word for it.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Open(_) => "open",
            Self::Play { .. } => "play",
            Self::Preview { .. } => "preview",
            Self::Pause => "pause",
            Self::Resume => "resume",
            Self::Step => "step",
            Self::Go => "go",
            Self::Speed(_) => "speed",
            Self::Home => "home",
            Self::Abort => "abort",
            Self::StopAll => "stop all",
            Self::DismissFailure => "dismiss the failure",
            Self::Refresh => "refresh",
            Self::Identify(_) => "identify",
            Self::Forget(_) => "forget",
            Self::Loop(_) => "loop",
            Self::Pin { .. } => "pin",
            Self::GoOn => "go on",
            Self::Admit(_) => "admit robots",
            Self::GoTo(_) => "go to a frame",
            Self::Skip => "skip",
            Self::LiveLight { .. } => "change live light",
            Self::Preflight => "preflight",
        }
    }
}

impl fmt::Display for ControllerState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Idle => "not connected",
            Self::Ready => "ready",
            Self::Preparing => "preparing a run",
            Self::Playing => "playing",
            Self::Paused => "paused",
            Self::Preview => "driving to a preview",
            Self::Aborting => "stopping the robots",
            Self::LinkLost => "without a link to the robots",
        })
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotConnected => write!(f, "There is no broker: connect first."),
            Self::NoShow => write!(f, "No show is open: open one first."),
            Self::Unfit { issue } => write!(f, "This show cannot be played: {issue}."),
            Self::NoSuchFrame { frame, frames } => {
                write!(f, "There is no frame {}: the show has {frames}.", frame + 1)
            }
            Self::Busy(state) => write!(f, "Not while the controller is {state}: abort first."),
            Self::NoRun => write!(f, "Nothing is being played."),
            Self::NotPaused => write!(f, "The run is not paused: pause it first."),
            Self::NoRobot => write!(f, "No robot is ready: turn robots on, and look for them."),
            Self::NoSuchSpeed => {
                write!(f, "Drives take place at {SPEED_MIN_PERCENT} to 100 % of their speed.")
            }
            Self::NoCue => write!(f, "No frame waits for GO: the show goes on by itself."),
            Self::Paused => write!(f, "The run is paused: resume it first."),
            Self::NothingToGoOn => {
                write!(f, "The show does not wait for this: it goes on once robots report again.")
            }
            Self::Driving => {
                write!(f, "Robots are driving: pause the show, or wait until they stand.")
            }
            Self::NothingToSkip => write!(f, "No frame comes next: the show ends."),
            Self::NoShowPlays => write!(f, "No show plays: live light needs one, so press Play first."),
            Self::WrongLayer { issue } => write!(f, "This light cannot be shown: {issue}."),
            Self::TooMuchLight { most } => {
                write!(f, "{most} live lights are on, and more are not possible: release one first.")
            }
            Self::TooFewRobots { pixels, robots, without_place, unfit } => {
                write!(f, "The show needs {pixels} robots, {robots} can take part")?;
                if *without_place > 0 {
                    write!(f, ", {without_place} do not know where they are")?;
                }
                if *unfit > 0 {
                    write!(f, ", {unfit} are silent or report a fault")?;
                }
                write!(f, ": add robots, or play and leave the missing pixels out.")
            }
            Self::PinnedMissing { pixels } => write!(
                f,
                "Pixels {pixels:?} are bound to robots that are not here: free them, or leave them out."
            ),
            Self::UnknownRobot(id) => write!(f, "No robot {id} is known: refresh the fleet."),
            Self::TakesPart(id) => write!(f, "Robot {id} takes part in the run: abort first."),
            Self::NotDismissed => {
                write!(f, "The last run was stopped: look at the floor, then dismiss the message about it.")
            }
            Self::NoRoom => {
                write!(
                    f,
                    "No robot has room to drive 50 mm: move robots at least 12 cm away from each other."
                )
            }
        }
    }
}

impl std::error::Error for Refusal {}
