//! Events for people and programs: one value for each fact. `event_text` has their lines for people.

use crate::operation::ControllerState;
use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_show::Severity;

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When it happened, show clock.
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
    /// A report shows that the reporting robot was restarted.
    RobotRestarted(RobotId),
    /// A robot has become stale: it has not reported for [`Ageing::stale_after`](crate::Ageing::stale_after).
    RobotStale(RobotId),
    /// A robot is gone: it has not reported for [`Ageing::gone_after`](crate::Ageing::gone_after).
    RobotGone(RobotId),
    /// A stale or gone robot reports again.
    RobotBack(RobotId),
    /// Two robots share a name. Either reports alternate between places, and no robot can have driven between these in
    /// the time. Or time questions follow two clocks.
    NameShared {
        /// The name.
        robot: RobotId,
        /// Up to two places from which robots of this name reported lately, stage metres.
        places: Vec<Vec2>,
    },
    /// A name that two robots shared belongs to one robot again.
    NameUnique(RobotId),
    /// A robot sends too many messages; the controller ignores those above the allowed rate.
    Flooding(RobotId),
    /// A new robot reported and was ignored, because the fleet already has the largest number of robots. Recorded once.
    FleetFull,
    /// A show was opened.
    ShowOpened {
        /// Its name.
        name: String,
        /// Number of its frames.
        frames: usize,
    },
    /// The preparation of a run of the open show, or of a preview, began.
    RunBegun {
        /// First frame, counted from 0.
        from: usize,
        /// Number of robots that take part, spares included.
        robots: usize,
    },
    /// A plan was made.
    Planned {
        /// Number of frames that the plan leads to; 0 if planning the first one failed.
        frames: usize,
    },
    /// Planning the drive to a frame failed, or the planned drive would take too long.
    PlanFailed {
        /// Counted from 0.
        frame: usize,
        /// Why.
        message: String,
    },
    /// Pixels of a frame stay dark because no robot shows them.
    LeftOut {
        /// Counted from 0.
        frame: usize,
        /// Ids of the first dark pixels, at most 16.
        pixels: Vec<u32>,
        /// Number of all dark pixels.
        count: usize,
    },
    /// Robots leave for a frame. If several drives lead there in turn, each has its own event.
    TransitionStarted {
        /// Counted from 0.
        frame: usize,
        /// When robots leave, show clock.
        starts: Instant,
        /// How long this drive is planned to take.
        duration: Span,
    },
    /// Robots have reached a frame.
    FrameReached {
        /// Counted from 0.
        frame: usize,
        /// Time from the first to the last arrival of a robot at its place in this frame; 0 if no robot had to arrive.
        spread: Span,
        /// Time from the planned end of the drive, which holds put off, until the frame was reached; 0 if it was
        /// reached earlier.
        wait: Span,
    },
    /// The preparation of the drive to the starting places began.
    GoingHome {
        /// Number of robots that take part.
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
    /// The operator sends robots to a frame of choice, in place of the next one.
    GoesTo {
        /// Counted from 0.
        frame: usize,
    },
    /// The operator leaves out the next frame.
    Skipped {
        /// Counted from 0.
        frame: usize,
    },
    /// The next frame is left out, because the show is behind the music.
    LeftOutForMusic {
        /// Counted from 0.
        frame: usize,
        /// How far the show is behind the music.
        late: Span,
    },
    /// No plan leads to the frame that a GoTo, a Skip or a left-out frame made the next frame. The change is undone:
    /// the frame that was next before is next again.
    JumpGivenUp {
        /// Counted from 0.
        frame: usize,
    },
    /// All robots wait or stop because of one robot.
    Waiting {
        /// The robot that the others wait or stop for.
        robot: RobotId,
        /// Why.
        why: Trouble,
    },
    /// Robots report, but none acknowledges its route: messages do not reach them.
    Undelivered,
    /// Many robots of a run fell silent at once: the run stands still until enough robots report again.
    LinkLost {
        /// Number of silent robots.
        silent: usize,
        /// Number of robots of the run.
        robots: usize,
    },
    /// Enough robots of an interrupted run report again.
    LinkBack {
        /// Number of robots that report again.
        reported: usize,
        /// Number of robots of the run.
        robots: usize,
        /// Time from the interruption of the run until now.
        after: Span,
        /// Whether the run goes on only once the operator agrees. Otherwise the run goes on by itself.
        asks_operator: bool,
    },
    /// This controller took up a run that was cut off when its former controller ended.
    TakenUp {
        /// The frame that robots were to reach next, counted from 0.
        frame: usize,
        /// Number of robots of the run.
        robots: usize,
        /// Time from the last journal entry of the former controller until now.
        away: Span,
        /// Whether the run is to go on once its robots report, if need be after the operator agrees. Otherwise robots
        /// are told to stop, and the run is over.
        goes_on: bool,
    },
    /// The drive goes on after a hold.
    Resumed,
    /// A robot drops out of the run; the other robots go on without it.
    Dropout {
        /// The robot.
        robot: RobotId,
        /// Why.
        why: Trouble,
    },
    /// A robot that dropped out takes part again, or a new robot joins the run.
    Rejoined(RobotId),
    /// The drives that remain are planned again, from the places where robots are.
    Replanning {
        /// The frame that robots reach next, counted from 0.
        frame: usize,
    },
    /// A robot stands away from the place where it should stand by plan.
    Misaligned {
        /// The robot.
        robot: RobotId,
        /// Distance from that place, metres.
        off_m: f64,
    },
    /// A robot reports an arrival, although it was sent nowhere or was unknown before.
    UnexpectedArrival(RobotId),
    /// Too many events came at once; this number of them was not recorded.
    Suppressed(u64),
    /// Every robot is being stopped, because the operator requested StopAll.
    StoppedAll,
    /// A run is over.
    RunEnded {
        /// How the run ended.
        outcome: RunOutcome,
        /// Number of frames that robots reached.
        frames_played: usize,
        /// Number of dropouts; a robot that dropped out twice counts twice.
        dropouts: usize,
    },
    /// Robots have reached the first frame of a loop, or a frame within it at which the run began. The frames of the
    /// loop repeat until the operator gives GO.
    LoopBegun {
        /// First frame of the loop, counted from 0.
        first: usize,
        /// Last frame of the loop, counted from 0.
        last: usize,
    },
    /// The operator gave GO in a loop: the show goes on after the last frame of the loop.
    LeavesLoop {
        /// Last frame of the loop, counted from 0.
        last: usize,
    },
    /// A preflight began.
    PreflightBegun {
        /// Number of robots that take part.
        robots: usize,
    },
    /// A preflight is over.
    PreflightEnded {
        /// Number of robots that passed.
        passed: usize,
        /// Number of robots that were to be tested.
        robots: usize,
    },
}

/// What is wrong with a robot in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// It is too far from its planned place on its path, or made no progress for too long.
    Late,
    /// It is silent.
    Silent,
    /// It did not acknowledge its route or its START, or it is not known to stand after STOP.
    Deaf,
    /// It does not know where it is.
    Lost,
    /// Its place is too uncertain to pass other robots, by the error that it reports.
    Unsure,
    /// It reports a fault.
    Faulty,
    /// It lost its link on a drive, its route or its clock, began its route alone, or was restarted.
    Cut,
    /// It did not reach its goal in time, left its straight drive, or does not stand where it should by plan.
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
    /// The run reached all its frames.
    Finished,
    /// The operator ended it.
    Aborted,
    /// The run could not go on. The text says where and why, for people, without a full stop at its end.
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
