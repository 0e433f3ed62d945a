//! A neighbour that has left its plan is in one place only.

use super::birth::expected_there;
use super::motion::OwnMotion;
use super::scan::{Expectation, Scan};
use super::sensors::Sensors;
use super::{Point, Track};
use crate::config::{NeighbourModel, ProximitySensors, SENSORS};

/// Number of the planned neighbour.
const NUMBER: u8 = 7;

#[test]
fn where_the_plan_has_a_neighbour_that_left_it_there_is_no_robot() {
    let sensors = Sensors::new(&ProximitySensors::ELISA_3, 0.027);
    // The neighbour stopped ahead to the left. By plan it is abeam by now, where a sensor sees another robot.
    let (stopped, due) = (Point::new(0.05, 0.04), Point::new(0.0, 0.075));
    let mut gaps_m = [f32::INFINITY; SENSORS];
    gaps_m[2] = sensors.expected(2, due).gap_m;
    let planned = [Expectation {
        index: NUMBER,
        at: due,
        velocity: Point::new(-0.2, 0.0),
        acceleration: Point::ZERO,
        clearance_m: 0.012,
    }];
    let own = OwnMotion { way_m: 0.0, turn_rad: 0.0, dt: 0.016 };
    let scan = Scan {
        gaps_m: &gaps_m,
        own: &own,
        planned: &planned,
        sensors: &sensors,
        planned_sigma_m: 0.001,
        of: &NeighbourModel::DEFAULT,
    };
    let known = expected_there(2, &[], &scan).expect("the plan explains what the sensor sees");
    let stray = Track { at: stopped, planned: None, left: Some(NUMBER), ..known.clone() };
    assert!(stray.strays() && stray.stands_for(NUMBER));
    assert!(expected_there(2, core::slice::from_ref(&stray), &scan).is_none());
    let other = Track { left: None, ..stray };
    assert!(!other.strays() && expected_there(2, &[other], &scan).is_some());
}
