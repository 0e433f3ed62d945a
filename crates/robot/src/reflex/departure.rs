//! Detection that a planned neighbour has left its plan, by a generalised likelihood ratio test. Source: Willsky and
//! Jones, *A Generalized Likelihood Ratio Approach to the Detection and Estimation of Jumps in Linear Systems*, 1976.
//!
//! The null hypothesis: the neighbour drives by plan, and the readings deviate from the plan by a slowly drifting
//! offset. The offset is a first-order Gauss-Markov process (Bar-Shalom, Li and Kirubarajan, section 4.2). The
//! alternatives: the neighbour stopped dead at one of the last places of its path. Each hypothesis has its own filter
//! for the offset. It accumulates the logarithm of its likelihood ratio, so that readings of several steps count
//! together.

use super::motion::OwnMotion;
use super::point::Point;
use super::scan::{Expectation, Scan};

/// Largest number of stop hypotheses: places at which the neighbour may have stopped. With fewer, new places replace
/// old ones before the readings can tell that a slow neighbour stopped.
const STOPS: usize = 6;
/// Distance on the neighbour's path between the places of two stop hypotheses, metres. With more, the place of a stop
/// is known less well. With less, the hypotheses cover fewer steps.
const STOP_EVERY_M: f32 = 0.002;
/// Share of a log-likelihood ratio that is kept from step to step. The model of the offset is only approximate, and
/// small errors add up in seconds. At 1, robots that drove side by side for 4 s, 2 mm off the neighbour's spline,
/// braked wrongly (formation 274).
const REMEMBERED: f32 = 0.95;
/// Directions in which a neighbour may stand when it comes into sight, radians from the axis of the sensor that sees it
/// first: 16° apart.
const FIRST_BEARINGS_RAD: [f32; 5] = [-0.56, -0.28, 0.0, 0.28, 0.56];
/// The test of whether one planned neighbour has left its plan.
#[derive(Clone, Debug)]
pub(crate) struct Departure {
    /// Deviation of the readings from what the plan predicts if the neighbour keeps to it, metres; positive if they are
    /// longer.
    offset_m: f32,
    /// Variance of the offset, square metres.
    variance: f32,
    /// How far the neighbour should have driven by plan since the last stop hypothesis was added, metres.
    driven_m: f32,
    stops: heapless::Vec<Stop, STOPS>,
}

/// The hypothesis that the neighbour stopped at the place `at`.
#[derive(Clone, Copy, Debug)]
struct Stop {
    /// Centre of the stopped neighbour, body space, metres.
    at: Point,
    offset_m: f32,
    /// Natural logarithm of the likelihood of this hypothesis over that of the null hypothesis.
    log_ratio: f32,
}

/// How a neighbour left its plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Left {
    /// It stands; its centre is at this place, body space, metres.
    Stands(Point),
    /// It left its plan in another way than by stopping.
    Strays,
}

impl Departure {
    /// A test without readings. `sigma_m`: deviation of neighbours from their planned places, 1 sigma, metres.
    pub fn new(sigma_m: f32) -> Self {
        Self {
            offset_m: 0.0,
            variance: sigma_m * sigma_m,
            driven_m: STOP_EVERY_M,
            stops: heapless::Vec::new(),
        }
    }

    /// Begins the test of a neighbour that comes into sight of a sensor, with the reading `read_m`. `planned`: its
    /// centre by plan, body space, metres. The neighbour may have stopped long before, in any direction at the distance
    /// read. If it drives by plan, the first reading measures its offset.
    pub fn at_first_sight(sensor: usize, read_m: f32, planned: Point, scan: &Scan<'_>) -> Self {
        let (axis, radius_m) = (scan.sensors.axes[sensor], scan.sensors.radius_m);
        let mut departure = Self::new(scan.planned_sigma_m);
        let gap_m = scan.sensors.expected(sensor, planned).gap_m;
        let gain = departure.variance / (departure.variance + scan.sensors.variance_m2(gap_m));
        departure.offset_m = gain * (read_m - gap_m);
        departure.variance *= 1.0 - gain;
        for bearing in FIRST_BEARINGS_RAD {
            let towards = axis.rotated(Point::unit(bearing));
            let at = axis.times(radius_m).plus(towards.times(radius_m + read_m));
            let _ = departure.stops.push(Stop { at, offset_m: 0.0, log_ratio: 0.0 });
        }
        departure
    }

