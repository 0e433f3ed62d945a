//! Converts distances along rays to the gaps that the sensors of the robot core would measure.
//!
//! A ray measures the distance along its line only. A sensor of the robot core measures the nearest point within a
//! cone. Each obstacle is assumed to be a robot. If two neighbouring rays meet something, the robot is the disc whose
//! rim contains both points that they meet. If a single ray meets something, the robot is a disc straight ahead of that
//! ray, `BESIDE_M` nearer than measured.

use std::f64::consts::{FRAC_PI_4, TAU};

use lightbots_base::{Limits, Vec2};

/// Number of sensors of the robot core, 45° apart (docs/simulator.md).
const SENSORS: usize = 8;
/// Cosine of half the angle of a sensor's cone in the robot core: half the angle is 50° (docs/simulator.md).
const CONE_COS: f64 = 0.642_787_609_686_539_3;
/// Distance by which a robot that only one ray meets is assumed to be nearer than measured, metres. A ray beside the
/// robot's centre reads up to 1.8 mm too far at 10 mm (measured by test `rays`). With a smaller value, robots touch
/// others that stand 9 to 12 mm beside their path. At 3 mm, the estimated position is wrong.
const BESIDE_M: f64 = 0.002;
/// Radius of a robot, metres.
const RADIUS_M: f64 = Limits::ELISA_3.radius_m;

/// Gaps of the robot core's sensors, metres, counter-clockwise from the front; infinite if nothing is in a sensor's
/// cone. `along_m`: distance along each ray from the robot's rim, metres, infinite if the ray meets nothing. The rays
/// leave the robot's centre at equal angles, counter-clockwise from the front.
pub fn gaps_m(along_m: &[f64]) -> [f32; SENSORS] {
    let rays = along_m.len();
    let met = |ray: usize| {
        let (ray, along_m) = (ray % rays, along_m[ray % rays]);
        along_m.is_finite().then(|| Vec2::unit(ray as f64 * TAU / rays as f64) * (RADIUS_M + along_m))
    };
    let mut gaps_m = [f64::INFINITY; SENSORS];
    for ray in 0..rays {
        let Some(here) = met(ray) else { continue };
        let shared = met(ray + 1).and_then(|next| disc_through(here, next));
        let shared_before = met(ray + rays - 1).and_then(|before| disc_through(before, here));
        let alone = || shared_before.is_none().then(|| here * (1.0 + (RADIUS_M - BESIDE_M) / here.length()));
        if let Some(centre) = shared.or_else(alone) {
            see(&mut gaps_m, centre);
        }
    }
    gaps_m.map(|gap_m| gap_m.max(0.0) as f32)
}

/// Centre, in body space, of the robot that has the two points on its rim; `left` is counter-clockwise of `right`.
/// `None` if the points are too far apart for one robot.
fn disc_through(right: Vec2, left: Vec2) -> Option<Vec2> {
    let (middle, half) = ((right + left) * 0.5, (left - right) * 0.5);
    let beyond_m2 = RADIUS_M * RADIUS_M - half.length_squared();
    let away = -half.normalized()?.left();
    (beyond_m2 > 0.0).then(|| middle + away * beyond_m2.sqrt())
}

/// Lowers the gap of each sensor whose cone contains a robot with centre `centre`, if this robot is nearer.
fn see(gaps_m: &mut [f64; SENSORS], centre: Vec2) {
    for (sensor, gap_m) in gaps_m.iter_mut().enumerate() {
        let looks = Vec2::unit(sensor as f64 * FRAC_PI_4);
        let from_sensor = centre - looks * RADIUS_M;
        let far_m = from_sensor.length();
        if from_sensor.dot(looks) > CONE_COS * far_m {
            *gap_m = gap_m.min(far_m - RADIUS_M);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of rays of the PROTO LightBot.
    const RAYS: usize = 10;

    /// Distances along the rays for a robot in this direction (body, degrees) at this gap.
    fn along_m(degrees: f64, gap_m: f64) -> [f64; RAYS] {
        let centre = Vec2::unit(degrees.to_radians()) * (2.0 * RADIUS_M + gap_m);
        std::array::from_fn(|ray| {
            let ray = Vec2::unit(ray as f64 * TAU / RAYS as f64);
            let (ahead_m, aside_m) = (ray.dot(centre), ray.cross(centre));
            let meets = ahead_m > 0.0 && aside_m.abs() < RADIUS_M;
            let chord_m = (RADIUS_M * RADIUS_M - aside_m * aside_m).max(0.0).sqrt();
            if meets { ahead_m - chord_m - RADIUS_M } else { f64::INFINITY }
        })
    }

    /// Gaps of ideal sensors for the same robot.
    fn ideal_m(degrees: f64, gap_m: f64) -> [f32; SENSORS] {
        let mut gaps_m = [f64::INFINITY; SENSORS];
        see(&mut gaps_m, Vec2::unit(degrees.to_radians()) * (2.0 * RADIUS_M + gap_m));
        gaps_m.map(|gap_m| gap_m as f32)
    }

    fn nearest_m(gaps_m: [f32; SENSORS]) -> f64 {
        gaps_m.into_iter().fold(f64::INFINITY, |least, gap| least.min(f64::from(gap)))
    }

    #[test]
    fn a_robot_in_sight_is_seen_wherever_it_is_and_about_as_near_as_it_is() {
        for tenths in 0..3_600 {
            let degrees = f64::from(tenths) * 0.1;
            let least_m = |gap_m: f64| gap_m - BESIDE_M - 1e-6;
            for (gap_m, more_m) in [
                (0.030, 0.0135),
                (0.020, 0.006),
                (0.014, 0.003),
                (0.010, 0.0018),
                (0.005, 0.001),
                (0.001, 0.001),
            ] {
                let seen_m = nearest_m(gaps_m(&along_m(degrees, gap_m)));
                let ideal_m = nearest_m(ideal_m(degrees, gap_m));
                assert!((least_m(gap_m)..ideal_m + more_m).contains(&seen_m), "{degrees}° {gap_m}: {seen_m}");
            }
        }
    }

    #[test]
    fn where_two_rays_meet_it_the_core_is_told_as_by_its_own_sensors() {
        let (found, ideal) = (gaps_m(&along_m(18.0, 0.010)), ideal_m(18.0, 0.010));
        assert!(ideal[0].is_finite() && ideal[1].is_finite() && ideal[2].is_infinite());
        assert!(
            found.iter().zip(ideal).all(|(found, ideal)| *found == ideal || (found - ideal).abs() < 1e-6)
        );
    }

    #[test]
    fn one_straight_ahead_is_nearly_as_far_as_the_ray_says_and_nothing_is_nothing() {
        let gaps = gaps_m(&along_m(180.0, 0.010));
        assert!((gaps[4] - 0.008).abs() < 1e-6 && gaps.iter().filter(|gap| gap.is_finite()).count() == 1);
        assert_eq!(gaps_m(&[f64::INFINITY; RAYS]), [f32::INFINITY; SENSORS]);
        assert_eq!(gaps_m(&[]), [f32::INFINITY; SENSORS]);
    }

    #[test]
    fn two_robots_next_to_each_other_are_no_nearer_than_they_are() {
        let both: Vec<f64> =
            along_m(-26.0, 0.010).iter().zip(along_m(26.0, 0.012)).map(|(a, b)| a.min(b)).collect();
        assert!((0.007..0.013).contains(&nearest_m(gaps_m(&both))));
    }
}
