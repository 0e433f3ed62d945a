//! Why a run has too few robots left to go on, in words for people.

use lightbots_base::Instant;

use crate::desk::Desk;
use crate::event::Trouble;
use crate::recovery::missing;
use crate::run::{Run, Seat};

impl Run {
    /// Why `riders` robots are too few for the `pixels` of the next frame. Reports from before `fresh_from` do not count.
    pub(crate) fn shortage(&self, desk: &Desk, fresh_from: Instant, riders: usize, pixels: usize) -> String {
        if riders > 0 {
            return format!("only {riders} of the {pixels} robots it needs can take part");
        }
        let is_silent = |known: &Seat| missing(desk, known, fresh_from) == Some(Trouble::Silent);
        let what = if self.seats.iter().all(is_silent) { "lost contact" } else { "dropped out" };
        match self.seats.len() {
            1 => format!("the only robot {what}"),
            robots => format!("all {robots} robots {what}"),
        }
    }
}
