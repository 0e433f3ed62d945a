//! How good the estimates of strangers are, neighbours that the plan does not know, and how well their covariances
//! match the errors. There are three scenes of ten thousand steps each. Planned neighbours: planned_scene_tests.rs;
//! walls: wall_scene_tests.rs.

extern crate std;

use core::f32::consts::PI;
use std::vec;
use std::vec::Vec;

use super::motion::OwnMotion;
use super::outline::NearestPoint;
use super::point::Point;
use super::scan::Scan;
use super::sensors::Sensors;
use super::track::Track;
use super::tracks::Tracks;
use crate::config::{NeighbourModel, ProximitySensors, SENSORS};

/// Duration of a step, seconds.
pub(super) const DT: f32 = 0.016;
/// Radius of a robot, metres.
pub(super) const RADIUS_M: f32 = 0.027;
/// Accelerations of neighbours, 1 sigma in each axis: ramps of robots have 1 m/s².
const RAMP_MPS2: f32 = 0.7;
/// The 95 % quantile of chi-square with four degrees of freedom.
const CHI2_95: f64 = 9.488;

pub(super) struct Dice(pub u64);

impl Dice {
    pub fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    pub fn between(&mut self, least: f32, most: f32) -> f32 {
        least + (most - least) * self.uniform()
    }

    pub fn normal(&mut self) -> f32 {
        let sum: f32 = (0..12).map(|_| self.uniform()).sum();
        sum - 6.0
    }
}

/// A disc in body space.
#[derive(Clone, Copy)]
pub(super) struct Disc {
    pub at: Point,
    pub velocity: Point,
}

/// Gap that a sensor reads without noise, metres: to the nearest rim in its cone.
pub(super) fn reads_m(discs: &[Disc], sensor: usize) -> f32 {
    let axis = Point::unit(sensor as f32 * core::f32::consts::FRAC_PI_4);
    let reads = |disc: &Disc| {
        let ray = disc.at.minus(axis.times(RADIUS_M));
        let far_m = ray.length();
        let gap_m = far_m - RADIUS_M;
        if ray.dot(axis) > 0.642_787_6 * far_m && gap_m < 0.03 { gap_m } else { f32::INFINITY }
    };
    discs.iter().map(reads).fold(f32::INFINITY, f32::min)
}

pub(super) fn readings(discs: &[Disc], dice: &mut Dice) -> [f32; SENSORS] {
    core::array::from_fn(|sensor| noisy(reads_m(discs, sensor), dice))
}

/// A reading with the noise of a sensor, metres.
pub(super) fn noisy(gap_m: f32, dice: &mut Dice) -> f32 {
    let noise = dice.normal() * (0.0003 + 0.05 * gap_m.abs());
    if gap_m.is_finite() { (gap_m + noise).max(0.0) } else { f32::INFINITY }
}

#[derive(Default)]
pub(super) struct Tally {
    places_m: Vec<f32>,
    speeds_mps: Vec<f32>,
    inside: usize,
    lost: usize,
}

impl Tally {
    fn add(&mut self, estimate: Option<&NearestPoint>, disc: &Disc) {
        let Some(track) = estimate else { return self.lost += 1 };
        let (place, velocity) = (track.at.minus(disc.at), track.velocity.minus(disc.velocity));
        self.places_m.push(place.length());
        self.speeds_mps.push(velocity.length());
        self.inside += usize::from(track.covariance.mahalanobis2(place, velocity) < CHI2_95);
    }

    /// Adds the errors of the estimate nearest to a disc.
    pub fn add_nearest(&mut self, estimates: impl Iterator<Item = NearestPoint>, disc: &Disc) {
        let off = |one: &NearestPoint| one.at.minus(disc.at).length();
        let nearest = estimates.min_by(|a, b| off(a).total_cmp(&off(b)));
        self.add(nearest.filter(|one| off(one) < 0.03).as_ref(), disc);
    }

    /// Adds the errors of the track nearest to a disc.
    pub fn add_nearest_track(&mut self, tracks: &Tracks, disc: &Disc) {
        self.add_nearest(tracks.list().iter().map(Track::estimate), disc);
    }

    /// Median errors of place, metres, and velocity, m/s; share of errors within the 95 % ellipse; share of steps in
    /// which the disc was followed.
    pub fn figures(&mut self) -> [f32; 4] {
        let median = |values: &mut Vec<f32>| {
            values.sort_by(f32::total_cmp);
            values[values.len() / 2]
        };
        let count = self.places_m.len();
        let inside = self.inside as f32 / count as f32;
        let followed = count as f32 / (count + self.lost) as f32;
        [median(&mut self.places_m), median(&mut self.speeds_mps), inside, followed]
    }
}

