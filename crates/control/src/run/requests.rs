//! Plan requests, and what the run does with their results.
//!
//! A leg is the drive of all robots between two moments at which all stand. A jump is a choice of another next frame:
//! by the operator, or for the music.

use crate::event::EventKind;
use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::operation::MissingPolicy;
use crate::plan_request::{PlanProblem, PlanRequest, PlanResult, PlannedRobot};
use crate::run::bystanders;
use crate::run::next::Next;
use crate::run::obstacles;
use crate::run::playback::{Jump, RunPurpose};
use crate::run::run_context::RunContext;
use lightbots_base::Span;
use std::ops::ControlFlow;

/// Largest number of routes that one request plans, so that planning ends in bounded time: 40 frames for 10,000 robots.
const ROUTES_A_REQUEST: usize = 400_000;
/// Number of planned frames that the queue should hold. While it holds fewer, more frames are planned.
const FRAMES_AHEAD: usize = 3;
/// Largest number of dark pixels that an event lists.
const LISTED: usize = 16;

/// Makes the next plan request, if the queue holds fewer than `FRAMES_AHEAD` frames, no request is pending and a frame
/// is left to plan.
pub(crate) fn plan_ahead(cx: &mut RunContext) {
    let ahead = cx.pipeline.queue.iter().filter(|leg| leg.reaches_frame).count();
    let planning = &cx.pipeline.planning;
    let (Some(first), None, true) = (planning.next, planning.pending, ahead < FRAMES_AHEAD) else { return };
    if planning.from.len() != cx.roster.len() {
        cx.pipeline.planning.from = (0..cx.roster.len()).map(|participant| cx.place(participant)).collect();
    }
    let stopped = std::mem::take(&mut cx.pipeline.planning.is_urgent);
    let lenient = cx.playback.missing == MissingPolicy::LeaveOut || cx.pipeline.driven.is_some() || stopped;
    let most = if stopped { 1 } else { ROUTES_A_REQUEST / cx.roster.len().max(1) };
    let frames = take_frames(cx, first, most);
    let obstacles::Discs { reported, inferred } = obstacles::standing_discs(cx);
    let problem = PlanProblem {
        show: cx.playback.show.clone(),
        frames,
        robots: planned_robots(cx),
        participants: cx.roster.len(),
        standing: [&reported[..], &inferred[..]].concat(),
        inferred,
        mapping: cx.io.mapping.clone(),
        lenient,
        stopped,
    };
    cx.pipeline.planning.around = bystanders::places(cx);
    cx.io.plan_number += 1;
    cx.io.plan_request = Some(PlanRequest { number: cx.io.plan_number, problem });
    cx.pipeline.planning.pending = Some((cx.io.plan_number, cx.now));
}

/// Takes at most `most` frames for one request, from `first` on. All are in the same round of the show and the same
/// pass of a loop. The frames then count as planned.
fn take_frames(cx: &mut RunContext, first: FrameCursor, most: usize) -> Vec<FrameCursor> {
    let planning = &mut cx.pipeline.planning;
    let mut frames = vec![first];
    planning.last = first;
    planning.next = cx.playback.after(first);
    while let Some(next) = planning.next.filter(|next| frames.len() < most && next.is_in_pass_of(first)) {
        frames.push(next);
        planning.last = next;
        planning.next = cx.playback.after(next);
    }
    frames
}

fn planned_robots(cx: &RunContext) -> Vec<PlannedRobot> {
    let robot = |participant: usize| {
        let robot = cx.robot(participant);
        let at = cx.pipeline.planning.from[participant];
        PlannedRobot { participant, id: robot.id, at, original: robot.is_original() }
    };
    cx.roster.active().map(|(participant, _)| robot(participant)).collect()
}

/// Takes in the result of a plan request and queues its legs. `Break`: the caller applies this [`Next`] and does
/// nothing else. `Continue`: the caller applies it and then works with the queue. `is_standing`: robots stand and wait
/// for the plan.
pub(crate) fn accept(cx: &mut RunContext, result: PlanResult, is_standing: bool) -> ControlFlow<Next, Next> {
    if cx.pipeline.planning.pending.is_none_or(|(number, _)| number != result.number) {
        return ControlFlow::Break(Next::Stay);
    }
    cx.pipeline.planning.pending = None;
    if result.stopped && result.failed.is_none() {
        if let Some(next) = refuse_if_too_late(cx, &result) {
            return ControlFlow::Break(next);
        }
        cx.tally.recovery.replanned();
    }
    let PlanResult { legs, frames, dark, failed, mapping, stopped, .. } = result;
    (cx.io.mapping.owners, cx.io.mapping.shown) = (mapping.owners, mapping.shown);
    remember_ends(cx, &legs);
    report_dark(cx, &dark);
    queue_legs(cx, legs, stopped);
    match cx.playback.purpose {
        RunPurpose::Home => cx.io.log.record(cx.now, EventKind::PlannedHome),
        RunPurpose::Preflight => {}
        RunPurpose::Play | RunPurpose::Preview => cx.io.log.record(cx.now, EventKind::Planned { frames }),
    }
    match failed {
        Some(failed) => on_failure(cx, failed, is_standing),
        None if cx.pipeline.driven.is_none()
            && cx.pipeline.planning.is_dark
            && cx.playback.missing == MissingPolicy::Refuse =>
        {
            let why = "some pixels have no robot, or one that takes no part stands on them";
            ControlFlow::Break(Next::failed(why))
        }
        None => ControlFlow::Continue(Next::Stay),
    }
}

