//! `check`: validate, plan, prove.

mod explain;
mod show_places;
mod stop_safe;

use lightbots_api::{self as api, rounded};
use lightbots_plan::{ShowClosest, ShowPlan};
use lightbots_show::{Show, most_pixels};
use serde::Serialize;

use super::{count, print_issues, print_json};
use crate::cli::CheckArguments;
use crate::failure::Outcome;
use crate::{say, show_file, show_plan};
use explain::Explained;
use show_places::{began_s, frame_name, pixel};
use stop_safe::StopSafe;

/// The JSON of `check`.
#[derive(Debug, Serialize)]
pub(super) struct Summary<'a> {
    ok: bool,
    frames: usize,
    pixels: usize,
    duration_s: f64,
    lower_bound_s: f64,
    closest_m: Option<f64>,
    closest: Option<Pair>,
    stop_safe: StopSafe,
    plan_ms: f64,
    issues: &'a [api::Issue],
    transitions: Vec<Drive>,
    /// With `--explain`: which solvers ran for each transition.
    #[serde(skip_serializing_if = "Option::is_none")]
    explanations: Option<Vec<Explained>>,
}

/// The two robots whose centres come closest in the whole show, at that moment.
#[derive(Debug, Serialize)]
struct Pair {
    distance_m: f64,
    /// The frame that the transition leads to, counted from 0.
    to: usize,
    /// Seconds from the start of the transition to the closest moment.
    at_s: f64,
    /// Seconds from the start of the show to the closest moment.
    show_at_s: f64,
    /// Ids of the pixels to which the two robots drive in the transition, in ascending order. Null, which comes first: a
    /// spare robot, which has no pixel.
    pixels: [Option<u32>; 2],
    /// Midpoint between the robots, stage metres.
    place: [f64; 2],
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
    stop_safe: f64,
}

pub fn run(arguments: &CheckArguments) -> Outcome {
    let opened = show_file::open(&arguments.show, &arguments.reading)?;
    let (made, plan) = show_plan::plan(&opened.show, &opened.issues);
    let mut summary = Summary::new(&opened.show, &made, &plan);
    summary.explanations = arguments.explain.then(|| Explained::all(&made));
    if arguments.json {
        print_json(&summary)?;
    } else {
        summary.print(&opened.show);
    }
    Ok(plan.ok)
}

impl<'a> Summary<'a> {
    pub(super) fn new(show: &Show, made: &ShowPlan, plan: &'a api::Plan) -> Self {
        let drive = |transition: &api::Transition| Drive {
            from: transition.from,
            to: transition.to,
            duration_s: transition.duration_s,
            least_s: transition.least_s,
            lower_bound_s: transition.lower_bound_s,
            closest_m: transition.closest_m,
            stop_safe: transition.stop_safe,
        };
        Self {
            ok: plan.ok,
            frames: show.frames.len(),
            pixels: most_pixels(show),
            duration_s: plan.duration_s,
            lower_bound_s: plan.lower_bound_s,
            closest_m: plan.closest_m,
            closest: Pair::of(show, made),
            stop_safe: StopSafe::of(show, made, plan),
            plan_ms: plan.plan_ms,
            issues: &plan.issues,
            transitions: plan.transitions.iter().map(drive).collect(),
            explanations: None,
        }
    }

    pub(super) fn print(&self, show: &Show) {
        print_issues(self.issues);
        let verdict = if self.ok { "fine" } else { "this show must not be played" };
        say::line(&format!(
            "{verdict}: {}, {}, {:.2} s (at least {:.2} s); planned in {:.1} ms",
            count(self.frames, "frame"),
            count(self.pixels, "pixel"),
            self.duration_s,
            self.lower_bound_s,
            self.plan_ms
        ));
        if let Some(pair) = &self.closest {
            say::line(&pair.line(show));
        }
        self.stop_safe.lines(show).iter().for_each(|line| say::line(line));
        let explained = self.explanations.iter().flatten();
        explained.flat_map(|one| one.lines(show)).for_each(|line| say::line(&line));
    }
}

impl Pair {
    fn of(show: &Show, made: &ShowPlan) -> Option<Self> {
        let ShowClosest { transition, closest } = made.closest?;
        let pixel = |robot| pixel(made, transition, robot);
        let began_s = began_s(show, made, transition);
        let at_s = closest.at.as_secs();
        let mut pixels = [pixel(closest.pair.0), pixel(closest.pair.1)];
        pixels.sort_unstable();
        Some(Self {
            distance_m: rounded(closest.distance_m, 5),
            to: transition,
            at_s: rounded(at_s, 3),
            show_at_s: rounded(began_s + at_s, 3),
            pixels,
            place: [rounded(closest.place.x, 4), rounded(closest.place.y, 4)],
        })
    }

    fn line(&self, show: &Show) -> String {
        let who = match self.pixels {
            [Some(a), Some(b)] => format!("the robots for pixels {a} and {b}"),
            [Some(one), None] | [None, Some(one)] => format!("the robot for pixel {one} and a spare one"),
            [None, None] => "two spare robots".into(),
        };
        let [x, y] = self.place;
        format!(
            "closest: {who}, {:.1} mm between their centres at ({x:.2}, {y:.2}) m, {:.2} s into the show, on the way to {}",
            self.distance_m * 1e3,
            self.show_at_s,
            frame_name(show, self.to)
        )
    }
}
