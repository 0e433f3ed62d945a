//! How good the estimates of planned neighbours are, and how well their covariances match the errors: three scenes, ten
//! thousand steps each.

extern crate std;

use std::vec;
use std::vec::Vec;

use super::estimator_tests::{DT, Dice, Disc, RADIUS_M, Tally, along, any, expect, polar, readings, reads_m};
use super::motion::OwnMotion;
use super::point::Point;
use super::scan::{Expectation, Scan};
use super::sensors::Sensors;
use super::tracks::Tracks;
use crate::config::{NeighbourModel, ProximitySensors, SENSORS};

/// How far a neighbour is off its plan as this robot sees it, 1 sigma in each axis, metres. Measured in rehearsals with
/// standard conditions on 2026-11-24.
const OFFSET_M: f32 = 0.00075;
/// Correlation time of the offset, seconds: measured with `OFFSET_M`.
const OFFSET_S: f32 = 0.3;
/// `Scan::planned_sigma_m` in these rehearsals, metres.
const PLANNED_SIGMA_M: f32 = 0.0009;
/// Time in which a neighbour goes by plan from one velocity to another, seconds.
const RAMP_S: f32 = 0.4;
/// Number of steps in each scene whose errors count.
const STEPS: usize = 10_000;

/// A neighbour of the route in body space.
struct Neighbour {
    /// Planned place and velocity.
    plan: Disc,
    acceleration: Point,
    /// How far it is off its plan, a first-order Gauss-Markov process, metres.
    offset: Point,
    /// How fast the offset changed in the latest step, m/s.
    offset_mps: Point,
}

impl Neighbour {
    /// A neighbour that by plan changes its velocity evenly from one random value to another.
    fn new(at: Point, dice: &mut Dice) -> Self {
        let (first, last) = (any(dice), any(dice));
        Self {
            plan: Disc { at, velocity: first },
            acceleration: last.minus(first).times(1.0 / RAMP_S),
            offset: Point::new(dice.normal(), dice.normal()).times(OFFSET_M),
            offset_mps: Point::ZERO,
        }
    }

    /// Its true place, and its velocity in the latest step, the change of its offset included.
    fn truth(&self) -> Disc {
        let Disc { at, velocity } = self.plan;
        Disc { at: at.plus(self.offset), velocity: velocity.plus(self.offset_mps) }
    }

    fn expectation(&self, index: usize) -> Expectation {
        Expectation {
            index: index as u8,
            at: self.plan.at,
            velocity: self.plan.velocity,
            acceleration: self.acceleration,
            clearance_m: 0.01,
        }
    }

    /// Carries the neighbour over a step in which the robot itself moved by `own`.
    fn advance(&mut self, own: &OwnMotion, dice: &mut Dice) {
        let turn = Point::unit(-own.turn_rad);
        let kept = libm::expf(-DT / OFFSET_S);
        let noise = Point::new(dice.normal(), dice.normal()).times(OFFSET_M * libm::sqrtf(1.0 - kept * kept));
        let offset = self.offset.times(kept).plus(noise);
        self.offset_mps = offset.minus(self.offset).times(1.0 / DT).rotated(turn);
        self.offset = offset.rotated(turn);
        let moved = self.plan.velocity.plus(self.acceleration.times(0.5 * DT)).times(DT);
        let way = Point::new(own.way_m, 0.0).rotated(Point::unit(0.5 * own.turn_rad));
        self.plan.at = self.plan.at.plus(moved).minus(way).rotated(turn);
        self.plan.velocity = self.plan.velocity.plus(self.acceleration.times(DT)).rotated(turn);
        self.acceleration = self.acceleration.rotated(turn);
    }
}

/// Whether a sensor would see each of the discs if there were no others.
fn all_in_cone(sensor: usize, discs: &[Disc]) -> bool {
    discs.iter().all(|disc| reads_m(core::slice::from_ref(disc), sensor).is_finite())
}

