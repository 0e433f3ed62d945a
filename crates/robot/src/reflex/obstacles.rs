//! The standing objects in sight that the plan does not know: which readings belong to them, and the tracks that stand
//! for them.

use super::obstacle::{Readings, StandingObject, bits};
use super::scan::Scan;
use super::track::Track;

/// Largest number of standing objects that are tracked at once: the two walls of a corner or a corridor.
const OBSTACLES: usize = 2;
/// An object is dropped if its `log_ratio` (standing object over moving neighbours) falls to this or below.
const LEAST_LOG_RATIO: f32 = -8.0;
/// Number of steps in a row without a reading after which an object is dropped.
const MISSED_MOST: u8 = 3;

/// All standing objects in sight.
#[derive(Debug, Default)]
pub(crate) struct StandingObjects {
    list: heapless::Vec<StandingObject, OBSTACLES>,
    /// The likely objects, each represented by a disc of a robot's size that touches the object at its nearest point.
    faces: heapless::Vec<Track, OBSTACLES>,
}

impl StandingObjects {
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub fn clear(&mut self) {
        self.list.clear();
        self.faces.clear();
    }

    /// The objects that are likelier than moving neighbours, each represented by a disc that touches the object at its
    /// nearest point.
    pub fn faces(&self) -> impl Iterator<Item = &Track> {
        self.faces.iter()
    }

    /// Updates all objects by the readings of a step. Drops objects that are unlikely or gone, begins a new one with a
    /// reading that is left, and makes the discs of the likely ones.
    pub fn step(&mut self, readings: &Readings<'_>, scan: &Scan<'_>) {
        let mut open = readings.open;
        for one in &mut self.list {
            one.predict(scan.own, scan.of);
            let before = one.seen_by;
            one.take(&Readings { open, ..*readings }, None, scan);
            let turns_out_known = before != 0 && before & readings.open == 0;
            one.missed = if turns_out_known { MISSED_MOST } else { one.missed };
            open &= !one.seen_by;
        }
        self.list.retain(|one| one.missed < MISSED_MOST && one.log_ratio > LEAST_LOG_RATIO);
        self.begin(&Readings { open, ..*readings }, scan);
        self.faces.clear();
        let radius_m = scan.sensors.radius_m;
        for one in self.list.iter().filter(|one| one.is_likely) {
            let estimate = one.nearest(scan.own, scan.of, radius_m).behind(radius_m);
            let _ = self.faces.push(Track::standing(&estimate, one.seen_by, one.is_flat(), scan));
        }
    }

    /// Begins a new object with the nearest reading that no object explains, unless there are [`OBSTACLES`] already.
    fn begin(&mut self, readings: &Readings<'_>, scan: &Scan<'_>) {
        if self.list.is_full() {
            return;
        }
        let free = bits(readings.open).filter_map(|sensor| Some((sensor, scan.reads_m(sensor)?)));
        let Some((sensor, read_m)) = free.min_by(|a, b| a.1.total_cmp(&b.1)) else { return };
        let mut one = StandingObject::begin(sensor, read_m, scan);
        one.take(readings, Some(sensor), scan);
        let _ = self.list.push(one);
    }

    /// Whether the objects for which `meant` returns `true` replace the track of a moving neighbour. They do if they
    /// explain all its readings. If the track has no reading, they do if they overlap it. A track of a planned
    /// neighbour, or of one that has left its plan, is never replaced.
    pub fn hide(&self, track: &Track, contact_m: f32, meant: fn(&Track) -> bool) -> bool {
        if track.is_known() {
            return false;
        }
        let faces = || self.faces.iter().filter(|face| meant(face));
        let overlaps = |face: &Track| face.at.minus(track.at).length() < contact_m;
        let seen_by = faces().fold(0, |seen_by, face| seen_by | face.seen_by);
        if track.seen_by == 0 { faces().any(overlaps) } else { track.seen_by & !seen_by == 0 }
    }
}
