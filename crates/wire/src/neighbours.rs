//! `N clearance knots…` at the end of `PATH`: the robots that come into sight by plan (neighbours), with places and
//! times. `R31` is a rule of docs/protocol.md.
//!
//! A neighbour is a clearance in tenths of a millimetre, a number of knots, and the knots. A knot has a path time in
//! milliseconds, a place in tenths of a millimetre, and a velocity in millimetres per second. Between two knots the
//! neighbour moves on the cubic Hermite spline that has both places and both velocities.

use core::fmt::{self, Write};

use lightbots_base::{Span, Vec2};

use crate::fields::Fields;
use crate::number::write_int;
use crate::text_buffer::TextBuffer;

/// Largest number of neighbours of one route (R31). With a larger value, each robot needs more memory.
pub const MAX_NEIGHBOURS: usize = 64;
/// Largest number of knots of all neighbours of one route together (R31).
pub const MAX_KNOTS: usize = 256;

/// Planned place and velocity of a neighbour at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Knot {
    /// Path time, milliseconds.
    pub at_ms: u32,
    /// Centre on the stage, x and y, tenths of a millimetre.
    pub place_tenths: [i32; 2],
    /// Velocity on the stage, x and y, mm/s.
    pub velocity_mmps: [i16; 2],
}

/// One planned neighbour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Neighbour {
    /// Least planned distance from rim to rim, tenths of a millimetre.
    pub clearance_tenths: u16,
    /// Index of its first knot in [`Neighbours::knots`].
    pub first: u16,
    /// Number of its knots, at least one.
    pub count: u16,
}

/// The neighbours of a route. By R31, those that drive come first, then those that stand, each group with the nearest
/// first. This type does not check the order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Neighbours {
    /// The neighbours.
    pub list: heapless::Vec<Neighbour, MAX_NEIGHBOURS>,
    /// Knots of all neighbours, neighbour after neighbour; those of one neighbour are sorted by time.
    pub knots: heapless::Vec<Knot, MAX_KNOTS>,
}

/// Place, velocity and acceleration of a neighbour at one path time, in stage space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeighbourMotion {
    /// Centre, metres.
    pub position: Vec2,
    /// Velocity, metres per second of path time.
    pub velocity: Vec2,
    /// Acceleration, metres per second squared, by path time.
    pub acceleration: Vec2,
}

impl Neighbours {
    /// No neighbours.
    pub const fn new() -> Self {
        Self { list: heapless::Vec::new(), knots: heapless::Vec::new() }
    }

    /// Adds a neighbour with its knots. Returns `false` and adds nothing if `knots` is empty or there is no room for
    /// all of them.
    pub fn push(&mut self, clearance_tenths: u16, knots: &[Knot]) -> bool {
        if knots.is_empty() || self.knots.len() + knots.len() > MAX_KNOTS {
            return false;
        }
        let (first, count) = (self.knots.len() as u16, knots.len() as u16);
        let has_room = self.list.push(Neighbour { clearance_tenths, first, count }).is_ok();
        has_room && self.knots.extend_from_slice(knots).is_ok()
    }

    /// Returns the motion of a neighbour at a path time. `None` before its first knot. After its last knot, `None` too,
    /// unless its velocity there is zero: then it stays at that knot.
    pub fn motion(&self, neighbour: &Neighbour, at: Span) -> Option<NeighbourMotion> {
        let first = usize::from(neighbour.first);
        let knots = self.knots.get(first..first + usize::from(neighbour.count))?;
        let at_us = at.0;
        let us = |knot: &Knot| i64::from(knot.at_ms) * 1000;
        let last = knots.last()?;
        if at_us >= us(last) && last.velocity_mmps == [0; 2] {
            return Some(last.motion());
        }
        let next = knots.iter().position(|knot| us(knot) >= at_us)?;
        let Some(before) = next.checked_sub(1) else {
            return (us(&knots[0]) == at_us).then(|| knots[0].motion());
        };
        let (from, to) = (&knots[before], &knots[next]);
        let over_s = ((us(to) - us(from)) as f64 * 1e-6).max(1e-3);
        Some(hermite(&from.motion(), &to.motion(), (at_us - us(from)) as f64 * 1e-6 / over_s, over_s))
    }

    /// Reads the neighbours at the end of a route. An invalid entry ends the list and is not an error (R31).
    pub(crate) fn decode(fields: &mut Fields<'_>) -> Self {
        let mut all = Self::new();
        while fields.next() == Some("N") {
            if decode_one(fields, &mut all).is_none() {
                break;
            }
        }
        all
    }

