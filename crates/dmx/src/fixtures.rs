//! The robots that are known, with their channels and slots.

use std::collections::{BTreeMap, BTreeSet};

use lightbots_base::{Instant, Rgb, RobotId, Span};
use lightbots_wire::Report;

use crate::patch::{DmxAddress, PatchTable};
use crate::universe::Universe;

/// Largest number of robots that are kept: the size of the largest fleet. Further robots are ignored.
const ROBOTS_MAX: usize = 20_000;
/// Time after which SLOT is sent again to a robot that does not report its slot. With a shorter time, SLOT is sent
/// needlessly on slow networks. With a longer time, a robot that was just switched on waits longer for the desk's light.
const AGAIN: Span = Span::from_millis(1_000);
/// Time without a report after which no SLOT is sent to a robot. Robots report at least every 2 s (R41).
const GONE: Span = Span::from_millis(10_000);
/// Largest number of SLOT messages that are sent at one moment. More messages would delay others.
const TOLD_AT_ONCE: usize = 50;
/// Number of times that RELEASE is sent to a robot, because messages may be lost. If 5 % are lost, one robot of 8,000
/// receives none of the three. It shows its own light 2.5 s later (R61).
const RELEASES: u8 = 3;

/// A robot whose light a lighting desk may control.
#[derive(Debug)]
struct Fixture {
    id: RobotId,
    /// Whether the robot understands live light.
    knows_live: bool,
    /// The slot that the robot reported last; `None`: it reported none.
    reported: Option<u16>,
    heard: Instant,
    told: Option<Instant>,
    address: Option<DmxAddress>,
    /// The colour from the desk; `None`: the robot shows its own light.
    colour: Option<Rgb>,
    /// Number of times that RELEASE is still to be sent to the robot.
    releases: u8,
}

/// All robots that have reported. A robot's slot is its index in the order of the robots' first reports, from 0.
#[derive(Debug, Default)]
pub(crate) struct Fixtures {
    by_slot: Vec<Fixture>,
    by_name: BTreeMap<RobotId, u16>,
    /// Whether robots were added after channels were assigned.
    are_new: bool,
}

impl Fixtures {
    /// Receives the report of a robot, and adds the robot if it has not reported before. If there are [`ROBOTS_MAX`]
    /// robots already, a further one is ignored. A report of name and place alone changes neither abilities nor slot.
    pub fn receive(&mut self, now: Instant, report: &Report) {
        let details = report.details.as_ref();
        let knows_live = details.is_some_and(|details| details.abilities.live);
        let slot = match self.by_name.get(&report.id) {
            Some(&slot) => slot,
            None if self.by_slot.len() < ROBOTS_MAX => self.add(now, report.id),
            None => return,
        };
        let fixture = &mut self.by_slot[usize::from(slot)];
        fixture.heard = now;
        if details.is_some() {
            (fixture.knows_live, fixture.reported) = (knows_live, details.and_then(|details| details.slot));
        }
    }

    fn add(&mut self, now: Instant, id: RobotId) -> u16 {
        let slot = self.by_slot.len() as u16;
        self.by_name.insert(id, slot);
        self.by_slot.push(Fixture {
            id,
            knows_live: false,
            reported: None,
            heard: now,
            told: None,
            address: None,
            colour: None,
            releases: 0,
        });
        self.are_new = true;
        slot
    }

    /// Number of robots that have reported.
    pub fn len(&self) -> usize {
        self.by_slot.len()
    }

    /// If robots were added, assigns channels to all robots, and returns the universes of these channels. `None` if no
    /// robots were added.
    pub fn patch(&mut self, table: &PatchTable) -> Option<BTreeSet<u16>> {
        if !std::mem::take(&mut self.are_new) {
            return None;
        }
        for (number, (&id, &slot)) in (0..).zip(&self.by_name) {
            self.by_slot[usize::from(slot)].address = table.address(id, number);
        }
        Some(self.by_slot.iter().filter_map(|fixture| fixture.address).map(|at| at.universe).collect())
    }

    /// Returns the robots to which SLOT must be sent now, with their slots, at most [`TOLD_AT_ONCE`]. Notes that it is sent.
    pub fn next_slots(&mut self, now: Instant) -> Vec<(RobotId, u16)> {
        let due = (0u16..).zip(&mut self.by_slot).filter(|(slot, fixture)| {
            let was_told = fixture.told.is_some_and(|told| now - told < AGAIN);
            fixture.needs_slot(*slot, now) && !was_told
        });
        due.take(TOLD_AT_ONCE)
            .map(|(slot, fixture)| {
                fixture.told = Some(now);
                (fixture.id, slot)
            })
            .collect()
    }

    /// Whether robots wait for channels or for their slots.
    pub fn need_something(&self, now: Instant) -> bool {
        self.are_new || (0u16..).zip(&self.by_slot).any(|(slot, fixture)| fixture.needs_slot(slot, now))
    }

    /// Updates the desk's colours of all robots from the values of the universes. A robot that no longer has a colour will
    /// be released. Returns whether any colour has changed.
    pub fn take_colours(&mut self, universes: &BTreeMap<u16, Universe>) -> bool {
        let mut has_changed = false;
        for (slot, fixture) in (0u16..).zip(&mut self.by_slot) {
            let address = fixture.address.filter(|_| fixture.is_ready(slot));
            let universe = address.and_then(|address| Some((universes.get(&address.universe)?, address)));
            let colour = universe.and_then(|(universe, address)| universe.colour(address.channel));
            if colour != fixture.colour {
                fixture.releases = if colour.is_none() { RELEASES } else { 0 };
                fixture.colour = colour;
                has_changed = true;
            }
        }
        has_changed
    }

    /// Slots of the robots that have a colour from a desk, with the colours, in order of slots.
    pub fn colours(&self) -> impl Iterator<Item = (u16, Rgb)> {
        (0u16..).zip(&self.by_slot).filter_map(|(slot, fixture)| Some((slot, fixture.colour?)))
    }

    /// Names of the robots that have a colour from a desk, with the colours.
    pub fn lights(&self) -> impl Iterator<Item = (RobotId, Rgb)> {
        self.by_slot.iter().filter_map(|fixture| Some((fixture.id, fixture.colour?)))
    }

    /// Slots of the robots to which RELEASE must still be sent, in order.
    pub fn released(&self) -> impl Iterator<Item = u16> {
        (0u16..).zip(&self.by_slot).filter(|(_, fixture)| fixture.releases > 0).map(|(slot, _)| slot)
    }

    /// Notes that RELEASE was sent once more to all robots of [`Self::released`].
    pub fn note_release(&mut self) {
        for fixture in &mut self.by_slot {
            fixture.releases = fixture.releases.saturating_sub(1);
        }
    }
}

impl Fixture {
    /// Whether the robot shows colours that are sent for `slot`: it understands live light and has reported this slot.
    fn is_ready(&self, slot: u16) -> bool {
        self.knows_live && self.reported == Some(slot)
    }

    fn needs_slot(&self, slot: u16, now: Instant) -> bool {
        self.knows_live && self.address.is_some() && self.reported != Some(slot) && now - self.heard < GONE
    }
}
