//! A whole show in virtual time: the real controller core and the real robot cores, with simulated bodies and networks.

use std::sync::Arc;

use lightbots_base::{RobotId, Vec2};
use lightbots_plan::{ShowOptions, ShowPlan};
use lightbots_show::{Issue, Show, back_rows, robots_needed};

use crate::light_watch::LightCounts;
use crate::options::{Progress, ROBOTS_MAX, RehearsalOptions};
use crate::play::Play;
use crate::report::RehearsalReport;
use crate::statistics::Spread;

/// Plays a whole show in virtual time and reports the result. The same show, options and version give the same report
/// to the bit. `progress` is called while the show is planned and played. A show that cannot be played gives a report
/// with the reasons in `issues`, and [`RehearsalReport::ok`] is false.
pub fn rehearse(
    show: &Show,
    options: &RehearsalOptions,
    progress: &mut dyn FnMut(Progress<'_>),
) -> RehearsalReport {
    rehearse_with(show, options, None, progress)
}

/// Plays as [`rehearse`] does, and passes the log of the controller's inputs on as [`Progress::Logged`]. A show that is
/// not played has no log. `notes`: pairs of name and value that are written into the log, for people.
pub fn rehearse_recorded(
    show: &Show,
    options: &RehearsalOptions,
    notes: Vec<(String, String)>,
    progress: &mut dyn FnMut(Progress<'_>),
) -> RehearsalReport {
    rehearse_with(show, options, Some(notes), progress)
}

fn rehearse_with(
    show: &Show,
    options: &RehearsalOptions,
    log: Option<Vec<(String, String)>>,
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
    let mut issues = lightbots_lighting::validate(show);
    let plan = lightbots_plan::show(show, &starts, &ShowOptions::default());
    add_new(&mut issues, &plan);
    if issues.iter().any(Issue::is_error) {
        let lower_bound_s = plan.lower_bound_s;
        return RehearsalReport { lower_bound_s, ..unplayed(show, options, robots, issues) };
    }
    let names = names(&plan, starts.len());
    let play = Play::new(Arc::new(show.clone()), &starts, &names, options, plan.duration_s);
    let mut report = play.run(log, progress);
    report.lower_bound_s = plan.lower_bound_s;
    issues.append(&mut report.issues);
    report.issues = issues;
    report
}

/// Number of robots that the show needs, or the number of its starts if that is larger.
fn usual_robots(show: &Show) -> usize {
    robots_needed(show).max(show.starts.as_ref().map_or(0, Vec::len))
}

/// `[robot]`: the name that a robot must have because pixels of the show are bound to this name; `None`: any name.
fn names(plan: &ShowPlan, robots: usize) -> Vec<Option<RobotId>> {
    let mut names = vec![None; robots];
    for (name, &robot) in &plan.names {
        names[robot] = RobotId::new(name);
    }
    names
}

/// The show's first `robots` starts. If the show has fewer starts: the places of [`back_rows`].
fn starts(show: &Show, robots: usize) -> Vec<Vec2> {
    match &show.starts {
        Some(starts) if starts.len() >= robots => starts[..robots].to_vec(),
        _ => back_rows(&show.stage, robots),
    }
}

/// Appends those issues of the plan that `issues` does not contain yet.
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
        lights: LightCounts::default(),
        stop_after_crash_s: None,
        messages: Default::default(),
        dropouts: 0,
        seed: options.seed,
        state_hash: format!("{:016x}", crate::StateHash::new().finish()),
        real_time_factor: None,
        issues,
        per_frame: Vec::new(),
    }
}
