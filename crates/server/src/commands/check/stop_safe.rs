//! What `check` says about robots that stop dead.

use lightbots_api as api;
use lightbots_plan::ShowPlan;
use lightbots_show::{Show, frame_label};
use serde::Serialize;

use super::{began_s, pixel};
use crate::numbers::rounded;

/// At which moments robots may stop dead.
#[derive(Debug, Serialize)]
pub(super) struct StopSafe {
    /// The share of all moments of robots that drive, 0 to 1; null where the plan must not be played.
    share: Option<f64>,
    /// The moment at which most room is missing; null where the share is 1.
    worst: Option<Worst>,
    /// `(transition, share)` of those with less than all.
    #[serde(skip)]
    less: Vec<(usize, f64)>,
}

/// A robot that must not stop dead at a moment.
#[derive(Debug, Serialize)]
struct Worst {
    robot: usize,
    /// The pixel it drives to; null: it has none.
    pixel: Option<u32>,
    /// Who would touch it, and the pixel that one drives to.
    by: usize,
    by_pixel: Option<u32>,
    /// The frame they drive to, counted from 0.
    frame: usize,
    /// When, seconds after the drive began, and after the show began.
    moment: f64,
    show_moment: f64,
    /// Where it is then, stage metres.
    place: [f64; 2],
    /// How much room the other is short of, metres.
    missing_m: f64,
}

impl StopSafe {
    pub fn of(show: &Show, made: &ShowPlan, plan: &api::Plan) -> Self {
        let worst = made.least_stop_safe().map(|(frame, one)| Worst {
            robot: one.robot,
            pixel: pixel(made, frame, one.robot),
            by: one.by,
            by_pixel: pixel(made, frame, one.by),
            frame,
            moment: rounded(one.at.as_secs(), 3),
            show_moment: rounded(began_s(show, made, frame) + one.at.as_secs(), 3),
            place: [rounded(one.place.x, 4), rounded(one.place.y, 4)],
            missing_m: rounded(one.missing_m, 5),
        });
        let transitions = plan.transitions.iter().map(|transition| (transition.to, transition.stop_safe));
        let less = transitions.filter(|(_, share)| *share < 1.0).collect();
        Self { share: plan.ok.then_some(plan.stop_safe), worst, less }
    }

    /// For people: how much, where least, and which pictures are too tight.
    pub fn lines(&self, show: &Show) -> Vec<String> {
        let Some(share) = self.share else { return Vec::new() };
        let Some(worst) = &self.worst else {
            return vec!["stop-safe: any one robot may stop dead at any moment".into()];
        };
        let name = |frame: usize| frame_label(frame, show.frames.get(frame).map_or("", |frame| &frame.name));
        let who = |pixel: Option<u32>| {
            pixel.map_or("a spare robot".into(), |id| format!("the robot for pixel {id}"))
        };
        let [x, y] = worst.place;
        let mut lines = vec![format!(
            "stop-safe: at {} of all moments any one robot may stop dead; worst: if {} does {:.2} s into the show, on the way \
             to {}, at ({x:.2}, {y:.2}) m, {} is {:.1} mm short of room to stop",
            percent(share),
            who(worst.pixel),
            worst.show_moment,
            name(worst.frame),
            who(worst.by_pixel),
            worst.missing_m * 1e3
        )];
        let less = self.less.iter().map(|(frame, share)| format!("{} {}", name(*frame), percent(*share)));
        let less: Vec<String> = less.collect();
        lines.push(format!("too tight for more on the way to: {}", less.join(", ")));
        lines
    }
}

/// Rounded down, so that 100 % means all.
fn percent(share: f64) -> String {
    format!("{:.2} %", (share * 1e4 + 1e-6).floor() / 1e2)
}
