//! Events for people and programs: one value for each fact. `event_text` has their lines for people.

use crate::operation::ControllerState;
use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_show::Severity;

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When, show clock.
    pub at: Instant,
    /// What.
    pub kind: EventKind,
}

/// What happened. `Display` is a line for people.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// The connection to the broker is established.
    Connected,
    /// The connection to the broker is lost.
    Disconnected,
    /// The state of the controller changed.
    StateChanged(ControllerState),
    /// A robot reported for the first time.
    RobotFound(RobotId),
    /// A robot that is not in [`Config::admitted`](crate::Config::admitted) reported for the first time: it may not
    /// take part.
    WantsToJoin(RobotId),
    /// A report shows that its robot was restarted.
    RobotRestarted(RobotId),
    /// A robot has become stale: it has not reported for [`Ageing::stale_after`](crate::Ageing::stale_after).
    RobotStale(RobotId),
    /// A robot is gone: it has not reported for [`Ageing::gone_after`](crate::Ageing::gone_after).
    RobotGone(RobotId),
    /// A stale or gone robot reports again.
    RobotBack(RobotId),
    /// Two robots share a name. Their reports come from places between which no robot can have driven, or their time
    /// questions follow two clocks.
    NameShared {
        /// The name.
        robot: RobotId,
        /// Places from which robots of this name reported last, stage metres.
        places: Vec<Vec2>,
    },
    /// A name that two robots shared belongs to one robot again.
    NameUnique(RobotId),
    /// A robot sends too many messages; the excess does not count.
    Flooding(RobotId),
    /// A robot reported that cannot be remembered, because there are too many. Recorded once.
    FleetFull,
    /// A show was opened.
    ShowOpened {
        /// Its name.
        name: String,
        /// Number of its frames.
        frames: usize,
    },
    /// The preparation of a run began.
    RunBegun {
        /// First frame, counted from 0.
        from: usize,
        /// Robots that take part, spares included.
        robots: usize,
    },
    /// A plan was made.
    Planned {
        /// Number of frames that the plan leads to.
        frames: usize,
    },
    /// Planning the drive to a frame failed.
    PlanFailed {
        /// Counted from 0.
        frame: usize,
        /// Why.
        message: String,
    },
    /// Pixels of a frame stay dark.
    LeftOut {
        /// Counted from 0.
        frame: usize,
        /// Ids of the pixels, at most 16.
        pixels: Vec<u32>,
        /// Number of all dark pixels.
        count: usize,
    },
    /// Robots leave for a frame.
    TransitionStarted {
        /// Counted from 0.
        frame: usize,
        /// When they leave, show clock.
        starts: Instant,
        /// How long the drive is planned to take.
        duration: Span,
    },
    /// Robots have reached a frame.
    FrameReached {
        /// Counted from 0.
        frame: usize,
        /// Time from the first to the last arrival at a place of this frame, over all legs to it.
        spread: Span,
        /// Time from the planned end of the drive until the frame was reached.
        wait: Span,
    },
    /// Robots began to drive to their starting places.
    GoingHome {
        /// Number of robots that drive.
        robots: usize,
    },
    /// The drive to the starting places was planned.
    PlannedHome,
    /// The robots have reached their starting places.
    AtHome,
    /// Robots have reached a frame and wait in it until the operator gives GO.
    WaitsForGo {
        /// Counted from 0.
        frame: usize,
        /// Name of the cue; may be empty.
        name: String,
    },
    /// The operator sends robots to another frame than the next one.
    GoesTo {
        /// Counted from 0.
        frame: usize,
    },
    /// The operator leaves out the next frame.
    Skipped {
        /// Counted from 0.
        frame: usize,
    },
    /// The next frame is left out, because robots are late for the music.
    LeftOutForMusic {
        /// Counted from 0.
        frame: usize,
        /// How late robots are.
        late: Span,
    },
    /// No plan leads to the frame that the operator chose: the show stays where it is.
    JumpGivenUp {
        /// Counted from 0.
        frame: usize,
    },
    /// All robots wait for one robot.
    Waiting {
        /// The robot they wait for.
        robot: RobotId,
        /// Why.
        why: Trouble,
    },
    /// Robots report, but none acknowledges its route: messages do not reach them.
    Undelivered,
    /// Many robots of a run fell silent at once: the run stands still until they report again.
    LinkLost {
        /// Number of silent robots.
        silent: usize,
        /// Robots of the run.
        robots: usize,
    },
    /// Robots of an interrupted run report again.
    LinkBack {
        /// Number of robots that report again.
        reported: usize,
        /// Robots of the run.
        robots: usize,
        /// Time since the run was interrupted.
        after: Span,
        /// Whether the run goes on only once the operator says so; otherwise it goes on by itself.
        asks_operator: bool,
    },
    /// This controller took up a run that was cut off when its former controller ended.
    TakenUp {
        /// The frame that was to be reached next, counted from 0.
        frame: usize,
        /// Robots of the run.
        robots: usize,
        /// How long there was no controller.
        away: Span,
        /// Whether the run goes on once its robots report; otherwise robots are told to stop, and the run is over.
        goes_on: bool,
    },
    /// The drive goes on after a hold.
    Resumed,
    /// A robot drops out of the run; the others go on without it.
    Dropout {
        /// The robot.
        robot: RobotId,
        /// Why.
        why: Trouble,
    },
    /// A robot that dropped out takes part again, or a new robot joins the run.
    Rejoined(RobotId),
    /// The rest of the run is planned again, from where robots are.
    Replanning {
        /// The frame they were heading for, counted from 0.
        frame: usize,
    },
    /// A robot that was to arrive stands away from its goal.
    Misaligned {
        /// The robot.
        robot: RobotId,
        /// Distance from the goal, metres.
        off_m: f64,
    },
    /// A robot that was sent nowhere, or that is unknown, reports an arrival.
    UnexpectedArrival(RobotId),
    /// This number of events was not recorded, because there were too many.
    Suppressed(u64),
    /// Every robot was told to stop.
    StoppedAll,
    /// A run is over.
    RunEnded {
        /// How the run ended.
        outcome: RunOutcome,
        /// Number of frames reached.
        frames_played: usize,
        /// Number of dropouts; a robot that dropped out twice counts twice.
        dropouts: usize,
    },
    /// Robots have reached the first frame of a loop: its frames repeat until the operator gives GO.
    LoopBegun {
        /// First frame of the loop, counted from 0.
        first: usize,
        /// Last frame of the loop, counted from 0.
        last: usize,
    },
    /// The operator gave GO for a loop: the show goes on after its last frame.
    LeavesLoop {
        /// Last frame of the loop, counted from 0.
        last: usize,
    },
    /// A preflight began.
    PreflightBegun {
        /// Robots that take part.
        robots: usize,
    },
    /// A preflight is over.
    PreflightEnded {
        /// Robots that passed.
        passed: usize,
        /// Robots that were to be tested.
        robots: usize,
    },
}

