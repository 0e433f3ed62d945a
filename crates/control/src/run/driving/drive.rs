//! The state of one drive: its time base, its timers, and what is known of each robot on its way.

use crate::run::path_clock::PathClock;
use crate::run::run_context::RunContext;
use lightbots_base::{Instant, Span};
use lightbots_wire::Command;

/// Robots are watched this often.
pub(crate) const WATCH_EVERY: Span = Span::from_millis(100);
/// Robots that have not arrived are asked this long after the planned end: an arrival in time is reported by then.
pub(crate) const ASK_AFTER_END: Span = Span::from_millis(300);

/// A robot is asked for a report this often at most.
pub(crate) const ASKED_EVERY: Span = Span::from_millis(90);

/// A robot on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RobotProgress {
    /// The robot reached the goal of the leg.
    pub arrived: bool,
    /// Since when the robot is too far off its path.
    pub late_since: Option<Instant>,
    /// The robot is late because it is not sure of its place.
    pub is_unsure: bool,
    /// Since when the robot reports an obstacle in its path.
    pub obstructed_since: Option<Instant>,
    /// When the robot last reported an obstacle while it was not late yet: then the obstacle is why it is late.
    pub obstructed_at: Option<Instant>,
    /// Since when the robot owes a report, because a robot near it is obstructed.
    pub probed_since: Option<Instant>,
    /// When the robot was last asked for a report.
    pub asked_at: Instant,
    /// When the robot was last on its route although the plan has ended.
    pub on_route_at: Instant,
    /// Shortest distance to its goal, metres, and when the robot last came nearer by a step that counts.
    pub nearest: (f64, Instant),
}

/// One drive.
#[derive(Clone, Debug)]
pub(crate) struct Driving {
    pub clock: PathClock,
    /// `[participant]`.
    pub progress: Vec<RobotProgress>,
    /// Number of robots that arrived.
    pub arrivals: usize,
    /// When the last of them did.
    pub last_arrival: Instant,
    /// Number of robots that are late.
    pub late: usize,
    /// When START is repeated, so that robots know that the link works.
    pub heartbeat_at: Instant,
    /// When robots are watched next.
    pub watch_at: Instant,
    /// When robots that have not arrived are asked.
    pub ask_at: Instant,
    /// The participant with which the watch goes on.
    pub watched: usize,
}

impl Driving {
    /// Asks a robot for a report, at a bounded rate.
    pub fn ask(&mut self, cx: &mut RunContext, participant: usize) {
        if cx.now - self.progress[participant].asked_at >= ASKED_EVERY {
            self.progress[participant].asked_at = cx.now;
            cx.send(participant, &[Command::Status]);
        }
    }

    /// A drive that began now, of that many participants.
    pub fn new(clock: PathClock, now: Instant, heartbeat_at: Instant, participants: usize) -> Self {
        let progress = RobotProgress {
            arrived: false,
            late_since: None,
            is_unsure: false,
            obstructed_since: None,
            obstructed_at: None,
            probed_since: None,
            asked_at: clock.began,
            on_route_at: Instant::ZERO,
            nearest: (f64::INFINITY, clock.began),
        };
        Self {
            clock,
            progress: vec![progress; participants],
            arrivals: 0,
            last_arrival: Instant::ZERO,
            late: 0,
            heartbeat_at,
            watch_at: now + WATCH_EVERY,
            ask_at: clock.ends + ASK_AFTER_END,
            watched: 0,
        }
    }

    /// When something is due.
    pub fn due(&self) -> Instant {
        let release_at = self.clock.hold.and_then(|hold| hold.release_at).unwrap_or(Instant::FAR);
        self.watch_at.min(self.heartbeat_at).min(release_at)
    }

    /// Whether a participant is still on its way.
    pub fn is_under_way(&self, cx: &RunContext, participant: usize) -> bool {
        cx.is_awaited(participant) && !self.progress[participant].arrived
    }
}
