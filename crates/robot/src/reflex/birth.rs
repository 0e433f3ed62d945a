//! Begins tracks: from the plan if a planned neighbour explains a reading, otherwise from the reading alone.

use super::covariance::Covariance;
use super::departure::Departure;
use super::point::Point;
use super::scan::{Expectation, Scan};
use super::sensors::BESIDE_M;
use super::track::Track;
use crate::config::SENSORS;

/// Uncertainty, across the line of sight, of a place that one sensor sees, 1 sigma, as a share of its distance. It
/// stands for directions that are evenly spread over ±19°: there a disc 10 mm away is in the cone of one sensor only.
pub(super) const BEARING_SIGMA: f32 = 0.19;
/// Readings of two adjacent sensors may be of one disc if they differ by less than this, metres. For a disc 20 mm away
/// at the edge of a sensor's cone, the readings differ by this much.
const SHARED_M: f32 = 0.015;
/// How much nearer a disc midway between two sensors is than either sensor reads, metres. It is also added to the noise
/// of a reading along the line of sight.
const BETWEEN_M: f32 = 0.002;
/// Largest innovation at which a planned neighbour explains a reading, in standard deviations of the innovation.
const EXPLAINS_SIGMAS: f32 = 4.5;

/// Begins a track of the planned neighbour that explains the reading of a sensor best; `None` if no planned neighbour
/// explains it. Neighbours that have a track do not count, and neither do neighbours that have left their plan.
pub(super) fn expected_there(sensor: usize, tracks: &[Track], scan: &Scan<'_>) -> Option<Track> {
    let read_m = scan.reads_m(sensor)?;
    let place_m2 = scan.planned_sigma_m * scan.planned_sigma_m;
    let is_followed = |one: &&Expectation| tracks.iter().any(|track| track.stands_for(one.index));
    let candidates = scan.planned.iter().filter(|one| !is_followed(one));
    let (_, one) = candidates
        .filter_map(|one| Some((explained_off_m(one, sensor, read_m, scan)?, one)))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    let velocity_variance = scan.of.planned_sigma_mps * scan.of.planned_sigma_mps;
    let covariance = Covariance::new(Point::new(1.0, 0.0), place_m2, place_m2, velocity_variance);
    let departure = Departure::at_first_sight(sensor, read_m, one.at, scan);
    Some(Track { planned: Some(one.index), departure, ..begun(one.at, one.velocity, covariance, scan) })
}

/// Absolute difference between a reading and the reading that a planned neighbour would give, metres; `None` if the
/// neighbour does not explain the reading.
pub(super) fn explained_off_m(one: &Expectation, sensor: usize, read_m: f32, scan: &Scan<'_>) -> Option<f32> {
    let expected = scan.sensors.expected(sensor, one.at);
    let variance = scan.planned_sigma_m * scan.planned_sigma_m + scan.sensors.variance_m2(expected.gap_m);
    let off_m = (read_m - expected.gap_m).abs();
    let explains = off_m * off_m < EXPLAINS_SIGMAS * EXPLAINS_SIGMAS * variance;
    (explains && expected.inside_m > -BESIDE_M).then_some(off_m)
}

/// Begins a track of an unplanned disc from the reading of a sensor. The disc is assumed straight ahead of the sensor,
/// or midway between two adjacent sensors with similar readings. `is_free`: whether a sensor's reading belongs to no
/// track yet.
pub(super) fn unknown(sensor: usize, is_free: &dyn Fn(usize) -> bool, scan: &Scan<'_>) -> Track {
    let read_m = scan.gaps_m[sensor];
    let shares = |beside: &usize| {
        let near = scan.reads_m(*beside).is_some_and(|gap_m| (gap_m - read_m).abs() < SHARED_M);
        near && is_free(*beside)
    };
    let beside = [(sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS].into_iter().find(shares);
    let axis = scan.sensors.axes[sensor];
    let direction = beside.map_or(axis, |beside| {
        let sum = axis.plus(scan.sensors.axes[beside]);
        sum.times(1.0 / sum.length().max(0.1))
    });
    let far_m = scan.sensors.contact_m() + read_m - if beside.is_some() { BETWEEN_M } else { 0.0 };
    let along = libm::sqrtf(scan.sensors.variance_m2(read_m)) + BETWEEN_M;
    let across = BEARING_SIGMA * far_m;
    let unknown_mps = scan.of.unknown_sigma_mps * scan.of.unknown_sigma_mps;
    let covariance = Covariance::new(direction, along * along, across * across, unknown_mps);
    begun(direction.times(far_m), Point::ZERO, covariance, scan)
}

fn begun(at: Point, velocity: Point, covariance: Covariance, scan: &Scan<'_>) -> Track {
    Track {
        at,
        velocity,
        covariance,
        planned: None,
        missed: 0,
        seen_by: 0,
        departure: Departure::new(scan.planned_sigma_m),
        left: None,
        age: 0,
        is_flat: false,
    }
}
