//! The result of the planner as a [`Plan`], which becomes JSON.

use lightbots_plan::ShowPlan;
use lightbots_show as show;
use lightbots_show::Issues;

use crate::{Issue, Path, Plan, Severity, Transition};

/// Returns a plan without its pixels and paths, for the WebSocket.
pub fn plan_summary(plan: &Plan) -> Plan {
    let transitions = plan.transitions.iter().map(|transition| Transition {
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
    Plan { transitions: transitions.collect(), issues: plan.issues.clone(), ..*plan }
}

impl From<&show::Issue> for Issue {
    fn from(issue: &show::Issue) -> Self {
        Self {
            code: issue.code.clone(),
            severity: match issue.severity {
                show::Severity::Note => Severity::Note,
                show::Severity::Warning => Severity::Warning,
                show::Severity::Error => Severity::Error,
            },
            frame: issue.frame,
            pixels: issue.pixels.clone(),
            message: issue.message.clone(),
        }
    }
}

/// Converts the planner's result into the form that the screen and scripts read. `found` has the issues from reading and
/// validating the show. `plan_ms` is the duration of planning, milliseconds.
pub fn plan_document(plan: &ShowPlan, found: &Issues, plan_ms: f64) -> Plan {
    let issues = merge(found, &plan.issues);
    let transitions = plan.transitions.iter().enumerate();
    Plan {
        revision: 0,
        planning: false,
        ok: !issues.iter().any(show::Issue::is_error),
        duration_s: rounded(plan.duration_s, 3),
        lower_bound_s: rounded(plan.lower_bound_s, 3),
        closest_m: plan.closest.as_ref().map(|closest| rounded(closest.closest.distance_m, 5)),
        stop_safe: share(plan.stop_safe_share()),
        plan_ms: rounded(plan_ms, 3),
        issues: issues.iter().map(Issue::from).collect(),
        transitions: transitions.map(|(index, way)| transition(index, way, plan)).collect(),
    }
}

/// Rounds a share, 0 to 1, down to 5 decimals, so that a share below 1 does not become 1.
fn share(share: f64) -> f64 {
    (share * 1e5 + 1e-6).floor() / 1e5
}

fn transition(index: usize, way: &lightbots_plan::Transition, plan: &ShowPlan) -> Transition {
    Transition {
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

fn path(path: &lightbots_plan::Path) -> Path {
    let metres = |value: f64| rounded(value, 5);
    let piece = |piece: &lightbots_base::Piece| {
        let [c1, c2, end] = [piece.c1, piece.c2, piece.end].map(|at| [metres(at.x), metres(at.y)]);
        [rounded(piece.duration.as_secs(), 6), c1[0], c1[1], c2[0], c2[1], end[0], end[1]]
    };
    Path {
        start: [metres(path.start.x), metres(path.start.y)],
        pieces: path.pieces.iter().map(piece).collect(),
    }
}

/// Returns the issues `found` before planning, then those of `planned`, the issues of planning, that are new. An issue of
/// planning is not new if `found` contains it. Nor is it new if `found` has an error about its frame, and about one of its
/// pixels if it names pixels.
fn merge(found: &Issues, planned: &Issues) -> Issues {
    let known = |issue: &show::Issue| {
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

/// Rounds a number to `decimals` decimal places, so that JSON stays readable. Returns infinities and NaN unchanged.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    let factor = 10_f64.powi(decimals);
    let rounded = (value * factor).round() / factor + 0.0;
    if rounded.is_finite() { rounded } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Vec2;
    use lightbots_plan::ShowOptions;

    #[test]
    fn what_validation_said_is_not_said_again() {
        let found = vec![show::Issue::error("pixels-touch", "a").in_frame(1).with_pixels([3, 4])];
        let planned = vec![
            show::Issue::error("too-close", "b").in_frame(1).with_pixels([4, 3]),
            show::Issue::error("no-plan", "c").in_frame(2),
        ];
        let merged = merge(&found, &planned);
        assert_eq!(merged.iter().map(|issue| issue.message.as_str()).collect::<Vec<_>>(), ["a", "c"]);
    }

    #[test]
    fn a_summary_has_no_paths_but_all_numbers() {
        let document = br##"{"lightbots": 1, "frames": [{"name": "A", "air_time_s": 1, "pixels": [
            {"id": 7, "place": [0.5, 0], "color": "#ffa500"}]}]}"##;
        let show = lightbots_exchange::read(document, None).unwrap().show;
        let plan = lightbots_plan::show(&show, &[Vec2::new(0.0, 0.0)], &ShowOptions::default());
        let full = plan_document(&plan, &Issues::new(), 1.5);
        assert_eq!((full.plan_ms, full.transitions[0].pixels[0]), (1.5, Some(7)));
        assert_eq!(full.transitions[0].paths.len(), 1);
        let brief = plan_summary(&full);
        assert_eq!(brief.duration_s, full.duration_s);
        assert!(brief.transitions[0].paths.is_empty());
    }

    #[test]
    fn rounding_keeps_what_is_no_number() {
        assert_eq!(rounded(1.23456, 3), 1.235);
        assert!(rounded(f64::NAN, 3).is_nan());
    }
}
