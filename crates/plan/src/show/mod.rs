//! Plans a whole show: transition 0 from the places of the robots, then frame after frame.

mod issues;
#[cfg(test)]
mod tests;

use crate::cancel::{Cancel, Cancelled, unless};
use crate::proof::stop_safe::{StopSafety, UnsafeMoment};
use crate::raise::raised;
use crate::transition::attempt;
use crate::{Bindings, Closest, Explanation, Transition, TransitionProblem};
use lightbots_base::Vec2;
use lightbots_show::{Frame, Identity, Issue, Issues, Show, validate};
use std::collections::BTreeMap;

/// Options of a plan beside the show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShowOptions {
    /// Overrides the identity of the show and its frames.
    pub identity: Option<Identity>,
    /// `robots[start]`: name of the robot there, for pixels that ask for a robot by name. Empty where names are not
    /// known yet: then each name means some robot, the same in every frame.
    pub robots: Vec<String>,
}

/// The plan of a show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShowPlan {
    /// `transitions[k]` leads to frame k; empty where the show has errors. With an error among `issues` they are
    /// drawings, not proven.
    pub transitions: Vec<Transition>,
    /// `mapping[k][robot]`: id of the pixel that robot shows in frame k; `None`: it is spare.
    pub mapping: Vec<Vec<Option<u32>>>,
    /// The robot that each name means.
    pub names: BTreeMap<String, usize>,
    /// Issues. With an error among them the plan must not be played.
    pub issues: Issues,
    /// Transitions and air times, seconds.
    pub duration_s: f64,
    /// The lower bounds of the transitions, and the air times, seconds.
    pub lower_bound_s: f64,
    /// The closest two centres of the whole show.
    pub closest: Option<ShowClosest>,
    /// `stop_safety[k]`: at which moments of transition k robots may stop dead.
    pub stop_safety: Vec<StopSafety>,
    /// `explanations[k]`: the solvers that ran for transition k, and why its plan was chosen.
    pub explanations: Vec<Explanation>,
}

/// The closest two centres of a show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShowClosest {
    /// Index of the transition.
    pub transition: usize,
    /// The two robots, place and moment.
    pub closest: Closest,
}

impl ShowPlan {
    /// Whether it may be played.
    pub fn ok(&self) -> bool {
        !self.issues.iter().any(Issue::is_error)
    }

    /// The share of all moments at which robots that drive may stop dead, 0 to 1.
    pub fn stop_safe_share(&self) -> f64 {
        let sum = |count: fn(&StopSafety) -> usize| self.stop_safety.iter().map(count).sum::<usize>();
        1.0 - sum(|safety| safety.unsafe_moments.len()) as f64 / sum(|safety| safety.moments).max(1) as f64
    }

    /// The transition and moment at which a dead robot leaves another least room to stop.
    pub fn least_stop_safe(&self) -> Option<(usize, &UnsafeMoment)> {
        let worst = self.stop_safety.iter().enumerate();
        let worst = worst.filter_map(|(transition, safety)| Some((transition, safety.worst()?)));
        worst.reduce(|worst, one| if one.1.missing_m > worst.1.missing_m { one } else { worst })
    }
}

/// Plans a show for robots at `starts` (stage metres). It never fails: an impossible frame is an issue. A show in
/// which [`validate`] finds errors is not planned; its errors are the issues.
pub fn show(show: &Show, starts: &[Vec2], options: &ShowOptions) -> ShowPlan {
    planned(show, starts, options, Cancel::NEVER)
}

/// [`show`], cancelled as soon as `is_wanted` says so. It is asked about every tenth of a second from this thread, and
/// must be cheap.
pub fn show_unless(
    show: &Show,
    starts: &[Vec2],
    options: &ShowOptions,
    is_wanted: &dyn Fn() -> bool,
) -> Result<ShowPlan, Cancelled> {
    unless(is_wanted, |cancel| planned(show, starts, options, cancel))
}

fn planned(show: &Show, starts: &[Vec2], options: &ShowOptions, cancel: Cancel<'_>) -> ShowPlan {
    let issues: Issues = validate(show).into_iter().filter(Issue::is_error).collect();
    if !issues.is_empty() {
        return ShowPlan { issues, ..ShowPlan::default() };
    }
    chained(show, starts, options, cancel)
}

/// The plan of a show without errors.
fn chained(show: &Show, starts: &[Vec2], options: &ShowOptions, cancel: Cancel<'_>) -> ShowPlan {
    let mut plan = ShowPlan::default();
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
        let problem = TransitionProblem::of_frame(&show.stage, frame, places, &bound);
        let mut attempt = attempt(&problem, cancel);
        let safety = match attempt.infeasible {
            None => raised(&problem, &mut attempt.transition, cancel),
            Some(_) => StopSafety::default(),
        };
        plan.stop_safety.push(safety);
        plan.explanations.push(attempt.explanation);
        if let Some(infeasible) = attempt.infeasible
            && !plan.issues[found_before..].iter().any(Issue::is_error)
        {
            plan.issues.push(issues::no_plan(show, index, &bound.pixels, &infeasible));
        }
        let transition = attempt.transition;
        let takes_s = transition.duration.as_secs();
        if let Some(asked_s) =
            frame.transition_s.filter(|&asked_s| asked_s >= 0.0 && takes_s > asked_s + 5e-3)
        {
            plan.issues.push(issues::takes_longer(show, index, asked_s, takes_s));
        }
        let shown: Vec<Option<u32>> =
            transition.goal_of.iter().map(|goal| goal.map(|goal| bound.pixels[goal].id)).collect();
        bindings.remember(&bound, &transition.goal_of);
        places = transition.paths.iter().map(|path| path.as_ref().end()).collect();
        plan.take(transition, shown, frame);
    }
    plan.names = bindings.by_name;
    plan
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
