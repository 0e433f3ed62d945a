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
    /// Number of robots. `None`: the number that the show needs, or the number of its starts if that is larger.
    pub robots: Option<usize>,
}

/// Progress of a rehearsal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress<'a> {
    /// Planning begins: of the show, or anew after a fault.
    Planning,
    /// Sent about once a second of virtual time, also before the first departure. Also sent when planning ends, so that
    /// callers can measure the time of planning.
    Playing {
        /// Virtual time since robots were switched on, seconds.
        at_s: f64,
        /// Planned duration of the show, seconds.
        planned_s: f64,
        /// Number of frames that robots have reached.
        frames: usize,
    },
    /// A drive begins: robots are about to leave, or have just left.
    Departing {
        /// Index of the frame that robots drive to, counted from 0.
        frame: usize,
        /// Time of departure, seconds after the first departure of the show. If robots are held on the way, they are
        /// later on their paths than this time says.
        begins_s: f64,
        /// Index and path of each robot that drives on a path. Paths begin at the reported places, so they differ from
        /// seed to seed.
        paths: &'a [(usize, &'a Path)],
    },
    /// True places of robots, about ten times a second of the show.
    Stepped {
        /// Virtual time since robots were switched on.
        at: Instant,
        /// Name and index of each robot.
        names: &'a [(RobotId, usize)],
        /// `[robot]`: its place, stage metres. If a person comes onto the floor, the last entry is the foot.
        places: &'a [Vec2],
    },
    /// Bytes to append to the log of the controller's inputs, which [`lightbots_control::replay`] reads.
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

/// Virtual time at which a rehearsal is given up: 60 s and five times the planned duration, because recovery takes
/// time.
pub(crate) fn time_limit(planned_s: f64) -> Instant {
    Instant::ZERO + Span::from_secs(60.0 + 5.0 * planned_s.clamp(0.0, 1e6))
}
