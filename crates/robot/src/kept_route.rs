//! The route that waits for its START.

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::Route;

use crate::drive::{BodyPose, Setpoint};
use crate::follow::Follow;
use crate::look_ahead::LookAhead;
use crate::storage::Slot;

/// A START that comes later than this after its moment is refused. Above, a robot would jump onto a route far under
/// way.
pub(crate) const TOO_LATE: Span = Span::from_millis(500);
/// Distance to the begin of a kept route within which a robot turns towards the route, metres. Below, robots that have
/// just arrived (R36) may not turn in time. Above, robots whose last route was aborted turn towards a route that they
/// cannot drive.
const BEGINS_HERE_M: f64 = 0.02;

/// A route that waits for its START.
#[derive(Debug)]
pub(crate) struct KeptRoute {
    pub(crate) slot: Slot,
    pub(crate) seq: u32,
    pub(crate) follow: Follow,
    pub(crate) starts: Option<Instant>,
    begin: Vec2,
    ahead: Option<Vec2>,
    /// Whether the robot turns towards the route. After an outage it does only once the START has come.
    is_turned_to: bool,
}

impl KeptRoute {
    pub(crate) fn new(slot: Slot, route: &Route, is_turned_to: bool) -> Self {
        let ahead = LookAhead::default().look(route, (0, Span::ZERO), Span::ZERO).map(|ahead| ahead.towards);
        let (seq, begin) = (route.seq, route.start);
        Self { slot, seq, starts: None, follow: Follow::new(), begin, ahead, is_turned_to }
    }

    /// Whether a START for the moment `at` is refused, because that is too long ago.
    pub(crate) fn is_late(&self, at: Instant, show: Option<Instant>) -> bool {
        show.is_some_and(|show| show - at > TOO_LATE)
    }

    /// Sets when the route begins. A later START counts only if its moment is later too: one with an earlier moment is
    /// an old message that was overtaken. Returns whether the moment changed.
    pub(crate) fn start(&mut self, at: Instant) -> bool {
        self.is_turned_to = true;
        let is_news = self.starts.is_none_or(|known| known < at);
        if is_news {
            self.starts = Some(at);
        }
        is_news
    }

    /// Stops turning towards the route until its START comes.
    pub(crate) fn await_start(&mut self) {
        self.is_turned_to = false;
    }

    /// The setpoint to turn towards the first direction of the route. `None` if the robot shall not turn or the route
    /// begins elsewhere.
    pub(crate) fn prepare(&mut self, body: BodyPose) -> Option<Setpoint> {
        let is_here = self.begin.distance(body.at) < BEGINS_HERE_M;
        self.ahead.filter(|_| self.is_turned_to && is_here).map(|ahead| self.follow.prepare(ahead, body))
    }
}
