//! Storage of a robot's large and rarely used data: routes, stretches of light, and odometry for fixes that arrive
//! late.

use lightbots_base::Vec2;
use lightbots_wire::{Neighbours, Pieces, Route};

use crate::history::OdometryHistory;
use crate::light_ahead::{StoredTrack, StoredTracks};

/// Storage of the route under way, of the route kept for later, of stretches of light and of the odometry history. It
/// has 31 KB, and a step reads only a small part of it.
///
/// A [`crate::Robot`] contains a storage or refers to a storage elsewhere. A simulator of thousands of robots keeps the
/// storages elsewhere. The state that steps need then lies close together in memory.
#[derive(Debug)]
pub struct RouteStorage {
    slots: [Route; 2],
    pub(crate) tracks: StoredTracks,
    pub(crate) history: OdometryHistory,
}

/// One of the two places for a route in [`RouteStorage`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    First,
    Second,
}

impl RouteStorage {
    /// An empty storage.
    pub const fn new() -> Self {
        const NOTHING: Route = Route {
            seq: 0,
            start: Vec2::ZERO,
            pieces: Pieces::new(),
            room_mm: None,
            neighbours: Neighbours::new(),
        };
        Self { slots: [NOTHING; 2], tracks: [StoredTrack::EMPTY; 3], history: OdometryHistory::new() }
    }

    pub(crate) fn put(&mut self, slot: Slot, route: &Route) {
        let Route { seq, start, pieces, room_mm, neighbours } = route;
        let free = &mut self.slots[slot as usize];
        (free.seq, free.start, free.room_mm) = (*seq, *start, *room_mm);
        free.pieces.clear();
        // Fits: both have the same capacity. A copy of the whole would copy the unused capacity.
        let _ = free.pieces.extend_from_slice(pieces);
        free.neighbours.list.clear();
        free.neighbours.knots.clear();
        let _ = free.neighbours.list.extend_from_slice(&neighbours.list);
        let _ = free.neighbours.knots.extend_from_slice(&neighbours.knots);
    }

    pub(crate) fn at(&self, slot: Slot) -> &Route {
        &self.slots[slot as usize]
    }
}

impl Default for RouteStorage {
    fn default() -> Self {
        Self::new()
    }
}

impl Slot {
    pub(crate) fn other(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
        }
    }
}
