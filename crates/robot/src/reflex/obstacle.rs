//! A standing object that the plan does not know: is it a straight edge, the end of an edge, or a robot? A Gaussian sum
//! filter decides (Alspach and Sorenson, *Nonlinear Bayesian Estimation Using Gaussian Sum Approximations*, 1972). Each
//! hypothesis is an extended Kalman filter of one outline, weighted by the likelihood of all readings.

use super::covariance::{CommonError, Covariance};
use super::likelihood::{log_density, log_sum};
use super::motion::OwnMotion;
use super::outline::{Form, NearestPoint, Outline};
use super::point::Point;
use super::scan::Scan;
use super::view::View;
use crate::config::{NeighbourModel, SENSORS};

/// Largest number of hypotheses about an object: those of the first reading, and two for ends that come into sight
/// later.
const HYPOTHESES: usize = 24;
/// Largest innovation at which a hypothesis explains a reading, in standard deviations of the innovation.
const EXPLAINS_SIGMAS: f32 = 4.0;
/// A hypothesis is dropped once the natural logarithm of its share in the likelihood of all hypotheses is below this.
const GIVEN_UP_LOG: f32 = -8.0;
/// Error of the direction of an edge that one sensor sees, 1 sigma, radians. Any direction is equally likely up to the
/// one at which the next sensor would be nearer to the edge.
const EDGE_SIGMA_RAD: f32 = 0.22;
/// Directions in which the end of an edge is assumed, radians from the sensor's axis; the sensor's cone is ±0.87.
const END_BEARINGS_RAD: [f32; 3] = [-0.5, 0.0, 0.5];
/// Error of the assumed place of an end across the line of sight, 1 sigma, as a share of the reading.
const END_ACROSS: f32 = 0.24;
/// Assumed angles between the line of sight to an end and the normal of its edge, to either side, radians.
const END_TURNS_RAD: [f32; 3] = [0.15, 0.6, 1.15];
/// Error of [`END_TURNS_RAD`], 1 sigma, radians.
const END_SIGMA_RAD: f32 = 0.25;
/// Directions in which the centre of a standing robot is assumed, radians from the sensor's axis.
const DISC_BEARINGS_RAD: [f32; 3] = [-0.35, 0.0, 0.35];
/// Error of the assumed place of a standing robot across the line of sight, 1 sigma, as a share of the distance from
/// the sensor.
const DISC_ACROSS: f32 = 0.08;
/// An object counts as a straight edge if the natural logarithm of that probability is above this: 95 %.
const FLAT_LOG: f32 = -0.05;
/// Upper bound of an object's log-likelihood ratio, so that an object that was assumed wrongly is dropped soon.
const MOST_LOG_RATIO: f32 = 12.0;

/// The hypothesis that an object has a certain outline.
#[derive(Clone, Debug)]
struct Hypothesis {
    outline: Outline,
    /// Natural logarithm of the share of this hypothesis in the likelihood of all hypotheses.
    log: f32,
}

/// A standing object, such as a wall.
#[derive(Clone, Debug)]
pub(crate) struct StandingObject {
    hypotheses: heapless::Vec<Hypothesis, HYPOTHESES>,
    /// Natural logarithm of the likelihood of its readings as a standing object over that as moving neighbours.
    pub log_ratio: f32,
    /// Whether a standing object explains the readings better than moving neighbours, with hysteresis.
    pub is_likely: bool,
    /// Sensors that saw it in the latest step, one bit each.
    pub seen_by: u8,
    /// Number of steps in a row in which no sensor saw the object.
    pub missed: u8,
}

/// The readings of a step that may belong to standing objects.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Readings<'a> {
    /// Sensors that see no planned neighbour and none that has left its plan, one bit each. Sensors without a reading
    /// are included.
    pub open: u8,
    /// For each sensor, the natural logarithm of the density that its reading has if the sensor sees a moving
    /// neighbour.
    pub logs: &'a [f32; SENSORS],
}

