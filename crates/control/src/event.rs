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
    /// The broker is there.
    Connected,
    /// The broker is lost.
    Disconnected,
    /// The state of the controller changed.
    StateChanged(ControllerState),
    /// A robot reported for the first time.
    RobotFound(RobotId),
    /// A robot that is not listed reported for the first time: it may not take part.
    WantsToJoin(RobotId),
    /// A robot introduced itself again after a restart.
    RobotRestarted(RobotId),
    /// A robot has not reported for a while.
    RobotStale(RobotId),
    /// A robot has not reported for long.
    RobotGone(RobotId),
    /// A stale or gone robot reports again.
    RobotBack(RobotId),
    /// Reports of one name come from places between which no robot can have driven, or its questions follow two clocks.
    NameShared {
        /// The name.
        robot: RobotId,
        /// Where its robots reported from last, stage metres.
        places: Vec<Vec2>,
    },
    /// One robot has a name again that two had shared.
    NameUnique(RobotId),
    /// A robot sends more messages than count.
    Flooding(RobotId),
    /// There are more robots than can be remembered; recorded once.
    FleetFull,
    /// A show was opened.
    ShowOpened {
        /// Its name.
        name: String,
        /// Number of its frames.
        frames: usize,
    },
    /// A run begins to be prepared.
    RunBegun {
        /// First frame, counted from 0.
        from: usize,
        /// Robots that take part, spares included.
        robots: usize,
    },
    /// A plan was made.
    Planned {
        /// Frames that it leads to.
        frames: usize,
    },
    /// There is no plan to a frame.
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
        /// Number of them.
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
    /// A picture stands.
    FrameReached {
        /// Counted from 0.
        frame: usize,
        /// Between the first and the last arrival at a place in this frame, over all its legs.
        spread: Span,
        /// From the planned end to the last arrival.
        wait: Span,
    },
    /// A drive of all robots to their starting places began.
    GoingHome {
        /// Number of them.
        robots: usize,
    },
    /// The drive to the starting places was planned.
    PlannedHome,
    /// All stand at their starting places.
    AtHome,
    /// A picture stands until the operator gives GO.
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
        /// How late they are.
        late: Span,
    },
    /// There is no path to the frame that the operator chose: the show stays where it is.
    JumpGivenUp {
        /// Counted from 0.
        frame: usize,
    },
    /// All robots wait for one.
    Waiting {
        /// The robot they wait for.
        robot: RobotId,
        /// Why.
        why: Trouble,
    },
    /// Robots report, and none acknowledges its route: the link to them is broken.
    Undelivered,
    /// Many robots of a run fell silent at once: the run stands still until they report again.
    LinkLost {
        /// Number of them.
        silent: usize,
        /// Robots of the run.
        robots: usize,
    },
    /// Robots of a run that was interrupted report again.
    LinkBack {
        /// Number of them.
        reported: usize,
        /// Robots of the run.
        robots: usize,
        /// Since the run was interrupted.
        after: Span,
        /// The run goes on once the operator says so; otherwise by itself.
        asks_operator: bool,
    },
    /// A run was cut off when its controller ended, and this one found it.
    TakenUp {
        /// The frame that was to be reached next, counted from 0.
        frame: usize,
        /// Robots of the run.
        robots: usize,
        /// How long there was no controller.
        away: Span,
        /// The run goes on once its robots report; otherwise they are told to stop, and it is over.
        goes_on: bool,
    },
    /// The drive goes on after a hold.
    Resumed,
    /// A robot takes no part any more; the rest goes on without it.
    Dropout {
        /// The robot.
        robot: RobotId,
        /// Why.
        why: Trouble,
    },
    /// A robot takes part again, or a new one takes a dark pixel.
    Rejoined(RobotId),
    /// The rest of the run is planned again, from where robots are.
    Replanning {
        /// The frame they were heading for, counted from 0.
        frame: usize,
    },
    /// A robot reports its arrival, but not where it should be.
    Misaligned {
        /// The robot.
        robot: RobotId,
        /// How far off, metres.
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
        /// How.
        outcome: RunOutcome,
        /// Frames reached.
        frames_played: usize,
        /// Robots lost on the way.
        dropouts: usize,
    },
    /// The first frame of a loop stands: frames repeat until the operator gives GO.
    LoopBegun {
        /// The first of them, counted from 0.
        first: usize,
        /// The last of them, counted from 0.
        last: usize,
    },
    /// The operator gave GO for a loop: the show goes on after its last frame.
    LeavesLoop {
        /// The last frame, counted from 0.
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
    /// It does not report.
    Silent,
    /// It did not acknowledge its route or its START.
    Deaf,
    /// It does not know where it is.
    Lost,
    /// It is not sure enough of its place to pass others.
    Unsure,
    /// It reports a fault.
    Faulty,
    /// It was cut off or restarted and stands.
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
    /// It could not go on: where and why, for people, without a full stop.
    Failed(String),
}

impl EventKind {
    /// Its severity.
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
