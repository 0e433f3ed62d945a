//! What a controller is told once, at its start.

use lightbots_base::{RobotId, Span};
use lightbots_lighting::{LampSettings, Tolerance};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Bounds and tolerances of a controller. The default is what the shell uses, except for `seq_base`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Config {
    /// Routes are numbered from here on. A restarted controller must not reuse numbers: derive it from the time of
    /// day at the start (seconds since 1970 times 8 will do).
    pub seq_base: u32,
    /// How far from its goal, along x and along y, a robot may be that reports its arrival, metres.
    pub arrival_tolerance_m: f64,
    /// The most robots that are remembered; further names are counted and dropped.
    pub robots_max: usize,
    /// Names of the robots that may take part in runs; `None`: any robot that is there when a run begins. Robots of other
    /// names are driven around.
    pub admitted: Option<BTreeSet<RobotId>>,
    /// When robots that do not report age.
    pub ageing: Ageing,
    /// How long before its moment a START is stated; grows by 20 µs a robot.
    pub start_lead: Span,
    /// How routes are sent.
    pub upload: UploadLimits,
    /// A robot that should report and did not for this long drops out.
    pub silence: Span,
    /// When a robot is late.
    pub late: LateBounds,
    /// How long a run waits.
    pub waits: WaitBounds,
    /// How far robots' lights may be from the colours of layers.
    pub light_tolerance: Tolerance,
    /// The lamps of the fleet: colours leave for robots corrected by these. All others, such as those of snapshots, are as
    /// they are meant.
    pub lamp: LampSettings,
}

/// When a robot is late.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LateBounds {
    /// A robot this far off its path makes all robots wait, metres; more where the plan leaves more room.
    pub off_m: f64,
    /// How long all robots wait for it before the rest is planned again around it.
    pub wait: Span,
}

/// How long a run waits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaitBounds {
    /// For a plan, before the run is given up.
    pub plan: Span,
    /// For the broker, or for robots that are all silent, before it ends.
    pub outage: Span,
    /// A run whose robots were out of reach for no longer than this goes on by itself. After that, people may have stepped
    /// on the floor, and the operator says that it goes on.
    pub goes_on_within: Span,
}

/// When robots that do not report age.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ageing {
    /// A robot that has not reported for longer is stale: it takes no part in a new run, but is driven around.
    pub stale_after: Span,
    /// A robot that has not reported for longer is gone: it is not driven around any more.
    pub gone_after: Span,
}

/// How routes are sent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UploadLimits {
    /// A route that was not acknowledged for this long is sent again.
    pub resend_after: Span,
    /// How often a route is sent before its robot drops out.
    pub tries: u32,
    /// Most routes that are sent and not acknowledged.
    pub window: usize,
}

impl Config {
    /// Whether a robot may take part in runs.
    pub(crate) fn admits(&self, robot: RobotId) -> bool {
        self.admitted.as_ref().is_none_or(|names| names.contains(&robot))
    }
}

impl Default for Config {
    fn default() -> Self {
        Self {
            seq_base: 1,
            arrival_tolerance_m: 0.02,
            robots_max: 20_000,
            admitted: None,
            ageing: Ageing { stale_after: Span::from_millis(6_000), gone_after: Span::from_millis(30_000) },
            start_lead: Span::from_millis(240),
            upload: UploadLimits { resend_after: Span::from_millis(250), tries: 12, window: 1_024 },
            silence: Span::from_millis(1_500),
            late: LateBounds { off_m: 0.012, wait: Span::from_millis(4_000) },
            waits: WaitBounds {
                plan: Span::from_millis(120_000),
                outage: Span::from_millis(300_000),
                goes_on_within: Span::from_millis(30_000),
            },
            light_tolerance: Tolerance::SIDE_BY_SIDE,
            lamp: LampSettings::default(),
        }
    }
}
