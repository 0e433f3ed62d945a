//! How a track begins: from the plan if a planned neighbour explains a reading, else from the reading alone.

use super::covariance::Covariance;
use super::departure::Departure;
use super::point::Point;
use super::scan::{Expectation, Scan};
use super::sensors::BESIDE_M;
use super::track::Track;
use crate::config::SENSORS;

/// Uncertainty across the line of sight of a place known from one sensor, 1 sigma, as a share of its distance. It
/// stands for ±19°, evenly spread: there a disc 10 mm away is in the cone of one sensor only.
pub(super) const BEARING_SIGMA: f32 = 0.19;
/// Difference below which readings of two sensors side by side may be of one disc, metres. At 20 mm, a disc at the edge
/// of a cone reads that much farther there.
const SHARED_M: f32 = 0.015;
/// How much nearer a disc between two sensors is than either reads, metres. Readings of one sensor alone have this
/// uncertainty on top of their noise.
const BETWEEN_M: f32 = 0.002;
/// Largest error with which a planned neighbour explains a reading, in sigma.
const EXPLAINS_SIGMAS: f32 = 4.5;

/// Begins a track of the planned neighbour that explains a reading best; `None` if none does. A neighbour that a track
/// follows already does not count. Neither does one that has left its plan, because it is not where the plan has it.
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

/// Difference between a reading and what it would be of a planned neighbour, metres; `None` if that neighbour does not
/// explain it.
pub(super) fn explained_off_m(one: &Expectation, sensor: usize, read_m: f32, scan: &Scan<'_>) -> Option<f32> {
    let expected = scan.sensors.expected(sensor, one.at);
    let variance = scan.planned_sigma_m * scan.planned_sigma_m + scan.sensors.variance_m2(expected.gap_m);
    let off_m = (read_m - expected.gap_m).abs();
    let explains = off_m * off_m < EXPLAINS_SIGMAS * EXPLAINS_SIGMAS * variance;
    (explains && expected.inside_m > -BESIDE_M).then_some(off_m)
}

/// Begins a track of an unknown disc from one reading. The disc is assumed straight ahead of the sensor, or midway between
/// two adjacent sensors with similar readings.
/// `is_free`: whether a sensor's reading belongs to no track yet.
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
