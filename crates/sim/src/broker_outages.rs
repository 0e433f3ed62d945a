//! Outages of the broker: it freezes, or is gone for a while.

use lightbots_base::Span;

use crate::conditions::{Conditions, Outage};
use crate::dice::{Dice, Purpose};
use crate::timetable::Timetable;

/// Longest time from the return of the broker until a client has reconnected, seconds. Clients try to connect at this
/// interval.
const RECONNECTS_WITHIN_S: f64 = 2.0;

/// Effects of a broker outage on connections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BrokerEvent {
    /// The broker stops passing on messages, for this long. Connections stay.
    Freezes(Span),
    /// All connections break, and messages under way are lost.
    Dies,
    /// A robot has found the broker again.
    RobotBack(usize),
    /// The controller has found the broker again.
    ControllerBack,
}

/// All outages of the broker in a rehearsal.
#[derive(Clone, Debug)]
pub(crate) struct BrokerOutages {
    coming: Timetable<BrokerEvent>,
    /// `[robot]`: whether the robot has no connection to the broker.
    is_away: Vec<bool>,
    is_controller_away: bool,
}

impl BrokerOutages {
    /// Schedules the outages in `conditions` for `robots` robots. After each absence of the broker, every client
    /// reconnects at a random time within [`RECONNECTS_WITHIN_S`].
    pub fn new(conditions: &Conditions, robots: usize, seed: u64) -> Self {
        let mut dice = Dice::new(seed, Purpose::Broker);
        let freezes = |outage: &Outage| (outage.at, BrokerEvent::Freezes(outage.over));
        let mut coming: Vec<_> = conditions.frozen.iter().map(freezes).collect();
        for outage in &conditions.gone {
            let mut back =
                || outage.at + outage.over + Span::from_secs(dice.between(0.0, RECONNECTS_WITHIN_S));
            coming.extend([(outage.at, BrokerEvent::Dies), (back(), BrokerEvent::ControllerBack)]);
            coming.extend((0..robots).map(|robot| (back(), BrokerEvent::RobotBack(robot))));
        }
        Self { coming: Timetable::new(coming), is_away: vec![false; robots], is_controller_away: false }
    }

    /// Removes and returns the next event. `None` if none is due at `since_begin`, the time since the first departure.
    pub fn next_until(&mut self, since_begin: Span) -> Option<BrokerEvent> {
        let event = self.coming.next_until(since_begin)?;
        match event {
            BrokerEvent::Freezes(_) => {}
            BrokerEvent::Dies => {
                self.is_away.fill(true);
                self.is_controller_away = true;
            }
            BrokerEvent::RobotBack(robot) => self.is_away[robot] = false,
            BrokerEvent::ControllerBack => self.is_controller_away = false,
        }
        Some(event)
    }

    /// Whether the controller has no connection to the broker.
    pub fn is_controller_away(&self) -> bool {
        self.is_controller_away
    }

    /// Whether messages between a robot and the controller are lost, because one of the two has no connection to the
    /// broker.
    #[inline]
    pub fn is_cut(&self, robot: usize) -> bool {
        self.is_controller_away || self.is_away[robot]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faults::Faults;

    #[test]
    fn clients_find_a_broker_that_is_back_within_two_seconds() {
        let conditions = Faults::parse("freeze=1s+4s,gone=10s+3s").unwrap().added_to(Conditions::default());
        let mut outages = BrokerOutages::new(&conditions, 5, 1);
        let millis = Span::from_millis;
        assert_eq!(outages.next_until(millis(999)), None);
        assert_eq!(outages.next_until(millis(1_000)), Some(BrokerEvent::Freezes(millis(4_000))));
        assert_eq!(outages.next_until(millis(12_999)), Some(BrokerEvent::Dies));
        assert_eq!(outages.next_until(millis(12_999)), None);
        assert!((0..5).all(|robot| outages.is_cut(robot)));
        let back = std::iter::from_fn(|| outages.next_until(millis(15_000))).count();
        assert_eq!(back, 6);
        assert!((0..5).all(|robot| !outages.is_cut(robot)));
    }
}
