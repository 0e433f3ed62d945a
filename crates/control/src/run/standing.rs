//! All stand: the air time runs, what comes is planned and uploaded, and the next drive starts in time.

use crate::event::{EventKind, RunOutcome, Trouble};
use crate::leg::LegKind;
use crate::run::bystanders;
use crate::run::driving::is_there;
use crate::run::link_loss;
use crate::run::next::{AirTime, Next};
use crate::run::obstacles;
use crate::run::pipeline::Pipeline;
use crate::run::requests;
use crate::run::run_context::RunContext;
use crate::run::target_commands;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Details, RobotState};

/// START is stated this much earlier than it must be, because the shell may wake the controller late.
const EARLY: Span = Span::from_millis(20);
/// How often the phase is looked at while nothing is due.
const CHECK_EVERY: Span = Span::from_millis(1_000);

/// All stand, in a frame or before the first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// When the frame may be left.
    pub air: AirTime,
    /// When the link is looked at.
    check_at: Instant,
}

impl Standing {
    /// All stand since now.
    pub fn begin(now: Instant, air: AirTime) -> Self {
        Self { air, check_at: now + CHECK_EVERY }
    }

    /// When something is due; START is stated `start_lead` ahead. `waits`: the run is paused, or waits for GO.
    pub fn due(&self, pipeline: &Pipeline, start_lead: Span, now: Instant, waits: bool) -> Instant {
        let start = match pipeline.queue.front().map(|leg| leg.kind) {
            _ if waits => Instant::FAR,
            Some(LegKind::Routes) if pipeline.is_uploaded() => self.air.until - start_lead - EARLY,
            Some(LegKind::Routes) => Instant::FAR,
            _ => self.air.until,
        };
        pipeline.due().min(start).min(now + CHECK_EVERY)
    }

    /// The frame is left at once: the operator gives GO, or steps to the next one.
    pub fn leave_now(&mut self, now: Instant) {
        (self.air.left, self.air.until) = (None, now);
    }

    /// A participant that is to stand reports its state.
    pub fn on_report(
        &mut self,
        cx: &mut RunContext,
        participant: usize,
        details: &Details,
        restarted: bool,
    ) -> Next {
        let next = drop_if_unfit(participant, details);
        if next.stays() && restarted {
            return cx.upload_again(participant);
        }
        next
    }

    /// Time passes.
    pub fn on_tick(&mut self, cx: &mut RunContext) -> Next {
        if cx.now >= self.check_at {
            self.check_at = cx.now + CHECK_EVERY;
            target_commands::ask_places(cx);
            if let Some(silent) = link_loss::apparent(cx) {
                return Next::Interrupt(Some(silent));
            }
            let lost = if cx.playback.waits_for_go { link_loss::stale(cx) } else { Vec::new() };
            if !lost.is_empty() {
                return Next::Drop(lost.into_iter().map(|one| (one, Trouble::Silent)).collect());
            }
        }
        requests::plan_ahead(cx);
        cx.pump_lights();
        let next = cx.pump();
        if !next.stays() {
            return next;
        }
        if cx.playback.paused {
            self.air.left.get_or_insert((self.air.until - cx.now).max(Span::ZERO));
            return Next::Stay;
        }
        if let Some(left) = self.air.left.take() {
            self.air.until = cx.now + left;
        }
        let pending = cx.pipeline.planning.pending;
        if pending.is_some_and(|(_, since)| cx.now - since > cx.io.config.waits.plan) {
            return Next::failed("planning took too long");
        }
        self.leave(cx)
    }

    /// Leaves the frame, if its air time is over and there is a next leg.
    fn leave(&self, cx: &mut RunContext) -> Next {
        if cx.playback.waits_for_go {
            return Next::Stay;
        }
        let until = self.air.until;
        let planning = &cx.pipeline.planning;
        match cx.pipeline.queue.front().map(|leg| leg.kind) {
            Some(LegKind::Targets) if cx.now >= until => Next::Drive(cx.now),
            Some(LegKind::Routes)
                if cx.pipeline.is_uploaded() && cx.now + cx.start_lead() + EARLY >= until =>
            {
                if bystanders::obstruct_next(cx) {
                    Next::Regather
                } else {
                    Next::Start(until)
                }
            }
            None if planning.pending.is_none() && planning.next.is_none() && cx.now >= until => end(cx),
            _ => Next::Stay,
        }
    }
}

/// Nothing is planned any more: the run is over, unless something is left to try.
fn end(cx: &mut RunContext) -> Next {
    // A plan that failed ahead says nothing once all frames were reached after all.
    let failure = cx.pipeline.planning.failure.take().filter(|_| !cx.playback.is_ended());
    match failure {
        None => Next::Over(RunOutcome::Finished),
        // What stood in the way when that was planned ahead may have gone.
        Some(_) if obstacles::relax(cx) => Next::Regather,
        Some(why) => Next::failed(why),
    }
}

/// Drops a standing participant that is faulty or does not know its place.
pub(crate) fn drop_if_unfit(participant: usize, details: &Details) -> Next {
    match details.state {
        RobotState::Faulty => Next::drop(participant, Trouble::Faulty),
        RobotState::Lost => Next::drop(participant, Trouble::Lost),
        _ => Next::Stay,
    }
}

/// A place that is reported while all stand: an arrival that is old or of a robot that went somewhere on its own, or a robot
/// that knows TARGET only and was lifted, which does not notice that.
pub(crate) fn check_place(cx: &mut RunContext, participant: usize, at: Option<Vec2>, noise_m: f64) {
    let (Some(at), Some(goal)) = (at, cx.goal(participant)) else { return };
    let is_known = cx.pipeline.planning.is_outdated;
    if is_known || is_there(at, goal, cx.io.config.arrival_tolerance_m + noise_m) {
        return;
    }
    let robot = cx.robot(participant).id;
    cx.io.unexpected += 1;
    cx.io.log.record_limited(cx.now, EventKind::Misaligned { robot, off_m: at.distance(goal) });
    cx.pipeline.planning.is_outdated = true;
}
