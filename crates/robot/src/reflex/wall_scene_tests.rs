//! How good the estimates of walls and no-go edges are, and how well their covariances match the errors. That robots
//! are not taken for walls: side_by_side_tests.rs.

extern crate std;

use core::f32::consts::PI;
use std::vec::Vec;

use super::estimator_tests::{Dice, Disc, RADIUS_M, Tally, along, noisy};
use super::motion::OwnMotion;
use super::point::Point;
use super::scan::Scan;
use super::sensors::Sensors;
use super::tracks::Tracks;
use crate::config::{NeighbourModel, ProximitySensors, SENSORS};

/// Half the angle of a sensor's cone, radians.
const HALF_CONE_RAD: f32 = ProximitySensors::ELISA_3.half_cone_rad;
/// Steps of which the errors count in each scene.
const STEPS: usize = 10_000;
/// Share of their way that the wheels lose or gain in an episode, 1 sigma: `NeighbourModel::odometry_share`.
const SLIP: f32 = 0.04;

/// A straight piece of wall in body space, from end to end.
#[derive(Clone, Copy)]
pub(super) struct Wall([Point; 2]);

impl Wall {
    /// The point of the wall that is nearest to a place.
    pub fn nearest(&self, to: Point) -> Point {
        let [from, end] = self.0;
        let span = end.minus(from);
        let share = to.minus(from).dot(span) / span.dot(span);
        from.plus(span.times(share.clamp(0.0, 1.0)))
    }

    /// The point where a ray from a place meets the wall.
    fn hit(&self, from: Point, towards: Point) -> Option<Point> {
        let [start, end] = self.0;
        let (span, normal) = (end.minus(start), towards.left());
        let share = from.minus(start).dot(normal) / span.dot(normal);
        let at = start.plus(span.times(share));
        ((0.0..=1.0).contains(&share) && at.minus(from).dot(towards) > 0.0).then_some(at)
    }

    /// What a sensor reads without noise, metres: the distance to the nearest point within its cone.
    pub fn reads_m(&self, sensor: usize) -> f32 {
        let axis_rad = sensor as f32 * core::f32::consts::FRAC_PI_4;
        let axis = Point::unit(axis_rad);
        let eye = axis.times(RADIUS_M);
        let is_inside = |at: &Point| {
            let ray = at.minus(eye);
            ray.dot(axis) > libm::cosf(HALF_CONE_RAD) * ray.length()
        };
        let edges = [-HALF_CONE_RAD, HALF_CONE_RAD].map(|edge| self.hit(eye, Point::unit(axis_rad + edge)));
        let inside = Some(self.nearest(eye)).filter(is_inside);
        let points = edges.into_iter().chain([inside]).flatten().chain(self.0.into_iter().filter(is_inside));
        points.map(|at| at.minus(eye).length()).filter(|&gap_m| gap_m < 0.03).fold(f32::INFINITY, f32::min)
    }

    /// The wall's nearest point, which slides along the wall as the robot drives, but not off its end.
    fn truth(&self, own: &OwnMotion) -> Disc {
        let at = self.nearest(Point::ZERO);
        let span = self.0[1].minus(self.0[0]);
        let along = span.times(1.0 / span.length());
        let own_mps = along.x * own.way_m / own.dt;
        let is_end = self.0.iter().any(|end| end.minus(at).length() < 1e-6);
        Disc { at, velocity: if is_end { Point::ZERO } else { along.times(own_mps) } }
    }

    /// Carries the wall over a step in which the robot moved by `own`.
    pub fn advance(&mut self, own: &OwnMotion) {
        self.0 = self.0.map(|end| own.carry(end));
    }
}

/// What was measured in a scene.
#[derive(Debug)]
struct Measured {
    /// The figures of `Tally::figures` for the nearest point of the wall.
    figures: [f32; 4],
    /// Gap to the nearest track less gap to the wall, metres: the 5 % and the 95 % quantile.
    gaps_m: [f32; 2],
    /// Share of the steps in which the wall is known to be a straight edge that goes on to both sides.
    flat: f32,
}