impl StandingObject {
    /// Begins an object with all hypotheses that the first reading of one sensor allows. `read_m`: the reading, metres.
    pub fn begin(sensor: usize, read_m: f32, scan: &Scan<'_>) -> Self {
        let sensors = scan.sensors;
        let (axis, sigma_m) = (sensors.axes[sensor], libm::sqrtf(sensors.variance_m2(read_m)));
        let eye = axis.times(sensors.radius_m);
        let mut hypotheses = heapless::Vec::new();
        let mut add = |outline, log| hypotheses.push(Hypothesis { outline, log }).is_ok();
        let bend = 1.0 - 0.5 * EDGE_SIGMA_RAD * EDGE_SIGMA_RAD;
        add(Outline::edge(read_m + sensors.radius_m * bend, axis, sigma_m, EDGE_SIGMA_RAD), 0.0);
        for bearing in END_BEARINGS_RAD {
            let towards = axis.rotated(Point::unit(bearing));
            let at = eye.plus(towards.times(read_m));
            for turn_rad in END_TURNS_RAD.into_iter().flat_map(|turn_rad| [-turn_rad, turn_rad]) {
                let sigmas_m = (sigma_m, END_ACROSS * read_m);
                add(Outline::end(at, towards, sigmas_m, turn_rad, END_SIGMA_RAD), scan.of.end_log_prior);
            }
        }
        for bearing in DISC_BEARINGS_RAD {
            let towards = axis.rotated(Point::unit(bearing));
            let far_m = read_m + sensors.radius_m;
            let at = eye.plus(towards.times(far_m));
            add(Outline::disc(at, towards, sigma_m, DISC_ACROSS * far_m), scan.of.disc_log_prior);
        }
        Self { hypotheses, log_ratio: 0.0, is_likely: false, seen_by: 1 << sensor, missed: 0 }
    }

    /// Predicts the outlines of all hypotheses after a step in which the robot itself moved.
    pub fn predict(&mut self, own: &OwnMotion, of: &NeighbourModel) {
        self.hypotheses.iter_mut().for_each(|one| one.outline.predict(own, of));
    }

    /// Updates all hypotheses, and the likelihood of the object, by the readings of a step. `but`: a sensor whose
    /// reading was used before, by [`begin`](Self::begin). Unlikely hypotheses are dropped, and similar ones merged.
    pub fn take(&mut self, readings: &Readings<'_>, but: Option<usize>, scan: &Scan<'_>) {
        let explained = self.explained(readings.open, scan);
        self.add_ends(scan);
        self.seen_by = explained;
        let new = but.map_or(explained, |sensor| explained & !(1 << sensor));
        let before = log_sum(self.logs());
        for one in &mut self.hypotheses {
            one.take(new, readings.open & !explained, scan);
        }
        let after = log_sum(self.logs());
        let of_moving: f32 = bits(new).map(|sensor| readings.logs[sensor]).sum();
        let remembered = scan.of.standing_remembered;
        self.log_ratio = (remembered * self.log_ratio + after - before - of_moving).min(MOST_LOG_RATIO);
        self.is_likely = self.log_ratio > if self.is_likely { 0.0 } else { scan.of.standing_log_ratio };
        self.hypotheses.iter_mut().for_each(|one| one.log = remembered * (one.log - after));
        self.hypotheses.retain(|one| one.log > GIVEN_UP_LOG);
        self.merge(scan.of);
        self.missed = if explained == 0 { self.missed.saturating_add(1) } else { 0 };
    }

    /// The sensors in `open` whose readings any hypothesis explains, one bit each.
    fn explained(&self, open: u8, scan: &Scan<'_>) -> u8 {
        let explains = |sensor: &usize| {
            let Some(read_m) = scan.reads_m(*sensor) else { return false };
            self.hypotheses.iter().any(|one| one.explains(*sensor, read_m, scan))
        };
        bits(open).filter(explains).fold(0, |explained, sensor| explained | 1 << sensor)
    }