/// What is wrong with a robot in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// It is behind its path.
    Late,
    /// It is silent.
    Silent,
    /// It did not acknowledge its route or its START.
    Deaf,
    /// It does not know where it is.
    Lost,
    /// It is not sure enough of its place to pass others.
    Unsure,
    /// It reports a fault.
    Faulty,
    /// It lost its link on a drive or was restarted, and stands.
    Cut,
    /// It did not reach its goal in time.
    Missed,
    /// An obstacle is in its path.
    Blocked,
    /// Another robot has its name.
    Shared,
    /// Its show clock is not precise yet.
    Clock,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RunOutcome {
    /// All frames were played.
    Finished,
    /// The operator ended it.
    Aborted,
    /// It could not go on. The text says where and why, for people, without a full stop.
    Failed(String),
}

impl EventKind {
    /// Returns how serious the event is.
    pub fn severity(&self) -> Severity {
        use EventKind::*;
        match self {
            NameShared { .. }
            | PlanFailed { .. }
            | Dropout { .. }
            | RunEnded { outcome: RunOutcome::Failed(_), .. } => Severity::Error,
            Disconnected
            | RobotStale(_)
            | RobotGone(_)
            | FleetFull
            | Flooding(_)
            | LeftOut { .. }
            | Waiting { .. }
            | Undelivered
            | LinkLost { .. }
            | TakenUp { .. }
            | LinkBack { asks_operator: true, .. }
            | Replanning { .. }
            | JumpGivenUp { .. }
            | LeftOutForMusic { .. }
            | Misaligned { .. }
            | UnexpectedArrival(_)
            | RobotRestarted(_)
            | Suppressed(_)
            | StoppedAll => Severity::Warning,
            _ => Severity::Note,
        }
    }
}
