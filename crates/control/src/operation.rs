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
    /// Play the show from a frame (counted from 0) to the end. The run begins with the drive to that frame from where
    /// robots are.
    Play {
        /// The first frame played.
        from: usize,
        /// What happens to pixels no robot can show.
        missing: MissingPolicy,
    },
    /// Drive to one frame (counted from 0). The run ends when robots have reached the frame.
    Preview {
        /// The frame.
        frame: usize,
        /// What happens to pixels no robot can show.
        missing: MissingPolicy,
    },
    /// Pause the run: robots on a drive slow down together and stand. While robots stand in a frame, its air time
    /// stops.
    Pause,
    /// Go on after a pause.
    Resume,
    /// Go on after a pause, and pause again when the next frame is reached. Robots that stand leave at once, also from
    /// a frame that waits for GO.
    Step,
    /// End the run. Robots on routes come to rest together, then all wheels stop. A second Abort stops them at once.
    Abort,
    /// Stop every robot, also robots that take no part in the run, and end the run. Robots on routes first come to rest
    /// together; a second StopAll stops them at once. Without a broker, robots are stopped once it is back; refused then if
    /// there is no run.
    StopAll,
    /// Remove the message that the last run failed or was stopped, because the operator has read it.
    DismissFailure,
    /// Ask all robots to report.
    Refresh,
    /// Make a robot flash for five seconds. A robot that does not support BLINK is asked to report.
    Identify(RobotId),
    /// Remove a robot from the fleet, and its pixel bindings. If it reports again, it is added as a new robot. Refused
    /// during a run, and while robots are being stopped.
    Forget(RobotId),
    /// Set whether the show starts again after its last frame.
    Loop(bool),
    /// Bind the pixels with an id to one robot in all frames, or free them.
    Pin {
        /// The pixel's id.
        pixel: u32,
        /// The only robot that may show the pixel; `None` frees the pixel for any robot.
        robot: Option<RobotId>,
    },
    /// Let an interrupted run go on from where robots stand, without robots that do not report.
    GoOn,
    /// GO: leave at once the frame that has a cue, even before its air time is over. In a loop of frames: go on after
    /// the last frame of the loop.
    Go,
    /// Set the speed of drives of all later runs except preflights, percent of the usual speed. Refused during a run
    /// and while robots are being stopped.
    Speed(u32),
    /// Drive all robots that can take part to the starting places of the open show. The run ends there.
    Home,
    /// Set the names of the robots that may take part in runs; `None` admits all robots. A robot that takes part in a
    /// run goes on with it.
    Admit(Option<BTreeSet<RobotId>>),
    /// Drive to this frame (counted from 0) instead of the next one, and play on from it. Ends a pause or a wait for
    /// GO. Refused while robots drive and are neither held nor paused, and while the run is interrupted.
    GoTo(usize),
    /// Leave out the frame that comes next. Robots that stand in a frame leave it at the usual time, but for the frame
    /// after the one that is left out. Refused like [`GoTo`](Self::GoTo).
    Skip,
    /// Put a layer of live light over the light of the show that plays. The new layer replaces the live layer of the
    /// same name.
    LiveLight {
        /// Name of the layer.
        name: String,
        /// The layer, whose span is ignored; `None` takes the layer of this name off.
        layer: Option<Layer>,
    },
    /// Test all robots that can take part and have room: each drives 50 mm out and back, is stopped on its way, and
    /// blinks. Refused during a run and while robots are being stopped. Also refused until the operator dismisses the
    /// message about a failed or stopped run.
    Preflight,
}

/// What happens to pixels that no robot can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum MissingPolicy {
    /// The run does not begin, or fails before its first drive. Once robots have driven, pixels stay dark all the same
    /// if robots drop out.
    #[default]
    Refuse,
    /// They stay dark.
    LeaveOut,
}

/// What the controller is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ControllerState {
    /// There is no broker and no run.
    #[default]
    Idle,
    /// There is a broker and no run.
    Ready,
    /// A run has not begun its first drive: robots report where they stand, and routes are planned and sent.
    Preparing,
    /// A show plays.
    Playing,
    /// A run is paused until the operator resumes it.
    Paused,
    /// A preview, the drive to the starting places, or a preflight has begun its first drive.
    Preview,
    /// Robots are being stopped.
    Aborting,
    /// A run is interrupted: its robots or the broker are out of reach, or the operator has to let the run go on.
    LinkLost,
}

/// Why an operation was refused. `Display` tells people the reason and what they can do.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// There is no broker.
    NotConnected,
    /// No show is open.
    NoShow,
    /// The show has an error, so that it cannot be played.
    Unfit {
        /// What is wrong with the show and what to do: the first error that validation finds, one line.
        issue: String,
    },
    /// The show has no such frame.
    NoSuchFrame {
        /// Requested frame, counted from 0.
        frame: usize,
        /// Number of frames of the show.
        frames: usize,
    },
    /// The operation is not possible while the controller is in this state.
    Busy(ControllerState),
    /// There is no run, which the operation needs.
    NoRun,
    /// The run is not paused.
    NotPaused,
    /// There is no robot that can take part.
    NoRobot,
    /// The speed is outside of the allowed range.
    NoSuchSpeed,
    /// No frame waits for GO, and no loop of frames that GO can end is under way.
    NoCue,
    /// The run is paused.
    Paused,
    /// The run is not interrupted, or none of its robots has reported since the interruption.
    NothingToGoOn,
    /// Robots drive. They can be sent to another frame once they stand or are held, or the run is paused.
    Driving,
    /// No frame comes next.
    NothingToSkip,
    /// No show is being played, so that there is no light to put live light over.
    NoShowPlays,
    /// The layer of live light is wrong.
    WrongLayer {
        /// What is wrong with the layer and what to do, one line.
        issue: String,
    },
    /// There are too many layers of live light.
    TooMuchLight {
        /// Largest number of layers of live light.
        most: usize,
    },
    /// There are not enough robots for all pixels. With [`MissingPolicy::LeaveOut`] one robot is enough.
    TooFewRobots {
        /// Number of pixels of the largest frame that is to be played.
        pixels: usize,
        /// Number of robots that can take part.
        robots: usize,
        /// Number of robots that report but do not know where they are.
        without_place: usize,
        /// Number of other known robots that cannot take part, for example because they are silent or report a fault.
        unfit: usize,
    },
    /// The show or the operator bound pixels to robots that cannot take part.
    PinnedMissing {
        /// The pixels' ids, at most 16.
        pixels: Vec<u32>,
    },
    /// No robot of that name is known.
    UnknownRobot(RobotId),
    /// The last run failed or was stopped, and the operator has not dismissed the message about it.
    NotDismissed,
    /// A preflight is not possible: no robot has enough free floor around it for its test drive.
    NoRoom,
}

impl Operation {
    /// Returns a short name of the operation.
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
            Self::Busy(ControllerState::Aborting) => {
                write!(f, "Not while the robots are being stopped: wait until they stand.")
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
                    write!(f, ", {unfit} are silent, not admitted, share a name or report a fault")?;
                }
                write!(f, ": add robots, or play and leave the missing pixels out.")
            }
            Self::PinnedMissing { pixels } => write!(
                f,
                "Pixels {pixels:?} are bound to robots that are not here: free them, or leave them out."
            ),
            Self::UnknownRobot(id) => write!(f, "No robot {id} is known: refresh the fleet."),
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
