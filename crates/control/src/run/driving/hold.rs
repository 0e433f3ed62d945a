//! HOLD and RESUME: all robots slow down together and pick up speed together, so that they keep to the proven plan.

use crate::event::{EventKind, Trouble};
use crate::mutant::Mutant;
use crate::run::driving::drive::{ASK_AFTER_END, Driving};
use crate::run::link_loss;
use crate::run::path_clock::Hold;
use crate::run::run_context::RunContext;
use crate::run::target_commands;
use lightbots_base::Span;
use lightbots_wire::{Command, Route};

/// How many copies of HOLD and RESUME are sent, and the time between them. With one message in ten lost, one robot of
/// 100,000 misses all copies.
const COPIES: (u32, Span) = (5, Span::from_millis(30));
/// Least time before the planned end of the drive at which a hold still begins, unless the operator asks for it. Robots
/// need [`Route::EASE`] to stop and as long to pick up speed.
const WORTH: Span = Span::from_millis(400);
/// Time from when all robots should stand in a hold until the controller checks that they do. Each robot has reported
/// by then.
const CHECK_AFTER: Span = Span::from_millis(400);

impl Driving {
    /// Begins a hold: all robots slow down together. A hold that has begun, and for which no RESUME was sent, is only
    /// prolonged. Does nothing shortly before the end of the drive, unless the operator asks.
    pub fn hold(&mut self, cx: &mut RunContext, by_operator: bool) {
        let (now, clock) = (cx.now, &mut self.clock);
        if let Some(hold) = &mut clock.hold
            && hold.until.is_none()
        {
            hold.by_operator |= by_operator;
            hold.release_at = None;
            return;
        }
        if !by_operator && now + WORTH > clock.ends {
            return;
        }
        let mut at = now + cx.link.hold_lead();
        if let Some(Hold { at: before, until: Some(until), .. }) = clock.hold {
            // Robots may still be picking up speed: the new hold begins after that.
            at = at.max(until + Route::EASE);
            clock.lost += until - before;
        }
        let check_at = at + Route::EASE + CHECK_AFTER;
        clock.hold = Some(Hold { at, by_operator, until: None, release_at: None, check_at });
        if cx.is_target_leg() {
            target_commands::halt_all(cx);
        } else if !Mutant::SkipHold.is_planted() {
            cx.io.outbox.broadcast(now, Command::Hold { at }, COPIES.0, COPIES.1);
        }
    }

    /// Ends a hold: sends RESUME, so that all robots pick up speed together once all stand. RESUME is sent no earlier
    /// than needed for that. After RESUME the next hold can begin only when robots are back at full speed. If this call
    /// is too early, only notes when RESUME is to be sent.
    pub fn release(&mut self, cx: &mut RunContext) {
        let (now, lead) = (cx.now, cx.link.resume_lead());
        let Some(hold) = self.clock.hold.as_mut().filter(|hold| hold.until.is_none()) else { return };
        let statable = hold.at + Route::EASE - lead;
        if now < statable {
            (hold.release_at, hold.by_operator) = (Some(statable), false);
            return;
        }
        let until = (now + lead).max(hold.at + Route::EASE);
        (hold.until, hold.release_at) = (Some(until), None);
        self.clock.ends += until - hold.at;
        self.ask_at = self.clock.ends + ASK_AFTER_END;
        cx.io.log.record(now, EventKind::Resumed);
        if cx.is_target_leg() {
            target_commands::resume_all(cx);
        } else {
            cx.io.outbox.broadcast(now, Command::Resume { at: until }, COPIES.0, COPIES.1);
            self.heartbeat_at = self.heartbeat_at.min(now);
        }
    }

    /// Ends the operator's part in a hold. Robots pick up speed again, unless the hold is still needed for a late
    /// robot.
    pub fn resume(&mut self, cx: &mut RunContext) {
        if let Some(hold) = &mut self.clock.hold {
            hold.by_operator = false;
        }
        if self.late == 0 {
            self.release(cx);
        }
    }

    /// Notes that all robots wait for a participant because of `why`, records an event, and begins a hold unless the
    /// drive is about to end. If the participant is silent, also asks all robots for a report.
    pub fn mark_late(&mut self, cx: &mut RunContext, participant: usize, why: Trouble) {
        self.late += 1;
        self.progress[participant].late_since = Some(cx.now);
        self.progress[participant].is_unsure = why == Trouble::Unsure;
        cx.report_waiting(participant, why);
        if why == Trouble::Silent {
            link_loss::ask_all(cx);
        }
        self.hold(cx, false);
    }

    /// Notes that a participant is no longer late. Returns whether it was late.
    pub fn clear_late(&mut self, participant: usize) -> bool {
        let was_late = self.progress[participant].late_since.take().is_some();
        if was_late {
            self.late = self.late.saturating_sub(1);
        }
        was_late
    }
}
