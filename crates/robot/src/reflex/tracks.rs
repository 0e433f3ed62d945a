//! All neighbours in sight: which reading belongs to which of them, and who has come or gone.

use super::covariance::Covariance;
use super::point::Point;
use super::sensors::Sensors;
use super::track::{OwnMotion, Track};
use crate::config::{ReflexParameters, SENSORS};

/// Neighbours that are followed at once: as many robots of one size as fit around another. More are not looked at.
pub(super) const TRACKS: usize = 6;
/// A reading belongs to a neighbour if it is this near to what is expected, metres, or within `ASSIGN_SIGMAS`: 8 mm is
/// what a gap of two robots that drive towards each other at full speed loses in a step.
const ASSIGN_M: f32 = 0.009;
const ASSIGN_SIGMAS: f32 = 4.0;
/// A neighbour this far outside a sensor's cone, metres, may still be what the sensor sees: its place is not that sure.
const BESIDE_M: f32 = 0.012;
/// A neighbour this far inside a sensor's cone, metres, and nearer than this share of its range is seen for sure.
const SURELY_INSIDE_M: f32 = 0.008;
const SURELY_NEAR: f32 = 0.8;
/// A neighbour that is not seen in this many steps, although it should be, has gone.
const MISSED_MOST: u8 = 3;
/// Uncertainty across of a place known from one sensor alone, as a share of its distance: ±19°, evenly spread.
const BEARING_SIGMA: f32 = 0.19;
/// Readings of two sensors side by side that differ by less than this, metres, may be of one disc.
const SHARED_M: f32 = 0.015;

/// Steps for which the plan does not count after a neighbour has done something it does not know.
const SHAKEN_STEPS: u8 = 5;

/// A neighbour that the plan expects in sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expectation {
    /// Its number among the neighbours of the route.
    pub index: u8,
    /// Its centre, body space, metres.
    pub at: Point,
    /// Over the floor along the axes of body space, m/s.
    pub velocity: Point,
    /// Its planned acceleration, m/s².
    pub acceleration: Point,
    /// Least distance from rim to rim that the plan leaves the two, metres.
    pub clearance_m: f32,
}

/// The neighbours in sight.
#[derive(Debug, Default)]
pub(crate) struct Tracks {
    list: heapless::Vec<Track, TRACKS>,
}