/// Carries discs and robot over a step: discs by their velocity with random accelerations, the robot by `own`.
pub(super) fn advance(discs: &mut [Disc], own: &OwnMotion, accel_mps2: f32, dice: &mut Dice) {
    let turn = Point::unit(-own.turn_rad);
    let half = Point::unit(0.5 * own.turn_rad);
    for disc in discs {
        let way = Point::new(own.way_m, 0.0).rotated(half);
        disc.at = disc.at.plus(disc.velocity.times(DT)).minus(way).rotated(turn);
        let push = Point::new(dice.normal(), dice.normal()).times(accel_mps2 * DT);
        disc.velocity = disc.velocity.plus(push).rotated(turn);
    }
}

fn scene(
    count: usize,
    warm: usize,
    episode: usize,
    make: impl Fn(&mut Dice) -> (Vec<Disc>, OwnMotion),
) -> [f32; 4] {
    let (sensors, of) = (Sensors::new(&ProximitySensors::ELISA_3, 0.027), NeighbourModel::DEFAULT);
    let (mut dice, mut tally, mut steps) = (Dice(7), Tally::default(), 0);
    while steps < 10_000 {
        let (mut discs, own) = make(&mut dice);
        let mut tracks = Tracks::default();
        for step in 0..episode {
            advance(&mut discs, &own, RAMP_MPS2, &mut dice);
            let touch = |a: &Disc, b: Point| a.at.minus(b).length() < 2.0 * RADIUS_M;
            let apart = discs.len() < 2 || !touch(&discs[0], discs[1].at);
            if !apart || discs.iter().any(|disc| touch(disc, Point::ZERO)) {
                break;
            }
            let gaps_m = readings(&discs, &mut dice);
            let in_sight = (0..SENSORS).any(|sensor| reads_m(&discs[..1], sensor) < 0.03);
            let scan = Scan {
                gaps_m: &gaps_m,
                own: &own,
                planned: &[],
                sensors: &sensors,
                planned_sigma_m: 0.001,
                of: &of,
            };
            tracks.step(&scan);
            if step >= warm && in_sight {
                discs[..count].iter().for_each(|disc| tally.add_nearest_track(&tracks, disc));
                steps += 1;
            }
        }
    }
    tally.figures()
}

pub(super) fn along(dice: &mut Dice) -> OwnMotion {
    OwnMotion { way_m: dice.between(0.0, 0.0043), turn_rad: 0.03 * dice.normal(), dt: DT }
}

pub(super) fn any(dice: &mut Dice) -> Point {
    Point::unit(dice.between(-PI, PI)).times(0.27 * libm::sqrtf(dice.uniform()))
}

pub(super) fn polar(degrees: f32, gap_m: f32) -> Point {
    Point::unit(degrees.to_radians()).times(2.0 * RADIUS_M + gap_m)
}

/// Checks that the median errors of place and velocity are at most these. The 95 % ellipse must hold 92 to 98 % of the
/// errors.
///
/// One sensor hardly sees a stranger's bearing: ±19° are 10 mm to either side. The covariance must cover that.
#[track_caller]
pub(super) fn expect(figures: [f32; 4], place_m: f32, speed_mps: f32) {
    let [place, speed, inside, followed] = figures;
    assert!(place <= place_m && speed <= speed_mps, "{figures:?}");
    assert!((0.92..=0.98).contains(&inside) && followed > 0.97, "{figures:?}");
}

#[test]
fn a_stranger_anywhere() {
    let figures = scene(1, 5, 25, |dice| {
        let at = polar(dice.between(-180.0, 180.0), dice.between(0.02, 0.03));
        (vec![Disc { at, velocity: any(dice) }], along(dice))
    });
    expect(figures, 0.005, 0.07);
}

#[test]
fn a_stranger_across_two_cones() {
    let figures = scene(1, 5, 20, |dice| {
        let at = polar(dice.between(15.0, 30.0), dice.between(0.01, 0.02));
        (vec![Disc { at, velocity: any(dice) }], along(dice))
    });
    expect(figures, 0.004, 0.06);
}

#[test]
fn a_stranger_that_appears_at_10_mm() {
    let figures = scene(1, 0, 10, |dice| {
        let at = polar(dice.between(-180.0, 180.0), 0.010);
        (vec![Disc { at, velocity: any(dice) }], along(dice))
    });
    expect(figures, 0.005, 0.12);
}
