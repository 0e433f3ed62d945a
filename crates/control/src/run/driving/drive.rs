//! The state of one drive: its time base, its timers, and what is known of each robot on its way.
//!
//! A hold is a common stop: all robots slow down together and wait. The watch checks all robots regularly.

use crate::run::path_clock::PathClock;
use crate::run::run_context::RunContext;
use lightbots_base::{Instant, Span};
use lightbots_wire::Command;

/// Time between two turns of the watch over driving robots.
pub(crate) const WATCH_EVERY: Span = Span::from_millis(100);
/// Time after the planned end of the drive from which robots are asked for a report because they have not arrived. An
/// arrival in time has been reported by then.
pub(crate) const ASK_AFTER_END: Span = Span::from_millis(300);

/// Least time between two requests by [`Driving::ask`] to the same robot for a report.
pub(crate) const ASKED_EVERY: Span = Span::from_millis(90);

/// What the controller notes of one robot on a drive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RobotProgress {
    /// Whether the robot counts as arrived: it has reached its goal in the leg, or was accepted beside the goal.
    pub arrived: bool,
    /// Since when the robot is late: all robots wait for it, because it is off its path, unsure of its place,
    /// obstructed or silent. `None` if it is not late.
    pub late_since: Option<Instant>,
    /// Whether the robot last became late because it was unsure of its place. Without meaning unless it is late.
    pub is_unsure: bool,
    /// Since when the robot reports an obstacle in its path. `None` if its last report names none.
    pub obstructed_since: Option<Instant>,
    /// When the robot last began to report an obstacle while it was not late, or had become late only just before. The
    /// obstacle then is the reason why it is late. `None` if it never did.
    pub obstructed_at: Option<Instant>,
    /// Since when a report of the robot is awaited, because a robot near it reports an obstacle. `None` if none is
    /// awaited.
    pub probed_since: Option<Instant>,
    /// When the robot was last asked individually for a report, other than by a check of a hold. At first, when the
    /// drive began.
    pub asked_at: Instant,
    /// Latest moment at which the robot was on its route or made progress; not noted later than `SLOW` after the
    /// planned end of the drive.
    pub on_route_at: Instant,
    /// Distance from the robot to its goal when it last made progress, metres, and when that was. Progress is a place
    /// that is nearer to the goal by more than `NEARER_M`. Infinite, and the beginning of the drive, until it is first
    /// compared.
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
    /// When START is sent again, so that robots know that the link works. [`Instant::FAR`] if robots drive by TARGET.
    pub heartbeat_at: Instant,
    /// When the next turn of the watch is due.
    pub watch_at: Instant,
    /// When the controller begins to ask robots for reports because they have not arrived.
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

    /// When [`on_tick`](Self::on_tick) has something to do next, apart from light and uploads of routes.
    pub fn due(&self) -> Instant {
        let release_at = self.clock.hold.and_then(|hold| hold.release_at).unwrap_or(Instant::FAR);
        self.watch_at.min(self.heartbeat_at).min(release_at)
    }

    /// Whether a participant has to arrive for the leg to end, and has not arrived yet.
    pub fn is_under_way(&self, cx: &RunContext, participant: usize) -> bool {
        cx.is_awaited(participant) && !self.progress[participant].arrived
    }
}
