//! The tracks (estimates) of all neighbours in sight. This module assigns readings to tracks, begins tracks of new
//! neighbours, and removes those of neighbours that have gone. Planned neighbours are those that the route names.

use super::birth::{BEARING_SIGMA, expected_there, explained_off_m, unknown};
use super::departure::{Departure, Left};
use super::likelihood::log_density;
use super::obstacle::Readings;
use super::obstacles::StandingObjects;
use super::point::Point;
use super::scan::{Expectation, Scan};
use super::sensors::{BESIDE_M, Sensors};
use super::track::Track;
use crate::config::SENSORS;

/// Largest number of moving neighbours that are tracked at once: the number of robots that fit around a robot of equal
/// size. Further neighbours are not tracked.
pub(super) const TRACKS: usize = 6;
/// Largest innovation at which a reading belongs to a neighbour's track, metres. With a larger value, readings of
/// another neighbour are assigned to the track. With less than 13 mm, a robot that stops dead is lost. The filter
/// follows it one or two steps late, and each step adds up to 4.3 mm.
const ASSIGN_M: f32 = 0.014;
/// Largest innovation at which a reading belongs to a track, in standard deviations of the innovation. The larger one
/// of this and [`ASSIGN_M`] counts.
pub(super) const ASSIGN_SIGMAS: f32 = 4.0;
/// A near neighbour is surely seen if its centre is farther inside a sensor's cone than this, metres.
const SURELY_INSIDE_M: f32 = 0.008;
/// A neighbour counts as near in this sense if its gap to the sensor is less than this share of the sensors' range.
const SURELY_NEAR: f32 = 0.8;
/// A track is removed once its count of steps in a row without a reading reaches this. A step in which the neighbour
/// should be seen counts double.
const MISSED_MOST: u8 = 3;
/// Two tracks whose centres are closer than this are of the same disc, metres.
const SAME_M: f32 = 0.03;

/// For each sensor, the index of the track to which its reading belongs; `None` if to none.
type Owners = [Option<usize>; SENSORS];

/// The neighbours in sight.
#[derive(Debug, Default)]
pub(crate) struct Tracks {
    list: heapless::Vec<Track, TRACKS>,
    obstacles: StandingObjects,
}

impl Tracks {
    pub fn is_empty(&self) -> bool {
        self.list.is_empty() && self.obstacles.is_empty()
    }

