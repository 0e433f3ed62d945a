//! What stands in sight and the plan does not know: which readings are of it, and what the policy learns of it.

use super::obstacle::{Readings, StandingObject, bits};
use super::scan::Scan;
use super::track::Track;

/// Obstacles that are followed at once: the two walls of a corner or a corridor.
const OBSTACLES: usize = 2;
/// An obstacle less likely than neighbours that move, by this factor, natural logarithm, begins anew.
const LEAST_LOG_RATIO: f32 = -8.0;
/// An obstacle that no sensor sees in this many steps has gone.
const MISSED_MOST: u8 = 3;

/// All obstacles in sight.
#[derive(Debug, Default)]
pub(crate) struct StandingObjects {
    list: heapless::Vec<StandingObject, OBSTACLES>,
    /// Those that are likely, each as a disc of a robot's size that touches it where it is nearest.
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

    /// Obstacles that are likelier than neighbours that move, as discs that touch them where they are nearest.
    pub fn faces(&self) -> impl Iterator<Item = &Track> {
        self.faces.iter()
    }

    /// Takes the readings of a step.
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

    /// Begins with the nearest reading that no obstacle explains. While all places are taken, none begins.
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

    /// Whether a track of a neighbour that moves explains only readings that obstacles that are `meant` explain better.
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
