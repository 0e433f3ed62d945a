//! Options of a rehearsal, and its progress.

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_plan::Path;

use crate::conditions::Conditions;

/// Options of a rehearsal.
#[derive(Clone, Debug, PartialEq)]
pub struct RehearsalOptions {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Faults of robots and networks.
    pub conditions: Conditions,
    /// Number of robots; `None`: as many as the show needs, or one for each start of the show.
    pub robots: Option<usize>,
}

/// Progress of a rehearsal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress<'a> {
    /// The show is planned, or planned anew after a fault.
    Planning,
    /// The show plays. Also sent after planning, so that callers can time both.
    Playing {
        /// Virtual time since robots were switched on, seconds.
        at_s: f64,
        /// Planned duration of the show, seconds.
        planned_s: f64,
        /// Number of frames that robots have reached.
        frames: usize,
    },
    /// Robots are about to leave, or have just left.
    Departing {
        /// Index of the frame they drive to.
        frame: usize,
        /// Departure, seconds after the first departure of the show. Holds delay what follows.
        begins_s: f64,
        /// `(robot, path)` of the robots that drive paths. A plan begins at the reported places, so it differs from
        /// seed to seed.
        paths: &'a [(usize, &'a Path)],
    },
    /// True places of robots, about ten times a second of the show.
    Stepped {
        /// Time on the show clock.
        at: Instant,
        /// Name and index of each robot.
        names: &'a [(RobotId, usize)],
        /// `[robot]`: its place, stage metres.
        places: &'a [Vec2],
    },
    /// Further bytes of the log of the controller's inputs ([`lightbots_control::replay`]).
    Logged(&'a [u8]),
}

impl Progress<'_> {
    /// Sends bytes of the log, if there are any.
    pub(crate) fn log(bytes: &[u8], progress: &mut dyn FnMut(Progress<'_>)) {
        if !bytes.is_empty() {
            progress(Progress::Logged(bytes));
        }
    }
}

/// Largest number of robots in a rehearsal.
pub const ROBOTS_MAX: usize = 20_000;

impl Default for RehearsalOptions {
    /// Seed 1, standard conditions, as many robots as the show needs.
    fn default() -> Self {
        Self { seed: 1, conditions: Conditions::default(), robots: None }
    }
}

/// Largest virtual duration of a rehearsal: many times the plan, because recovery takes time.
pub(crate) fn time_limit(planned_s: f64) -> Instant {
    Instant::ZERO + Span::from_secs(60.0 + 5.0 * planned_s.clamp(0.0, 1e6))
}