    pub(crate) fn encode(&self, out: &mut TextBuffer<'_>) -> fmt::Result {
        for neighbour in &self.list {
            let first = usize::from(neighbour.first);
            let knots = self.knots.get(first..first + usize::from(neighbour.count)).unwrap_or_default();
            out.write_str(" N")?;
            for value in [i64::from(neighbour.clearance_tenths), knots.len() as i64] {
                write_field(out, value)?;
            }
            for knot in knots {
                write_field(out, i64::from(knot.at_ms))?;
                knot.place_tenths.iter().try_for_each(|&value| write_field(out, i64::from(value)))?;
                knot.velocity_mmps.iter().try_for_each(|&value| write_field(out, i64::from(value)))?;
            }
        }
        Ok(())
    }
}

impl Knot {
    fn motion(&self) -> NeighbourMotion {
        let [x, y] = self.place_tenths.map(|tenths| f64::from(tenths) * 1e-4);
        let [vx, vy] = self.velocity_mmps.map(|mmps| f64::from(mmps) * 1e-3);
        NeighbourMotion { position: Vec2::new(x, y), velocity: Vec2::new(vx, vy), acceleration: Vec2::ZERO }
    }
}

/// Returns the motion on the cubic Hermite spline from `from` to `to`, which takes `over_s` seconds, at its share `u`
/// from 0 to 1.
fn hermite(from: &NeighbourMotion, to: &NeighbourMotion, u: f64, over_s: f64) -> NeighbourMotion {
    let (chord, m0, m1) = (to.position - from.position, from.velocity * over_s, to.velocity * over_s);
    // position = p0 + m0·u + b·u² + a·u³
    let (a, b) = (m0 + m1 - chord * 2.0, chord * 3.0 - m0 * 2.0 - m1);
    NeighbourMotion {
        position: from.position + (m0 + (b + a * u) * u) * u,
        velocity: (m0 + (b * 2.0 + a * (3.0 * u)) * u) / over_s,
        acceleration: (b * 2.0 + a * (6.0 * u)) / (over_s * over_s),
    }
}

fn decode_one(fields: &mut Fields<'_>, all: &mut Neighbours) -> Option<()> {
    let clearance_tenths = fields.next()?.parse().ok()?;
    let count: usize = fields.next()?.parse().ok().filter(|&count| (1..=MAX_KNOTS).contains(&count))?;
    let (first, room) = (all.knots.len(), MAX_KNOTS - all.knots.len());
    if count > room || all.list.is_full() {
        return None;
    }
    for _ in 0..count {
        let Some(knot) = decode_knot(fields) else {
            all.knots.truncate(first);
            return None;
        };
        // Cannot fail, because the length was checked above.
        let _ = all.knots.push(knot);
    }
    let ordered = all.knots[first..].windows(2).all(|pair| pair[0].at_ms < pair[1].at_ms);
    if !ordered {
        all.knots.truncate(first);
        return None;
    }
    let _ = all.list.push(Neighbour { clearance_tenths, first: first as u16, count: count as u16 });
    Some(())
}

fn decode_knot(fields: &mut Fields<'_>) -> Option<Knot> {
    Some(Knot {
        at_ms: fields.next()?.parse().ok()?,
        place_tenths: [fields.next()?.parse().ok()?, fields.next()?.parse().ok()?],
        velocity_mmps: [fields.next()?.parse().ok()?, fields.next()?.parse().ok()?],
    })
}

fn write_field(out: &mut TextBuffer<'_>, value: i64) -> fmt::Result {
    out.write_str(" ")?;
    write_int(out, value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knot(at_ms: u32, x: i32, vx: i16) -> Knot {
        Knot { at_ms, place_tenths: [x, 50], velocity_mmps: [vx, 0] }
    }

    #[test]
    fn between_knots_it_moves_smoothly_and_outside_it_is_not_in_sight() {
        let mut all = Neighbours::new();
        assert!(all.push(31, &[knot(1000, 0, 0), knot(1270, 364, 270), knot(2270, 3064, 270)]));
        let at = |ms: i64| all.motion(&all.list[0], Span::from_millis(ms));
        assert_eq!(at(999), None);
        assert_eq!(at(2271), None);
        assert_eq!(at(1000).unwrap().position, Vec2::new(0.0, 0.005));
        let cruising = at(1770).unwrap();
        assert!((cruising.position.x - 0.1714).abs() < 1e-9 && (cruising.velocity.x - 0.27).abs() < 1e-9);
        let ramp = at(1135).unwrap();
        assert!(
            (ramp.acceleration.x - 1.0).abs() < 0.01 && (ramp.velocity.x - 0.135).abs() < 0.002,
            "{ramp:?}"
        );
    }

    #[test]
    fn what_has_no_room_is_left_out_whole() {
        let mut all = Neighbours::new();
        let many = [knot(0, 0, 0); MAX_KNOTS];
        assert!(all.push(10, &many[1..]));
        assert!(!all.push(10, &many[..2]) && all.list.len() == 1);
        assert!(all.push(10, &many[..1]) && !all.push(10, &many[..1]) && !all.push(10, &[]));
    }
}
