//! Candidates: robots that may take part from the next frame on. They are new, or dropped out and report again.

use crate::event::EventKind;
use crate::run::playback::RunPurpose;
use crate::run::probation;
use crate::run::readiness::is_ready;
use crate::run::run_context::RunContext;

/// Makes a robot a candidate for the next frame, if a show is played and the robot may take part and is ready. Called
/// when a robot that takes no part or dropped out has reported. A robot that was never in the run is wanted only while
/// pixels stay dark. May send the route of a driving test. `is_stopping`: all robots are being stopped.
pub(crate) fn consider(cx: &mut RunContext, robot: usize, is_stopping: bool) {
    let participant = cx.io.fleet.robot(robot).participant.map(|participant| participant as usize);
    let is_welcome = match participant {
        Some(participant) => cx.participant(participant).membership.may_return(),
        // Any client can claim to be a robot. A name that first appears during a run takes a pixel only if it is
        // listed.
        None => cx.pipeline.planning.is_dark && is_expected(cx, robot),
    };
    let plays = cx.playback.purpose == RunPurpose::Play;
    if !is_welcome || !plays || !is_ready(cx.io, robot) || cx.roster.candidates.contains(&robot) {
        return;
    }
    if participant.is_none_or(|participant| probation::passes(cx, participant, is_stopping)) {
        cx.roster.candidates.push(robot);
    }
}

/// Whether a robot that was never in the run may take part. It has to be admitted. If there is no list of admitted
/// robots, it must have been found before the run began.
fn is_expected(cx: &RunContext, robot: usize) -> bool {
    let known = cx.io.fleet.robot(robot);
    known.is_admitted && !(cx.io.config.admitted.is_none() && cx.roster.is_stranger(known))
}

/// Lets candidates that are ready take part; called while all robots stand. Candidates that are not ready are removed,
/// and those that may come back only in a later frame are kept. Returns whether any joined.
pub(crate) fn admit(cx: &mut RunContext) -> bool {
    if cx.roster.candidates.is_empty() || cx.playback.is_ended() {
        return false;
    }
    let mut is_any_admitted = false;
    for robot in std::mem::take(&mut cx.roster.candidates) {
        if !is_ready(cx.io, robot) {
            continue;
        }
        let known =
            cx.io.fleet.robot(robot).participant.map(|participant| cx.participant(participant as usize));
        if known.is_some_and(|known| known.membership.eligible_from_frame > cx.tally.frames_played) {
            cx.roster.candidates.push(robot);
            continue;
        }
        cx.roster.admit(cx.io, robot);
        is_any_admitted = true;
        cx.io.log.record(cx.now, EventKind::Rejoined(cx.io.fleet.robot(robot).id));
    }
    is_any_admitted
}
