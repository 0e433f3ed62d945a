//! Plans a whole show. Transition 0 leads from the places of the robots to frame 0, and transition k from frame k − 1
//! to frame k.

mod issues;
#[cfg(test)]
mod tests;

use crate::cancel::{Cancel, Cancelled, unless};
use crate::problem::ASKED_SLACK_S;
use crate::proof::stop_safe::{StopSafety, UnsafeMoment};
use crate::raise::raised;
use crate::transition::attempt;
use crate::workers::{OneThread, Workers};
use crate::{Bindings, Closest, Explanation, Transition, TransitionProblem};
use lightbots_base::Vec2;
use lightbots_show::{Frame, Identity, Issue, Issues, Show, validate};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Options for planning a show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShowOptions {
    /// Overrides the identity setting of the show and of all frames: whether a pixel id is the same robot in every
    /// frame. `None` keeps the setting.
    pub identity: Option<Identity>,
    /// `robots[start]`: name of the robot at that start, for pixels that ask for a robot by name. Empty if names are
    /// not known yet. The planner then chooses one robot for each name, for all frames.
    pub robots: Vec<String>,
    /// For previews: stop-safety is neither raised nor measured, and absolute times of frames are not checked. The
    /// paths are still proven.
    pub as_preview: bool,
}

/// The plan of a show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShowPlan {
    /// `transitions[k]` leads to frame k. Empty if the show has validation errors. If `issues` has any other error,
    /// transitions are for drawing only, because not all are proven.
    pub transitions: Vec<Transition>,
    /// `mapping[k][robot]`: id of the pixel that the robot shows in frame k; `None` if the robot shows none.
    pub mapping: Vec<Vec<Option<u32>>>,
    /// Names of robots, given by the options or chosen by the planner; each value is the index of the robot.
    pub names: BTreeMap<String, usize>,
    /// Problems of the show and its plan. If one of them is an error, the plan must not be played.
    pub issues: Issues,
    /// Duration of the show, seconds: the sum of all transitions and air times.
    pub duration_s: f64,
    /// Lower bound of `duration_s`, seconds: the sum of the transitions' lower bounds and all air times.
    pub lower_bound_s: f64,
    /// The closest approach of two centres in the whole show; `None` if no transition has one.
    pub closest: Option<ShowClosest>,
    /// `stop_safety[k]`: the moments of transition k at which robots must not stop dead, because another robot would
    /// touch them. Empty for a preview. A transition that must not be driven has no moments.
    pub stop_safety: Vec<StopSafety>,
    /// `explanations[k]`: the solvers that ran for transition k, and why its plan was chosen.
    pub explanations: Vec<Explanation>,
}

/// The closest approach of two centres in a show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShowClosest {
    /// Index of the transition in which they are closest.
    pub transition: usize,
    /// The two robots, their distance, place and moment.
    pub closest: Closest,
}

impl ShowPlan {
    /// Whether the plan may be played: none of its issues is an error.
    pub fn ok(&self) -> bool {
        !self.issues.iter().any(Issue::is_error)
    }

    /// Share of the sampled moments of driving robots at which they may stop dead without a contact, 0 to 1. It is 1 if
    /// stop-safety was not measured.
    pub fn stop_safe_share(&self) -> f64 {
        let sum = |count: fn(&StopSafety) -> usize| self.stop_safety.iter().map(count).sum::<usize>();
        1.0 - sum(|safety| safety.unsafe_moments.len()) as f64 / sum(|safety| safety.moments).max(1) as f64
    }

    /// Returns the unsafe moment with the greatest `missing_m`, and the index of its transition. `None` if all moments
    /// are safe.
    pub fn least_stop_safe(&self) -> Option<(usize, &UnsafeMoment)> {
        let worst = self.stop_safety.iter().enumerate();
        let worst = worst.filter_map(|(transition, safety)| Some((transition, safety.worst()?)));
        worst.reduce(|worst, one| if one.1.missing_m > worst.1.missing_m { one } else { worst })
    }
}

/// Plans a show for robots at `starts` (stage metres). Planning always returns a plan: a frame without a legal drive
/// becomes an issue. A show in which [`validate`] finds errors is not planned; the issues of its plan are these errors.
pub fn show(show: &Show, starts: &[Vec2], options: &ShowOptions) -> ShowPlan {
    planned(show, starts, options, &OneThread, Cancel::NEVER)
}

/// [`show`], cancelled once `is_wanted` returns `true`. `is_wanted` is called at least about every tenth of a second,
/// mostly far more often, on the calling thread. It must be cheap.
pub fn show_unless(
    show: &Show,
    starts: &[Vec2],
    options: &ShowOptions,
    is_wanted: &dyn Fn() -> bool,
) -> Result<ShowPlan, Cancelled> {
    show_with(&OneThread, show, starts, options, is_wanted)
}

/// [`show_unless`] with `workers`, which may measure and raise the stop-safety of several drives at the same time. The
/// drives are planned one after the other on the calling thread. The plan is the same, bit for bit, for any number of
/// threads.
pub fn show_with(
    workers: &dyn Workers,
    show: &Show,
    starts: &[Vec2],
    options: &ShowOptions,
    is_wanted: &dyn Fn() -> bool,
) -> Result<ShowPlan, Cancelled> {
    unless(is_wanted, |cancel| planned(show, starts, options, workers, cancel))
}

fn planned(
    show: &Show,
    starts: &[Vec2],
    options: &ShowOptions,
    workers: &dyn Workers,
    cancel: Cancel<'_>,
) -> ShowPlan {
    let issues: Issues = validate(show).into_iter().filter(Issue::is_error).collect();
    if !issues.is_empty() {
        return ShowPlan { issues, ..ShowPlan::default() };
    }
    whole(show, starts, options, workers, cancel)
}

