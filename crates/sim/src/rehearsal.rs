//! A whole show in virtual time: the real controller core, the real robot cores, simulated bodies and networks.

use std::sync::Arc;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_plan::{Path, ShowOptions, ShowPlan};
use lightbots_show::{Issue, Show, front_rows, robots_needed};

use crate::conditions::Conditions;
use crate::play::Play;
use crate::report::RehearsalReport;
use crate::statistics::Spread;

/// How a show is rehearsed.
#[derive(Clone, Debug, PartialEq)]
pub struct RehearsalOptions {
    /// The seed of everything that chance decides.
    pub seed: u64,
    /// What robots and networks suffer.
    pub conditions: Conditions,
    /// How many robots there are; `None`: as many as the show needs, or as it has starts.
    pub robots: Option<usize>,
}

/// How far a rehearsal is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress<'a> {
    /// The show is being planned, or planned again after something went wrong.
    Planning,
    /// It plays, again after planning too: so that callers can time the two apart.
    Playing {
        /// Virtual time since robots were switched on, seconds.
        at_s: f64,
        /// How long the show is planned to take, seconds.
        planned_s: f64,
        /// Frames that stood so far.
        frames: usize,
    },
    /// Robots are about to leave, or have just left.
    Departing {
        /// The frame they drive to, counted from 0.
        frame: usize,
        /// When they leave, seconds after the first departure of the show; holds delay what follows.
        begins_s: f64,
        /// `(robot, its path)`, of the robots that drive paths. The plan of a rehearsal begins where robots report to be,
        /// so that it differs from seed to seed.
        paths: &'a [(usize, &'a Path)],
    },
}

/// The most robots a rehearsal has.
pub const ROBOTS_MAX: usize = 20_000;

impl Default for RehearsalOptions {
    /// Seed 1, standard conditions, as many robots as the show needs.
    fn default() -> Self {
        Self { seed: 1, conditions: Conditions::default(), robots: None }
    }
}

/// Plays a whole show in virtual time and says how it went. The same show, options and version give the same report to
/// the bit. `progress` is told about every second of virtual time; it must not change anything.
pub fn rehearse(
    show: &Show,
    options: &RehearsalOptions,
    progress: &mut dyn FnMut(Progress<'_>),
) -> RehearsalReport {
    progress(Progress::Planning);
    let robots = options.robots.unwrap_or_else(|| usual_robots(show));
    if robots == 0 || robots > ROBOTS_MAX || show.frames.is_empty() {
        let message = match (show.frames.is_empty(), robots) {
            (true, _) => "The show has no frames: add one.".into(),
            (_, 0) => "There are no robots to rehearse with: the show has no pixels.".into(),
            _ => format!("{robots} robots are more than the {ROBOTS_MAX} a rehearsal can have."),
        };
        return unplayed(show, options, robots, vec![Issue::error("nothing-to-rehearse", message)]);
    }
    let starts = starts(show, robots);
    let mut issues = lightbots_show::validate(show);
    let plan = lightbots_plan::show(show, &starts, &ShowOptions::default());
    add_new(&mut issues, &plan);
    if issues.iter().any(Issue::is_error) {
        let lower_bound_s = plan.lower_bound_s;
        return RehearsalReport { lower_bound_s, ..unplayed(show, options, robots, issues) };
    }
    let names = names(&plan, starts.len());
    let play = Play::new(Arc::new(show.clone()), &starts, &names, options, plan.duration_s);
    let mut report = play.run(progress);
    report.lower_bound_s = plan.lower_bound_s;
    issues.append(&mut report.issues);
    report.issues = issues;
    report
}

/// As many as the show needs; where it says where more robots start, those are there as well.
fn usual_robots(show: &Show) -> usize {
    robots_needed(show).max(show.starts.as_ref().map_or(0, Vec::len))
}

/// `[robot]`: the name by which pixels ask for it, so that who is bound to a pixel takes part.
fn names(plan: &ShowPlan, robots: usize) -> Vec<Option<RobotId>> {
    let mut names = vec![None; robots];
    for (name, &robot) in &plan.names {
        names[robot] = RobotId::new(name);
    }
    names
}

/// Where the show says robots start, in rows along the front edge where it does not or says too few.
fn starts(show: &Show, robots: usize) -> Vec<Vec2> {
    match &show.starts {
        Some(starts) if starts.len() >= robots => starts[..robots].to_vec(),
        _ => front_rows(&show.stage, robots),
    }
}

/// Adds what the plan found and the show's own check did not.
fn add_new(issues: &mut Vec<Issue>, plan: &ShowPlan) {
    for issue in &plan.issues {
        if !issues.contains(issue) {
            issues.push(issue.clone());
        }
    }
}

/// The report of a show that was not played.
fn unplayed(show: &Show, options: &RehearsalOptions, robots: usize, issues: Vec<Issue>) -> RehearsalReport {
    RehearsalReport {
        ok: false,
        robots,
        frames_played: 0,
        frames: show.frames.len(),
        duration_s: 0.0,
        planned_s: 0.0,
        lower_bound_s: 0.0,
        contacts: 0,
        contacts_after_replan: 0,
        replans: 0,
        wall_contacts: 0,
        wall_pressed_m: 0.0,
        brakes: Default::default(),
        closest_m: None,
        arrival_spread_s: Spread::default(),
        position_error_m: Spread::default(),
        estimate_error_m: Spread::default(),
        tracking_error_m: Spread::default(),
        clock_spread_s: Spread::default(),
        messages: Default::default(),
        dropouts: 0,
        seed: options.seed,
        state_hash: format!("{:016x}", crate::StateHash::new().finish()),
        real_time_factor: None,
        issues,
        per_frame: Vec::new(),
    }
}

/// How long a rehearsal may take at most, of virtual time: many times the plan, as recovery takes time.
pub(crate) fn time_limit(planned_s: f64) -> Instant {
    Instant::ZERO + Span::from_secs(60.0 + 5.0 * planned_s.clamp(0.0, 1e6))
}
