//! Turns packets of lighting desks and reports of robots into messages of live light.

use std::collections::{BTreeMap, VecDeque};

use lightbots_base::{Instant, Rgb, RobotId, Span};
use lightbots_light::LampSettings;
use lightbots_wire::{Command, Report, Topic, encode};

use crate::fixtures::Fixtures;
use crate::messages::write_moment;
use crate::packet::DmxPacket;
use crate::patch::PatchTable;
use crate::universe::{Taken, Universe};
use crate::unpatched::UnpatchedUniverses;

/// Shortest time between two moments of live light, at which the colours of all robots are sent. For each robot,
/// `PERIOD_PER_ROBOT` is added, up to `PERIOD_MAX`: there are 20 moments a second for few robots, and 10 from 1,000 robots
/// on. Each robot receives the colours of all robots, four bytes each: with 1,000 robots, 40 KB a second.
const PERIOD: Span = Span::from_millis(50);
/// Time that each robot adds to the time between two moments of live light: 50 µs.
const PERIOD_PER_ROBOT: Span = Span(50);
/// Longest time between two moments of live light while colours change. `PERIOD` is the shortest.
const PERIOD_MAX: Span = Span::from_millis(100);
/// Time after which unchanged colours are sent again. A robot shows its own light after 2.5 s without colours (R61), so that
/// it can miss four successive messages.
const AGAIN: Span = Span::from_millis(500);
/// Number of moments after a change of colours at which they are sent again, because some robots may have missed them.
const REPEATS: u32 = 2;

/// How long the number of robots with a desk's colours must be unchanged before people are told it, because robots get
/// colours one by one.
const SETTLED: Span = Span::from_millis(1_000);

/// An MQTT message to publish at QoS 0, not retained.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LivePublish {
    /// Topic.
    pub topic: Topic,
    /// Payload: UTF-8 text.
    pub payload: Vec<u8>,
}

/// Events that people should be told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeskNews {
    /// Desks took over the lights of robots. The event comes when the number of these robots has not changed for a second.
    Began {
        /// Number of robots that show a desk's colours.
        robots: usize,
    },
    /// All robots show their own lights again.
    Ended,
    /// Desks send universes in which no robot has channels. Each universe is reported once.
    Unpatched {
        /// Numbers of the universes, in order.
        universes: Vec<u16>,
        /// Whether there are further universes without robots. They are never named, to keep the list short.
        has_more: bool,
    },
}

/// Numbers of packets with values that were received since the receiver was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PacketCounts {
    /// Number of packets with the newest values of their source, or with the end of their source's stream.
    pub newest: u64,
    /// Number of packets that came after a later packet of their source, or twice, and were ignored.
    pub old: u64,
    /// Number of packets for universes without robots. Packets that came before the first robot are not counted.
    pub unpatched: u64,
    /// Number of packets that were ignored because their universe had too many sources.
    pub crowded: u64,
}

/// Receives packets of lighting desks and reports of robots, and makes messages of live light. Inputs are
/// [`packet`](Self::packet), [`report`](Self::report) and [`wake`](Self::wake), each with the time `now`, which must
/// not decrease. After each input, ask [`wake_at`](Self::wake_at) when to call `wake`. After each `wake`, take all
/// results of [`next_publish`](Self::next_publish) and [`next_news`](Self::next_news).
///
/// A desk controls the light of a robot if it sends the robot's three channels, and the robot understands live light
/// and reports its slot. The show controls the light of all other robots.
#[derive(Debug)]
pub struct DeskReceiver {
    patch: PatchTable,
    /// Settings of the robots' lamps, by which colours in messages are corrected.
    lamp: LampSettings,
    /// The universes in which robots have channels, by number. Packets of other universes are not kept.
    universes: BTreeMap<u16, Universe>,
    fixtures: Fixtures,
    /// Number of the next moment of live light.
    number: u32,
    /// When the next moment may be sent.
    moment_at: Instant,
    /// When colours were last sent.
    sent_at: Instant,
    /// Number of next moments at which the colours are sent even if they do not change.
    repeats: u32,
    is_lit: bool,
    /// Number of robots that have a desk's colour, and when this number last changed.
    counted: (usize, Instant),
    /// Whether the last event of these two was [`DeskNews::Began`], and not [`DeskNews::Ended`].
    is_told: bool,
    unpatched: UnpatchedUniverses,
    publishes: VecDeque<LivePublish>,
    news: VecDeque<DeskNews>,
    counts: PacketCounts,
}

impl DeskReceiver {
    /// Makes a receiver that knows no robots. `number` is the number of the first moment of live light. It must be
    /// higher than all numbers that were sent before, because robots ignore numbers that are a little lower (R60).
    pub fn new(patch: PatchTable, number: u32, lamp: LampSettings) -> Self {
        Self {
            patch,
            lamp,
            universes: BTreeMap::new(),
            fixtures: Fixtures::default(),
            number,
            moment_at: Instant::ZERO,
            sent_at: Instant::ZERO,
            repeats: 0,
            is_lit: false,
            counted: (0, Instant::ZERO),
            is_told: false,
            unpatched: UnpatchedUniverses::default(),
            publishes: VecDeque::new(),
            news: VecDeque::new(),
            counts: PacketCounts::default(),
        }
    }