/// Plans a show that has no validation errors.
fn whole(
    show: &Show,
    starts: &[Vec2],
    options: &ShowOptions,
    workers: &dyn Workers,
    cancel: Cancel<'_>,
) -> ShowPlan {
    let (mut plan, drives) = chained(show, starts, options, cancel);
    if options.as_preview {
        for (frame, drive) in show.frames.iter().zip(drives) {
            plan.take(drive.transition, drive.shown, frame);
        }
        return plan;
    }
    let raised = all_raised(drives, workers, cancel);
    for (frame, (shown, transition, safety)) in show.frames.iter().zip(raised) {
        plan.take(transition, shown, frame);
        plan.stop_safety.push(safety);
    }
    issues::of_nails(show, &plan.transitions, &mut plan.issues);
    plan
}

/// The planned drive to a frame, before its stop-safety is raised.
struct Drive {
    problem: TransitionProblem,
    transition: Transition,
    is_infeasible: bool,
    /// `[robot]`: id of the pixel that the robot shows; `None` if it shows none.
    shown: Vec<Option<u32>>,
}

/// Raises and measures the stop-safety of all drives. The ends of paths stay the same, so each drive is an independent
/// task. Returns for each drive what its robots show, its transition and its stop-safety.
fn all_raised(
    drives: Vec<Drive>,
    workers: &dyn Workers,
    cancel: Cancel<'_>,
) -> Vec<(Vec<Option<u32>>, Transition, StopSafety)> {
    let slots: Vec<Mutex<(Drive, StopSafety)>> =
        drives.into_iter().map(|drive| Mutex::new((drive, StopSafety::default()))).collect();
    workers.each(slots.len(), &|| cancel.is_wanted(), &|index, is_wanted| {
        // Each slot belongs to a single task, so no other task can poison its lock.
        let mut slot = slots[index].lock().unwrap_or_else(PoisonError::into_inner);
        let (drive, safety) = &mut *slot;
        if !drive.is_infeasible {
            *safety = raised(&drive.problem, &mut drive.transition, Cancel::when(is_wanted));
        }
    });
    let done = slots.into_iter().map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner));
    done.map(|(drive, safety)| (drive.shown, drive.transition, safety)).collect()
}

/// Plans the drives of a show that has no validation errors, each from the end of the drive before it. The stop-safety
/// of the drives is not raised yet. The returned plan has issues, names and explanations, but not the drives.
fn chained(
    show: &Show,
    starts: &[Vec2],
    options: &ShowOptions,
    cancel: Cancel<'_>,
) -> (ShowPlan, Vec<Drive>) {
    let mut plan = ShowPlan::default();
    let mut drives = Vec::with_capacity(show.frames.len());
    let mut places = starts.to_vec();
    let mut bindings = bindings(starts.len(), options);
    issues::of_names(show, starts.len(), &bindings, &mut plan.issues);
    for (index, frame) in show.frames.iter().enumerate() {
        if cancel.is_wanted() {
            break;
        }
        let found_before = plan.issues.len();
        let identity = options.identity.or(frame.identity).unwrap_or(show.identity);
        let bound = bindings.bind(&frame.pixels, identity, &places, |_| false);
        issues::of_frame(show, index, starts.len(), &bound.dark, &mut plan.issues);
        issues::of_bound_frame(show, index, &bound, &mut plan.issues);
        let problem = TransitionProblem::of_frame(show, index, places, &bound);
        let attempt = attempt(&problem, cancel);
        let is_infeasible = attempt.infeasible.is_some();
        if let Some(why) = attempt.not_as_prescribed {
            plan.issues.push(issues::not_as_prescribed(show, index, why));
        }
        plan.explanations.push(attempt.explanation);
        if let Some(infeasible) = attempt.infeasible
            && !plan.issues[found_before..].iter().any(Issue::is_error)
        {
            plan.issues.push(issues::no_plan(show, index, &bound.pixels, &infeasible));
        }
        let transition = attempt.transition;
        let takes_s = transition.duration.as_secs();
        if let Some(asked_s) =
            frame.transition_s.filter(|&asked_s| asked_s >= 0.0 && takes_s > asked_s + ASKED_SLACK_S)
        {
            plan.issues.push(issues::takes_longer(show, index, asked_s, takes_s));
        }
        let shown: Vec<Option<u32>> =
            transition.goal_of.iter().map(|goal| goal.map(|goal| bound.pixels[goal].id)).collect();
        bindings.remember(&bound, &transition.goal_of);
        places = transition.paths.iter().map(|path| path.as_ref().end()).collect();
        drives.push(Drive { problem, transition, is_infeasible, shown });
    }
    plan.names = bindings.by_name;
    (plan, drives)
}

fn bindings(robots: usize, options: &ShowOptions) -> Bindings {
    let names = options.robots.iter().take(robots).enumerate();
    Bindings {
        by_name: names.map(|(robot, name)| (name.clone(), robot)).collect(),
        names_known: !options.robots.is_empty(),
        ..Bindings::default()
    }
}

impl ShowPlan {
    fn take(&mut self, transition: Transition, shown: Vec<Option<u32>>, frame: &Frame) {
        let air_s = if frame.air_time_s.is_finite() { frame.air_time_s.max(0.0) } else { 0.0 };
        self.duration_s += transition.duration.as_secs() + air_s;
        self.lower_bound_s += transition.lower_bound_s + air_s;
        if let Some(closest) = transition.closest
            && self.closest.is_none_or(|known| closest.distance_m < known.closest.distance_m)
        {
            self.closest = Some(ShowClosest { transition: self.transitions.len(), closest });
        }
        self.transitions.push(transition);
        self.mapping.push(shown);
    }
}
