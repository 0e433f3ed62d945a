//! HOLD and RESUME: everybody slows down and picks up together, so that nobody leaves the plan.

use crate::desk::Desk;
use crate::event::{EventKind, Trouble};
use crate::leg::Kind;
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Route};

/// HOLD and RESUME are said this often, …
const SAY: u32 = 5;
/// … this far apart.
const SAY_EVERY: Span = Span::from_millis(30);
/// Later than this before the end, holding gains nothing.
const HOLD_WORTH: Span = Span::from_millis(400);

/// Progress is held.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hold {
    pub at: Instant,
    /// The operator wants it.
    pub by_operator: bool,
    /// When progress picks up again, once that is said.
    pub until: Option<Instant>,
    /// When that is to be said: not long before it can be, so that it can still be thought better of.
    pub release_at: Option<Instant>,
    /// When it is looked at whether all stand.
    pub check_at: Instant,
}

impl Run {
    /// Everybody slows down together.
    pub fn hold(&mut self, desk: &mut Desk, now: Instant, by_operator: bool) {
        let lead = self.hold_lead();
        let Phase::Driving(drive) = &mut self.phase else { return };
        if let Some(hold) = &mut drive.hold
            && hold.until.is_none()
        {
            hold.by_operator |= by_operator;
            hold.release_at = None;
            return;
        }
        if !by_operator && now + HOLD_WORTH > drive.ends {
            return;
        }
        let mut at = now + lead;
        if let Some(Hold { at: before, until: Some(until), .. }) = drive.hold {
            // All are still picking up again: they stop once they have.
            at = at.max(until + Route::EASE);
            drive.lost += until - before;
        }
        let check_at = at + Route::EASE + Span::from_millis(400);
        drive.hold = Some(Hold { at, by_operator, until: None, release_at: None, check_at });
        if self.current.as_ref().is_some_and(|leg| leg.kind == Kind::Targets) {
            self.halt_originals(desk, now);
        } else {
            desk.outbox.broadcast(now, Command::Hold { at }, SAY, SAY_EVERY);
        }
    }

    /// Everybody picks up again together, once all stand: stated further ahead, one hold after the other would be put
    /// off until long after what it is for.
    pub fn release(&mut self, desk: &mut Desk, now: Instant) {
        let lead = self.hold_lead();
        let Phase::Driving(drive) = &mut self.phase else { return };
        let Some(hold) = drive.hold.as_mut().filter(|hold| hold.until.is_none()) else { return };
        let sayable = hold.at + Route::EASE - lead;
        if now < sayable {
            (hold.release_at, hold.by_operator) = (Some(sayable), false);
            return;
        }
        let until = (now + lead).max(hold.at + Route::EASE);
        (hold.until, hold.release_at) = (Some(until), None);
        drive.ends += until - hold.at;
        drive.ask_at = drive.ends + Span::from_millis(300);
        desk.log.tell(now, EventKind::Resumed);
        if self.current.as_ref().is_some_and(|leg| leg.kind == Kind::Targets) {
            self.resume_hops(desk, now);
        } else {
            desk.outbox.broadcast(now, Command::Resume { at: until }, SAY, SAY_EVERY);
        }
    }

    /// Everybody waits for a robot.
    pub fn wait_for(&mut self, desk: &mut Desk, now: Instant, seat: usize, why: Trouble) {
        let robot = desk.fleet.robot(self.seats[seat].robot).id;
        desk.log.tell_limited(now, EventKind::Waiting { robot, why });
        self.hold(desk, now, false);
    }
}