impl Tracks {
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub fn iter(&self) -> impl Iterator<Item = &Track> {
        self.list.iter()
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Takes the readings of a step in which the robot moved as `own` says.
    pub fn step(
        &mut self,
        gaps_m: &[f32; SENSORS],
        own: &OwnMotion,
        planned: &[Expectation],
        sensors: &Sensors,
        of: &ReflexParameters,
    ) {
        for track in &mut self.list {
            track.predict(own, of);
            if let Some(one) = planned.iter().find(|one| track.planned == Some(one.index)) {
                track.velocity = track.velocity.plus(one.acceleration.times(own.dt));
            }
        }
        let mut owner = [None; SENSORS];
        for (sensor, owner) in owner.iter_mut().enumerate() {
            if gaps_m[sensor] < sensors.range_m {
                *owner = self.owner(sensor, gaps_m[sensor], planned, sensors, of);
            }
        }
        for index in 0..self.list.len() {
            self.correct(index, gaps_m, &owner, own.dt, sensors, of);
        }
        self.list.retain(|track| track.missed < MISSED_MOST);
        self.welcome(gaps_m, owner, planned, sensors, of);
        self.part();
        self.recognise(planned, of);
        self.explain(gaps_m, &owner, planned, sensors, of);
    }

    /// Whose reading this most likely is; nobody's where a planned neighbour that is not followed yet explains it better.
    fn owner(
        &self,
        sensor: usize,
        read_m: f32,
        planned: &[Expectation],
        sensors: &Sensors,
        of: &ReflexParameters,
    ) -> Option<usize> {
        let mut best: Option<(f32, usize)> = None;
        for (index, track) in self.list.iter().enumerate() {
            let expected = sensors.expected(sensor, track.at);
            if expected.inside_m < -BESIDE_M {
                continue;
            }
            let (off_m, variance) = track.innovation(&expected, read_m, sensors);
            let off_m = off_m.abs();
            let within_m = ASSIGN_M.max(ASSIGN_SIGMAS * libm::sqrtf(variance));
            if off_m < within_m && best.is_none_or(|(least_m, _)| off_m < least_m) {
                best = Some((off_m, index));
            }
        }
        let (least_m, index) = best?;
        let newcomer = self.expected_there(sensor, read_m, planned, sensors, of);
        let explains_better = |track: Track| {
            let expected = sensors.expected(sensor, track.at);
            expected.inside_m > 0.0 && (read_m - expected.gap_m).abs() < least_m
        };
        (!newcomer.is_some_and(explains_better)).then_some(index)
    }

    /// Corrects a neighbour by the readings that are its own, and by what did not see it.
    fn correct(
        &mut self,
        index: usize,
        gaps_m: &[f32; SENSORS],
        owner: &[Option<usize>; SENSORS],
        dt: f32,
        sensors: &Sensors,
        of: &ReflexParameters,
    ) {
        let track = &mut self.list[index];
        track.age = track.age.saturating_add(1);
        track.shaken = track.shaken.saturating_sub(1);
        let mut seen = false;
        for sensor in 0..SENSORS {
            if owner[sensor] != Some(index) {
                continue;
            }
            let expected = sensors.expected(sensor, track.at);
            let (off_m, variance) = track.innovation(&expected, gaps_m[sensor], sensors);
            if track.is_shaken_by(off_m, variance, of) {
                track.loosen(of.manoeuvre_mps, dt);
                track.shaken = SHAKEN_STEPS;
                track.strays = true;
            }
            take(track, sensor, gaps_m[sensor], sensors);
            seen = true;
        }
        bound_bearing(track, index, owner, sensors);
        let (mut surely, mut seen_by) = (false, 0);
        for sensor in 0..SENSORS {
            let expected = sensors.expected(sensor, track.at);
            let sees = owner[sensor] == Some(index);
            let blank = gaps_m[sensor] >= sensors.range_m;
            let near = expected.gap_m < SURELY_NEAR * sensors.range_m;
            surely |= expected.inside_m > SURELY_INSIDE_M && near;
            seen_by |= u8::from(sees) << sensor;
            let contradicts = sees && expected.inside_m < 0.0 || blank && near && expected.inside_m > 0.0;
            if contradicts && track.planned.is_none() {
                let gradient = sensors.inside_gradient(sensor, &expected);
                track.stay_within(expected.towards.left(), gradient, expected.inside_m);
            }
        }
        track.seen_by = seen_by;
        let gone = !seen && (surely || track.gap_m(sensors) > sensors.range_m);
        track.missed = if seen { 0 } else { track.missed.saturating_add(if gone { 2 } else { 1 }) };
    }

    /// Begins to follow what readings show that belong to nobody yet, the nearest first.
    fn welcome(
        &mut self,
        gaps_m: &[f32; SENSORS],
        mut owner: [Option<usize>; SENSORS],
        planned: &[Expectation],
        sensors: &Sensors,
        of: &ReflexParameters,
    ) {
        loop {
            let free = |sensor: &usize| owner[*sensor].is_none() && gaps_m[*sensor] < sensors.range_m;
            let nearest = (0..SENSORS).filter(free).min_by(|a, b| gaps_m[*a].total_cmp(&gaps_m[*b]));
            let Some(sensor) = nearest else { return };
            let known = self.expected_there(sensor, gaps_m[sensor], planned, sensors, of);
            let mut track = known.unwrap_or_else(|| unknown(sensor, gaps_m, &owner, sensors, of));
            let index = self.list.len();
            owner[sensor] = Some(index);
            take(&mut track, sensor, gaps_m[sensor], sensors);
            for (beside, owner) in owner.iter_mut().enumerate() {
                let read_m = gaps_m[beside];
                if owner.is_some() || read_m >= sensors.range_m {
                    continue;
                }
                let expected = sensors.expected(beside, track.at);
                let (off_m, variance) = track.innovation(&expected, read_m, sensors);
                if expected.inside_m > -BESIDE_M && off_m * off_m < ASSIGN_SIGMAS * ASSIGN_SIGMAS * variance {
                    *owner = Some(index);
                    take(&mut track, beside, read_m, sensors);
                }
            }
            if self.list.push(track).is_err() {
                return;
            }
        }
    }

    /// The planned neighbour that explains a reading, if there is one that is not followed yet.
    fn expected_there(
        &self,
        sensor: usize,
        read_m: f32,
        planned: &[Expectation],
        sensors: &Sensors,
        of: &ReflexParameters,
    ) -> Option<Track> {
        let place_m2 = of.planned_sigma_m * of.planned_sigma_m;
        let mut best: Option<(f32, Track)> = None;
        for one in planned {
            let expected = sensors.expected(sensor, one.at);
            let variance = place_m2 + sensors.variance_m2(expected.gap_m);
            let off_m = (read_m - expected.gap_m).abs();
            let explains = expected.inside_m > -BESIDE_M && off_m * off_m < 9.0 * variance;
            let followed = self.list.iter().any(|track| track.planned == Some(one.index));
            if explains && !followed && best.as_ref().is_none_or(|(least_m, _)| off_m < *least_m) {
                let velocity_variance = of.planned_sigma_mps * of.planned_sigma_mps;
                let track = Track {
                    at: one.at,
                    velocity: one.velocity,
                    covariance: Covariance::new(Point::new(1.0, 0.0), place_m2, place_m2, velocity_variance),
                    planned: Some(one.index),
                    missed: 0,
                    seen_by: 0,
                    shaken: 0,
                    strays: false,
                    unplanned: 0,
                    alarm: [0.0; 2],
                    age: 0,
                };
                best = Some((off_m, track));
            }
        }
        best.map(|(_, track)| track)
    }

    /// Compares neighbours with the plan: those that keep to it are known by it.
    fn recognise(&mut self, planned: &[Expectation], of: &ReflexParameters) {
        for index in 0..self.list.len() {
            let track = &self.list[index];
            let expected = match track.planned {
                Some(known) => planned.iter().find(|one| one.index == known),
                None => planned.iter().find(|one| {
                    let taken = self.list.iter().any(|other| other.planned == Some(one.index));
                    !taken && track.keeps_to(one.at, one.velocity, of)
                }),
            };
            let kept = expected.filter(|one| track.keeps_to(one.at, one.velocity, of));
            let track = &mut self.list[index];
            track.planned = kept.map(|one| one.index);
            track.unplanned = if kept.is_some() { 0 } else { track.unplanned.saturating_add(1) };
            if let Some(one) = kept.filter(|_| track.shaken == 0) {
                for axis in [Point::new(1.0, 0.0), Point::new(0.0, 1.0)] {
                    track.learn_place(axis, one.at, of.planned_sigma_m);
                    track.learn_velocity(axis, one.velocity, of.planned_sigma_mps);
                }
            }
        }
    }

    /// A neighbour that the plan does not know, and that a planned one explains as well which nobody follows, is that one.
    /// What has left its plan is never taken for another.
    fn explain(
        &mut self,
        gaps_m: &[f32; SENSORS],
        owner: &[Option<usize>; SENSORS],
        planned: &[Expectation],
        sensors: &Sensors,
        of: &ReflexParameters,
    ) {
        for index in 0..self.list.len() {
            let track = &self.list[index];
            if track.planned.is_some() || track.strays {
                continue;
            }
            let seeing = |sensor: &usize| owner[*sensor] == Some(index);
            let Some(sensor) = (0..SENSORS).filter(seeing).min_by(|a, b| gaps_m[*a].total_cmp(&gaps_m[*b]))
            else {
                continue;
            };
            if let Some(known) = self.expected_there(sensor, gaps_m[sensor], planned, sensors, of) {
                let seen = *track;
                let track = &mut self.list[index];
                *track = Track { age: seen.age, seen_by: seen.seen_by, ..known };
                (0..SENSORS).filter(seeing).for_each(|sensor| take(track, sensor, gaps_m[sensor], sensors));
            }
        }
    }

    /// Two discs are never in one place: the one that is known for a shorter time is no other.
    fn part(&mut self) {
        let mut index = 1;
        while index < self.list.len() {
            let track = self.list[index];
            let near_m = 0.03;
            let double = self.list[..index].iter().any(|other| other.at.minus(track.at).length() < near_m);
            if double {
                self.list.remove(index);
            } else {
                index += 1;
            }
        }
    }
}

/// What one sensor sees lies around its axis, what two see between them.
fn bound_bearing(track: &mut Track, index: usize, owner: &[Option<usize>; SENSORS], sensors: &Sensors) {
    let seeing = (0..SENSORS).filter(|&sensor| owner[sensor] == Some(index));
    let sum = seeing.fold(Point::ZERO, |sum, sensor| sum.plus(sensors.axes[sensor]));
    let size = sum.length();
    if size < 0.1 {
        return;
    }
    let (axis, far_m) = (sum.times(1.0 / size), track.at.length());
    track.bound_place(axis.left(), axis.times(far_m), BEARING_SIGMA * far_m);
}

/// Takes a reading into a track.
fn take(track: &mut Track, sensor: usize, read_m: f32, sensors: &Sensors) {
    let expected = sensors.expected(sensor, track.at);
    let (off_m, variance) = track.innovation(&expected, read_m, sensors);
    track.correct(expected.towards, off_m, variance);
}

/// A disc of which nothing is known but a reading: straight ahead of the sensor, or between two that see it.
fn unknown(
    sensor: usize,
    gaps_m: &[f32; SENSORS],
    owner: &[Option<usize>; SENSORS],
    sensors: &Sensors,
    of: &ReflexParameters,
) -> Track {
    let read_m = gaps_m[sensor];
    let shares = |beside: &usize| {
        owner[*beside].is_none()
            && (gaps_m[*beside] - read_m).abs() < SHARED_M
            && gaps_m[*beside] < sensors.range_m
    };
    let beside = [(sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS].into_iter().find(shares);
    let axis = sensors.axes[sensor];
    let direction = beside.map_or(axis, |beside| {
        let sum = axis.plus(sensors.axes[beside]);
        sum.times(1.0 / sum.length().max(0.1))
    });
    let far_m = sensors.contact_m() + read_m - if beside.is_some() { 0.002 } else { 0.0 };
    let (along, across) = (libm::sqrtf(sensors.variance_m2(read_m)) + 0.002, BEARING_SIGMA * far_m);
    let unknown_mps = of.unknown_sigma_mps * of.unknown_sigma_mps;
    Track {
        at: direction.times(far_m),
        velocity: Point::ZERO,
        covariance: Covariance::new(direction, along * along, across * across, unknown_mps),
        planned: None,
        missed: 0,
        seen_by: 0,
        shaken: 0,
        strays: false,
        unplanned: 0,
        alarm: [0.0; 2],
        age: 0,
    }
}
