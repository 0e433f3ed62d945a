//! Where a robot that fell silent on a drive may stand.
//!
//! The robot may have died. Or its reports are lost, and it stops with the others. Or its link broke, and it drives on
//! along its path until it stops by itself.

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
use lightbots_plan::Path;
use lightbots_wire::RobotState;

/// Longest time that a robot drives on between its last report and its death: driving robots report every 500 ms (R41).
const UNREPORTED: Span = Span::from_millis(600);

/// How long a robot drives on after its link broke, counted from its last report. By R43 of docs/protocol.md it slows
/// down from 1.9 s after the last message that it received. It comes to rest where its path would have led it after 2
/// s.
pub(crate) struct LinkLoss {
    /// Least time that the robot drives on after its last report.
    pub drives_on: Span,
    /// Largest time that the robot drives on beyond `drives_on`.
    pub at_most_longer: Span,
}

impl LinkLoss {
    /// Longest time after its last report until the robot stands.
    pub const fn stands_after(&self) -> Span {
        Span(self.drives_on.0 + self.at_most_longer.0)
    }
}

/// The last message that a robot received is at most 500 ms older or newer than its last report. The 2 s of R43 are
/// therefore 1.5 to 2.5 s after that report.
pub(crate) const LINK_LOSS: LinkLoss =
    LinkLoss { drives_on: Span::from_millis(1_500), at_most_longer: Span::from_millis(1_000) };

/// Time between two sampled places of a path: 14 mm at full speed.
const PATH_STEP: Span = Span::from_millis(50);
/// Number of steps of `PATH_STEP` by which a robot that receives STOP may stop later than the other robots.
const STEPS_UNTIL_STOP: i64 = 2;
/// Distance between two sampled places of a straight drive, metres.
const STRAIGHT_STEP_M: f64 = 0.03;
/// Largest distance, metres, between a reported place and the path on which the robot was at that time. Robots keep
/// within 10 mm of their paths, and sampled places are up to 14 mm apart.
pub(crate) const OFF_PATH_M: f64 = 0.03;
/// Moments of a path count as equally close to a reported place if their distances differ by at most this, metres. The
/// first of the closest moments is taken.
const SAME_MOMENT_M: f64 = 0.005;
/// Sampled places closer to each other than this count as one, metres. Other robots pass the discs of the kept places
/// as closely as the planner allows. The disc of a dropped place must therefore not stick out of the kept ones.
const SAME_PLACE_M: f64 = 0.002;

/// Where a silent robot may stand. Likely places are on its path near its last report, if it died. Another likely place
/// is where its path was when all stopped, if only its reports are lost. Possible places are also those where it stops
/// by itself (R43), if it receives no messages either.
///
/// If its last report came after all began to stop, the path from the reported place on counts too. A frozen broker may
/// have held the report back, or the clock of a restarted controller is wrong. Stopped robots may also have blocked the
/// silent one.
///
/// Empty if the robot has reported since the drive began that it stands: it is where it reported. A robot without a
/// path may stand on the part of its straight drive that it was allowed to drive and has not surely passed.
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
    let place = |time: Span| path.as_ref().at(time).position;
    let since = clock.path_time(placed).max(Span::ZERO);
    let is_late = placed > stop.began;
    let reached = robot.reported.at.filter(|_| is_late).and_then(|at| reached(path, at));
    // A robot that reported before the drive began stops by itself sooner after the beginning.
    let early = (clock.began - placed).max(Span::ZERO);
    let died = [since].into_iter().chain(reached).flat_map(|from| steps(from, from + UNREPORTED));
    let likely = thinned(died.chain(stopped(clock, stop)).map(place));
    let stands_after = (LINK_LOSS.stands_after() - early).max(Span::ZERO);
    let stops_from = if is_late { since } else { since + (LINK_LOSS.drives_on - early).max(Span::ZERO) };
    let first = reached.map_or(stops_from, |reached| reached.min(stops_from));
    let last = reached.map_or(since, |reached| reached.max(since)) + stands_after;
    let possible = thinned(steps(first, last).map(place)).into_iter().chain(likely.iter().copied()).collect();
    Whereabouts { possible, likely }
}

/// Path times at which a robot may have stopped if it received the command that stopped all.
pub(crate) fn stopped(clock: &PathClock, stop: StopTimes) -> impl Iterator<Item = Span> {
    let until = (stop.stood - stop.began).0 / PATH_STEP.0 + STEPS_UNTIL_STOP;
    (0..=until).map(move |step| clock.path_time(stop.began + PATH_STEP * step))
}

/// Path times from `from` to `to`, one every `PATH_STEP`.
fn steps(from: Span, to: Span) -> impl Iterator<Item = Span> {
    (0..=(to - from).0 / PATH_STEP.0).map(move |step| from + PATH_STEP * step)
}

/// The first path time at which a path leads through the reported place `at`. `None` if the path does not lead there.
fn reached(path: &Path, at: Vec2) -> Option<Span> {
    let path = path.as_ref();
    let off_m = |time: Span| path.at(time).position.distance(at);
    let least_m = steps(Span::ZERO, path.duration()).map(off_m).fold(f64::INFINITY, f64::min);
    let is_there = |time: &Span| off_m(*time) <= least_m + SAME_MOMENT_M;
    steps(Span::ZERO, path.duration()).find(is_there).filter(|_| least_m <= OFF_PATH_M)
}

