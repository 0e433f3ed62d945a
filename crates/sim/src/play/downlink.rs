//! The controller's outputs: messages for the network, events, and the journal.

use std::rc::Rc;

use lightbots_control::{EventKind, Operation};
use lightbots_wire::Topic;

use super::state::Play;
use crate::network::Way;

impl Play {
    /// Handles all messages, events and pieces of the journal that the controller has put out.
    pub(super) fn drain_controller(&mut self) {
        while let Some(send) = self.controller.next_send() {
            let payload: Rc<[u8]> = send.payload.into();
            match send.topic {
                Topic::Robot(id) => {
                    let place = self.by_id.binary_search_by_key(&id, |entry| entry.0);
                    let first = place.ok().map(|place| self.by_id[place]);
                    let named = first.iter().chain(&self.namesakes).filter(|(name, _)| *name == id);
                    // A robot that has another name by now has subscribed to the topic of that name.
                    for &(_, robot) in named.filter(|(_, robot)| self.robots.id(*robot) == id) {
                        self.network.send(self.now, Way::ToRobot(robot), send.topic, payload.clone());
                    }
                }
                topic => {
                    for robot in 0..self.robots.len() {
                        self.network.send(self.now, Way::ToRobot(robot), topic, payload.clone());
                    }
                }
            }
        }
        while let Some(event) = self.controller.next_event() {
            let event = self.clock.in_virtual_time(event);
            if matches!(event.kind, EventKind::LinkBack { asks_operator: true, .. }) {
                self.operator.asked(self.now);
            }
            if matches!(event.kind, EventKind::FrameReached { .. })
                && let Some(frame) = self.visits.pop_front()
            {
                self.operator.does(self.now, Operation::GoTo(frame));
            }
            if let Some(invariants) = &mut self.invariants {
                invariants.event(&event, &self.by_id);
            }
            self.record.event(&event, &self.controller, &self.robots, &self.by_id, &self.show);
        }
        self.write_journal();
    }

    /// Writes the new piece of the journal, if there is one. Some time after a failure of the disk, the journal is
    /// first begun again.
    fn write_journal(&mut self) {
        if self.crashes.disk.begins_again(self.now) {
            self.controller.begin_journal_again();
        }
        if let Some(piece) = self.controller.take_journal(self.clock.computer_time(self.now)) {
            self.crashes.disk.write(self.now, piece);
        }
    }
}
