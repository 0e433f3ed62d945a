//! The inputs of one step: readings, the robot's own motion, and the neighbours that the plan expects in sight.

use super::motion::OwnMotion;
use super::point::Point;
use super::sensors::Sensors;
use crate::config::{NeighbourModel, SENSORS};

/// A neighbour that the plan expects in sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expectation {
    /// Its index among the neighbours of the route.
    pub index: u8,
    /// Its planned centre, body space, metres.
    pub at: Point,
    /// Planned velocity over the floor along the axes of body space, m/s.
    pub velocity: Point,
    /// Planned acceleration over the floor along the axes of body space, m/s².
    pub acceleration: Point,
    /// Least planned clearance between this neighbour and the robot, metres.
    pub clearance_m: f32,
}

/// The readings of a step, and the data with which they are compared.
#[derive(Clone, Copy)]
pub(crate) struct Scan<'a> {
    /// Gap that each sensor reads, metres. A value at or above the sensors' range means that the sensor sees nothing.
    pub gaps_m: &'a [f32; SENSORS],
    pub own: &'a OwnMotion,
    pub planned: &'a [Expectation],
    pub sensors: &'a Sensors,
    /// Deviation of neighbours from their planned places in body space, 1 sigma in each axis, metres. It includes the
    /// place errors of both robots.
    pub planned_sigma_m: f32,
    pub of: &'a NeighbourModel,
}

impl Scan<'_> {
    /// Gap that a sensor reads, metres; `None` if it sees nothing.
    pub fn reads_m(&self, sensor: usize) -> Option<f32> {
        Some(self.gaps_m[sensor]).filter(|&gap_m| gap_m < self.sensors.range_m)
    }

    /// The planned motion of the neighbour with this index; `None` if the plan does not expect it in sight.
    pub fn plan_of(&self, index: Option<u8>) -> Option<&Expectation> {
        self.planned.iter().find(|one| index == Some(one.index))
    }
}
