//! A driving robot falls silent: the fleet holds.
//!
//! It may have died, or nobody hears it and it holds with the others, or its link broke and it drives on along its path
//! until it stops by itself. Robots that hold where it drives on are seen by its proximity sensors; a dead robot sees
//! nothing.

use crate::desk::Desk;
use crate::driving::Drive;
use crate::event::Trouble;
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Span};
use lightbots_wire::Route;

/// A robot that fell silent died at most this long after its last report.
pub(crate) const UNHEARD: Span = Span::from_millis(600);
/// One whose link broke after that drives on for so long at least, and so much longer at most.
pub(crate) const CUT: (Span, Span) = (Span::from_millis(1_500), Span::from_millis(1_000));
/// Everybody waits for a driving robot that was not heard for so long, link times on top.
const HUSH: Span = Span::from_millis(800);
impl Run {
    /// A driving robot was not heard for so long: whether everybody waits for it by now, or it is dropped.
    pub fn watch_silent(&mut self, desk: &mut Desk, now: Instant, seat: usize, silent: Span) -> bool {
        let Phase::Driving(drive) = self.phase else { return false };
        let silence = desk.config.silence + self.round_trip * 2;
        if silent > silence && self.all_stand(now, silent, &drive) {
            self.drop_out(desk, now, seat, Trouble::Silent);
            return true;
        }
        let held = drive.hold.is_some_and(|hold| hold.until.is_none());
        if held || silent <= HUSH + self.round_trip || self.seats[seat].late.is_some() {
            return false;
        }
        self.mark_late(desk, now, seat, Trouble::Silent);
        true
    }

    /// Whether all stand who drive, or as good as: told to stop now they would not stop together with one that does not
    /// hear it.
    fn all_stand(&self, now: Instant, silent: Span, drive: &Drive) -> bool {
        let bound = CUT.0 + CUT.1 + Route::EASE + self.hold_lead() * 2;
        silent > bound
            || match drive.hold.filter(|hold| hold.until.is_none()) {
                Some(hold) => now >= hold.at + Route::EASE,
                None => now >= drive.ends,
            }
    }
}
