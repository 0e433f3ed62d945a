//! Settings that a controller gets at its start.

use lightbots_base::{RobotId, Span};
use lightbots_lighting::{LampSettings, Tolerance};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Bounds and tolerances of a controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Config {
    /// Number of the first route or stretch of light; later numbers count up from it. 0 counts as 1. A restarted
    /// controller must not reuse numbers. So derive this one from the time of day (8 times the seconds since 1970,
    /// modulo 2³², will do).
    pub seq_base: u32,
    /// Largest distance between a robot and its goal, along x and along y, at which the robot counts as arrived,
    /// metres.
    pub arrival_tolerance_m: f64,
    /// Largest number of robots in the fleet. Reports of further robots are counted and dropped. Robots of a run that
    /// is taken up are added in any case.
    pub robots_max: usize,
    /// Names of the robots that may take part in runs; `None` admits all robots.
    pub admitted: Option<BTreeSet<RobotId>>,
    /// Durations of silence after which robots are stale, and gone.
    pub ageing: Ageing,
    /// Least time between sending a START and the moment at which robots start. The controller adds 20 µs per robot,
    /// and more on slow links and after lost answers.
    pub start_lead: Span,
    /// Limits for sending routes.
    pub upload: UploadLimits,
    /// Time without reports after which a driving robot may drop out of the run. Round trips of the link come on top,
    /// and on drives by TARGET it is four times as long. If many robots fall silent at once, the run is interrupted
    /// instead.
    pub silence: Span,
    /// Bounds for robots that are behind the planned places on their paths.
    pub late: LateBounds,
    /// Longest times for which a run waits.
    pub waits: WaitBounds,
    /// Largest deviation of a robot's light from the colours that layers of light give it. It is exceeded where one
    /// message has no room for enough detail.
    pub light_tolerance: Tolerance,
    /// Correction for the fleet's lamps, applied to colours that are sent to robots. Other colours, such as those of
    /// snapshots, are not corrected.
    pub lamp: LampSettings,
}

/// Bounds for robots that are behind the planned places on their paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LateBounds {
    /// Distance from its planned place above which a late robot makes all robots wait, metres. In legs with much
    /// clearance the bound is larger.
    pub off_m: f64,
    /// How long all robots wait for a late robot after it last made progress. Then the late robot drops out, and the
    /// others are planned around it. On drives by TARGET it is twice as long.
    pub wait: Span,
}

/// Longest times for which a run waits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaitBounds {
    /// Longest wait of standing robots for a plan; then the run fails.
    pub plan: Span,
    /// Longest wait for the broker, for silent robots, or for the first acknowledgement of any sent route; then the run
    /// fails.
    pub outage: Span,
    /// Longest interruption after which a run goes on by itself. After a longer one the operator has to agree, because
    /// people may have stepped on the floor.
    pub goes_on_within: Span,
}

/// Durations of silence after which robots are stale, and gone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ageing {
    /// Silence after which a robot is stale: it takes no part in a new run, but plans drive around it.
    pub stale_after: Span,
    /// Silence after which a robot is gone: plans no longer drive around it, unless it is a robot of the present run.
    pub gone_after: Span,
}

/// Limits for sending routes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UploadLimits {
    /// Least time without acknowledgement after which a route is sent again; on slow links the time is longer.
    pub resend_after: Span,
    /// How many times a route is sent without acknowledgement before its robot drops out. While the link itself seems
    /// to fail, the route is sent more often.
    pub tries: u32,
    /// Largest number of routes, and also of stretches of light, that are sent and not yet acknowledged.
    pub window: usize,
}

impl Config {
    /// Whether `admitted` lets a robot take part in runs.
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