    /// Converts the places of the stop hypotheses to body space after a step in which the robot itself moved.
    pub fn predict(&mut self, own: &OwnMotion) {
        for stop in &mut self.stops {
            stop.at = own.carry(stop.at);
        }
    }

    /// Tests the neighbour by the readings of the sensors that see it. `one`: its planned motion. Returns how the
    /// neighbour has left its plan; `None` while it still agrees with the plan. Without readings, no likelihood
    /// changes.
    pub fn test(
        &mut self,
        one: &Expectation,
        seen_by: impl Iterator<Item = usize> + Clone,
        scan: &Scan<'_>,
    ) -> Option<Left> {
        let mean = Mean { seen_by, scan };
        if let Some((off_m, noise)) = mean.off_m(one.at) {
            let (sigma_m, share) = (scan.planned_sigma_m, scan.of.offset_share * scan.own.dt);
            self.variance += 2.0 * share * (sigma_m * sigma_m - self.variance);
            let sum = self.variance + noise;
            let gain = self.variance / sum;
            let step = |offset_m: &mut f32, off_m: f32| {
                *offset_m -= share * *offset_m;
                let innovation = off_m - *offset_m;
                *offset_m += gain * innovation;
                innovation * innovation
            };
            let null = step(&mut self.offset_m, off_m);
            self.variance *= 1.0 - gain;
            for stop in &mut self.stops {
                let Some((off_m, _)) = mean.off_m(stop.at) else { continue };
                let gain = (null - step(&mut stop.offset_m, off_m)) / (2.0 * sum);
                stop.log_ratio = REMEMBERED * stop.log_ratio + gain;
            }
        }
        let likeliest = self.stops.iter().max_by(|a, b| a.log_ratio.total_cmp(&b.log_ratio));
        if let Some(stop) = likeliest.filter(|stop| stop.log_ratio > scan.of.stop_log_ratio) {
            let towards = stop.at.times(1.0 / stop.at.length().max(1e-3));
            return Some(Left::Stands(stop.at.plus(towards.times(stop.offset_m))));
        }
        if self.offset_m.abs() > scan.of.stray_sigmas * scan.planned_sigma_m {
            return Some(Left::Strays);
        }
        self.add_stop(one, scan.own.dt);
        None
    }

    /// Adds the hypothesis that the neighbour stops at its present planned place, once this place is [`STOP_EVERY_M`]
    /// from the last one. If there are too many hypotheses, the least likely one is dropped.
    fn add_stop(&mut self, one: &Expectation, dt: f32) {
        self.driven_m += one.velocity.length() * dt;
        if self.driven_m < STOP_EVERY_M {
            return;
        }
        self.driven_m = 0.0;
        if self.stops.is_full() {
            let least =
                (0..STOPS).min_by(|&a, &b| self.stops[a].log_ratio.total_cmp(&self.stops[b].log_ratio));
            self.stops.remove(least.unwrap_or(0));
        }
        let _ = self.stops.push(Stop { at: one.at, offset_m: self.offset_m, log_ratio: 0.0 });
    }
}

/// Averages over the sensors that see a neighbour.
struct Mean<'a, S> {
    seen_by: S,
    scan: &'a Scan<'a>,
}

impl<S: Iterator<Item = usize> + Clone> Mean<'_, S> {
    /// Returns how much more the sensors read on average than they would for a neighbour centred at `at`, metres. With
    /// it, the variance of this mean, square metres. `None` if no sensor has a reading.
    fn off_m(&self, at: Point) -> Option<(f32, f32)> {
        let (mut off_m, mut variance, mut count) = (0.0, 0.0, 0.0);
        for sensor in self.seen_by.clone() {
            let Some(read_m) = self.scan.reads_m(sensor) else { continue };
            let expected = self.scan.sensors.expected(sensor, at);
            off_m += read_m - expected.gap_m;
            variance += self.scan.sensors.variance_m2(expected.gap_m);
            count += 1.0;
        }
        (count > 0.0).then_some((off_m / count, variance / (count * count)))
    }
}
