//! Robots off their paths, and robots that are unsure of their places. All robots hold (stop together) and wait for
//! both kinds, within bounds.

use crate::event::Trouble;
use crate::run::driving::drive::Driving;
use crate::run::run_context::RunContext;
use lightbots_base::{Span, Vec2};
use lightbots_wire::Details;

/// Largest bound on a robot's distance off its path, metres. The bound is half the clearance of the plan, but at most
/// this and at least the configured one. Beyond the bound, all wait for the robot. Also the largest distance off its
/// path at which an overdue robot counts as still on its way.
pub(crate) const LATE_MAX_M: f64 = 0.03;
/// A late robot counts as back on its path when its distance off the path falls below this share of the bound. The gap
/// prevents quick switching between the two (hysteresis).
const BACK: f64 = 0.6;

/// Bounds on the standard error of a robot's place (1 sigma).
struct Uncertainty {
    /// Below this error, all robots drive on, metres.
    sure_m: f64,
    /// From this error on, all robots wait, metres. At 20 mm a robot reports the state `lost` (R46).
    unsure_m: f64,
    /// For errors between these two: all wait if the plan brings another robot closer than the contact distance plus
    /// `sigmas` times the error plus `others_m`.
    sigmas: f64,
    /// Allowance for the error of the other robot's place, metres.
    others_m: f64,
    /// How far ahead in time the paths are checked.
    ahead: Span,
    /// Time between two checked moments of the paths.
    step: Span,
}

/// With smaller bounds, noise stops the fleet. With larger ones, robots that get no position fixes touch others.
const UNCERTAINTY: Uncertainty = Uncertainty {
    sure_m: 0.004,
    unsure_m: 0.010,
    sigmas: 2.5,
    others_m: 0.003,
    ahead: Span::from_millis(1_000),
    step: Span::from_millis(50),
};

const _: () = assert!(UNCERTAINTY.sure_m < UNCERTAINTY.unsure_m && UNCERTAINTY.others_m < UNCERTAINTY.sure_m);

/// How long all wait for robots that are unsure of their places. The wait is bounded, because in a large fleet some
/// robot is unsure at any time.
struct Patience {
    /// Longest wait, in fleets of up to `robots` robots. In larger fleets the wait is shorter in proportion.
    longest: Span,
    robots: f64,
    /// Shortest wait, in the largest fleets.
    shortest: Span,
}

/// The wait is half of `longest` in fleets of 80 robots, and a fifth of it from 200 on.
const PATIENCE: Patience =
    Patience { longest: Span::from_millis(3_500), robots: 40.0, shortest: Span::from_millis(700) };

impl Driving {
    /// Handles a driving robot's report of how far it is off its path and how unsure it is of its place. Beyond the
    /// bounds all robots hold and wait for it. Once the last late robot is back on its path, the hold ends unless the
    /// operator asked for it.
    pub fn on_progress(&mut self, cx: &mut RunContext, participant: usize, details: &Details) {
        let room_m = cx.pipeline.leg().map_or(0.0, |leg| leg.room_m);
        let late_m = cx.io.config.late.off_m.max((room_m / 2.0).min(LATE_MAX_M));
        let off_m = details.off_m.unwrap_or(0.0);
        let is_unsure = details.err_m.is_some_and(|err_m| self.is_too_unsure(cx, participant, err_m));
        if (off_m > late_m || is_unsure) && self.progress[participant].late_since.is_none() {
            self.mark_late(cx, participant, if is_unsure { Trouble::Unsure } else { Trouble::Late });
            return;
        }
        let is_back = off_m < late_m * BACK && !is_unsure && self.clear_late(participant);
        if is_back && self.late == 0 && self.clock.hold.is_some_and(|hold| !hold.by_operator) {
            self.release(cx);
        }
    }

    /// Whether all robots have to wait because of `err_m`, the standard error of a robot's place, metres. `true` from
    /// `unsure_m` on, `false` below `sure_m`. Between these bounds: whether the robot, wrong by its error, may touch
    /// another one within `ahead`.
    fn is_too_unsure(&self, cx: &RunContext, participant: usize, err_m: f64) -> bool {
        let Uncertainty { sure_m, unsure_m, sigmas, others_m, ahead, step } = UNCERTAINTY;
        let Some(leg) = cx.pipeline.leg() else { return false };
        if !(sure_m..unsure_m).contains(&err_m) {
            return err_m >= unsure_m;
        }
        let needed_m = cx.playback.contact_m() + sigmas * err_m + others_m;
        let from = self.clock.path_time(cx.now).max(Span::ZERO);
        let place = |one: usize, time: Span| match leg.path(one) {
            Some(path) => path.as_ref().at(time).position,
            None => leg.goal(one).unwrap_or(Vec2::ZERO),
        };
        let far_m = needed_m + 2.0 * cx.playback.show.stage.limits.speed_mps * ahead.as_secs();
        let here = place(participant, from);
        let near = |other: &usize| *other != participant && place(*other, from).distance(here) < far_m;
        let near: Vec<usize> = (0..leg.robots.len()).filter(near).collect();
        (0..=ahead.0 / step.0).any(|number| {
            let time = from + step * number;
            let at = place(participant, time);
            near.iter().any(|&other| place(other, time).distance(at) < needed_m)
        })
    }

    /// Ends a hold that has lasted long, if its only reason is robots that are unsure of their places. Robots that
    /// still are unsure then cause a new hold. The larger the fleet, the sooner a hold ends, because waiting for all
    /// would never end.
    pub fn lose_patience(&mut self, cx: &mut RunContext) {
        let share = PATIENCE.robots / (cx.roster.len().max(1) as f64);
        let longest_s = PATIENCE.longest.as_secs();
        let patience = Span::from_secs((longest_s * share).min(longest_s)).max(PATIENCE.shortest);
        let hold = self.clock.open_hold().filter(|hold| !hold.by_operator);
        let waits_long = hold.is_some_and(|hold| cx.now - hold.at > patience);
        let only_unsure = self.progress.iter().all(|known| known.late_since.is_none() || known.is_unsure);
        if waits_long && only_unsure {
            self.progress.iter_mut().for_each(|known| known.late_since = None);
            self.late = 0;
            self.release(cx);
        }
    }
}
