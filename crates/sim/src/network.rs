//! The network between the controller and the robots. Messages may be late, lost, doubled or overtaken.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::rc::Rc;

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use crate::conditions::LinkConditions;
use crate::dice::{Dice, Purpose};
use crate::prefetch::prefetch;

/// At most this number of messages per robot, and [`UNDER_WAY`] more, are under way at one time. Further messages are
/// lost.
const UNDER_WAY_PER_ROBOT: usize = 64;
/// Number of messages that may be under way in addition to [`UNDER_WAY_PER_ROBOT`] per robot, for all robots together.
const UNDER_WAY: usize = 1024;
/// Share of the messages that jitter delays.
const JITTERED: f64 = 0.1;

/// In `Network::queue`, this value in place of a robot's index means that the controller receives the message.
const CONTROLLER: u32 = u32::MAX;

/// Direction of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// To a robot, by its index.
    ToRobot(usize),
    /// From a robot, by its index, to the controller.
    ToController(usize),
}

/// A message that arrives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NetworkMessage {
    /// Its direction.
    pub way: Way,
    /// Its topic.
    pub topic: Topic,
    /// Its bytes. Copies of a broadcast share them.
    pub payload: Rc<[u8]>,
}

/// Numbers of messages sent and lost. A broadcast counts once for each receiver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct MessageCounts {
    /// Number of messages sent. The second copy of a doubled message does not count.
    pub sent: u64,
    /// Number of messages that the network lost: at random, because too many were under way, or because the broker
    /// died. In the last case both copies of a doubled message count. Messages that a robot's broken link or an absent
    /// controller swallows do not count.
    pub lost: u64,
}

/// The links between the controller and all robots. A link keeps the order of its messages, except for those that may
/// be overtaken.
#[derive(Debug)]
pub(crate) struct Network {
    conditions: LinkConditions,
    dice: Dice,
    /// Messages under way, the earliest arrival first. Each entry: arrival, number in order of sending, index in
    /// `slots`, and receiving robot or [`CONTROLLER`].
    queue: BinaryHeap<Reverse<(Instant, u64, u32, u32)>>,
    slots: Vec<Option<NetworkMessage>>,
    free: Vec<u32>,
    /// `[robot]`: when the last message to the robot, and the last one from it, arrives. Messages that may be overtaken
    /// do not count.
    last: Vec<[Instant; 2]>,
    /// The broker passes nothing on until this time.
    frozen_until: Instant,
    said: u64,
    counts: MessageCounts,
}

impl Network {
    /// Links to a number of robots.
    pub fn new(conditions: &LinkConditions, robots: usize, seed: u64) -> Self {
        Self {
            conditions: conditions.clone(),
            dice: Dice::new(seed, Purpose::Links),
            queue: BinaryHeap::new(),
            slots: Vec::new(),
            free: Vec::new(),
            last: vec![[Instant::ZERO; 2]; robots],
            frozen_until: Instant::ZERO,
            said: 0,
            counts: MessageCounts::default(),
        }
    }

    /// Sends a message. At random it is lost or doubled; it is also lost if too many messages are under way.
    pub fn send(&mut self, now: Instant, way: Way, topic: Topic, payload: Rc<[u8]>) {
        self.counts.sent += 1;
        let full = self.queue.len() >= UNDER_WAY + UNDER_WAY_PER_ROBOT * self.last.len();
        if full || self.dice.chance(self.conditions.loss) {
            self.counts.lost += 1;
            return;
        }
        let message = NetworkMessage { way, topic, payload };
        if self.dice.chance(self.conditions.double) {
            self.post(now, message.clone());
        }
        self.post(now, message);
    }

    /// When the next message arrives; `None` if no message is under way.
    pub fn next_at(&self) -> Option<Instant> {
        self.queue.peek().map(|&Reverse((at, ..))| at.max(self.frozen_until))
    }

    /// Removes and returns the next message with its time of arrival; `None` if none arrives by `until`.
    pub fn next_until(&mut self, until: Instant) -> Option<(Instant, NetworkMessage)> {
        if self.next_at()? > until {
            return None;
        }
        let Reverse((at, _, slot, _)) = self.queue.pop()?;
        self.free.push(slot);
        if let Some(&Reverse((_, _, next, _))) = self.queue.peek() {
            prefetch(&self.slots[next as usize]);
        }
        Some((at.max(self.frozen_until), self.slots[slot as usize].take()?))
    }

    /// Freezes the broker until a time. Until then it passes nothing on, and messages wait.
    pub fn freeze(&mut self, until: Instant) {
        self.frozen_until = self.frozen_until.max(until);
    }

    /// Discards all messages under way as lost, and ends a freeze.
    pub fn clear(&mut self) {
        self.counts.lost += self.queue.len() as u64;
        self.queue.clear();
        self.slots.clear();
        self.free.clear();
        self.frozen_until = Instant::ZERO;
    }

    /// The robot that receives the next message. `None` if the controller does, or no message is under way.
    pub fn next_receiver(&self) -> Option<usize> {
        let &Reverse((.., robot)) = self.queue.peek()?;
        (robot != CONTROLLER).then_some(robot as usize)
    }

    /// Number of messages sent and lost.
    pub fn counts(&self) -> MessageCounts {
        self.counts
    }