    /// The tracks that can make the robot brake: standing objects that are surely straight edges, and all other
    /// neighbours as moving ones. Any other standing object may be a robot, which may drive off at any moment.
    pub fn iter<'a>(&'a self, sensors: &Sensors) -> impl Iterator<Item = &'a Track> + use<'a> {
        self.explained_by(sensors, |face| face.is_flat)
    }

    /// The tracks of the likeliest explanation of all readings: standing objects, and moving neighbours that these do
    /// not replace.
    #[cfg(test)]
    pub fn likeliest<'a>(&'a self, sensors: &Sensors) -> impl Iterator<Item = &'a Track> + use<'a> {
        self.explained_by(sensors, |_| true)
    }

    /// Tracks of the standing objects for which `meant` returns `true`, and of the moving neighbours that these objects
    /// do not replace.
    fn explained_by<'a>(
        &'a self,
        sensors: &Sensors,
        meant: fn(&Track) -> bool,
    ) -> impl Iterator<Item = &'a Track> + use<'a> {
        let contact_m = sensors.contact_m();
        let faces = self.obstacles.faces().filter(move |face| meant(face));
        let hidden = move |track: &Track| self.obstacles.hide(track, contact_m, meant);
        self.list.iter().filter(move |track| !hidden(track)).chain(faces)
    }

    /// Tracks of all moving neighbours, including those that standing objects replace.
    #[cfg(test)]
    pub fn list(&self) -> &[Track] {
        &self.list
    }

    pub fn clear(&mut self) {
        self.list.clear();
        self.obstacles.clear();
    }

    /// Updates the tracks of moving neighbours and the standing objects by the readings of a step. Begins and removes
    /// tracks.
    pub fn step(&mut self, scan: &Scan<'_>) {
        for track in &mut self.list {
            track.predict(scan.own, scan.of);
            if let Some(one) = scan.plan_of(track.planned) {
                track.velocity = track.velocity.plus(one.acceleration.times(scan.own.dt));
            }
        }
        let owners: Owners = core::array::from_fn(|sensor| self.owner(sensor, scan));
        let mut logs = [scan.sensors.new_log; SENSORS];
        for index in 0..self.list.len() {
            let seen_by =
                (0..SENSORS).fold(0, |seen, sensor| seen | u8::from(owners[sensor] == Some(index)) << sensor);
            correct(&mut self.list[index], seen_by, scan, &mut logs);
        }
        self.welcome(owners, scan, &mut logs);
        self.list.retain(|track| track.missed < MISSED_MOST);
        self.merge();
        self.recognise(scan);
        self.explain(scan);
        self.look_for_obstacles(&logs, scan);
    }

    /// Updates the standing objects by the readings that belong to no planned neighbour and to no neighbour that has
    /// left its plan. `logs`: see [`Readings::logs`].
    fn look_for_obstacles(&mut self, logs: &[f32; SENSORS], scan: &Scan<'_>) {
        let known = self.list.iter().filter(|track| track.is_known());
        let open = !known.fold(0, |seen_by, track| seen_by | track.seen_by);
        let is_free = |sensor: usize| open >> sensor & 1 == 1 && scan.reads_m(sensor).is_some();
        if !self.obstacles.is_empty() || (0..SENSORS).any(is_free) {
            self.obstacles.step(&Readings { open, logs }, scan);
        }
    }

    /// Index of the track to which a sensor's reading most likely belongs. `None` if the sensor has no reading, if the
    /// reading fits no track, or if a planned neighbour without a track explains it better.
    fn owner(&self, sensor: usize, scan: &Scan<'_>) -> Option<usize> {
        let read_m = scan.reads_m(sensor)?;
        let mut best: Option<(f32, usize)> = None;
        for (index, track) in self.list.iter().enumerate() {
            let expected = scan.sensors.expected(sensor, track.at);
            if expected.inside_m < -BESIDE_M {
                continue;
            }
            let (off_m, variance) = track.innovation(&expected, read_m, scan.sensors);
            let off_m = off_m.abs();
            let within_m = ASSIGN_M.max(ASSIGN_SIGMAS * libm::sqrtf(variance));
            if off_m < within_m && best.is_none_or(|(least_m, _)| off_m < least_m) {
                best = Some((off_m, index));
            }
        }
        let (least_m, index) = best?;
        let explains_better = |newcomer: Track| {
            let expected = scan.sensors.expected(sensor, newcomer.at);
            expected.inside_m > 0.0 && (read_m - expected.gap_m).abs() < least_m
        };
        (!expected_there(sensor, &self.list, scan).is_some_and(explains_better)).then_some(index)
    }

    /// Begins tracks for readings that belong to no track yet, the nearest reading first, until there are [`TRACKS`]
    /// tracks. `logs`: see [`Readings::logs`].
    fn welcome(&mut self, mut owners: Owners, scan: &Scan<'_>, logs: &mut [f32; SENSORS]) {
        // Each round assigns at least one sensor.
        for _ in 0..SENSORS {
            let free = (0..SENSORS).filter(|&sensor| owners[sensor].is_none());
            let readings = free.filter_map(|sensor| Some((sensor, scan.reads_m(sensor)?)));
            let Some((sensor, _)) = readings.min_by(|a, b| a.1.total_cmp(&b.1)) else { return };
            let index = self.list.len();
            let is_free = |sensor: usize| owners[sensor].is_none();
            let mut track =
                expected_there(sensor, &self.list, scan).unwrap_or_else(|| unknown(sensor, &is_free, scan));
            for one in core::iter::once(sensor).chain((0..SENSORS).filter(|&beside| beside != sensor)) {
                let Some(read_m) = scan.reads_m(one).filter(|_| owners[one].is_none()) else { continue };
                let expected = scan.sensors.expected(one, track.at);
                let (off_m, variance) = track.innovation(&expected, read_m, scan.sensors);
                let is_near = off_m * off_m < ASSIGN_SIGMAS * ASSIGN_SIGMAS * variance;
                if one == sensor || expected.inside_m > -BESIDE_M && is_near {
                    owners[one] = Some(index);
                    track.seen_by |= 1 << one;
                    track.take(one, read_m, scan.sensors);
                    if one != sensor && !track.is_known() {
                        logs[one] = log_density(off_m, variance);
                    }
                }
            }
            if self.list.push(track).is_err() {
                return;
            }
        }
    }

    /// Compares tracks with the planned neighbours. A track that keeps to the plan of a neighbour is taken for this
    /// neighbour, and is corrected by its planned place and velocity. A track that no longer keeps to the plan follows
    /// no planned neighbour.
    fn recognise(&mut self, scan: &Scan<'_>) {
        for index in 0..self.list.len() {
            let track = &self.list[index];
            let expected = scan.plan_of(track.planned).or_else(|| {
                let others = || self.list[..index].iter().chain(&self.list[index + 1..]);
                let is_free = |planned: u8| others().all(|other| !other.stands_for(planned));
                scan.planned.iter().find(|one| is_free(one.index) && keeps_to(track, one, scan))
            });
            let kept = expected.filter(|one| keeps_to(track, one, scan));
            let track = &mut self.list[index];
            if track.planned.is_none() && kept.is_some() {
                track.departure = Departure::new(scan.planned_sigma_m);
            }
            track.planned = kept.map(|one| one.index);
            if let Some(one) = kept {
                for axis in [Point::new(1.0, 0.0), Point::new(0.0, 1.0)] {
                    track.learn_place(axis, one.at, scan.planned_sigma_m);
                    track.learn_velocity(axis, one.velocity, scan.of.planned_sigma_mps);
                }
            }
        }
    }

    /// Replaces the track of an unplanned neighbour by the track of a planned neighbour. The planned neighbour must
    /// have no track yet and must explain the nearest reading. A track of a neighbour that has left its plan is never
    /// replaced.
    fn explain(&mut self, scan: &Scan<'_>) {
        for index in 0..self.list.len() {
            let track = &self.list[index];
            if track.planned.is_some() || track.left.is_some() {
                continue;
            }
            let readings = track.sensors().filter_map(|sensor| Some((sensor, scan.reads_m(sensor)?)));
            let Some((sensor, _)) = readings.min_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
            if let Some(known) = expected_there(sensor, &self.list, scan) {
                let mut known = Track { age: track.age, seen_by: track.seen_by, ..known };
                for sensor in track.sensors() {
                    if let Some(read_m) = scan.reads_m(sensor) {
                        known.take(sensor, read_m, scan.sensors);
                    }
                }
                self.list[index] = known;
            }
        }
    }

    /// Removes one of two tracks in the same place, because two discs cannot overlap. If a sensor saw only the later
    /// one in the list, removes the earlier one; otherwise the later one.
    fn merge(&mut self) {
        let mut index = 1;
        while index < self.list.len() {
            let at = self.list[index].at;
            match self.list[..index].iter().position(|other| other.at.minus(at).length() < SAME_M) {
                Some(older) if self.list[older].seen_by == 0 && self.list[index].seen_by != 0 => {
                    self.list.remove(older);
                }
                Some(_) => {
                    self.list.remove(index);
                }
                None => index += 1,
            }
        }
    }
}