/// Notes where all robots stand at the end of the last leg, because the next request plans from there.
fn remember_ends(cx: &mut RunContext, legs: &[Leg]) {
    let Some(last) = legs.last() else { return };
    cx.pipeline.planning.from = last.robots.iter().map(|robot| robot.goal).collect();
    for participant in (0..cx.roster.len()).filter(|&one| cx.roster.is_excluded(one)) {
        cx.pipeline.planning.from[participant] = cx.place(participant);
    }
}

fn report_dark(cx: &mut RunContext, dark: &[(usize, Vec<u32>)]) {
    cx.pipeline.planning.is_dark = !dark.is_empty();
    for (frame, pixels) in dark {
        let (frame, count) = (*frame, pixels.len());
        let pixels = pixels.iter().copied().take(LISTED).collect();
        cx.io.log.record(cx.now, EventKind::LeftOut { frame, pixels, count });
    }
}

fn queue_legs(cx: &mut RunContext, legs: Vec<Leg>, stopped: bool) {
    let last = cx.pipeline.queue.back().or(cx.pipeline.leg());
    // Robots that were stopped do not leave from the frame before. The duration of this drive does not count for the
    // timeline.
    let mut before = last.map(|leg| leg.frame).filter(|_| !stopped);
    let mut takes = Span::ZERO;
    for mut leg in legs {
        leg.seq = cx.io.number_route();
        leg.around = cx.pipeline.planning.around.clone();
        takes += leg.duration;
        if leg.reaches_frame {
            if before.replace(leg.frame).is_some_and(|before| before + 1 == leg.frame) {
                cx.pipeline.light.times.plan_drive(leg.frame, takes);
            }
            let air = cx.playback.air_time(leg.frame);
            cx.tally.recovery.planned(leg.frame, std::mem::take(&mut takes) + air);
        }
        cx.pipeline.queue.push_back(leg);
    }
}

/// Handles that there is no plan to `frame`. The run ends if nothing was driven yet. If robots stand and nothing is
/// queued, a jump is undone, or else obstacles are dropped and all is planned again. Otherwise the reason is kept: the
/// run fails once nothing is left to drive.
fn on_failure(
    cx: &mut RunContext,
    (frame, message): (usize, String),
    is_standing: bool,
) -> ControlFlow<Next, Next> {
    cx.io.log.record(cx.now, EventKind::PlanFailed { frame, message: message.clone() });
    let why = format!("no plan for frame {}: {message}", frame + 1);
    cx.pipeline.planning.next = None;
    if cx.pipeline.driven.is_none() && cx.tally.frames_played == 0 {
        return ControlFlow::Break(Next::failed(why));
    }
    if cx.pipeline.queue.is_empty()
        && is_standing
        && let Some(jump) = cx.playback.jump
    {
        give_up(cx, jump, frame);
        return ControlFlow::Continue(Next::Stay);
    }
    if cx.pipeline.queue.is_empty() && is_standing && obstacles::relax(cx) {
        return ControlFlow::Continue(Next::Regather);
    }
    cx.pipeline.planning.failure = Some(why);
    ControlFlow::Continue(Next::Stay)
}

/// Undoes a jump, because no path leads to `frame`. The frame that was next before the jump is planned again.
fn give_up(cx: &mut RunContext, jump: Jump, frame: usize) {
    cx.playback.give_up(jump);
    cx.io.log.record(cx.now, EventKind::JumpGivenUp { frame });
    let planning = &mut cx.pipeline.planning;
    planning.next = (!cx.playback.is_ended()).then_some(cx.playback.next);
    planning.is_urgent = true;
    planning.from.clear();
}

/// Checks whether recovery from dropouts has cost too much time, or would with this plan. If it has or would, records
/// an event, and returns that all is planned again with fewer obstacles, or that the run ends. `None` otherwise.
fn refuse_if_too_late(cx: &mut RunContext, result: &PlanResult) -> Option<Next> {
    let takes = result.legs.iter().fold(Span::ZERO, |sum, leg| sum + leg.duration);
    let why = cx.tally.recovery.exceeded(cx.now + takes)?;
    let frame = cx.playback.next.frame;
    let message = format!("the drive around what stands there would take {:.0} s", takes.as_secs());
    cx.io.log.record(cx.now, EventKind::PlanFailed { frame, message });
    let is_hopeless = cx.tally.recovery.exceeded(cx.now).is_some() || !obstacles::relax(cx);
    Some(if is_hopeless { Next::failed(why) } else { Next::Regather })
}

/// Sets whether the show starts again after its last frame. With `looping`, the next round is planned; otherwise plans
/// for the next round are dropped. `is_starting`: START was sent for the first leg of the queue.
pub(crate) fn set_looping(cx: &mut RunContext, looping: bool, is_starting: bool) {
    let (playback, pipeline) = (&mut *cx.playback, &mut *cx.pipeline);
    let planning = &mut pipeline.planning;
    playback.looping = looping;
    if looping {
        if playback.is_ended() {
            playback.next = FrameCursor { round: playback.next.round + 1, ..FrameCursor::default() };
        }
        if planning.next.is_none() && planning.failure.is_none() {
            planning.next = playback.after(planning.last);
        }
        return;
    }
    let driven = pipeline.driven.as_ref().map(|driven| &driven.leg);
    let present = driven.filter(|_| !is_starting).map_or(playback.next.round, |leg| leg.round);
    pipeline.queue.retain(|leg| leg.round <= present);
    if planning.last.round > present {
        planning.pending = None;
        let frame = playback.show.frames.len().saturating_sub(1);
        planning.last = FrameCursor { frame, round: present, pass: 0 };
        if let Some(last) = pipeline.queue.back().or(driven) {
            planning.from = last.robots.iter().map(|robot| robot.goal).collect();
        }
    }
    planning.next = planning.next.filter(|next| next.round <= present);
    if playback.next.round > present {
        playback.next = FrameCursor { frame: usize::MAX, round: present, pass: 0 };
    }
}
