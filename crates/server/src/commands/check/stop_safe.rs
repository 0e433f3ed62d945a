//! The stop-safety part of `check`: what happens if a robot stops dead.

use lightbots_api as api;
use lightbots_api::rounded;
use lightbots_plan::ShowPlan;
use lightbots_show::Show;
use serde::Serialize;

use super::show_places::{began_s, frame_name, pixel};

/// At how many moments a robot may stop dead without a contact, and the worst moment.
#[derive(Debug, Serialize)]
pub(super) struct StopSafe {
    /// Share of safe moments among all moments of driving robots, 0 to 1; null: the plan must not be played.
    share: Option<f64>,
    /// The unsafe moment with the largest missing clearance; null: all moments are safe, or no transition has a plan.
    worst: Option<Worst>,
    /// Index and share of each transition with a share below 1.
    #[serde(skip)]
    less: Vec<(usize, f64)>,
}

/// A robot and a moment at which a dead stop leads to a contact.
#[derive(Debug, Serialize)]
struct Worst {
    robot: usize,
    /// Id of the pixel to which the robot drives; null: the robot has none.
    pixel: Option<u32>,
    /// Index of the other robot, which would touch the stopped robot. If `missing_m` is 0, the other robot can stop in
    /// time, but then a third robot would touch it.
    by: usize,
    /// Id of the pixel to which the other robot drives; null: that robot has none.
    by_pixel: Option<u32>,
    /// The frame that the transition leads to, counted from 0.
    frame: usize,
    /// Seconds from the start of the transition to the dead stop.
    moment: f64,
    /// Seconds from the start of the show to the dead stop.
    show_moment: f64,
    /// Place of the robot at the dead stop, stage metres.
    place: [f64; 2],
    /// Clearance that is missing to the other robot, metres.
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

    /// Returns the lines for people: the share, the worst moment, and the frames whose transitions have a share below
    /// 1. One line if all moments are safe. Empty if the plan must not be played.
    pub fn lines(&self, show: &Show) -> Vec<String> {
        let Some(share) = self.share else { return Vec::new() };
        let Some(worst) = &self.worst else {
            return vec!["stop-safe: any one robot may stop dead at any moment".into()];
        };
        let name = |frame: usize| frame_name(show, frame);
        let robot = |pixel: Option<u32>| {
            pixel.map_or("a spare robot".into(), |id| format!("the robot for pixel {id}"))
        };
        let [x, y] = worst.place;
        let mut lines = vec![format!(
            "stop-safe: at {} of all moments any one robot may stop dead; worst: if {} does {:.2} s into the show, on the way \
             to {}, at ({x:.2}, {y:.2}) m, {} is {:.1} mm short of room to stop",
            percent(share),
            robot(worst.pixel),
            worst.show_moment,
            name(worst.frame),
            robot(worst.by_pixel),
            worst.missing_m * 1e3
        )];
        let less = self.less.iter().map(|(frame, share)| format!("{} {}", name(*frame), percent(*share)));
        let less: Vec<String> = less.collect();
        lines.push(format!("too tight for more on the way to: {}", less.join(", ")));
        lines
    }
}

/// Formats a share as percent, rounded down, so that 100 % means all.
fn percent(share: f64) -> String {
    format!("{:.2} %", (share * 1e4 + 1e-6).floor() / 1e2)
}
