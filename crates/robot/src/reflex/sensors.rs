//! The proximity sensors, and what they would read for a disc at a given place.

use super::point::Point;
use crate::config::{ProximitySensors, SENSORS};

/// A neighbour may be the object that a sensor sees if its estimated centre is at most this far outside the sensor's
/// cone, metres. The centre is uncertain.
pub(super) const BESIDE_M: f32 = 0.012;

/// The proximity sensors of the robot, in the form that the formulas need.
#[derive(Clone, Debug)]
pub(crate) struct Sensors {
    /// Unit vectors of the directions in which they look, body space.
    pub axes: [Point; SENSORS],
    /// Unit vector at half the opening angle of a cone: x is the cosine, y the sine.
    pub cone: Point,
    /// Largest gap that counts as a reading, metres.
    pub range_m: f32,
    noise_m: f32,
    noise_share: f32,
    /// Natural logarithm of the density of a reading of a new object, which may be at any distance within the range.
    pub new_log: f32,
    /// Radius of the robot, and of each disc in sight, metres.
    pub radius_m: f32,
}

/// What a sensor would read for a disc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expected {
    /// The reading: distance from the sensor to the rim of the disc, metres.
    pub gap_m: f32,
    /// Distance from the sensor to the centre of the disc, metres.
    pub far_m: f32,
    /// Unit vector from the sensor to the disc's centre. It is also the gradient of the reading over the disc's place.
    pub towards: Point,
    /// Measure of how far the disc's centre is inside the sensor's cone, metres; negative if it is outside. It is the
    /// centre's distance along the axis, minus that of a place on the cone's edge equally far from the sensor.
    pub inside_m: f32,
}

impl Sensors {
    pub fn new(of: &ProximitySensors, radius_m: f64) -> Self {
        Self {
            axes: of.bearings_rad.map(Point::unit),
            cone: Point::unit(of.half_cone_rad),
            range_m: of.range_m,
            noise_m: of.noise_m,
            noise_share: of.noise_share,
            new_log: -libm::logf(of.range_m),
            radius_m: radius_m as f32,
        }
    }

    /// Distance between the centres of two robots that touch, metres.
    pub fn contact_m(&self) -> f32 {
        2.0 * self.radius_m
    }

    /// What a sensor would read for a disc centred at `at`, body space.
    pub fn expected(&self, sensor: usize, at: Point) -> Expected {
        let axis = self.axes[sensor];
        let ray = at.minus(axis.times(self.radius_m));
        let far_m = ray.length().max(1e-3);
        let towards = ray.times(1.0 / far_m);
        let inside_m = ray.dot(axis) - self.cone.x * far_m;
        Expected { gap_m: far_m - self.radius_m, far_m, towards, inside_m }
    }

    /// Gradient of [`Expected::inside_m`] over the disc's place.
    pub fn inside_gradient(&self, sensor: usize, expected: &Expected) -> Point {
        self.axes[sensor].minus(expected.towards.times(self.cone.x))
    }

    /// Variance of a reading of this gap, square metres.
    pub fn variance_m2(&self, gap_m: f32) -> f32 {
        let sigma_m = self.noise_m + self.noise_share * gap_m.abs();
        sigma_m * sigma_m
    }
}
