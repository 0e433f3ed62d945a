//! What the robot says of itself.

use core::borrow::BorrowMut;

use lightbots_base::wrap;
use lightbots_wire::{Blocked, Details, Report, RobotState, TimeQuestion, Topic};

use super::{Message, Robot};
use crate::outbox::Fact;
use crate::reflex::Block;
use crate::shelf::Shelf;

impl<S: BorrowMut<Shelf>> Robot<S> {
    /// Writes the next message it has to send; `None`, and an empty message, when there is none.
    #[inline]
    pub fn outgoing(&mut self, out: &mut Message) -> Option<Topic> {
        out.clear();
        if self.outbox.is_empty() { None } else { self.write_next(out) }
    }

    fn write_next(&mut self, out: &mut Message) -> Option<Topic> {
        let at = self.place();
        let fact = self.outbox.take(at.is_some(), self.config.abilities.route)?;
        let (topic, route) = match fact {
            Fact::Introduction => (Topic::Uuid, self.routes.named()),
            Fact::Arrival(route) => (Topic::Arrival, route),
            Fact::Status => (Topic::Status, self.routes.named()),
            Fact::Question => {
                let question = TimeQuestion { id: self.config.id, asked: self.now };
                return question.encode(out).ok().map(|()| Topic::Time);
            }
        };
        let speaks_ours = self.config.abilities != Default::default();
        // Nobody heard that it was cut while it was: the first report over the new link says it.
        let was_cut = fact == Fact::Introduction && self.supervisor.take_untold();
        let state = if was_cut { RobotState::Cut } else { self.state };
        let details = speaks_ours.then(|| Details { route, state, ..self.details() });
        Report { id: self.config.id, at, details }.encode(out).ok()?;
        Some(topic)
    }

    /// What stands in its way.
    pub(super) fn block(&self) -> Option<Block> {
        if self.wary { self.reflex.block() } else { None }
    }

    /// What stands in its way: how far, and in which direction of the stage.
    pub(super) fn blocked(&self) -> Option<Blocked> {
        let (block, pose) = (self.block()?, self.pose()?);
        Some(Blocked { gap_m: block.gap_m, towards: wrap(pose.heading + block.towards) })
    }

    fn details(&self) -> Details {
        Details {
            heading: self.pose().map(|pose| pose.heading),
            battery: self.battery,
            state: self.state,
            route: self.routes.named(),
            starts: self.routes.starts().filter(|_| self.clock.show_time(self.now).is_some()),
            off_m: self.routes.off_m(),
            err_m: self.place().map(|_| self.err_m()),
            clock_us: self.clock.error_us(self.now),
            firmware: self.config.firmware.clone(),
            abilities: self.config.abilities,
            unknown: self.unknown,
            blocked: self.blocked(),
            simulated: self.config.simulated,
        }
    }
}
