//! What a rehearsal does between two steps of the world: messages and the controller's wake-ups, in their order.

use std::rc::Rc;

use lightbots_base::Instant;
use lightbots_control::{EventKind, Operation};
use lightbots_wire::Topic;

use super::Play;
use crate::breakdowns::Breakdowns;
use crate::broker_outages::BrokerOutages;
use crate::forgeries::Forgeries;
use crate::network::{Network, Way};
use crate::record::RehearsalRecord;

/// Most messages and wake-ups between two steps. Only a controller that wakes itself without end reaches it.
const ROUNDS_PER_STEP: usize = 1_000_000;

impl Play {
    /// Handles messages and wake-ups until `until`, in order.
    pub(super) fn pass_time(&mut self, until: Instant) {
        for _ in 0..ROUNDS_PER_STEP {
            let wake = self.controller.wake_at().map(|at| self.clock.when(at).max(self.now));
            let wake = wake.filter(|_| !self.is_controller_away());
            let message = self.network.next_at();
            let wakes_first = wake.is_some_and(|wake| message.is_none_or(|message| wake < message));
            if wakes_first {
                let at = wake.unwrap_or(until);
                if at > until {
                    return;
                }
                self.now = at;
                self.controller.wake(self.shown());
                self.drain_controller();
            } else {
                let Some((at, message)) = self.network.next_until(until) else { return };
                self.now = at.max(self.now);
                if let Some(robot) = self.network.next_receiver() {
                    self.robots.prefetch_receiver(robot);
                }
                match message.way {
                    Way::ToRobot(robot) if self.breakdowns.is_deaf(robot) || self.broker.is_cut(robot) => {}
                    Way::ToRobot(robot) => {
                        if let Some(invariants) = &mut self.invariants {
                            invariants.received(robot, self.now);
                        }
                        self.robots.receive(self.now, robot, message.topic, &message.payload);
                        let Self { robots, network, record, breakdowns, broker, forgeries, now, .. } = self;
                        robots.drain_messages(robot, &mut |robot, topic, text| {
                            send(
                                network,
                                record,
                                (breakdowns, broker, forgeries),
                                *now,
                                (robot, topic, text),
                            );
                        });
                    }
                    Way::ToController(_) if self.crashes.is_gone() => {}
                    Way::ToController(robot) => {
                        self.hash.word(at.0 ^ (robot as u64) << 48);
                        self.hash.bytes(&message.payload);
                        self.controller.message(self.shown(), &message.topic.write(), &message.payload);
                        self.drain_controller();
                    }
                }
            }
        }
    }

    /// Whether there is no controller, or its computer sleeps.
    pub(super) fn is_controller_away(&self) -> bool {
        self.crashes.is_gone() || self.clock.is_asleep(self.now)
    }

    pub(super) fn drain_controller(&mut self) {
        while let Some(send) = self.controller.next_send() {
            let payload: Rc<[u8]> = send.payload.into();
            match send.topic {
                Topic::Robot(id) => {
                    let place = self.by_id.binary_search_by_key(&id, |entry| entry.0);
                    let first = place.ok().map(|place| self.by_id[place]);
                    let named = first.iter().chain(&self.namesakes).filter(|(name, _)| *name == id);
                    // A robot that has another name by now has subscribed to that one.
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
}

/// Sends a message of a robot to the controller, unless the robot is mute.
pub(super) fn send(
    network: &mut Network,
    record: &mut RehearsalRecord,
    (breakdowns, broker, forgeries): (&Breakdowns, &BrokerOutages, &mut Forgeries),
    now: Instant,
    (robot, topic, text): (usize, Topic, &[u8]),
) {
    if topic == Topic::Arrival {
        record.arrived(robot, now);
    }
    if !breakdowns.is_mute(robot) && !broker.is_cut(robot) {
        network.send(now, Way::ToController(robot), topic, forgeries.forge(robot, topic, text).into());
    }
}
