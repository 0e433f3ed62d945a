//! The messages that the robot sends, and when it reports without being asked.

use core::borrow::BorrowMut;

use lightbots_base::{Instant, wrap};
use lightbots_wire::{Blocked, Details, Report, RobotState, TimeQuestion, Topic};

use super::state::Robot;
use crate::outbox::MessageKind;
use crate::reflex::Block;
use crate::storage::RouteStorage;

/// Payload of an outgoing message. The longest report has 343 bytes.
pub type Message = heapless::String<376>;

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    /// Takes the next outgoing message: writes its payload to `out` and returns its topic. `None` if no message is to
    /// be sent.
    #[inline]
    pub fn outgoing(&mut self, out: &mut Message) -> Option<Topic> {
        out.clear();
        if self.hot.outbox.is_empty() { None } else { self.write_next(out) }
    }

    fn write_next(&mut self, out: &mut Message) -> Option<Topic> {
        let at = self.place();
        let kind = self.hot.outbox.take(at.is_some(), self.hot.takes_routes)?;
        let (topic, route) = match kind {
            MessageKind::Introduction => (Topic::Uuid, self.hot.routes.named()),
            MessageKind::Arrival(route) => (Topic::Arrival, route),
            MessageKind::Status => (Topic::Status, self.hot.routes.named()),
            MessageKind::Question => {
                let question = TimeQuestion { id: self.config.id, asked: self.hot.now };
                return question.encode(out).ok().map(|()| Topic::Time);
            }
        };
        let speaks_ours = self.config.abilities != Default::default();
        // No report got out while the robot was cut off. So the introduction over the new link says that it was.
        let was_cut = kind == MessageKind::Introduction && self.hot.supervisor.take_untold();
        let state = if was_cut { RobotState::Cut } else { self.hot.state };
        let details = speaks_ours.then(|| Details { route, state, ..self.details() });
        Report { id: self.config.id, at, details }.encode(out).ok()?;
        Some(topic)
    }

    /// The obstacle to report; `None` if there is none.
    pub(super) fn block(&self) -> Option<Block> {
        if self.hot.is_wary { self.reflex.block() } else { None }
    }

    /// The obstacle to report, with its gap in metres and its direction in the stage in radians. `None` if there is no
    /// such obstacle or the pose is unknown.
    pub(super) fn blocked(&self) -> Option<Blocked> {
        let (block, pose) = (self.block()?, self.pose()?);
        Some(Blocked { gap_m: block.gap_m, towards: wrap(pose.heading + block.towards) })
    }

    /// Puts the messages that are due after a step at `now` (own clock) into the outbox.
    pub(super) fn notice(&mut self, now: Instant) {
        let hot = &mut self.hot;
        if hot.takes_routes && hot.supervisor.is_up() && hot.clock.is_question_due(now) {
            self.clock_filter.ask(&mut hot.clock, now);
            hot.outbox.ask_time();
        }
        let knows_place = hot.state != RobotState::Lost && !self.is_lost_now();
        let is_blind = self.hot.routes.under_way() && self.hot.quality.blind;
        let err_m = is_blind.then(|| self.err_m());
        let off_m = self.hot.routes.due_off_m();
        let rests = matches!(self.hot.state, RobotState::Idle | RobotState::Ready) && self.hot.drive.stands();
        let error_m = if rests { self.hot.estimate.error_m() } else { 0.0 };
        let at = knows_place.then(|| (self.hot.estimate.at(), error_m));
        // In a silence a report would be lost. The robot says where it is once messages come again.
        if rests && !self.hot.supervisor.is_silent(now) {
            self.hot.outbox.notice_place(now, at.map(|(at, _)| at));
        }
        self.hot.outbox.notice(now, self.hot.state, off_m, err_m, at);
        let towards = if self.hot.is_wary { self.blocked().map(|blocked| blocked.towards) } else { None };
        self.hot.outbox.notice_block(towards);
    }

    fn details(&self) -> Details {
        Details {
            heading: self.pose().map(|pose| pose.heading),
            battery: self.battery,
            state: self.hot.state,
            route: self.hot.routes.named(),
            light: self.light.tracks.newest(),
            slot: self.light.live.slot(),
            starts: self.hot.routes.starts().filter(|_| self.hot.clock.show_time(self.hot.now).is_some()),
            off_m: self.hot.routes.due_off_m(),
            err_m: self.place().map(|_| self.err_m()),
            clock_us: self.clock_filter.error_us(&self.hot.clock, self.hot.now),
            firmware: self.config.firmware.clone(),
            abilities: self.config.abilities,
            unknown: self.unknown,
            blocked: self.blocked(),
            simulated: self.config.simulated,
            brakes: self.reflex.encounters.brakes(),
            near_m: self.reflex.encounters.near_m(),
        }
    }
}
