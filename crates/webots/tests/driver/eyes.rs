//! Readings of proximity sensors in Webots, whose rays end at bounding objects. The PROTO LightBot has ten sensors with
//! one ray each.
//!
//! Source: the reference manual of R2025a, `DistanceSensor`. A sensor of type "generic" measures the distance to the
//! first hit.

use Controller::proximity::{RAYS, TABLE, sigma_m};
use lightbots_base::{Pose, Vec2};
use std::f64::consts::TAU;

/// Distance from the robot's centre to a sensor, metres.
const SENSOR_M: f64 = 0.024;
/// Distance from a robot's centre to its rim, metres.
const RADIUS_M: f64 = 0.027;

/// Simulates the sensors of all robots.
pub struct Eyes {
    /// State of the random generator for the noise.
    dice: u64,
}

impl Eyes {
    /// Sensors whose noise has this seed.
    pub fn new(seed: u64) -> Self {
        Self { dice: seed.wrapping_mul(2).wrapping_add(1) }
    }

    /// Noisy readings of the robot's sensors, clockwise from the front, metres. Infinite if a ray hits no other robot
    /// within its range. `places`: centres of all robots, this one included.
    pub fn near_m(&mut self, robot: Pose, places: &[Vec2]) -> [f64; RAYS] {
        let reach_m = TABLE[TABLE.len() - 1][0];
        let sight_m = SENSOR_M + reach_m + RADIUS_M;
        let others: Vec<Vec2> =
            places.iter().copied().filter(|at| *at != robot.at && at.distance(robot.at) < sight_m).collect();
        if others.is_empty() {
            return [f64::INFINITY; RAYS];
        }
        std::array::from_fn(|sensor| {
            let ray = Vec2::unit(robot.heading - sensor as f64 * TAU / RAYS as f64);
            let from = robot.at + ray * SENSOR_M;
            let hits = others.iter().filter_map(|other| hit_m(ray, *other - from));
            let seen_m = hits.fold(f64::INFINITY, f64::min);
            if seen_m < reach_m { seen_m + self.normal() * sigma_m(seen_m) } else { f64::INFINITY }
        })
    }

    /// A random number of about normal distribution, as the sum of twelve uniform ones.
    fn normal(&mut self) -> f64 {
        let even = (0..12).map(|_| {
            self.dice ^= self.dice << 13;
            self.dice ^= self.dice >> 7;
            self.dice ^= self.dice << 17;
            (self.dice >> 11) as f64 / (1_u64 << 53) as f64
        });
        even.sum::<f64>() - 6.0
    }
}

/// Distance along a unit ray from the origin to a disc around `centre`, metres. `None` if the ray misses the disc.
fn hit_m(ray: Vec2, centre: Vec2) -> Option<f64> {
    let (ahead_m, aside_m) = (ray.dot(centre), ray.cross(centre));
    let meets = ahead_m > 0.0 && aside_m.abs() < RADIUS_M;
    meets.then(|| (ahead_m - (RADIUS_M * RADIUS_M - aside_m * aside_m).sqrt()).max(0.0))
}