/// [`whereabouts`] of a participant after its drive was interrupted. Empty if no drive was.
pub(crate) fn whereabouts_after(cx: &RunContext, left: &Position, participant: usize) -> Whereabouts {
    let (Position { drive: Some(clock), stops: Some(stops), .. }, Some(DrivenLeg { leg, targets })) =
        (left, &cx.pipeline.driven)
    else {
        return Whereabouts::default();
    };
    whereabouts((leg, targets), clock, *stops, participant, cx.robot(participant))
}

/// Drops each place that is closer than `SAME_PLACE_M` to the last kept one before it.
fn thinned(places: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = places.collect();
    places.dedup_by(|a, b| a.distance(*b) < SAME_PLACE_M);
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leg::{LegKind, RobotLeg, Task};
    use lightbots_base::{Instant, Piece, RobotId};

    /// Speed of the robot on its path along x, m/s.
    const SPEED_MPS: f64 = 0.2;

    /// A drive of one robot along x, 2 m in 10 s.
    fn leg() -> Leg {
        let (end, third) = (Vec2::new(2.0, 0.0), Vec2::new(2.0 / 3.0, 0.0));
        let piece = Piece { duration: Span::from_millis(10_000), c1: third, c2: third * 2.0, end };
        let path = Path { start: Vec2::ZERO, pieces: vec![piece] };
        Leg {
            frame: 0,
            round: 0,
            pass: 0,
            seq: 1,
            kind: LegKind::Routes,
            robots: vec![RobotLeg { task: Task::Path(path), ..RobotLeg::stay(end) }],
            drives: Vec::new(),
            drivers: 1,
            duration: Span::from_millis(10_000),
            reaches_frame: true,
            room_m: 1.0,
            around: Vec::new().into(),
        }
    }

    /// Where a silent robot may stand, if its last report gave the place `at` and came `came_ms` after the drive began.
    /// All robots began to stop after 5 s.
    fn after_a_report(at: Vec2, came_ms: u64) -> Whereabouts {
        let (leg, began) = (leg(), Instant(20_000_000));
        let mut clock = PathClock::new(began, leg.duration);
        let stopped = began + Span::from_millis(5_000);
        clock.stand(stopped);
        let mut robot = KnownRobot::new(RobotId::new("a").unwrap(), began);
        robot.reported.at = Some(at);
        robot.standstill.placed = Instant(began.0 + came_ms * 1000);
        let stops = StopTimes { began: stopped, stood: stopped };
        whereabouts((&leg, &TargetProgress::new(&leg)), &clock, stops, 0, &robot)
    }

    /// Whether the robot may stand where its path is at each of these moments, hundredths of a second.
    fn covers(places: &Whereabouts, moments: std::ops::Range<i32>) -> bool {
        let x_m = |moment: i32| f64::from(moment) * 0.01 * SPEED_MPS;
        let is_there = |x: f64| places.possible.iter().any(|place| place.distance(Vec2::new(x, 0.0)) < 0.01);
        moments.map(x_m).all(is_there)
    }

    #[test]
    fn a_silent_robot_died_or_holds_or_stops_by_itself() {
        let places = after_a_report(Vec2::new(3.0 * SPEED_MPS, 0.001), 3_000);
        assert!(
            [300..360, 490..510, 450..550].into_iter().all(|moments| covers(&places, moments)),
            "{places:?}"
        );
        assert!(
            [285..290, 400..405, 570..575].into_iter().all(|moments| !covers(&places, moments)),
            "{places:?}"
        );
    }

    #[test]
    fn a_report_that_a_broker_held_back_leaves_the_robot_anywhere_from_its_place_on() {
        let places = after_a_report(Vec2::new(3.0 * SPEED_MPS, 0.001), 11_000);
        assert!(covers(&places, 300..760), "{places:?}");
        assert!(!covers(&places, 285..290) && !covers(&places, 800..805), "{places:?}");
    }

    #[test]
    fn a_report_from_ahead_of_the_plan_tells_of_a_wrong_clock() {
        let places = after_a_report(Vec2::new(7.0 * SPEED_MPS, 0.0), 6_000);
        assert!(covers(&places, 530..940), "{places:?}");
    }

    #[test]
    fn a_late_report_from_elsewhere_does_not_say_how_far_the_robot_is_on_its_path() {
        let places = after_a_report(Vec2::new(0.2, 0.5), 6_000);
        assert!(covers(&places, 530..760) && !covers(&places, 450..455), "{places:?}");
    }

    #[test]
    fn no_place_of_a_silent_robot_is_far_from_one_that_is_driven_around() {
        let braking = || (0..30).map(|step| Vec2::new(0.0135 * f64::from(step) * 0.9f64.powi(step), 0.0));
        let kept = thinned(braking());
        assert!(braking().all(|place| kept.iter().any(|disc| disc.distance(place) < 0.002)), "{kept:?}");
        assert_eq!(thinned([Vec2::ZERO; 9].into_iter()).len(), 1);
    }
}
