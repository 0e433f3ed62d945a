//! The inputs of one step: readings, own motion, and the neighbours that the plan has in sight.

use super::motion::OwnMotion;
use super::point::Point;
use super::sensors::Sensors;
use crate::config::{NeighbourModel, SENSORS};

/// A neighbour that the plan expects in sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expectation {
    /// Its number among the neighbours of the route.
    pub index: u8,
    /// Its centre, body space, metres.
    pub at: Point,
    /// Planned velocity over the floor along the axes of body space, m/s.
    pub velocity: Point,
    /// Its planned acceleration, m/s².
    pub acceleration: Point,
    /// Least distance from rim to rim that the plan leaves the two, metres.
    pub clearance_m: f32,
}

/// The readings of a step and all that they are compared with.
#[derive(Clone, Copy)]
pub(crate) struct Scan<'a> {
    /// Gap that each sensor reads, metres. A value not below the sensors' range means that the sensor sees nothing.
    pub gaps_m: &'a [f32; SENSORS],
    pub own: &'a OwnMotion,
    pub planned: &'a [Expectation],
    pub sensors: &'a Sensors,
    /// How far neighbours are off their plan as this robot sees it, 1 sigma in each axis, metres.
    pub planned_sigma_m: f32,
    pub of: &'a NeighbourModel,
}

impl Scan<'_> {
    /// Gap that a sensor reads, metres; `None` if it sees nothing.
    pub fn reads_m(&self, sensor: usize) -> Option<f32> {
        Some(self.gaps_m[sensor]).filter(|&gap_m| gap_m < self.sensors.range_m)
    }

    /// The plan for the neighbour with this number; `None` if the plan does not have it in sight.
    pub fn plan_of(&self, index: Option<u8>) -> Option<&Expectation> {
        self.planned.iter().find(|one| index == Some(one.index))
    }
}
