//! Proximity sensors: eight around each robot's rim, which measure the gaps to the robots near them.

use lightbots_base::Vec2;

use crate::contacts::ContactState;
use crate::dice::{Dice, Purpose};

/// Largest gap that a sensor reads, metres, measured from the sensor's place on the rim. Sensors of the Elisa-3 read up
/// to 60 mm, with less and less certainty.
const RANGE_M: f64 = 0.03;
/// Constant part of a reading's noise, metres, 1 sigma. Together with [`NOISE_SHARE`] it fits the Elisa-3 in Webots
/// R2023b, measured on 2026-11-21. The measured noise is 0.5 mm at a gap of 5 mm, and 0.8 mm at 10 mm.
const NOISE_M: f64 = 0.0003;
/// Part of a reading's noise that grows with the gap, as a share of the gap, 1 sigma.
const NOISE_SHARE: f64 = 0.05;
/// Cosine of half the angle of a sensor's cone: half the angle is 50°.
const CONE_COS: f64 = 0.642_787_609_686_539_3;
/// Tangent of 22.5°, half the angle between two sensors.
const TAN_22_5: f64 = 0.414_213_562_373_095_03;
/// Sine and cosine of 45°.
const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;
/// Directions of the sensors in body space, counter-clockwise from the front.
const SENSORS: [Vec2; 8] = [
    Vec2::new(1.0, 0.0),
    Vec2::new(HALF, HALF),
    Vec2::new(0.0, 1.0),
    Vec2::new(-HALF, HALF),
    Vec2::new(-1.0, 0.0),
    Vec2::new(-HALF, -HALF),
    Vec2::new(0.0, -1.0),
    Vec2::new(HALF, -HALF),
];
/// Readings of a robot with nothing in range.
const NOTHING: [f32; 8] = [f32::INFINITY; 8];

/// The readings of all robots' sensors.
#[derive(Clone, Debug)]
pub(crate) struct ProximityReadings {
    radius_m: f64,
    /// `[robot][sensor]`: gap, metres; infinite if nothing is in range.
    gaps_m: Vec<[f32; 8]>,
    /// Robots that have a reading in range.
    seeing: Vec<u32>,
    dice: Dice,
}

impl ProximityReadings {
    /// The sensors of a number of robots with this radius, metres.
    pub fn new(robots: usize, radius_m: f64, seed: u64) -> Self {
        let dice = Dice::new(seed, Purpose::Proximity);
        Self { radius_m, gaps_m: vec![NOTHING; robots], seeing: Vec::new(), dice }
    }

    /// Distance of two centres from which on two robots are out of range of each other's sensors, metres.
    pub fn sight_m(radius_m: f64) -> f64 {
        2.0 * radius_m + RANGE_M
    }

    /// Readings of a robot's eight sensors, counter-clockwise from the front, metres.
    #[inline]
    pub fn gaps_m(&self, robot: usize) -> [f32; 8] {
        self.gaps_m[robot]
    }

    /// Takes new readings. `near`: the pairs within [`Self::sight_m`].
    pub fn sample(&mut self, near: &[(u32, u32)], places: &[Vec2], contact_states: &[ContactState]) {
        for robot in self.seeing.drain(..) {
            self.gaps_m[robot as usize] = NOTHING;
        }
        for &(a, b) in near {
            let way = places[b as usize] - places[a as usize];
            // Each sensor has noise of its own.
            let [first, second, third, fourth] = self.dice.normal4();
            self.see(a, contact_states[a as usize].forward, way, [first, second]);
            self.see(b, contact_states[b as usize].forward, -way, [third, fourth]);
        }
    }

