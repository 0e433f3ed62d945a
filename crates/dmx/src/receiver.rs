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

/// Time between two moments of live light without robots. `PERIOD_PER_ROBOT` is added for each robot, up to
/// `PERIOD_MAX`: 20 moments a second for few robots, 10 from 1,000 robots on. Each robot receives the colours of all,
/// four bytes each: with 1,000 robots 40 KB a second.
const PERIOD: Span = Span::from_millis(50);
/// Time that each robot adds to `PERIOD`: 50 µs.
const PERIOD_PER_ROBOT: Span = Span(50);
/// Longest time between two moments of live light while colours change, see `PERIOD`.
const PERIOD_MAX: Span = Span::from_millis(100);
/// Time after which unchanged colours are sent again. A robot shows its own light after 2.5 s without a message (R61),
/// so four messages in a row may be lost.
const AGAIN: Span = Span::from_millis(500);
/// Number of further moments in which changed colours are sent again, for robots that did not receive them.
const REPEATS: u32 = 2;

/// Time for which the number of robots must not change before it is reported to people, because robots come one by one.
const SETTLED: Span = Span::from_millis(1_000);

/// A message to publish at QoS 0, not retained.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LivePublish {
    /// Topic.
    pub topic: Topic,
    /// UTF-8 text.
    pub payload: Vec<u8>,
}

/// Events that are reported to people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeskNews {
    /// A desk took over the lights of robots. Reported when their number has settled.
    Began {
        /// Number of these robots.
        robots: usize,
    },
    /// All robots show their own lights again.
    Ended,
    /// Desks send universes without robots. Each universe is reported once.
    Unpatched {
        /// Numbers of the universes, in order.
        universes: Vec<u16>,
        /// Whether there are more, which are never named, because their number is bounded.
        has_more: bool,
    },
}

/// Numbers of packets with values since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PacketCounts {
    /// Packets with the newest values of their source, or with the end of its stream.
    pub newest: u64,
    /// Packets that were overtaken by later ones.
    pub old: u64,
    /// Packets for universes without robots, counted while any robot is known.
    pub unpatched: u64,
    /// Packets of sources beyond the number that a universe may have.
    pub crowded: u64,
}

/// Receives what lighting desks send. Inputs are [`packet`](Self::packet), [`report`](Self::report) and
/// [`wake`](Self::wake), each with `now`, which never goes back. After each input, call `wake` at the time of
/// [`wake_at`](Self::wake_at). Then drain [`next_publish`](Self::next_publish) and [`next_news`](Self::next_news).
///
/// A desk controls the light of the robots whose three channels it sends. The show controls the light of all others.
#[derive(Debug)]
pub struct DeskReceiver {
    patch: PatchTable,
    /// Settings of the robots' lamps. Colours in messages are corrected by them.
    lamp: LampSettings,
    /// The universes that have robots, by number. Packets of other universes are not kept.
    universes: BTreeMap<u16, Universe>,
    fixtures: Fixtures,
    /// Number of the next moment of live light.
    number: u32,
    /// When the next moment may be sent.
    moment_at: Instant,
    /// When colours were sent last.
    sent_at: Instant,
    /// Number of further moments in which the colours are sent even if they do not change.
    repeats: u32,
    is_lit: bool,
    /// Number of robots that show colours of a desk, and when it last changed.
    counted: (usize, Instant),
    /// Whether people were told that a desk took over lights, and not yet that this has ended.
    is_told: bool,
    unpatched: UnpatchedUniverses,
    publishes: VecDeque<LivePublish>,
    news: VecDeque<DeskNews>,
    counts: PacketCounts,
}

impl DeskReceiver {
    /// Makes a receiver that knows no robot yet. `number` is that of the first moment of live light, higher than any
    /// sent before.
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

    /// Queues messages and news that are due at `now`. Does nothing before the next moment is due.
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

    /// When to call [`wake`](Self::wake) next; `None`: after the next packet or report.
    pub fn wake_at(&self, now: Instant) -> Option<Instant> {
        let is_lit = self.is_lit || self.universes.values().any(Universe::is_lit);
        let is_released = self.fixtures.released().next().is_some();
        let is_busy =
            is_lit || is_released || self.unpatched.is_waiting() || self.fixtures.need_something(now);
        is_busy.then_some(self.moment_at)
    }

    /// The next message to publish.
    pub fn next_publish(&mut self) -> Option<LivePublish> {
        self.publishes.pop_front()
    }

    /// The next event to report to people.
    pub fn next_news(&mut self) -> Option<DeskNews> {
        self.news.pop_front()
    }

    /// The colours that desks give to robots.
    pub fn lights(&self) -> impl Iterator<Item = (RobotId, Rgb)> {
        self.fixtures.lights()
    }

    /// Universes with robots, in order.
    pub fn universes(&self) -> impl Iterator<Item = u16> {
        self.universes.keys().copied()
    }

    /// Numbers of packets since the start.
    pub fn counts(&self) -> PacketCounts {
        self.counts
    }

    /// Assigns channels if robots were added. Then keeps exactly the universes that have robots.
    fn give_channels(&mut self, now: Instant) {
        let Some(needed) = self.fixtures.patch(&self.patch) else { return };
        self.unpatched.robots_added(now, |universe| needed.contains(&universe));
        self.universes.retain(|universe, _| needed.contains(universe));
        for universe in needed {
            self.universes.entry(universe).or_default();
        }
    }

    /// Queues the messages of a moment if colours have changed, are due again, or robots are to be released.
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