    fn logs(&self) -> impl Iterator<Item = f32> + Clone {
        self.hypotheses.iter().map(|one| one.log)
    }

    /// Adds hypotheses that the endless edge has an end to the left or to the right. The end is assumed between two
    /// places. One is the outermost place at which a sensor saw the object in the step before. The other is the
    /// outermost place that any sensor could see.
    fn add_ends(&mut self, scan: &Scan<'_>) {
        let Some(endless) = self.hypotheses.iter().find(|one| one.outline.form == Form::Edge) else { return };
        let Hypothesis { outline, log } = endless.clone();
        let left = outline.normal.left();
        for (form, side) in [(Form::EdgeToLeft, 1.0), (Form::EdgeToRight, -1.0)] {
            if self.hypotheses.iter().any(|one| one.outline.form == form) {
                continue;
            }
            let foot_m = |sensor: usize| side * scan.sensors.radius_m * scan.sensors.axes[sensor].dot(left);
            let seen_m = bits(self.seen_by).map(foot_m).fold(f32::INFINITY, f32::min);
            let far_m = (0..SENSORS)
                .filter_map(|sensor| outline.stretch(sensor, scan.sensors))
                .map(|[right_m, left_m]| if side > 0.0 { right_m } else { -left_m })
                .fold(f32::INFINITY, f32::min);
            if seen_m.is_finite() && far_m < seen_m {
                let outline = outline.ending(form, side * far_m, side * seen_m);
                let _ = self.hypotheses.push(Hypothesis { outline, log: log + scan.of.new_end_log_prior });
            }
        }
    }

    /// Merges hypotheses whose outlines have become alike. The outline of the likelier hypothesis is kept, with the
    /// likelihood of both.
    fn merge(&mut self, of: &NeighbourModel) {
        let mut index = 1;
        while index < self.hypotheses.len() {
            let (others, rest) = self.hypotheses.split_at_mut(index);
            let one = &mut rest[0];
            let Some(other) = others.iter_mut().find(|other| other.outline.is_like(&one.outline, of)) else {
                index += 1;
                continue;
            };
            let log = log_sum([other.log, one.log].into_iter());
            if one.log > other.log {
                other.outline = one.outline;
            }
            other.log = log;
            self.hypotheses.swap_remove(index);
        }
    }

    /// Whether the object surely is a straight edge that extends to both sides of its nearest point. `false` if only
    /// one sensor sees the object, because one sensor cannot tell.
    pub fn is_flat(&self) -> bool {
        if self.seen_by.count_ones() < 2 {
            return false;
        }
        let flat = self.hypotheses.iter().filter(|one| one.outline.is_flat()).map(|one| one.log);
        log_sum(flat) - log_sum(self.logs()) > FLAT_LOG
    }

    /// The point of the object that is nearest to the robot: mean and covariance over all hypotheses, weighted by their
    /// likelihoods.
    pub fn nearest(&self, own: &OwnMotion, of: &NeighbourModel, radius_m: f32) -> NearestPoint {
        let total = log_sum(self.logs());
        let all = || {
            let estimate = |one: &Hypothesis| one.outline.nearest(own, of, radius_m);
            self.hypotheses.iter().map(move |one| (libm::expf(one.log - total), estimate(one)))
        };
        let (at, velocity) = all().fold((Point::ZERO, Point::ZERO), |(at, velocity), (share, one)| {
            (at.plus(one.at.times(share)), velocity.plus(one.velocity.times(share)))
        });
        let mut covariance = Covariance::default();
        for (share, one) in all() {
            covariance.mix(&one.covariance, share);
            let root = libm::sqrtf(share);
            let (place, velocity) = (one.at.minus(at).times(root), one.velocity.minus(velocity).times(root));
            covariance.add(&CommonError { place, velocity });
        }
        NearestPoint { at, velocity, covariance }
    }
}