    fn post(&mut self, now: Instant, message: NetworkMessage) {
        let mut at = now + self.delay();
        let (robot, direction) = match message.way {
            Way::ToRobot(robot) => (robot, 0),
            Way::ToController(robot) => (robot, 1),
        };
        if self.dice.chance(self.conditions.reorder) {
            at += self.conditions.delay_max + Span::from_millis(self.dice.below(50) as i64);
        } else {
            let last = &mut self.last[robot][direction];
            at = at.max(*last);
            *last = at;
        }
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots.push(None);
            self.slots.len() as u32 - 1
        });
        self.slots[slot as usize] = Some(message);
        if let Some(&next) = self.free.last() {
            prefetch(&self.slots[next as usize]);
        }
        self.said += 1;
        let receiver = if direction == 0 { robot as u32 } else { CONTROLLER };
        self.queue.push(Reverse((at, self.said, slot, receiver)));
    }

    fn delay(&mut self) -> Span {
        let LinkConditions { delay_min, delay_max, jitter, .. } = self.conditions;
        let mut delay = delay_min + Span(self.dice.below((delay_max - delay_min).0.max(0) as u64 + 1) as i64);
        if jitter > Span::ZERO && self.dice.chance(JITTERED) {
            delay += Span(self.dice.below(jitter.0 as u64) as i64);
        }
        delay
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conditions::Conditions;
    use crate::faults::Faults;

    /// Sends `count` messages a millisecond apart over one link. Returns numbers and delays (ms) in order of arrival.
    fn arrivals(faults: &str, count: u32) -> (Vec<(u32, f64)>, MessageCounts) {
        arrivals_over(&Faults::parse(faults).unwrap().added_to(Conditions::default()).link, count)
    }

    fn arrivals_over(link: &LinkConditions, count: u32) -> (Vec<(u32, f64)>, MessageCounts) {
        let mut network = Network::new(link, 1, 9);
        let mut got = Vec::new();
        for number in 0..count {
            let now = Instant(u64::from(number) * 1000);
            network.send(now, Way::ToRobot(0), Topic::Broadcast, Rc::new(number.to_le_bytes()));
            got.extend(drained(&mut network, now));
        }
        got.extend(drained(&mut network, Instant::FAR));
        (got, network.counts())
    }

    fn drained(network: &mut Network, until: Instant) -> Vec<(u32, f64)> {
        std::iter::from_fn(|| network.next_until(until))
            .map(|(at, message)| {
                let number = u32::from_le_bytes((*message.payload).try_into().unwrap());
                (number, at.as_secs() * 1e3 - f64::from(number))
            })
            .collect()
    }

    fn in_order(got: &[(u32, f64)]) -> bool {
        got.windows(2).all(|pair| pair[0].0 <= pair[1].0)
    }

    #[test]
    fn the_standard_link_is_late_in_order_and_loses_none() {
        let (got, counts) = arrivals_over(&LinkConditions::default(), 1000);
        assert!(in_order(&got) && got.len() == 1000);
        assert!(got.iter().all(|&(_, late)| (5.0..=20.001).contains(&late)));
        assert_eq!(counts, MessageCounts { sent: 1000, lost: 0 });
    }

    #[test]
    fn loss_doubling_and_reordering_happen_as_often_as_told() {
        let (got, counts) = arrivals("loss=5%", 10_000);
        assert!((400..600).contains(&counts.lost) && got.len() as u64 == 10_000 - counts.lost);
        let (got, _) = arrivals("double=10%", 10_000);
        assert!((10_900..11_100).contains(&got.len()) && in_order(&got));
        let (got, _) = arrivals("reorder=1%", 1000);
        assert!(!in_order(&got) && got.len() == 1000);
    }

    #[test]
    fn jitter_and_delay_add_up() {
        let (got, _) = arrivals("delay=100..300ms,jitter=50ms", 1000);
        let latest = got.iter().fold(0.0, |latest: f64, got| latest.max(got.1));
        assert!(got.iter().all(|got| got.1 >= 100.0) && (300.0..=350.0).contains(&latest));
    }

    #[test]
    fn a_frozen_broker_passes_everything_on_at_once_and_in_order() {
        let mut network = Network::new(&LinkConditions::default(), 1, 9);
        network.freeze(Instant(1_000_000));
        for number in 0..20u32 {
            network.send(Instant(0), Way::ToRobot(0), Topic::Broadcast, Rc::new(number.to_le_bytes()));
        }
        assert_eq!(network.next_until(Instant(999_999)), None);
        let got = drained(&mut network, Instant(1_000_000));
        assert!(in_order(&got) && got.len() == 20);
        network.send(Instant(2_000_000), Way::ToRobot(0), Topic::Broadcast, Rc::new([0; 4]));
        network.clear();
        assert_eq!((network.next_at(), network.counts().lost), (None, 1));
    }

    #[test]
    fn a_flood_is_bounded() {
        let mut network = Network::new(&LinkConditions::default(), 1, 9);
        for _ in 0..3000 {
            network.send(Instant::ZERO, Way::ToController(0), Topic::Status, Rc::new([0; 4]));
        }
        assert_eq!(drained(&mut network, Instant::FAR).len(), UNDER_WAY + UNDER_WAY_PER_ROBOT);
        assert_eq!(network.counts().lost, 3000 - (UNDER_WAY + UNDER_WAY_PER_ROBOT) as u64);
    }
}
