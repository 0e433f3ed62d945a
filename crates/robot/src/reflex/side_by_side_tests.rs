//! Robots that the plan does not know are not taken for walls: alone, and two side by side.

extern crate std;

use std::vec;
use std::vec::Vec;

use super::estimator_tests::{Dice, Disc, RADIUS_M, advance, along, any, polar, readings, reads_m};
use super::motion::OwnMotion;
use super::point::Point;
use super::sensors::Sensors;
use super::tracks::Tracks;
use super::wall_scene_tests::look;
use crate::config::{ProximitySensors, SENSORS};

/// Number of steps that count in each scene.
const STEPS: usize = 10_000;

/// What was measured in a scene.
#[derive(Debug)]
struct Measured {
    /// Share of the steps in which something is taken for a wall.
    walls: f32,
    /// Gap to the nearest track less gap to the nearest robot, metres: the 5 % and the 95 % quantile.
    gaps_m: [f32; 2],
}

/// Runs episodes of at most 40 steps. The steps in which a sensor sees a robot count.
fn scene(make: impl Fn(&mut Dice) -> (Vec<Disc>, OwnMotion)) -> Measured {
    let sensors = Sensors::new(&ProximitySensors::ELISA_3, f64::from(RADIUS_M));
    let (mut dice, mut walls, mut off_m) = (Dice(7), 0, Vec::new());
    while off_m.len() < STEPS {
        let (mut discs, own) = make(&mut dice);
        let mut tracks = Tracks::default();
        for _ in 0..40 {
            advance(&mut discs, &own, 0.0, &mut dice);
            let gaps_m = discs.iter().map(|disc| disc.at.length() - 2.0 * RADIUS_M);
            let gap_m = gaps_m.fold(f32::INFINITY, f32::min);
            if gap_m < 0.0 {
                break;
            }
            look(&mut tracks, &readings(&discs, &mut dice), &own, &sensors);
            if (0..SENSORS).any(|sensor| reads_m(&discs, sensor).is_finite()) {
                let nearest_m = tracks.likeliest(&sensors).map(|track| track.gap_m(&sensors));
                off_m.push(nearest_m.fold(f32::INFINITY, f32::min) - gap_m);
                walls += usize::from(tracks.iter(&sensors).any(|track| track.is_flat));
            }
        }
    }
    let count = off_m.len() as f32;
    off_m.sort_by(f32::total_cmp);
    let gaps_m = [0.05, 0.95].map(|share| off_m[(share * count) as usize]);
    Measured { walls: walls as f32 / count, gaps_m }
}

/// A robot 5 to 30 mm away in any direction.
fn beside(velocity: Point, dice: &mut Dice) -> Vec<Disc> {
    vec![Disc { at: polar(dice.between(-180.0, 180.0), dice.between(0.005, 0.03)), velocity }]
}

/// Two robots side by side with 2 to 21 mm between their rims. The line through their centres is 5 to 30 mm farther
/// away than at contact.
fn two(velocity: Point, dice: &mut Dice) -> Vec<Disc> {
    let towards_deg = dice.between(-180.0, 180.0);
    let middle = polar(towards_deg, dice.between(0.005, 0.03));
    let (apart_m, share) = (dice.between(0.056, 0.075), dice.uniform());
    let left = Point::unit(towards_deg.to_radians()).left();
    let discs =
        [share, share - 1.0].map(|share| Disc { at: middle.plus(left.times(share * apart_m)), velocity });
    Vec::from(discs)
}

/// Checks that robots are taken for a wall in at most the share `walls` of the steps. In 90 % of the steps the error of
/// the gap must be within `gaps_m`, metres.
#[track_caller]
fn expect(measured: &Measured, walls: f32, gaps_m: [f32; 2]) {
    assert!(measured.walls <= walls, "{measured:?}");
    assert!(measured.gaps_m[0] >= gaps_m[0] && measured.gaps_m[1] <= gaps_m[1], "{measured:?}");
}

#[test]
fn a_robot_that_stands_is_no_wall() {
    expect(&scene(|dice| (beside(Point::ZERO, dice), along(dice))), 0.002, [-0.003, 0.001]);
}

#[test]
fn a_robot_that_drives_is_no_wall() {
    let measured = scene(|dice| {
        let velocity = any(dice);
        (beside(velocity, dice), along(dice))
    });
    expect(&measured, 0.005, [-0.0045, 0.0015]);
}

/// While only one sensor sees it, a robot that drives parallel looks much as a wall does, because it comes neither
/// nearer nor farther.
#[test]
fn a_robot_that_drives_parallel_is_no_wall() {
    let measured = scene(|dice| {
        let own = OwnMotion { turn_rad: 0.0, ..along(dice) };
        (beside(Point::new(own.way_m / own.dt, 0.0), dice), own)
    });
    expect(&measured, 0.025, [-0.006, 0.0015]);
}

#[test]
fn two_robots_that_stand_side_by_side_are_no_wall() {
    expect(&scene(|dice| (two(Point::ZERO, dice), along(dice))), 0.03, [-0.003, 0.0015]);
}

#[test]
fn two_robots_that_drive_side_by_side_are_no_wall() {
    let measured = scene(|dice| {
        let velocity = any(dice);
        (two(velocity, dice), along(dice))
    });
    expect(&measured, 0.02, [-0.0045, 0.0025]);
}
