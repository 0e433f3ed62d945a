//! The track (estimate) of one neighbour that the sensors see: an extended Kalman filter of its place and velocity. A
//! planned neighbour is one that the route names. Source: Bar-Shalom, Li and Kirubarajan, *Estimation with Applications
//! to Tracking and Navigation*, 2001. The filter has the nearly constant velocity model of section 6.3, the
//! second-order measurement of 10.3 and the manoeuvre detection of 11.2.
//!
//! The place is relative to the robot: the centre of the neighbour in body space. The velocity is absolute: over the
//! floor, given along the axes of body space. A standing neighbour has velocity zero.

use super::covariance::Covariance;
use super::departure::Departure;
use super::motion::OwnMotion;
use super::outline::NearestPoint;
use super::point::Point;
use super::scan::Scan;
use super::sensors::{Expected, Sensors};
use crate::config::{NeighbourModel, SENSORS};

/// Uncertainty of where the edge of a sensor's cone lies, metres, 1 sigma: how far a neighbour moves across it in a
/// step.
const EDGE_SIGMA_M: f32 = 0.003;

/// Largest difference of a neighbour's place or velocity from the plan at which it keeps to the plan, in standard
/// deviations.
const RECOGNISED_SIGMAS: f32 = 4.5;

/// Number of steps over which a robot's deviation from its plan hardly changes. So the plan counts as one measurement
/// in this number of steps.
const CORRELATED_STEPS: f32 = 10.0;

/// A neighbour in sight.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Its centre in body space, metres.
    pub at: Point,
    /// Its velocity over the floor, along the axes of body space, m/s.
    pub velocity: Point,
    pub covariance: Covariance,
    /// Index, among the neighbours of the route, of the planned neighbour that this track follows; `None` if it follows
    /// none.
    pub planned: Option<u8>,
    /// Count of steps in a row in which no sensor saw it. A step counts double if a sensor should have seen it.
    pub missed: u8,
    /// Sensors that saw it in the latest step, one bit each.
    pub seen_by: u8,
    /// The test whether the neighbour still keeps to the plan.
    pub departure: Departure,
    /// Index, among the neighbours of the route, of the planned neighbour that it was before it last left its plan.
    /// `None` if it never left one.
    pub left: Option<u8>,
    /// Number of steps since the neighbour came into sight, at most 255. Always 255 for a standing object.
    pub age: u8,
    /// Whether the track stands for a straight edge. A robot that drives along an edge comes no nearer to it.
    pub is_flat: bool,
}

impl Track {
    /// The track that stands for a standing object. `estimate`: centre of a disc of a robot's size that touches the
    /// object at its nearest point.
    pub fn standing(estimate: &NearestPoint, seen_by: u8, is_flat: bool, scan: &Scan<'_>) -> Self {
        let NearestPoint { at, velocity, covariance } = *estimate;
        let departure = Departure::new(scan.planned_sigma_m);
        Self {
            at,
            velocity,
            covariance,
            planned: None,
            missed: 0,
            seen_by,
            departure,
            left: None,
            age: u8::MAX,
            is_flat,
        }
    }

    /// Its centre, velocity and covariance.
    #[cfg(test)]
    pub fn estimate(&self) -> NearestPoint {
        NearestPoint { at: self.at, velocity: self.velocity, covariance: self.covariance }
    }

    /// Whether it is a neighbour that the plan names, or one that has left its plan.
    pub fn is_known(&self) -> bool {
        self.planned.is_some() || self.left.is_some()
    }

    /// Whether it is a neighbour that has left its plan.
    pub fn strays(&self) -> bool {
        self.left.is_some() && self.planned.is_none()
    }

    /// Whether it is the planned neighbour with this index, even if it has left its plan.
    pub fn stands_for(&self, index: u8) -> bool {
        self.planned == Some(index) || self.left == Some(index)
    }

    /// Whether a sensor saw it in the latest step.
    pub fn is_seen_by(&self, sensor: usize) -> bool {
        self.seen_by >> sensor & 1 == 1
    }

    /// The sensors that saw it in the latest step.
    pub fn sensors(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        let seen_by = self.seen_by;
        (0..SENSORS).filter(move |sensor| seen_by >> sensor & 1 == 1)
    }

    /// Corrects the track by a reading of a sensor. Returns the innovation, metres, and its variance, square metres.
    pub fn take(&mut self, sensor: usize, read_m: f32, sensors: &Sensors) -> (f32, f32) {
        let expected = sensors.expected(sensor, self.at);
        let (off_m, variance) = self.innovation(&expected, read_m, sensors);
        self.correct(expected.towards, off_m, variance);
        (off_m, variance)
    }

    /// Gap between the robot's rim and the neighbour's rim, metres.
    pub fn gap_m(&self, sensors: &Sensors) -> f32 {
        self.at.length() - sensors.contact_m()
    }

    /// Predicts the neighbour's state after a step in which the robot itself moved, too.
    pub fn predict(&mut self, own: &OwnMotion, of: &NeighbourModel) {
        let turn = Point::of_small_angle(-own.turn_rad);
        self.at = own.carry(self.at.plus(self.velocity.times(own.dt)));
        self.velocity = self.velocity.rotated(turn);
        self.departure.predict(own);
        let known = self.planned.is_some();
        let accel_mps2 = if known { of.accel_sigma_mps2 } else { of.unplanned_accel_mps2 };
        self.covariance.predict(own.dt, accel_mps2 * own.dt);
        let odometry_m = of.odometry_share * own.way_m;
        self.covariance.add_place(odometry_m * odometry_m);
        self.covariance.rotate(turn);
    }

