//! The robot brakes for a neighbour that the plan names if that neighbour surely is nearer than planned.

use super::Point;
use super::covariance::Covariance;
use super::departure::Departure;
use super::policy::{Wish, allowed_mps};
use super::sensors::Sensors;
use super::track::Track;
use crate::config::{ProximitySensors, SafetyPolicy};

/// The speed allowed for a robot at 0.24 m/s that meets another one, m/s; `None` if it is not limited. The other robot
/// comes the other way and will pass 55 mm away from centre to centre. Its place is known to `sigma_m` metres.
/// `clearance_m`: the clearance that the plan leaves between the two, metres; `None` if the plan does not know the
/// other robot.
fn allowed(sigma_m: f32, clearance_m: Option<f32>) -> Option<f32> {
    let of = SafetyPolicy::DEFAULT;
    let covariance = Covariance::new(Point::new(1.0, 0.0), sigma_m * sigma_m, sigma_m * sigma_m, 1e-6);
    let track = Track {
        at: Point::new(0.02, 0.0552),
        velocity: Point::new(-0.24, 0.0),
        covariance,
        planned: clearance_m.map(|_| 0),
        missed: 0,
        seen_by: 1,
        departure: Departure::new(0.001),
        left: None,
        age: 4,
        is_flat: false,
    };
    let wish = Wish { speed_mps: 0.24, told_mps: 0.24, dt: 0.016 };
    allowed_mps(&track, &wish, clearance_m, &Sensors::new(&ProximitySensors::ELISA_3, 0.027), &of)
}

#[test]
fn a_planned_neighbour_is_believed_to_keep_to_its_plan_until_it_is_nearer_for_sure() {
    assert_eq!(allowed(0.003, Some(0.008)), None);
    assert!(allowed(0.0005, Some(0.008)).is_some_and(|mps| mps < 0.2), "{:?}", allowed(0.0005, Some(0.008)));
    // The robot brakes for a stranger sooner, because it knows less about it.
    assert!(allowed(0.003, None).is_some_and(|mps| mps < 0.2), "{:?}", allowed(0.003, None));
}
