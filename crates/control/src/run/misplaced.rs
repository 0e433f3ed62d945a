//! Robots that stand elsewhere than the plan has them: they were lifted or pushed, or their last reports were false.

use crate::event::{EventKind, Trouble};
use crate::run::driving::is_there;
use crate::run::next::Next;
use crate::run::run_context::RunContext;
use lightbots_base::Vec2;
use lightbots_wire::{Details, RobotState};

/// Largest number of times that all is planned again because one robot stands elsewhere; then it drops out. A robot
/// that is somewhere else each time must not hold up the show.
const REPLANS_MAX: u8 = 5;

/// Compares the status report of a robot that stands with the plan; see [`check`].
pub(crate) fn check_status(cx: &mut RunContext, participant: usize, details: &Details) -> Next {
    match details.state {
        RobotState::Idle | RobotState::Ready => check(cx, participant, 0.0),
        _ => Next::Stay,
    }
}

/// Compares the reported place of a robot that stands with the plan. If the robot stands elsewhere, all is planned
/// again; if that happens too often, the robot drops out. `noise_m`: error of the reported place, metres.
pub(crate) fn check(cx: &mut RunContext, participant: usize, noise_m: f64) -> Next {
    let (at, expected) = (cx.robot(participant).reported.at, expected(cx, participant));
    let Some((at, expected)) = at.zip(expected) else { return Next::Stay };
    if is_there(at, expected, cx.io.config.arrival_tolerance_m + noise_m) {
        return Next::Stay;
    }
    let known = &mut cx.roster.participants[participant];
    if known.misplaced >= REPLANS_MAX {
        return Next::drop(participant, Trouble::Missed);
    }
    known.misplaced += 1;
    let robot = cx.robot(participant).id;
    cx.io.unexpected += 1;
    cx.io.log.record_limited(cx.now, EventKind::Misaligned { robot, off_m: at.distance(expected) });
    Next::Regather
}

/// Where the plan has a robot that stands, stage metres: where its next drive begins. `None` if all is about to be
/// planned from reported places.
fn expected(cx: &RunContext, participant: usize) -> Option<Vec2> {
    match cx.pipeline.queue.front() {
        Some(leg) => leg.begin(participant),
        None => cx.pipeline.planning.from.get(participant).copied(),
    }
}