/// Whether a neighbour keeps to the plan `one`. Its estimate and its readings must agree with the plan, because a very
/// uncertain estimate agrees with anything.
fn keeps_to(track: &Track, one: &Expectation, scan: &Scan<'_>) -> bool {
    let explains = |sensor: usize| {
        scan.reads_m(sensor).is_none_or(|read_m| explained_off_m(one, sensor, read_m, scan).is_some())
    };
    track.keeps_to(one.at, one.velocity, scan.planned_sigma_m, scan.of) && track.sensors().all(explains)
}

/// First tests whether the track's neighbour has left its plan. Then corrects the track by the readings that belong to
/// it, and by the fact that other sensors do not see the neighbour. `seen_by`: the sensors with its readings, one bit
/// each; `logs`: see [`Readings::logs`].
fn correct(track: &mut Track, seen_by: u8, scan: &Scan<'_>, logs: &mut [f32; SENSORS]) {
    track.age = track.age.saturating_add(1);
    track.seen_by = seen_by;
    watch(track, scan);
    for (sensor, log) in logs.iter_mut().enumerate() {
        if let Some(read_m) = scan.reads_m(sensor).filter(|_| track.is_seen_by(sensor)) {
            let (off_m, variance) = track.take(sensor, read_m, scan.sensors);
            if !track.is_known() {
                *log = log_density(off_m, variance);
            }
        }
    }
    bound_bearing(track, scan.sensors);
    let mut surely = false;
    for sensor in 0..SENSORS {
        let expected = scan.sensors.expected(sensor, track.at);
        let near = expected.gap_m < SURELY_NEAR * scan.sensors.range_m;
        surely |= expected.inside_m > SURELY_INSIDE_M && near;
        let is_outside = track.is_seen_by(sensor) && expected.inside_m < 0.0;
        let is_inside = scan.reads_m(sensor).is_none() && near && expected.inside_m > 0.0;
        if (is_outside || is_inside) && track.planned.is_none() {
            let gradient = scan.sensors.inside_gradient(sensor, &expected);
            track.stay_within(expected.towards.left(), gradient, expected.inside_m);
        }
    }
    let should_be_seen = surely || track.gap_m(scan.sensors) > scan.sensors.range_m;
    let missed = if should_be_seen { 2 } else { 1 };
    track.missed = if seen_by != 0 { 0 } else { track.missed.saturating_add(missed) };
}

/// Tests whether a planned neighbour has left its plan, and if so, changes its track to that of an unplanned one.
fn watch(track: &mut Track, scan: &Scan<'_>) {
    let Some(one) = scan.plan_of(track.planned) else { return };
    let seen_by = track.sensors();
    match track.departure.test(one, seen_by.clone(), scan) {
        Some(Left::Stands(at)) => track.stand(at, scan.of),
        Some(Left::Strays) => {
            let nearest = seen_by.min_by(|&a, &b| scan.gaps_m[a].total_cmp(&scan.gaps_m[b]));
            let Some(sensor) = nearest else { return };
            let seen = track.seen_by;
            *track = Track {
                age: track.age,
                seen_by: seen,
                ..unknown(sensor, &|beside| seen >> beside & 1 == 1, scan)
            };
        }
        None => return,
    }
    track.left = Some(one.index);
}

/// Bounds the direction of a track: an object that one sensor sees lies around the axis of this sensor. An object that
/// two sensors see lies between their axes.
fn bound_bearing(track: &mut Track, sensors: &Sensors) {
    let sum = track.sensors().fold(Point::ZERO, |sum, sensor| sum.plus(sensors.axes[sensor]));
    let size = sum.length();
    if size < 0.1 {
        return;
    }
    let (axis, far_m) = (sum.times(1.0 / size), track.at.length());
    track.bound_place(axis.left(), axis.times(far_m), BEARING_SIGMA * far_m);
}