/// Whether two of the discs touch each other, or one touches the robot.
fn touch(discs: &[Disc]) -> bool {
    let near = |at: Point| at.length() < 2.0 * RADIUS_M;
    discs.iter().enumerate().any(|(index, disc)| {
        near(disc.at) || discs[index + 1..].iter().any(|other| near(other.at.minus(disc.at)))
    })
}

/// Passes a step to the tracks: readings of the neighbours at their true places, and the plan, from which they are off.
fn look(tracks: &mut Tracks, neighbours: &[Neighbour], own: &OwnMotion, sensors: &Sensors, dice: &mut Dice) {
    let discs: Vec<Disc> = neighbours.iter().map(Neighbour::truth).collect();
    let planned: Vec<Expectation> =
        neighbours.iter().enumerate().map(|(index, one)| one.expectation(index)).collect();
    tracks.step(&Scan {
        gaps_m: &readings(&discs, dice),
        own,
        planned: &planned,
        sensors,
        planned_sigma_m: PLANNED_SIGMA_M,
        of: &NeighbourModel::DEFAULT,
    });
}

/// Runs episodes of at most `episode` steps, until something touches. The steps from `warm` on count in which at least
/// `cones` sensors have all neighbours in their cones.
fn scene(
    (warm, episode): (usize, usize),
    cones: usize,
    make: impl Fn(&mut Dice) -> (Vec<Neighbour>, OwnMotion),
) -> [f32; 4] {
    let sensors = Sensors::new(&ProximitySensors::ELISA_3, f64::from(RADIUS_M));
    let (mut dice, mut tally, mut steps) = (Dice(7), Tally::default(), 0);
    while steps < STEPS {
        let (mut neighbours, own) = make(&mut dice);
        let mut tracks = Tracks::default();
        for step in 0..episode {
            neighbours.iter_mut().for_each(|neighbour| neighbour.advance(&own, &mut dice));
            let discs: Vec<Disc> = neighbours.iter().map(Neighbour::truth).collect();
            if touch(&discs) {
                break;
            }
            look(&mut tracks, &neighbours, &own, &sensors, &mut dice);
            let is_in_scene = (0..SENSORS).filter(|&sensor| all_in_cone(sensor, &discs)).count() >= cones;
            if step >= warm && is_in_scene {
                discs.iter().for_each(|disc| tally.add_nearest_track(&tracks, disc));
                steps += 1;
            }
        }
    }
    tally.figures()
}

/// Largest median errors allowed: of place, metres, and of velocity, m/s. No estimate is better: an offset that changes
/// by 15 mm/s in each axis from step to step has a median speed of 18 mm/s.
const MEDIANS: [f32; 2] = [0.002, 0.020];

#[test]
fn two_planned_neighbours_in_one_cone() {
    let figures = scene((5, 25), 1, |dice| {
        let axis_deg = 45.0 * libm::floorf(8.0 * dice.uniform());
        let sides = [-1.0, 1.0].map(|side| {
            let at = polar(axis_deg + side * dice.between(24.0, 28.0), dice.between(0.01, 0.025));
            Neighbour::new(at, dice)
        });
        (Vec::from(sides), along(dice))
    });
    expect(figures, MEDIANS[0], MEDIANS[1]);
}

#[test]
fn a_planned_neighbour_across_two_cones() {
    let figures = scene((5, 20), 2, |dice| {
        let at = polar(dice.between(15.0, 30.0), dice.between(0.01, 0.02));
        (vec![Neighbour::new(at, dice)], along(dice))
    });
    expect(figures, MEDIANS[0], MEDIANS[1]);
}

#[test]
fn a_planned_neighbour_that_appears_at_10_mm() {
    let figures = scene((0, 10), 1, |dice| {
        let at = polar(dice.between(-180.0, 180.0), 0.010);
        (vec![Neighbour::new(at, dice)], along(dice))
    });
    expect(figures, MEDIANS[0], MEDIANS[1]);
}
