//! The standing objects in sight that the plan does not know: which readings belong to them, and how the policy sees
//! them.

use super::obstacle::{Readings, StandingObject, bits};
use super::scan::Scan;
use super::track::Track;

/// Largest number of obstacles followed at once: the two walls of a corner or a corridor.
const OBSTACLES: usize = 2;
/// Log-likelihood ratio (natural) of standing over moving below which an obstacle is dropped.
const LEAST_LOG_RATIO: f32 = -8.0;
/// Number of steps in a row without a reading after which an obstacle has gone.
const MISSED_MOST: u8 = 3;

/// All obstacles in sight.
#[derive(Debug, Default)]
pub(crate) struct StandingObjects {
    list: heapless::Vec<StandingObject, OBSTACLES>,
    /// The likely obstacles, each as a disc of a robot's size that touches it at its nearest point.
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

    /// The obstacles that are likelier than moving neighbours, as discs that touch them at their nearest points.
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

    /// Begins an obstacle with the nearest reading that no obstacle explains, unless all places are taken.
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

    /// Whether obstacles selected by `meant` replace the track of a moving neighbour. They do if they explain all its
    /// readings or, without a reading, overlap it. A track that the plan names is never replaced.
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
