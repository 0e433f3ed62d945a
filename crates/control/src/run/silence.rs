//! Where a robot that fell silent on a drive may stand.
//!
//! The robot may have died. Or its reports are lost, and it holds with the others. Or its link broke, and it drives
//! on along its path until it stops by itself.

use crate::journal::Position;
use crate::leg::Leg;
use crate::robot::KnownRobot;
use crate::run::path_clock::PathClock;
use crate::run::pipeline::DrivenLeg;
use crate::run::roster::Whereabouts;
use crate::run::run_context::RunContext;
use crate::run::stop_times::StopTimes;
use crate::run::target_progress::TargetProgress;
use lightbots_base::{Span, Vec2};
use lightbots_wire::RobotState;

/// Longest time from the last report of a robot until it died: driving robots report every 500 ms (R41).
const UNREPORTED: Span = Span::from_millis(600);

/// How long a robot drives on after its link broke, by R43 of docs/protocol.md. It slows down from 1.9 s after the
/// last message that it received. It comes to rest where it would have been after 2 s.
pub(crate) struct LinkLoss {
    /// Least time that the robot drives on after its last report.
    pub drives_on: Span,
    /// How much longer than `drives_on` the robot may drive on.
    pub at_most_longer: Span,
}

impl LinkLoss {
    /// Longest time after the last report until the robot stands.
    pub const fn stands_after(&self) -> Span {
        Span(self.drives_on.0 + self.at_most_longer.0)
    }
}

/// The last message that a robot received is at most 500 ms older or newer than its last report.
pub(crate) const LINK_LOSS: LinkLoss =
    LinkLoss { drives_on: Span::from_millis(1_500), at_most_longer: Span::from_millis(1_000) };

/// Time between two sampled places of a path: 14 mm at full speed.
const PATH_STEP: Span = Span::from_millis(50);
/// Number of steps of `PATH_STEP` by which a robot that receives STOP may stop later than the others.
const STEPS_UNTIL_STOP: i64 = 2;
/// Distance between two sampled places of a straight drive, metres.
const STRAIGHT_STEP_M: f64 = 0.03;
/// Places closer to each other than this count as one, metres. The disc of a dropped place must not stick out of the
/// kept discs, because other robots pass these as closely as the planner allows.
const SAME_PLACE_M: f64 = 0.002;

/// Where a silent robot may stand. Likely if it died: along its path from where it last reported. Likely if only its
/// reports are lost: where its path was when all stopped. Possible places also include those where it stops by
/// itself, if it receives no messages either. Empty if the robot has reported since the drive began that it stands:
/// it is where it reported.
pub(crate) fn whereabouts(
    (leg, targets): (&Leg, &TargetProgress),
    clock: &PathClock,
    stop: StopTimes,
    participant: usize,
    robot: &KnownRobot,
) -> Whereabouts {
    let (placed, state) = (robot.standstill.placed, robot.reported.state);
    let stands = matches!(state, Some(RobotState::Idle | RobotState::Cut | RobotState::Faulty));
    if stands && placed > clock.began && robot.reported.at.is_some() {
        return Whereabouts::default();
    }
    let Some(path) = leg.path(participant) else {
        let places = targets.whereabouts(leg, participant, STRAIGHT_STEP_M);
        return Whereabouts { possible: places.clone(), likely: places };
    };
    let since = clock.path_time(placed).max(Span::ZERO);
    // A robot that reported before the drive began drives for less long until it stops by itself.
    let drives_on = LINK_LOSS.drives_on - (clock.began - placed).max(Span::ZERO);
    let died = (0..=UNREPORTED.0 / PATH_STEP.0).map(|step| since + PATH_STEP * step);
    let until = (stop.stood - stop.began).0 / PATH_STEP.0 + STEPS_UNTIL_STOP;
    let stopped = (0..=until).map(|step| clock.path_time(stop.began + PATH_STEP * step));
    let cut = (0..=LINK_LOSS.at_most_longer.0 / PATH_STEP.0)
        .map(|step| since + (drives_on + PATH_STEP * step).max(Span::ZERO));
    let place = |time: Span| path.as_ref().at(time).position;
    let likely = thinned(died.chain(stopped).map(place));
    let possible = thinned(cut.map(place)).into_iter().chain(likely.iter().copied()).collect();
    Whereabouts { possible, likely }
}

/// [`whereabouts`] of a participant after a drive was broken off. Empty if no drive was.
pub(crate) fn whereabouts_after(cx: &RunContext, left: &Position, participant: usize) -> Whereabouts {
    let (Position { drive: Some(clock), stops: Some(stops), .. }, Some(DrivenLeg { leg, targets })) =
        (left, &cx.pipeline.driven)
    else {
        return Whereabouts::default();
    };
    whereabouts((leg, targets), clock, *stops, participant, cx.robot(participant))
}

/// Drops each place that is closer than `SAME_PLACE_M` to the last one kept before it.
fn thinned(places: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = places.collect();
    places.dedup_by(|a, b| a.distance(*b) < SAME_PLACE_M);
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_place_of_a_silent_robot_is_far_from_one_that_is_driven_around() {
        let braking = || (0..30).map(|step| Vec2::new(0.0135 * f64::from(step) * 0.9f64.powi(step), 0.0));
        let kept = thinned(braking());
        assert!(braking().all(|place| kept.iter().any(|disc| disc.distance(place) < 0.002)), "{kept:?}");
        assert_eq!(thinned([Vec2::ZERO; 9].into_iter()).len(), 1);
    }
}
