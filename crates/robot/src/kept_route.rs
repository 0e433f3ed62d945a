//! The kept route: the next route, which waits for its START or its start time.

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::Route;

use crate::drive::{BodyPose, Setpoint};
use crate::follow::Follow;
use crate::look_ahead::LookAhead;
use crate::storage::Slot;

/// A START is refused if its moment is past by more than this. With a smaller value, robots on slow links refuse more
/// STARTs. With a larger value, a robot would jump onto a route that others have driven for long.
pub(crate) const TOO_LATE: Span = Span::from_millis(500);
/// A robot turns towards a kept route only if it is within this distance of the route's start, metres. With a smaller
/// value, robots that have just arrived (R36 of docs/protocol.md) may not turn in time. With a larger value, robots
/// that aborted their last route turn towards a route that they cannot drive.
const BEGINS_HERE_M: f64 = 0.02;

/// A route that waits for its START or its start time.
#[derive(Debug)]
pub(crate) struct KeptRoute {
    pub(crate) slot: Slot,
    pub(crate) seq: u32,
    pub(crate) follow: Follow,
    pub(crate) starts: Option<Instant>,
    begin: Vec2,
    ahead: Option<Vec2>,
    /// Whether the robot turns towards the route before the start. After an outage of the link, it does so only once
    /// the START has come.
    is_turned_to: bool,
}

impl KeptRoute {
    pub(crate) fn new(slot: Slot, route: &Route, is_turned_to: bool) -> Self {
        let ahead = LookAhead::default().look(route, (0, Span::ZERO), Span::ZERO).map(|ahead| ahead.towards);
        let (seq, begin) = (route.seq, route.start);
        Self { slot, seq, starts: None, follow: Follow::new(), begin, ahead, is_turned_to }
    }

    /// Whether a START for the moment `at` is refused, because the moment is past by more than [`TOO_LATE`]. `show`:
    /// the show clock now. Without it, no START is refused.
    pub(crate) fn is_late(&self, at: Instant, show: Option<Instant>) -> bool {
        show.is_some_and(|show| show - at > TOO_LATE)
    }

    /// Sets that the route begins at the moment `at`, show clock, and allows the robot to turn towards it. A further
    /// START counts only if its moment is later: a START with an earlier moment is an old message that was overtaken.
    /// Returns whether the moment changed.
    pub(crate) fn start(&mut self, at: Instant) -> bool {
        self.is_turned_to = true;
        let is_news = self.starts.is_none_or(|known| known < at);
        if is_news {
            self.starts = Some(at);
        }
        is_news
    }

    /// Makes the robot stop turning towards the route until the START comes.
    pub(crate) fn await_start(&mut self) {
        self.is_turned_to = false;
    }

    /// The setpoint that turns the robot towards the first direction of the route. `None` if the robot shall not turn,
    /// if the route begins farther away than [`BEGINS_HERE_M`], or if the route does not move.
    pub(crate) fn prepare(&mut self, body: BodyPose) -> Option<Setpoint> {
        let is_here = self.begin.distance(body.at) < BEGINS_HERE_M;
        self.ahead.filter(|_| self.is_turned_to && is_here).map(|ahead| self.follow.prepare(ahead, body))
    }
}
