//! What proximity sensors see in Webots, whose rays end at bounding objects: those of the PROTO LightBot, eight sonars
//! with three rays each in the plane.
//!
//! Source: the reference manual of R2025a, `DistanceSensor`: a sonar tells the nearest of its rays, and a ray that
//! meets something at more than π/8 does not come back.

use Controller::proximity::{TABLE, sigma_m};
use lightbots_base::{Pose, Vec2};
use std::f64::consts::{FRAC_PI_4, FRAC_PI_8};

/// From the centre to a sensor, and to the rim, metres.
const SENSOR_M: f64 = 0.024;
const RADIUS_M: f64 = 0.027;
/// The rays of a sensor, from its direction.
const RAYS: [f64; 3] = [-FRAC_PI_8, 0.0, FRAC_PI_8];

/// The eyes of all robots.
pub struct Eyes {
    /// State of the noise's generator.
    dice: u64,
}

impl Eyes {
    /// Eyes with this noise.
    pub fn new(seed: u64) -> Self {
        Self { dice: seed.wrapping_mul(2).wrapping_add(1) }
    }

    /// What a robot's sensors see, clockwise from the front, metres; infinite: nothing.
    pub fn near_m(&mut self, robot: Pose, places: &[Vec2]) -> [f64; 8] {
        let reach_m = TABLE[TABLE.len() - 1][0];
        let sight_m = SENSOR_M + reach_m + RADIUS_M;
        let others: Vec<Vec2> =
            places.iter().copied().filter(|at| *at != robot.at && at.distance(robot.at) < sight_m).collect();
        if others.is_empty() {
            return [f64::INFINITY; 8];
        }
        std::array::from_fn(|sensor| {
            let looks = robot.heading - sensor as f64 * FRAC_PI_4;
            let from = robot.at + Vec2::unit(looks) * SENSOR_M;
            let rays = RAYS.iter().map(|aside| Vec2::unit(looks + aside));
            let hits = rays.flat_map(|ray| others.iter().filter_map(move |other| hit_m(ray, *other - from)));
            let seen_m = hits.fold(f64::INFINITY, f64::min);
            if seen_m < reach_m { seen_m + self.normal() * sigma_m(seen_m) } else { f64::INFINITY }
        })
    }

    /// About normal: a sum of twelve even numbers.
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

/// How far along a ray of length 1 a disc around `centre` begins; `None` where it misses it or meets it too obliquely.
fn hit_m(ray: Vec2, centre: Vec2) -> Option<f64> {
    let aside = ray.cross(centre) / RADIUS_M;
    let ahead_m = ray.dot(centre);
    let counts = ahead_m > 0.0 && aside.abs() < FRAC_PI_8.sin();
    counts.then(|| (ahead_m - RADIUS_M * (1.0 - aside * aside).sqrt()).max(0.0))
}

#[test]
fn from_wherever_it_comes_a_robot_is_seen_before_it_touches() {
    for degrees in 0..360 {
        for gap_mm in 0..=20 {
            let gap_m = f64::from(gap_mm) * 1e-3;
            let robot = Pose::new(Vec2::ZERO, 0.3);
            let other = Vec2::unit(f64::from(degrees).to_radians()) * (2.0 * RADIUS_M + gap_m);
            let seen = Eyes::new(1).near_m(robot, &[robot.at, other]);
            let nearest_m = seen.into_iter().fold(f64::INFINITY, f64::min) + SENSOR_M - RADIUS_M;
            // Between two sensors it is a little farther from either than from the rim.
            assert!((gap_m - 0.003..gap_m + 0.008).contains(&nearest_m), "{degrees}° {gap_m}: {nearest_m}");
        }
    }
}
