//! Plans of whole shows: for the screen, for `check` and for `plan`.

use std::time::{Duration, Instant};

use lightbots_api as api;
use lightbots_api::plan_document;
use lightbots_plan::{Cancelled, ShowOptions, ShowPlan};
use lightbots_show::{Issue, Issues, Show, starting_places};

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
    let starts = starting_places(show);
    let plan = lightbots_plan::show_with(&Threads, show, &starts, &ShowOptions::default(), is_wanted)?;
    let plan_ms = began.elapsed().as_secs_f64() * 1e3;
    let found: Issues = found.iter().cloned().chain(lightbots_lighting::flashes_of(show, &plan)).collect();
    let document = plan_document(&plan, &found, plan_ms);
    Ok((plan, document))
}

/// What is said of a show whose planning took too long: no part of a plan.
pub fn cut_off(found: &Issues, budget: Duration) -> api::Plan {
    let message = format!(
        "planning took longer than {} s and was cut off: check the show on the command line, make it smaller, or start \
         lightbots with a longer --plan-budget",
        budget.as_secs()
    );
    let issues =
        found.iter().chain([&Issue::error("planning-cut-off", message)]).map(api::Issue::from).collect();
    api::Plan { issues, ..api::Plan::default() }
}
