//! What a robot knows of itself: place, doubt, what it is doing and what is wrong.

use super::Robot;
use crate::processor::Processor;
use crate::shelf::Shelf;
use core::borrow::BorrowMut;
use lightbots_base::{Instant, Pose, RobotId, Span, Vec2};
use lightbots_wire::RobotState;

/// A robot whose fixes stay away says how sure it will be so much later: until then nobody could stop.
const FORESIGHT: Span = Span::from_millis(500);
/// Fixes stay away when three have not come and this long has passed on top.
const OVERDUE: Span = Span::from_millis(16);

impl<S: BorrowMut<Shelf>> Robot<S> {
    /// Where it believes to be; `None` where it does not know, or does not know its heading.
    pub fn pose(&self) -> Option<Pose> {
        self.place().and_then(|_| self.estimate.pose())
    }

    pub(super) fn place(&self) -> Option<Vec2> {
        (!self.is_lost(self.now - self.lag)).then(|| self.estimate.at())
    }

    /// In which direction of body space that is for which its safety layer slows it in this step, radians; `None`: it is
    /// free.
    pub fn braking_towards(&self) -> Option<f64> {
        if self.wary { self.reflex.braking_towards() } else { None }
    }

    /// What it is doing.
    pub fn state(&self) -> RobotState {
        self.state
    }

    /// The show clock at `now` of its own clock; `None` until it is synchronised.
    pub fn show_time(&self, now: Instant) -> Option<Instant> {
        self.clock.show_time(now)
    }

    /// The show clock by which its route goes on: that of the world its wheels are in.
    pub(super) fn route_time(&self, now: Instant) -> Option<Instant> {
        self.clock.show_time(now).map(|show| show - self.lag)
    }

    /// How far it is from where its route says, metres; `None` without a route under way.
    pub fn off_m(&self) -> Option<f64> {
        self.routes.off_m()
    }

    /// Where its route wants it to be one step after the latest, stage metres; `None` without a route under way.
    pub fn route_place(&self) -> Option<Vec2> {
        self.routes.due()
    }

    /// Expected error of its place, 1 sigma in each coordinate, metres.
    pub fn place_error_m(&self) -> f64 {
        self.estimate.error_m()
    }

    /// The same half a second of its route from now, where fixes stay away; else now, metres.
    pub(super) fn err_m(&self) -> f64 {
        let way_m =
            if self.is_blind() { self.routes.way_ahead_m(FORESIGHT, self.shelf.borrow()) } else { 0.0 };
        let err_m = self.estimate.error_after_m(way_m);
        libm::round(err_m * 1e4) / 1e4
    }

    /// Whether it knows too little to drive. Held, it need not know that well.
    pub(super) fn is_lost(&self, now: Instant) -> bool {
        if self.routes.rests_held() { self.estimate.lost_for_good(now) } else { self.estimate.lost(now) }
    }

    /// The same as the step under way knows it: asked for again and again, and the answer hangs on the routes alone.
    pub(super) fn is_lost_now(&self) -> bool {
        if self.routes.rests_held() { self.doubts.for_good } else { self.doubts.lost }
    }

    /// Whether fixes that should have come stay away.
    pub(super) fn is_blind(&self) -> bool {
        self.estimate.blind(self.now - self.lag, self.config.fix_pace * 3 + OVERDUE)
    }

    /// Lets a processor fetch what [`fetch`](Self::fetch) looks at itself: some turns before that.
    #[inline]
    pub fn fetch_first(&self, processor: &impl Processor) {
        self.routes.fetch_first(processor);
    }

    /// Lets a processor fetch what the next step will look at. Who lets thousands of robots take turns does so a turn or two
    /// ahead: a step that has to wait for memory itself waits longer than it works.
    #[inline]
    pub fn fetch(&self, processor: &impl Processor) {
        processor.fetch(&self.config.fix_pace);
        processor.fetch(&self.config.limits.track_m);
        processor.fetch(&self.now);
        processor.fetch(&self.drive);
        processor.fetch(&self.stall);
        processor.fetch(&self.supervisor);
        processor.fetch(&self.seek);
        processor.fetch(&self.outbox);
        self.light.fetch(processor);
        self.clock.fetch(processor);
        self.estimate.fetch(processor);
        self.routes.fetch(processor);
    }

    /// Its name.
    pub fn id(&self) -> RobotId {
        self.config.id
    }

    /// Commands it did not know or could make no sense of, since power-on.
    pub fn unknown(&self) -> u32 {
        self.unknown
    }

    pub(super) fn what_it_does(&self, show: Option<Instant>) -> RobotState {
        if self.supervisor.is_faulty() {
            RobotState::Faulty
        } else if self.supervisor.is_cut() {
            RobotState::Cut
        } else if self.is_lost_now() {
            RobotState::Lost
        } else if self.routes.held(show) {
            RobotState::Held
        } else if self.routes.under_way() || self.seek.is_some() {
            RobotState::Driving
        } else if self.routes.keeps_one() {
            RobotState::Ready
        } else {
            RobotState::Idle
        }
    }

    /// What is wrong, in flashes of its light; an original robot shows nothing of it.
    pub(super) fn trouble(&self, now: Instant) -> u8 {
        match self.state {
            _ if self.config.abilities == Default::default() => 0,
            RobotState::Faulty => 3,
            RobotState::Cut => 2,
            RobotState::Lost => 1,
            _ if self.supervisor.is_down(now) => 2,
            _ => 0,
        }
    }
}
