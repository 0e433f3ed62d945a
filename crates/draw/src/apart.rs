//! Pushes places apart that are closer than wanted. The closest pair sets the size of a picture on the floor, because
//! it must be enlarged until even these two robots have room.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::lines::LineSet;
use crate::symmetry::Pairing;

/// Largest number of rounds in which all close pairs are pushed.
const ROUNDS: usize = 150;

/// How a place may move.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Freedom {
    /// Anywhere within the drawing.
    Free,
    /// Along the lines only.
    Line,
    /// Not at all: a corner, an end, a crossing, or a place that a user chose.
    Fixed,
}

/// Where the places of one part may go.
pub(crate) struct Room<'a> {
    /// Buckets of `points`.
    pub inside: &'a Buckets<'a>,
    /// Sample points that fill the inside of the drawing densely.
    pub points: &'a [Vec2],
    /// A free place farther than this from every point is outside the drawing and moves to the nearest point.
    pub slack: f64,
    /// Lines for places that slide.
    pub track: &'a LineSet,
    /// Buckets of the points of `track`.
    pub on_track: &'a Buckets<'a>,
    /// Which places are mirror images of each other. `None` if places need not stay symmetric.
    pub pairing: Option<&'a Pairing>,
}

/// Moves places until no pair is closer than `distance`, or [`ROUNDS`] are over. `holds[i]` says how place `i` may
/// move. Places with a pairing stay symmetric.
pub(crate) fn push_apart(places: &mut [Vec2], holds: &[Freedom], distance: f64, room: &Room<'_>) {
    for _ in 0..ROUNDS {
        if !push_once(places, holds, distance, |_| room) {
            return;
        }
        if let Some(pairing) = room.pairing {
            pairing.apply(places);
        }
    }
}

/// Moves places of several parts until no pair is closer than `distance`, or [`ROUNDS`] are over. `rooms` has an entry
/// for each part; `owners` has the index of the part of each place.
pub(crate) fn push_parts_apart(
    places: &mut [Vec2],
    holds: &[Freedom],
    distance: f64,
    rooms: &[Room<'_>],
    owners: &[usize],
) {
    for _ in 0..ROUNDS {
        if !push_once(places, holds, distance, |index| &rooms[owners[index]]) {
            return;
        }
    }
}

/// Pushes all pairs apart once that are closer than 99.9 % of `distance`. Returns whether there were any.
fn push_once<'r, 'b: 'r>(
    places: &mut [Vec2],
    holds: &[Freedom],
    distance: f64,
    room_of: impl Fn(usize) -> &'r Room<'b>,
) -> bool {
    let mut pushes = vec![Vec2::ZERO; places.len()];
    let mut close = false;
    Buckets::new(places, distance).pairs(distance * 0.999, |a, b, length| {
        close = true;
        let (share_a, share_b) = shares(&holds[a], &holds[b]);
        // Two places on one point move apart in a direction that depends on their indices alone.
        let way = (places[a] - places[b]).normalized().unwrap_or_else(|| Vec2::unit((a + 3 * b) as f64));
        pushes[a] += way * ((distance - length) * share_a);
        pushes[b] -= way * ((distance - length) * share_b);
    });
    for (index, push) in pushes.into_iter().enumerate() {
        if push != Vec2::ZERO {
            places[index] = room_of(index).nearest(places[index] + push, &holds[index]);
        }
    }
    close
}

/// Two places that are too close move apart by the distance that is missing. Returns the shares of this distance that
/// the first and the second place move; both are 0 if both places are fixed.
fn shares(a: &Freedom, b: &Freedom) -> (f64, f64) {
    match (a, b) {
        (Freedom::Fixed, Freedom::Fixed) => (0.0, 0.0),
        (Freedom::Fixed, _) => (0.0, 1.0),
        (_, Freedom::Fixed) => (1.0, 0.0),
        (Freedom::Line, Freedom::Free) => (0.2, 0.8),
        (Freedom::Free, Freedom::Line) => (0.8, 0.2),
        _ => (0.5, 0.5),
    }
}

impl Room<'_> {
    /// Returns where a place goes that was pushed to `at`. A free place stays there unless it is outside the drawing;
    /// then it goes to the nearest sample point. A place on a line goes to a near point of the line.
    fn nearest(&self, at: Vec2, hold: &Freedom) -> Vec2 {
        match hold {
            Freedom::Fixed => at,
            Freedom::Line => self.track.project(at, self.on_track),
            Freedom::Free => match self.inside.nearest(at) {
                Some((index, square)) if square > self.slack * self.slack => self.points[index],
                _ => at,
            },
        }
    }
}
