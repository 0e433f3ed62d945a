//! The broker is lost: robots stop by themselves, and the run waits for it.

use crate::run::next::{AirTime, Next};
use crate::run::run_context::RunContext;
use lightbots_base::{Instant, Span};

/// How often the wait is looked at.
const CHECK_EVERY: Span = Span::from_millis(1_000);

/// The broker is lost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offline {
    /// Since then.
    pub since: Instant,
    /// The frame that stood when the broker was lost: its air time goes on.
    pub stood: Option<AirTime>,
}

impl Offline {
    /// When something is due.
    pub fn due(&self, now: Instant) -> Instant {
        now + CHECK_EVERY
    }

    /// Time passes.
    pub fn on_tick(&mut self, cx: &mut RunContext) -> Next {
        if cx.now - self.since > cx.io.config.offline_bound {
            return Next::failed("the broker did not come back");
        }
        Next::Stay
    }
}
