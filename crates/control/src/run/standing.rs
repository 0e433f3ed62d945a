//! The phase in which all robots stand. Meanwhile the air time (how long the show keeps robots in a frame) runs, and
//! the next legs are planned and uploaded. The next drive is started in time.
//!
//! A leg is the drive of all robots between two moments at which all stand.

use crate::event::{RunOutcome, Trouble};
use crate::leg::LegKind;
use crate::run::bystanders;
use crate::run::link_loss;
use crate::run::misplaced;
use crate::run::next::{AirTime, Next};
use crate::run::obstacles;
use crate::run::pipeline::Pipeline;
use crate::run::requests;
use crate::run::run_context::RunContext;
use crate::run::target_commands;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Details, RobotState};

/// How much earlier than necessary START is sent, because the program around this core may call it late.
const EARLY: Span = Span::from_millis(20);
/// Longest time between two checks of the phase.
const CHECK_EVERY: Span = Span::from_millis(1_000);

/// The state while all robots stand: in a frame, before the first one, or where a drive was broken off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// When robots may leave the frame.
    pub air: AirTime,
    /// When the link is checked next.
    check_at: Instant,
}

impl Standing {
    /// The state of robots that stand since `now`.
    pub fn begin(now: Instant, air: AirTime) -> Self {
        Self { air, check_at: now + CHECK_EVERY }
    }

    /// When [`on_tick`](Self::on_tick) has something to do next. START is sent `start_lead` before its moment. `waits`:
    /// the run is paused or waits for GO, so that no START is due.
    pub fn due(&self, pipeline: &Pipeline, start_lead: Span, now: Instant, waits: bool) -> Instant {
        let start = match pipeline.queue.front().map(|leg| leg.kind) {
            _ if waits => Instant::FAR,
            Some(LegKind::Routes) if pipeline.is_uploaded() => self.air.until - start_lead - EARLY,
            Some(LegKind::Routes) => Instant::FAR,
            _ => self.air.until,
        };
        pipeline.due().min(start).min(now + CHECK_EVERY)
    }

    /// Ends the air time at `now`, because the operator gave GO, steps to the next frame, or chose another frame.
    pub fn leave_now(&mut self, now: Instant) {
        (self.air.left, self.air.until) = (None, now);
    }

    /// Handles a status report of a participant. An unfit robot drops out, and a restarted one is sent its route again.
    /// If a robot stands elsewhere than planned, all is planned again.
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
        next.or_else(|| misplaced::check_status(cx, participant))
    }

    /// Does what is due: checks the link, plans and uploads the next legs, and leaves the frame.
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

    /// Returns the change to the next drive if the next leg is ready and the air time is over. For routes it is
    /// returned earlier, because START is sent ahead of its moment. If nothing more is planned, returns what [`end`]
    /// decides.
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
                    misplaced::prevents_start(cx).unwrap_or(Next::Start(until))
                }
            }
            None if planning.pending.is_none() && planning.next.is_none() && cx.now >= until => end(cx),
            _ => Next::Stay,
        }
    }
}

/// Ends the run, because nothing more is planned: as failed if the next frame has no plan, and otherwise as finished.
/// If the failed plan drove around obstacles that another plan can ignore, all is planned again instead.
fn end(cx: &mut RunContext) -> Next {
    // A plan that failed ahead does not matter once all frames were reached after all.
    let failure = cx.pipeline.planning.failure.take().filter(|_| !cx.playback.is_ended());
    match failure {
        None => Next::Over(RunOutcome::Finished),
        // The plan was made ahead, and what blocked it may have gone since.
        Some(_) if obstacles::relax(cx) => Next::Regather,
        Some(why) => Next::failed(why),
    }
}

/// Returns the dropout of a robot that reports a fault or does not know its place.
pub(crate) fn drop_if_unfit(participant: usize, details: &Details) -> Next {
    match details.state {
        RobotState::Faulty => Next::drop(participant, Trouble::Faulty),
        RobotState::Lost => Next::drop(participant, Trouble::Lost),
        _ => Next::Stay,
    }
}
