//! The fault campaign: a seed chooses a show and a series of faults. The invariants must hold in spite of these faults.
//! docs/campaign.md describes the campaign.

mod invariants;
mod route_watch;
mod scene;
mod story;

use core::fmt;
use std::sync::Arc;

use lightbots_base::{Instant, Span};
use lightbots_plan::ShowOptions;

use crate::options::{Progress, RehearsalOptions};
use crate::play::Play;
use crate::report::RehearsalReport;

pub(crate) use invariants::Invariants;
pub use invariants::Violation;
pub use scene::Scene;
pub use story::Story;

/// Part of the time limit of a run: time from the moment robots are switched on until the first departure, seconds. On
/// a slow link, robots need half a minute to find the controller and set their clocks.
const BEGINS_WITHIN_S: f64 = 42.0;
/// Time that recovery from a fault may take after the fault has ended, seconds. It is enough to notice a silent robot,
/// to plan three times, and to gather robots after each plan.
const RECOVERS_WITHIN_S: f64 = 40.0;
/// Each fault may cost this multiple of the show's planned duration in addition (`control/src/run/recovery_bound.rs`).
const REPLAYS: f64 = 2.0;

/// Only seeds that are multiples of this number have the log of their first controller replayed. A replay costs as much
/// as planning the show once more.
const REPLAYED: u64 = 4;

/// One seed of the campaign, played.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// The seed.
    pub seed: u64,
    /// Its show and robots.
    pub scene: Scene,
    /// Its faults.
    pub story: Story,
    /// Violations of the invariants, and the difference that a replay of the log found, if any.
    pub violations: Vec<Violation>,
    /// How the show went.
    pub report: RehearsalReport,
}

impl Campaign {
    /// Plays the campaign of `seed` with `robots` robots; `None`: the seed decides how many.
    pub fn play(seed: u64, robots: Option<usize>) -> Self {
        let scene = Scene::new(seed, robots);
        let story = Story::new(seed, &scene);
        let options = RehearsalOptions { seed, conditions: story.conditions(), robots };
        let starts = scene.show.starts.clone().unwrap_or_default();
        let plan = lightbots_plan::show(&scene.show, &starts, &ShowOptions::default());
        let mut play = Play::new(Arc::new(scene.show.clone()), &starts, &[], &options, plan.duration_s);
        let watched = Invariants::new(scene.robots, story.originals(), limit(plan.duration_s, &story));
        play.invariants =
            Some(Box::new(if story.loses_messages() { watched.on_a_bad_link() } else { watched }));
        let mut log = Vec::new();
        let notes = seed.is_multiple_of(REPLAYED).then(Vec::new);
        play.play(notes, &mut |progress| {
            if let Progress::Logged(bytes) = progress {
                log.extend_from_slice(bytes);
            }
        });
        let mut violations = play.invariants.take().map_or(Vec::new(), |watch| watch.into_violations());
        violations.extend(differences(&log));
        Self { seed, scene, story, violations, report: play.report() }
    }

    /// Whether no invariant was violated.
    pub fn is_fine(&self) -> bool {
        self.violations.is_empty()
    }
}

/// Replays a log of the controller. Returns the first difference between replay and log, or why the log cannot be
/// replayed. `None` if there is no difference, or the log is empty.
fn differences(log: &[u8]) -> Option<Violation> {
    if log.is_empty() {
        return None;
    }
    let (at, what) = match lightbots_control::replay(log, &mut |_| {}) {
        Ok(report) => {
            let difference = report.difference?;
            (difference.at, format!("input {}, {}, had other outputs", difference.input, difference.what))
        }
        Err(error) => (Instant::ZERO, format!("{error:?}")),
    };
    Some(Violation { at, invariant: "replay", what })
}

/// Virtual time by which a show with the faults of `story` must be over. `planned_s`: planned duration of the show,
/// seconds.
fn limit(planned_s: f64, story: &Story) -> Instant {
    let for_faults_s = story.count() as f64 * (RECOVERS_WITHIN_S + REPLAYS * planned_s);
    Instant::ZERO + Span::from_secs(BEGINS_WITHIN_S + 2.0 * planned_s + for_faults_s) + story.lasts()
}

impl fmt::Display for Campaign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { seed, scene, story, violations, report } = self;
        let (robots, frames) = (scene.robots, scene.show.frames.len());
        let side_m = scene.show.stage.width_m;
        writeln!(f, "seed {seed}: {robots} robots, {frames} frames on {side_m:.2} m by {side_m:.2} m")?;
        write!(f, "{story}")?;
        for violation in violations {
            writeln!(f, "  VIOLATED {violation}")?;
        }
        for issue in &report.issues {
            writeln!(f, "    {}", issue.message)?;
        }
        write!(f, "  again: cargo xtask simulate --from {seed} --seeds 1 --robots {robots}")
    }
}