/// Runs episodes of at most 25 steps. The steps from the sixth on in which a sensor sees the wall count. The robot's
/// wheels slip by `SLIP`.
fn scene(make: impl Fn(&mut Dice) -> (Wall, OwnMotion)) -> Measured {
    let sensors = Sensors::new(&ProximitySensors::ELISA_3, f64::from(RADIUS_M));
    let (mut dice, mut tally, mut off_m) = (Dice(7), Tally::default(), Vec::new());
    let mut flats = 0;
    while off_m.len() < STEPS {
        let (mut wall, own) = make(&mut dice);
        let told = OwnMotion { way_m: own.way_m * (1.0 + SLIP * dice.normal()), ..own };
        let mut tracks = Tracks::default();
        for step in 0..25 {
            wall.advance(&own);
            let truth = wall.truth(&own);
            let gap_m = truth.at.length() - RADIUS_M;
            if gap_m < 0.0 {
                break;
            }
            let reads_m: [f32; SENSORS] = core::array::from_fn(|sensor| wall.reads_m(sensor));
            look(&mut tracks, &reads_m.map(|gap_m| noisy(gap_m, &mut dice)), &told, &sensors);
            if step >= 5 && reads_m.iter().any(|gap_m| gap_m.is_finite()) {
                let points = tracks.likeliest(&sensors).map(|track| track.estimate().behind(-RADIUS_M));
                tally.add_nearest(points, &truth);
                flats += usize::from(tracks.likeliest(&sensors).any(|track| track.is_flat));
                let nearest_m = tracks
                    .likeliest(&sensors)
                    .map(|track| track.gap_m(&sensors))
                    .fold(f32::INFINITY, f32::min);
                off_m.push(nearest_m - gap_m);
            }
        }
    }
    off_m.sort_by(f32::total_cmp);
    let gaps_m = [0.05, 0.95].map(|share| off_m[(share * off_m.len() as f32) as usize]);
    Measured { figures: tally.figures(), gaps_m, flat: flats as f32 / off_m.len() as f32 }
}

/// Passes readings to the tracks for a step in which the plan has no neighbour in sight.
pub(super) fn look(tracks: &mut Tracks, gaps_m: &[f32; SENSORS], own: &OwnMotion, sensors: &Sensors) {
    let of = &NeighbourModel::DEFAULT;
    tracks.step(&Scan { gaps_m, own, planned: &[], sensors, planned_sigma_m: 0.0009, of });
}

/// A piece of wall in the direction `towards_rad`, whose line is `gap_m` off the robot's rim. Along that line it goes
/// from `from_m` to 1 m to the left, metres.
pub(super) fn wall_at(towards_rad: f32, gap_m: f32, from_m: f32) -> Wall {
    let towards = Point::unit(towards_rad);
    let foot = towards.times(RADIUS_M + gap_m);
    Wall([from_m, 1.0].map(|along_m| foot.plus(towards.left().times(along_m))))
}

/// A piece of wall in any direction, 10 to 30 mm off the rim, that begins at `from_m` along its line.
fn wall_from(from_m: f32, dice: &mut Dice) -> Wall {
    wall_at(dice.between(-PI, PI), dice.between(0.01, 0.03), from_m)
}

/// Checks that the median errors of the wall's nearest point are at most 2 mm and 20 mm/s. The 95 % ellipse must hold
/// 92 to 98 % of the errors. In 90 % of the steps the gap is wrong by -2.5 to 1.5 mm.
#[track_caller]
fn expect(measured: &Measured) {
    let [place_m, speed_mps, held, followed] = measured.figures;
    assert!(place_m <= 0.002 && speed_mps <= 0.020, "{measured:?}");
    assert!((0.92..=0.98).contains(&held) && followed > 0.97, "{measured:?}");
    assert!(measured.gaps_m[0] >= -0.0025 && measured.gaps_m[1] <= 0.0015, "{measured:?}");
}

#[test]
fn a_wall() {
    let measured = scene(|dice| (wall_from(-1.0, dice), along(dice)));
    expect(&measured);
    assert!(measured.flat > 0.65, "{measured:?}");
}

#[test]
fn the_end_of_a_no_go_edge() {
    expect(&scene(|dice| (wall_from(dice.between(-0.04, 0.04), dice), along(dice))));
}
