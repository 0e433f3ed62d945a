//! Robots that stand elsewhere than the plan has them: they were lifted or pushed, or their last reports were false.

use crate::event::{EventKind, Trouble};
use crate::run::driving::is_there;
use crate::run::next::Next;
use crate::run::run_context::RunContext;
use lightbots_base::Vec2;
use lightbots_wire::RobotState;

/// How far beyond the arrival tolerance a robot counts as moved, along x and along y, metres. With less, the noise of
/// position fixes makes robots count as moved that arrived at the edge of the tolerance.
const SLACK_M: f64 = 0.005;

/// What to do instead of a START because a robot does not stand where its route begins, by its last report. `None` if
/// all robots do that report that they stand. All is planned again even if the same robot caused a new plan just
/// before.
pub(crate) fn prevents_start(cx: &mut RunContext) -> Option<Next> {
    let stands = |&one: &usize| is_at_rest(cx, one) && off(cx, one, 0.0).is_some();
    let misplaced = cx.roster.active().map(|(participant, _)| participant).find(stands)?;
    Some(check(cx, misplaced, 0.0).or_else(|| Next::Regather))
}

/// Compares the last reported place of a robot with the plan, if it reports that it stands; see [`check`].
pub(crate) fn check_status(cx: &mut RunContext, participant: usize) -> Next {
    if is_at_rest(cx, participant) { check(cx, participant, 0.0) } else { Next::Stay }
}

fn is_at_rest(cx: &RunContext, participant: usize) -> bool {
    matches!(cx.robot(participant).reported.state, Some(RobotState::Idle | RobotState::Ready))
}

/// Compares the reported place of a standing robot with the plan. If the robot stands elsewhere, an event is recorded
/// and all is planned again. If that happens too often, the robot drops out. Shortly after the last time, nothing
/// happens. `noise_m`: error of the reported place, metres.
pub(crate) fn check(cx: &mut RunContext, participant: usize, noise_m: f64) -> Next {
    let Some(off_m) = off(cx, participant, noise_m) else { return Next::Stay };
    match cx.roster.participants[participant].misplaced.count(cx.now) {
        None => return Next::Stay,
        Some(false) => return Next::drop(participant, Trouble::Missed),
        Some(true) => {}
    }
    let robot = cx.robot(participant).id;
    cx.io.unexpected += 1;
    cx.io.log.record_limited(cx.now, EventKind::Misaligned { robot, off_m });
    Next::Regather
}

/// Distance between where a robot stands and where the plan has it, metres. `None` if it is there, or if either place
/// is unknown.
fn off(cx: &RunContext, participant: usize, noise_m: f64) -> Option<f64> {
    let (at, expected) = cx.robot(participant).reported.at.zip(expected(cx, participant))?;
    let is_there = is_there(at, expected, cx.io.config.arrival_tolerance_m + SLACK_M + noise_m);
    (!is_there).then(|| at.distance(expected))
}

/// Where the plan has a robot that stands, stage metres: where its next drive begins. `None` if all is about to be
/// planned from reported places.
fn expected(cx: &RunContext, participant: usize) -> Option<Vec2> {
    match cx.pipeline.queue.front() {
        Some(leg) => leg.begin(participant),
        // With an empty queue, the drive that is planned next begins where robots stand now.
        None => cx.pipeline.planning.from.get(participant).copied(),
    }
}