    /// Sets the place to `at` (centre of the neighbour, body space, metres) and the velocity to 0. The errors are those
    /// of a neighbour that was found to have stopped. The track then follows no planned neighbour (`planned` is
    /// `None`). The caller sets `left`.
    pub fn stand(&mut self, at: Point, of: &NeighbourModel) {
        let towards = at.times(1.0 / at.length().max(1e-3));
        let [place_m2, velocity_m2ps2] = [of.stop_sigma_m, of.stop_sigma_mps].map(|sigma| sigma * sigma);
        (self.at, self.velocity, self.planned) = (at, Point::ZERO, None);
        self.covariance = Covariance::new(towards, 0.25 * place_m2, place_m2, velocity_m2ps2);
    }

    /// Innovation of the reading `read_m` against the expected reading, metres, and the variance of the innovation,
    /// square metres.
    pub fn innovation(&self, expected: &Expected, read_m: f32, sensors: &Sensors) -> (f32, f32) {
        let across = expected.towards.left();
        // The reading is quadratic in the place across the line of sight: second-order mean and variance.
        let bend_m = 0.5 * self.covariance.place_along(across) / expected.far_m;
        let variance = self.covariance.place_along(expected.towards)
            + sensors.variance_m2(expected.gap_m)
            + 2.0 * bend_m * bend_m;
        (read_m - expected.gap_m - bend_m, variance)
    }

    /// Corrects the track by a measurement whose gradient over the place is `gradient`. `variance`: variance of the
    /// innovation.
    fn correct(&mut self, gradient: Point, innovation: f32, variance: f32) {
        let (place, velocity) = self.covariance.correct(gradient, innovation, variance);
        self.at = self.at.plus(place);
        self.velocity = self.velocity.plus(velocity);
    }

    /// Corrects the coordinate of the place along the unit vector `unit` to that of `at`, by other knowledge than
    /// readings. The error of `at` is `sigma_m` (metres, 1 sigma). The correction only reduces the variance along
    /// `unit` to that of `at`. So repeating it at every step makes the place no more certain.
    pub fn bound_place(&mut self, unit: Point, at: Point, sigma_m: f32) {
        let (known, bound) = (self.covariance.place_along(unit), sigma_m * sigma_m);
        if known > bound {
            let noise = known * bound / (known - bound).max(1e-12);
            self.correct(unit, at.minus(self.at).dot(unit), known + noise);
        }
    }

    /// Corrects the place along a unit vector by a known place `at`. Its error `sigma_m` hardly changes for
    /// [`CORRELATED_STEPS`], so each correction counts only a part.
    pub fn learn_place(&mut self, unit: Point, at: Point, sigma_m: f32) {
        let variance = self.covariance.place_along(unit) + CORRELATED_STEPS * sigma_m * sigma_m;
        self.correct(unit, at.minus(self.at).dot(unit), variance);
    }

    /// Corrects the velocity along a unit vector by a known velocity. Its error `sigma_mps` hardly changes for
    /// [`CORRELATED_STEPS`], so each correction counts only a part.
    pub fn learn_velocity(&mut self, unit: Point, velocity: Point, sigma_mps: f32) {
        let variance = self.covariance.velocity_along(unit) + CORRELATED_STEPS * sigma_mps * sigma_mps;
        let off = velocity.minus(self.velocity).dot(unit);
        let (place, velocity) = self.covariance.correct_velocity(unit, off, variance);
        self.at = self.at.plus(place);
        self.velocity = self.velocity.plus(velocity);
    }

    /// Whether the track agrees with the planned place `at` and the planned `velocity` within [`RECOGNISED_SIGMAS`].
    /// `sigma_m`: error of the planned place, metres, 1 sigma.
    pub fn keeps_to(&self, at: Point, velocity: Point, sigma_m: f32, of: &NeighbourModel) -> bool {
        let agrees = |off: Point, planned_sigma: f32, variance: &dyn Fn(Point) -> f32| {
            let size = off.length().max(1e-6);
            let known = variance(off.times(1.0 / size)).max(0.0);
            size * size < RECOGNISED_SIGMAS * RECOGNISED_SIGMAS * (known + planned_sigma * planned_sigma)
        };
        agrees(self.at.minus(at), sigma_m, &|unit| self.covariance.place_along(unit))
            && agrees(self.velocity.minus(velocity), of.planned_sigma_mps, &|unit| {
                self.covariance.velocity_along(unit)
            })
    }

    /// Moves the place along the unit vector `across` towards the edge of a sensor's cone, because it is on the wrong
    /// side of that edge. `inside_m`: how far it is inside the cone, negative if outside; `gradient`: of `inside_m`
    /// over the place. The place becomes no more certain, because the next steps repeat the same information.
    pub fn stay_within(&mut self, across: Point, gradient: Point, inside_m: f32) {
        let slope = gradient.dot(across);
        let known = self.covariance.place_along(across);
        let share = known / (known + EDGE_SIGMA_M * EDGE_SIGMA_M);
        if slope.abs() > 0.2 {
            self.at = self.at.minus(across.times(share * inside_m / slope));
        }
    }
}