    /// Takes the readings that a robot with front `forward` has of one other robot. `way`: vector from the robot's
    /// centre to the other's, stage metres. `noise`: noise of the two sensors that may detect it, in sigma.
    #[inline]
    fn see(&mut self, robot: u32, forward: Vec2, way: Vec2, noise: [f64; 2]) {
        let other_in_body = Vec2::new(forward.dot(way), forward.cross(way));
        let nearest = nearest_sensor(other_in_body);
        let left = SENSORS[nearest].cross(other_in_body) > 0.0;
        let beside = if left { nearest + 1 } else { nearest + 7 } % 8;
        let gaps_m = &mut self.gaps_m[robot as usize];
        for (sensor, noise) in [nearest, beside].into_iter().zip(noise) {
            let ray = other_in_body - SENSORS[sensor] * self.radius_m;
            let far = ray.length();
            let gap = far - self.radius_m;
            if gap < RANGE_M && ray.dot(SENSORS[sensor]) > CONE_COS * far {
                let read = (gap + noise * (NOISE_M + NOISE_SHARE * gap.abs())) as f32;
                gaps_m[sensor] = gaps_m[sensor].min(read.max(0.0));
            }
        }
        if gaps_m[nearest] < f32::INFINITY && self.seeing.last() != Some(&robot) {
            self.seeing.push(robot);
        }
    }
}

/// Index in [`SENSORS`] of the sensor whose axis is nearest to a direction in body space.
#[inline]
fn nearest_sensor(towards: Vec2) -> usize {
    let (x, y) = (towards.x.abs(), towards.y.abs());
    let (ahead, left) = (towards.x > 0.0, towards.y > 0.0);
    if y < TAN_22_5 * x {
        return if ahead { 0 } else { 4 };
    }
    if x < TAN_22_5 * y {
        return if left { 2 } else { 6 };
    }
    match (ahead, left) {
        (true, true) => 1,
        (false, true) => 3,
        (false, false) => 5,
        (true, false) => 7,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_sensor_is_the_nearest() {
        for degrees in 0..360 {
            let angle = f64::from(degrees).to_radians() + 1e-9;
            let expected = (f64::from(degrees) / 45.0).round() as usize % 8;
            assert!(degrees % 45 == 22 || nearest_sensor(Vec2::unit(angle)) == expected, "{degrees}");
        }
    }

    #[test]
    fn both_see_each_other_and_nothing_when_they_have_parted() {
        let mut proximity = ProximityReadings::new(2, 0.027, 1);
        let contact_states = [ContactState::new(Vec2::new(1.0, 0.0)), ContactState::new(Vec2::new(0.0, 1.0))];
        let places = [Vec2::ZERO, Vec2::new(0.064, 0.0)];
        proximity.sample(&[(0, 1)], &places, &contact_states);
        let (front, left) = (proximity.gaps_m(0)[0], proximity.gaps_m(1)[2]);
        assert!((front - 0.01).abs() < 0.004 && (left - 0.01).abs() < 0.004);
        assert_eq!(proximity.gaps_m(0).iter().filter(|gap| gap.is_finite()).count(), 1);
        proximity.sample(&[], &places, &contact_states);
        assert_eq!((proximity.gaps_m(0), proximity.gaps_m(1)), (NOTHING, NOTHING));
    }

    #[test]
    fn between_two_sensors_both_see_a_little_farther_each_with_noise_of_its_own() {
        let mut proximity = ProximityReadings::new(2, 0.027, 1);
        let contact_states = [
            ContactState::new(Vec2::unit(core::f64::consts::FRAC_PI_8)),
            ContactState::new(Vec2::new(1.0, 0.0)),
        ];
        let mut looks = (0..1000).map(|_| {
            proximity.sample(&[(0, 1)], &[Vec2::ZERO, Vec2::new(0.06, 0.0)], &contact_states);
            let [ahead, .., right] = proximity.gaps_m(0);
            [ahead, right]
        });
        let [ahead, right] = looks.next().unwrap();
        assert!(ahead != right && (0.006..0.013).contains(&ahead), "{ahead} {right}");
        let looks: Vec<[f32; 2]> = looks.collect();
        let mean_m = |of: &dyn Fn(&[f32; 2]) -> f32| looks.iter().map(of).sum::<f32>() / looks.len() as f32;
        let means_m = [mean_m(&|look| look[0]), mean_m(&|look| look[1])];
        assert!(
            (means_m[0] - means_m[1]).abs() < 1e-4 && (0.0094..0.0097).contains(&means_m[0]),
            "{means_m:?}"
        );
        let product = mean_m(&|look| (look[0] - means_m[0]) * (look[1] - means_m[1]));
        assert!(
            product.abs() < 0.1 * 0.0007 * 0.0007,
            "the noise of one goes with that of the other: {product}"
        );
    }
}
