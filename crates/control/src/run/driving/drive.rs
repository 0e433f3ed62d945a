//! The state of one drive: its time base, its timers, and what is known of each robot on its way.
//!
//! A hold is a common stop: all robots slow down together and wait. The watch checks all robots regularly.

use crate::run::path_clock::PathClock;
use crate::run::run_context::RunContext;
use lightbots_base::{Instant, Span};
use lightbots_wire::Command;

/// Time between two turns of the watch over driving robots.
pub(crate) const WATCH_EVERY: Span = Span::from_millis(100);
/// Time after the planned end of the drive at which robots that have not arrived are first asked for a report. An
/// arrival in time has been reported by then.
pub(crate) const ASK_AFTER_END: Span = Span::from_millis(300);

/// Least time between two requests to the same robot for a report.
pub(crate) const ASKED_EVERY: Span = Span::from_millis(90);

/// What the controller notes of one robot on a drive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RobotProgress {
    /// Whether the robot has reached the goal of the leg.
    pub arrived: bool,
    /// Since when all robots wait for this one, because it is off its path, unsure of its place, obstructed or silent.
    /// `None` if they do not.
    pub late_since: Option<Instant>,
    /// Whether the robot is late because it is unsure of its place.
    pub is_unsure: bool,
    /// Since when the robot reports an obstacle in its path. `None` if its last report names none.
    pub obstructed_since: Option<Instant>,
    /// When the robot last began to report an obstacle, if it was not late before, or had become late just before. The
    /// obstacle is then the reason why it is late.
    pub obstructed_at: Option<Instant>,
    /// Since when a report of the robot is awaited, because a robot near it reports an obstacle. `None` if none is
    /// awaited.
    pub probed_since: Option<Instant>,
    /// When the robot was last asked for a report.
    pub asked_at: Instant,
    /// Latest moment, at most `SLOW` after the planned end of the drive, at which the robot was on its route or made
    /// progress.
    pub on_route_at: Instant,
    /// Shortest distance from the robot's reported places to its goal, metres, and when that distance last fell by at
    /// least `NEARER_M`.
    pub nearest: (f64, Instant),
}

/// The state of one drive.
#[derive(Clone, Debug)]
pub(crate) struct Driving {
    pub clock: PathClock,
    /// `[participant]`: what is noted of its robot.
    pub progress: Vec<RobotProgress>,
    /// Number of robots that have arrived.
    pub arrivals: usize,
    /// When the latest of these arrivals was counted.
    pub last_arrival: Instant,
    /// Number of robots for which all wait (`late_since`).
    pub late: usize,
    /// When START is sent again, so that robots know that the link works.
    pub heartbeat_at: Instant,
    /// When the next turn of the watch is due.
    pub watch_at: Instant,
    /// When the controller begins to ask robots that have not arrived.
    pub ask_at: Instant,
    /// The participant with which the next turn of the watch begins.
    pub watched: usize,
}

impl Driving {
    /// Asks a robot for a report, unless it was asked less than [`ASKED_EVERY`] ago.
    pub fn ask(&mut self, cx: &mut RunContext, participant: usize) {
        if cx.now - self.progress[participant].asked_at >= ASKED_EVERY {
            self.progress[participant].asked_at = cx.now;
            cx.send(participant, &[Command::Status]);
        }
    }

    /// The state of a drive that has just begun, for the given number of participants.
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

    /// When [`on_tick`](Self::on_tick) has something to do next.
    pub fn due(&self) -> Instant {
        let release_at = self.clock.hold.and_then(|hold| hold.release_at).unwrap_or(Instant::FAR);
        self.watch_at.min(self.heartbeat_at).min(release_at)
    }

    /// Whether a participant has to arrive for the leg to end, and has not arrived yet.
    pub fn is_under_way(&self, cx: &RunContext, participant: usize) -> bool {
        cx.is_awaited(participant) && !self.progress[participant].arrived
    }
}