    /// Receives a packet with values of a universe.
    pub fn packet(&mut self, now: Instant, packet: DmxPacket) {
        self.give_channels(now);
        let Some(universe) = self.universes.get_mut(&packet.universe) else {
            if self.fixtures.len() > 0 {
                self.unpatched.receive(now, packet.universe);
                self.counts.unpatched += 1;
            }
            return;
        };
        let count = match universe.receive(now, packet) {
            Taken::Newest => &mut self.counts.newest,
            Taken::Old => &mut self.counts.old,
            Taken::Crowded => &mut self.counts.crowded,
        };
        *count += 1;
    }

    /// Receives the report of a robot.
    pub fn report(&mut self, now: Instant, report: &Report) {
        self.fixtures.receive(now, report);
    }

    /// Queues the messages and events that are due at `now`. Does nothing if the next moment of live light is not due yet.
    pub fn wake(&mut self, now: Instant) {
        if now < self.moment_at {
            return;
        }
        let period = PERIOD + PERIOD_PER_ROBOT * self.fixtures.len() as i64;
        self.moment_at = now + period.min(PERIOD_MAX);
        self.give_channels(now);
        self.universes.values_mut().for_each(|universe| universe.expire(now));
        for (robot, slot) in self.fixtures.next_slots(now) {
            let mut text = String::new();
            // A text takes all bytes.
            let _ = encode(&Command::Slot(slot), &mut text);
            self.publishes.push_back(LivePublish { topic: Topic::Robot(robot), payload: text.into_bytes() });
        }
        if self.fixtures.take_colours(&self.universes) {
            self.repeats = REPEATS + 1;
        }
        self.send(now);
        self.tell(now);
    }

    /// When to call [`wake`](Self::wake) next; `None`: it need not be called before the next packet or report.
    pub fn wake_at(&self, now: Instant) -> Option<Instant> {
        let is_lit = self.is_lit || self.universes.values().any(Universe::is_lit);
        let is_released = self.fixtures.released().next().is_some();
        let is_busy =
            is_lit || is_released || self.unpatched.is_waiting() || self.fixtures.need_something(now);
        is_busy.then_some(self.moment_at)
    }

    /// Takes the next message to publish; `None`: there are no more.
    pub fn next_publish(&mut self) -> Option<LivePublish> {
        self.publishes.pop_front()
    }

    /// Takes the next event that people should be told; `None`: there are no more.
    pub fn next_news(&mut self) -> Option<DeskNews> {
        self.news.pop_front()
    }

    /// The robots that have a desk's colour, with the colours before the correction for lamps.
    pub fn lights(&self) -> impl Iterator<Item = (RobotId, Rgb)> {
        self.fixtures.lights()
    }

    /// Numbers of the universes in which robots have channels, in order.
    pub fn universes(&self) -> impl Iterator<Item = u16> {
        self.universes.keys().copied()
    }

    /// Numbers of packets that were received since the receiver was made.
    pub fn counts(&self) -> PacketCounts {
        self.counts
    }

    /// If robots were added, assigns channels to all robots, and then keeps exactly the universes of these channels.
    fn give_channels(&mut self, now: Instant) {
        let Some(needed) = self.fixtures.patch(&self.patch) else { return };
        self.unpatched.robots_added(now, |universe| needed.contains(&universe));
        self.universes.retain(|universe, _| needed.contains(universe));
        for universe in needed {
            self.universes.entry(universe).or_default();
        }
    }

    /// Queues the messages of a moment of live light if colours have changed, are due again, or robots must be released.
    fn send(&mut self, now: Instant) {
        let is_lit = self.fixtures.colours().next().is_some();
        let is_due = is_lit && (self.repeats > 0 || now - self.sent_at >= AGAIN);
        if !is_due && self.fixtures.released().next().is_none() {
            return;
        }
        self.repeats = self.repeats.saturating_sub(1);
        self.sent_at = now;
        let lamp = self.lamp;
        let colours = self.fixtures.colours().map(|(slot, meant)| (slot, lamp.sent(meant)));
        for payload in write_moment(self.number, colours, self.fixtures.released()) {
            self.publishes.push_back(LivePublish { topic: Topic::Broadcast, payload });
        }
        self.number = self.number.checked_add(1).unwrap_or(1);
        self.fixtures.note_release();
    }

    fn tell(&mut self, now: Instant) {
        let robots = self.fixtures.colours().count();
        self.is_lit = robots > 0;
        if robots != self.counted.0 {
            self.counted = (robots, now);
        }
        let is_settled = now - self.counted.1 >= SETTLED;
        if self.is_lit && !self.is_told && is_settled {
            self.is_told = true;
            self.news.push_back(DeskNews::Began { robots });
        } else if !self.is_lit && self.is_told {
            self.is_told = false;
            self.news.push_back(DeskNews::Ended);
        }
        if let Some((universes, has_more)) = self.unpatched.take(now) {
            self.news.push_back(DeskNews::Unpatched { universes, has_more });
        }
    }
}