impl Hypothesis {
    fn explains(&self, sensor: usize, read_m: f32, scan: &Scan<'_>) -> bool {
        self.outline.view(sensor, scan.sensors).is_some_and(|view| {
            let (off_m, variance) = self.outline.innovation(&view, read_m, scan.sensors);
            off_m * off_m < EXPLAINS_SIGMAS * EXPLAINS_SIGMAS * variance
        })
    }

    /// Updates the hypothesis by the readings of the sensors `seen`, and by the fact that the sensors `unseen` do not
    /// see the outline. Both are sets with one bit for each sensor.
    fn take(&mut self, seen: u8, unseen: u8, scan: &Scan<'_>) {
        for sensor in bits(seen) {
            let view = self.outline.view(sensor, scan.sensors);
            self.log += self.take_reading(sensor, view, scan.gaps_m[sensor], scan);
        }
        for sensor in bits(unseen) {
            let Some(view) = self.outline.view(sensor, scan.sensors) else { continue };
            // A nearer object would hide it.
            if scan.gaps_m[sensor] > view.gap_m {
                self.log += self.take_silence(sensor, &view, scan);
            }
        }
    }

    /// Corrects the outline by a reading and returns the natural logarithm of the reading's density. The result is at
    /// least the density of a reading of a new neighbour. If the outline is an edge with an end outside the sensor's
    /// cone, the end is moved towards the cone.
    fn take_reading(&mut self, sensor: usize, view: Option<View>, read_m: f32, scan: &Scan<'_>) -> f32 {
        let unexplained = scan.sensors.new_log;
        let Some(view) = view else {
            if let Some(bound_m) = self.reach_m(sensor, scan) {
                self.outline.move_end(bound_m, -1.0);
            }
            return unexplained;
        };
        let (off_m, variance) = self.outline.innovation(&view, read_m, scan.sensors);
        if off_m * off_m < EXPLAINS_SIGMAS * EXPLAINS_SIGMAS * variance {
            self.outline.correct(view.gradient, off_m, variance);
        }
        log_density(off_m, variance).max(unexplained)
    }

    /// Uses the fact that a sensor does not see the outline, and returns the natural logarithm of its probability.
    /// Possible reasons: the outline is out of range, it ends before the sensor's cone, or the sensor misses it. If an
    /// end before the cone is the likeliest reason, the end is moved there.
    fn take_silence(&mut self, sensor: usize, view: &View, scan: &Scan<'_>) -> f32 {
        let (off_m, variance) = self.outline.innovation(view, scan.sensors.range_m, scan.sensors);
        let mut silence =
            super::likelihood::cumulative(-off_m / libm::sqrtf(variance)) + scan.of.unseen_share;
        if let Some(bound_m) = self.reach_m(sensor, scan) {
            let outside = self.outline.ends_before(bound_m).unwrap_or(0.0);
            if outside > silence {
                silence = outside;
                self.outline.move_end(bound_m, 1.0);
            }
        }
        libm::logf(silence.min(1.0))
    }

    /// The farthest place along the edge that the sensor would see, on the side to which the edge extends, metres.
    /// `None` for an outline without an end, or out of range.
    fn reach_m(&self, sensor: usize, scan: &Scan<'_>) -> Option<f32> {
        let [right_m, left_m] = self.outline.stretch(sensor, scan.sensors)?;
        match self.outline.form {
            Form::EdgeToLeft => Some(left_m),
            Form::EdgeToRight => Some(right_m),
            Form::Edge | Form::Disc => None,
        }
    }
}

/// Returns the indices of the sensors in the set `of`, ascending. The set has one bit for each sensor.
pub(super) fn bits(of: u8) -> impl Iterator<Item = usize> + Clone {
    (0..SENSORS).filter(move |sensor| of >> sensor & 1 == 1)
}
