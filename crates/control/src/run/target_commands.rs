//! Commands to TARGET-only robots (they understand the command TARGET but no routes). Each of these robots is sent a
//! target only as far as it may safely go on its straight drive. It is sent on when the robots to which it yields have
//! made progress.
//!
//! In this file, `place` is the index of a straight drive in the leg's list of drives.

use crate::run::pipeline::{DrivenLeg, Pipeline};
use crate::run::run_context::RunContext;
use lightbots_base::{Span, Vec2};
use lightbots_plan::unsynchronised::StraightDrive;
use lightbots_wire::Command;

/// Least distance by which a robot is sent farther, unless it may go to the end of its drive; metres. For less than its
/// tolerance of 20 mm it would not move.
const STEP_M: f64 = 0.025;
/// Largest error of a robot's progress on its straight drive, as computed from its report, metres.
pub(crate) const PASSED_ERROR_M: f64 = 0.01;
/// Time between requests to a TARGET-only robot for its place, while no other robot waits for it. A robot without
/// progress is sent its target again at the same interval.
pub(crate) const ASK: Span = Span::from_millis(500);

/// How a TARGET-only robot is brought to rest: it gets a target a little ahead of its place, so that it does not turn
/// round.
struct Stopping {
    /// Highest speed of the robot, m/s.
    speed_mps: f64,
    /// Time from sending a message until the robot reacts to it.
    reaction: Span,
}

/// A lower speed or a shorter reaction would send a robot back to a place that it has passed.
const STOPPING: Stopping = Stopping { speed_mps: 0.3, reaction: Span::from_millis(150) };

/// Sends a robot farther on its straight drive `place`, if it may go farther by now. Does nothing during a hold, if
/// `place` is `None`, or if it is not the drive that the robot is on or begins next.
pub(crate) fn grant_farther(cx: &mut RunContext, is_held: bool, place: Option<usize>) {
    let Pipeline { driven: Some(DrivenLeg { leg, targets }), .. } = &mut *cx.pipeline else { return };
    let Some(place) = place else { return };
    let drive = &leg.drives[place];
    let state = targets.states[place];
    let is_present = targets.present[drive.robot] == Some(place);
    if is_held || state.granted >= 1.0 || !is_present || cx.roster.is_excluded(drive.robot) {
        return;
    }
    let may = drive.yields.iter().fold(1.0, |share: f64, yields| match &targets.states[yields.to] {
        first if first.done => share,
        first => share.min(drive.clear_share(&leg.drives[yields.to], first.passed, yields.gap_m)),
    });
    if may < 1.0 && (may - state.granted) * drive.length_m() < STEP_M {
        return;
    }
    let state = &mut targets.states[place];
    (state.granted, state.moved_at) = (may, cx.now);
    send_target(cx, place);
}

/// Sends a robot the target on its straight drive up to which it may go, and its colour.
pub(crate) fn send_target(cx: &mut RunContext, place: usize) {
    if let Some(driven) = &mut cx.pipeline.driven {
        driven.targets.states[place].sent_at = cx.now;
    }
    let Some(DrivenLeg { leg, targets }) = &cx.pipeline.driven else { return };
    let (drive, granted) = (&leg.drives[place], targets.states[place].granted);
    let (participant, color) = (drive.robot, leg.robots[drive.robot].color);
    let beyond = || beyond(cx, drive, cx.robot(participant).original.short_m);
    let target = if granted < 1.0 { drive.at(granted) } else { beyond() };
    cx.send(participant, &[Command::Target(target), Command::Color(color)]);
}

/// The target for a robot that stops `short_m` metres before its targets, so that it stands where its straight drive
/// ends. The target is inside the stage, or at most as far out as the end of the drive.
pub(crate) fn beyond(cx: &RunContext, drive: &StraightDrive, short_m: f64) -> Vec2 {
    let stage = &cx.playback.show.stage;
    let inset = Vec2::new(stage.limits.radius_m, stage.limits.radius_m);
    let most = Vec2::new(stage.width_m, stage.depth_m) / 2.0 - inset;
    let target = drive.to + (drive.to - drive.from).normalized().unwrap_or(Vec2::ZERO) * short_m;
    let inside = |value: f64, to: f64, most: f64| value.clamp(-most.max(to.abs()), most.max(to.abs()));
    Vec2::new(inside(target.x, drive.to.x, most.x), inside(target.y, drive.to.y, most.y))
}

/// Sends each TARGET-only robot off on its first straight drive, as far as no other robot is in its way.
pub(crate) fn begin(cx: &mut RunContext) {
    let participants = cx.pipeline.driven.as_ref().map_or(0, |driven| driven.targets.present.len());
    for participant in 0..participants {
        let present = cx.pipeline.driven.as_ref().and_then(|driven| driven.targets.present[participant]);
        grant_farther(cx, false, present);
    }
}

/// Asks TARGET-only robots where they stand, if they have not reported for longer than `ASK`.
pub(crate) fn ask_places(cx: &mut RunContext) {
    for participant in 0..cx.roster.len() {
        let is_asked = !cx.roster.is_excluded(participant) && cx.robot(participant).is_original();
        if is_asked && cx.now - cx.robot(participant).contact.heard > ASK {
            cx.send(participant, &[Command::Uuid]);
        }
    }
}

/// Stops all robots on straight drives a little ahead of the places that they reported last, and asks for their places.
pub(crate) fn halt_all(cx: &mut RunContext) {
    for participant in 0..cx.roster.len() {
        halt(cx, participant);
    }
}

/// Stops one robot as [`halt_all`] does, if it is on a straight drive.
pub(crate) fn halt(cx: &mut RunContext, participant: usize) {
    let Some(DrivenLeg { leg, targets }) = &cx.pipeline.driven else { return };
    let Some(place) = targets.under_way(participant) else { return };
    if cx.roster.is_excluded(participant) {
        return;
    }
    let (drive, state) = (&leg.drives[place], &targets.states[place]);
    let silent = (cx.now - cx.robot(participant).contact.heard).min(ASK);
    let ahead_m = PASSED_ERROR_M + STOPPING.speed_mps * (silent + STOPPING.reaction).as_secs();
    let target = drive.at((state.passed + ahead_m / drive.length_m()).min(state.granted));
    cx.send(participant, &[Command::Target(target), Command::Uuid]);
}

/// Lets robots that were halted on straight drives drive on.
pub(crate) fn resume_all(cx: &mut RunContext) {
    let participants = cx.pipeline.driven.as_ref().map_or(0, |driven| driven.targets.present.len());
    for participant in 0..participants {
        let Some(driven) = &mut cx.pipeline.driven else { return };
        let under_way = driven.targets.under_way(participant);
        if let Some(place) = under_way.filter(|_| !cx.roster.is_excluded(participant)) {
            driven.targets.states[place].moved_at = cx.now;
            send_target(cx, place);
        }
        let present = cx.pipeline.driven.as_ref().and_then(|driven| driven.targets.present[participant]);
        grant_farther(cx, false, present);
    }
}
