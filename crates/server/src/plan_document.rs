//! Plans as JSON: for the screen, for `check` and for `plan`.

use std::time::{Duration, Instant};

use lightbots_api as api;
use lightbots_base::Vec2;
use lightbots_plan::{Cancelled, ShowOptions, ShowPlan, Transition};
use lightbots_show::{Issue, Issues, Severity, Show, front_rows, robots_needed};

use crate::numbers::rounded;
use crate::threads::Threads;

/// Plans a show from its starting places. `found` is what reading and validating it showed.
pub fn plan(show: &Show, found: &Issues) -> (ShowPlan, api::Plan) {
    // It is never given up.
    plan_unless(show, found, &|| false).unwrap_or_default()
}

/// The same, given up as soon as `is_wanted` says so.
pub fn plan_unless(
    show: &Show,
    found: &Issues,
    is_wanted: &dyn Fn() -> bool,
) -> Result<(ShowPlan, api::Plan), Cancelled> {
    let began = Instant::now();
    let starts = starts(show);
    let plan = lightbots_plan::show_with(&Threads, show, &starts, &ShowOptions::default(), is_wanted)?;
    let plan_ms = began.elapsed().as_secs_f64() * 1e3;
    let document = document(&plan, merge(found, &plan.issues), plan_ms);
    Ok((plan, document))
}

/// What is said of a show whose planning took too long: no part of a plan.
pub fn cut_off(found: &Issues, budget: Duration) -> api::Plan {
    let message = format!(
        "planning took longer than {} s and was cut off: check the show on the command line, make it smaller, or start \
         lightbots with a longer --plan-budget",
        budget.as_secs()
    );
    let issues = found.iter().chain([&Issue::error("planning-cut-off", message)]).map(issue).collect();
    api::Plan { issues, ..api::Plan::default() }
}

/// Where the robots of a show wait.
pub fn starts(show: &Show) -> Vec<Vec2> {
    show.starts.clone().unwrap_or_else(|| front_rows(&show.stage, robots_needed(show)))
}

/// The same without the paths, for the WebSocket.
pub fn summary(plan: &api::Plan) -> api::Plan {
    let transitions = plan.transitions.iter().map(|transition| api::Transition {
        from: transition.from,
        to: transition.to,
        duration_s: transition.duration_s,
        least_s: transition.least_s,
        lower_bound_s: transition.lower_bound_s,
        closest_m: transition.closest_m,
        stop_safe: transition.stop_safe,
        pixels: Vec::new(),
        paths: Vec::new(),
    });
    api::Plan { transitions: transitions.collect(), issues: plan.issues.clone(), ..*plan }
}

/// An issue as the screen reads it.
pub fn issue(issue: &Issue) -> api::Issue {
    api::Issue {
        code: issue.code.clone(),
        severity: match issue.severity {
            Severity::Note => api::Severity::Note,
            Severity::Warning => api::Severity::Warning,
            Severity::Error => api::Severity::Error,
        },
        frame: issue.frame,
        pixels: issue.pixels.clone(),
        message: issue.message.clone(),
    }
}

fn document(plan: &ShowPlan, issues: Issues, plan_ms: f64) -> api::Plan {
    let transitions = plan.transitions.iter().enumerate();
    api::Plan {
        revision: 0,
        planning: false,
        ok: !issues.iter().any(Issue::is_error),
        duration_s: rounded(plan.duration_s, 3),
        lower_bound_s: rounded(plan.lower_bound_s, 3),
        closest_m: plan.closest.as_ref().map(|closest| rounded(closest.closest.distance_m, 5)),
        stop_safe: share(plan.stop_safe_share()),
        plan_ms: rounded(plan_ms, 3),
        issues: issues.iter().map(issue).collect(),
        transitions: transitions.map(|(index, way)| transition(index, way, plan)).collect(),
    }
}

/// A share of moments, rounded down: 1 means all of them.
pub fn share(share: f64) -> f64 {
    (share * 1e5 + 1e-6).floor() / 1e5
}

fn transition(index: usize, way: &Transition, plan: &ShowPlan) -> api::Transition {
    api::Transition {
        from: index.checked_sub(1),
        to: index,
        duration_s: rounded(way.duration.as_secs(), 3),
        least_s: rounded(way.least.as_secs(), 3),
        lower_bound_s: rounded(way.lower_bound_s, 3),
        closest_m: way.closest.as_ref().map(|closest| rounded(closest.distance_m, 5)),
        stop_safe: plan.stop_safety.get(index).map_or(1.0, |safety| share(safety.share())),
        pixels: plan.mapping.get(index).cloned().unwrap_or_default(),
        paths: way.paths.iter().map(path).collect(),
    }
}

fn path(path: &lightbots_plan::Path) -> api::Path {
    let metres = |value: f64| rounded(value, 5);
    let piece = |piece: &lightbots_base::Piece| {
        let [c1, c2, end] = [piece.c1, piece.c2, piece.end].map(|at| [metres(at.x), metres(at.y)]);
        [rounded(piece.duration.as_secs(), 6), c1[0], c1[1], c2[0], c2[1], end[0], end[1]]
    };
    api::Path {
        start: [metres(path.start.x), metres(path.start.y)],
        pieces: path.pieces.iter().map(piece).collect(),
    }
}

/// What was found before planning, then what planning adds: it repeats some of it in other words.
fn merge(found: &Issues, planned: &Issues) -> Issues {
    let known = |issue: &Issue| {
        found.contains(issue)
            || found.iter().any(|other| {
                other.is_error()
                    && issue.frame.is_some()
                    && other.frame == issue.frame
                    && (issue.pixels.is_empty() || other.pixels.iter().any(|id| issue.pixels.contains(id)))
            })
    };
    found.iter().chain(planned.iter().filter(|issue| !known(issue))).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_validation_said_is_not_said_again() {
        let found = vec![Issue::error("pixels-touch", "a").in_frame(1).with_pixels([3, 4])];
        let planned = vec![
            Issue::error("too-close", "b").in_frame(1).with_pixels([4, 3]),
            Issue::error("no-plan", "c").in_frame(2),
        ];
        let merged = merge(&found, &planned);
        assert_eq!(merged.iter().map(|issue| issue.message.as_str()).collect::<Vec<_>>(), ["a", "c"]);
    }

    #[test]
    fn a_summary_has_no_paths_but_all_numbers() {
        let show =
            lightbots_exchange::read(br#"[{"name":"A","airTime":1.0,"pixels":[]}]"#, None).unwrap().show;
        let (_, full) = plan(&show, &Vec::new());
        let summary = summary(&full);
        assert_eq!(summary.duration_s, full.duration_s);
        assert!(summary.transitions.iter().all(|transition| transition.paths.is_empty()));
    }
}
