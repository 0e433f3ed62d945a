//! `check`: validate, plan, prove.

use lightbots_api as api;
use serde::Serialize;

use super::{count, print_issues, print_json};
use crate::cli::CheckArguments;
use crate::failure::Outcome;
use crate::{plan_document, say, show_file};

/// The JSON of `check`.
#[derive(Debug, Serialize)]
pub(super) struct Summary<'a> {
    ok: bool,
    frames: usize,
    pixels: usize,
    duration_s: f64,
    lower_bound_s: f64,
    closest_m: Option<f64>,
    plan_ms: f64,
    issues: &'a [api::Issue],
    transitions: Vec<Drive>,
}

/// One transition without its paths.
#[derive(Debug, Serialize)]
struct Drive {
    from: Option<usize>,
    to: usize,
    duration_s: f64,
    least_s: f64,
    lower_bound_s: f64,
    closest_m: Option<f64>,
}

pub fn run(arguments: &CheckArguments) -> Outcome {
    let opened = show_file::open(&arguments.show, &arguments.reading)?;
    let (_, plan) = plan_document::plan(&opened.show, &opened.issues);
    let summary = Summary::new(&opened.show, &plan);
    if arguments.json {
        print_json(&summary)?;
    } else {
        summary.print();
    }
    Ok(plan.ok)
}

impl<'a> Summary<'a> {
    pub(super) fn new(show: &lightbots_show::Show, plan: &'a api::Plan) -> Self {
        let drive = |transition: &api::Transition| Drive {
            from: transition.from,
            to: transition.to,
            duration_s: transition.duration_s,
            least_s: transition.least_s,
            lower_bound_s: transition.lower_bound_s,
            closest_m: transition.closest_m,
        };
        Self {
            ok: plan.ok,
            frames: show.frames.len(),
            pixels: show_file::pixels(show),
            duration_s: plan.duration_s,
            lower_bound_s: plan.lower_bound_s,
            closest_m: plan.closest_m,
            plan_ms: plan.plan_ms,
            issues: &plan.issues,
            transitions: plan.transitions.iter().map(drive).collect(),
        }
    }

    pub(super) fn print(&self) {
        print_issues(self.issues);
        let verdict = if self.ok { "fine" } else { "this show must not be played" };
        let closest = self
            .closest_m
            .map_or(String::new(), |metres| format!(", centres never closer than {:.1} mm", metres * 1e3));
        say::line(&format!(
            "{verdict}: {}, {}, {:.2} s (at least {:.2} s){closest}; planned in {:.1} ms",
            count(self.frames, "frame"),
            count(self.pixels, "pixel"),
            self.duration_s,
            self.lower_bound_s,
            self.plan_ms
        ));
    }
}
