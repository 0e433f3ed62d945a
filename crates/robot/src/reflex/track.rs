//! One neighbour that the sensors see: an extended Kalman filter of its place and velocity (Bar-Shalom, Li and
//! Kirubarajan, *Estimation with Applications to Tracking and Navigation*, 2001: the nearly constant velocity model of
//! section 6.3, the second-order measurement of 10.3, the manoeuvre detection of 11.2).
//!
//! The state is relative in place and absolute in velocity: the centre of the neighbour in body space, and its velocity
//! over the floor along the axes of body space. A standing neighbour is the special case of velocity zero.

use super::covariance::Covariance;
use super::point::Point;
use super::sensors::{Expected, Sensors};
use crate::config::{ReflexParameters, SENSORS};

/// Uncertainty of the edge of a cone, metres: what a neighbour moves along it in a step.
const EDGE_SIGMA_M: f32 = 0.003;

/// A neighbour off its plan by more sigma than this, in place or velocity, does not keep to it.
const RECOGNISED_SIGMAS: f32 = 3.5;

/// Weight of the jump of the step before: a robot that stops dead is read 2 sigma nearer within the step in which it
/// stops, and 5 sigma nearer after the next (18 mm ahead at 0.27 m/s).
const STEP_BEFORE: f32 = 0.4;
/// Share of its speed that a neighbour most likely has left after a jump towards the robot, and the uncertainty of that as
/// a share of its speed.
const STOPPED_SHARE: f32 = 0.25;
const STOPPED_SIGMA: f32 = 0.5;
/// Robots are off their plan by much the same for this many steps.
const CORRELATED_STEPS: f32 = 10.0;

/// How a robot moved in a step, in its own body space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnMotion {
    /// Forward, metres.
    pub way_m: f32,
    /// Counter-clockwise, radians.
    pub turn_rad: f32,
    /// Length of the step, seconds.
    pub dt: f32,
}

/// A slowly drifting offset between readings and the plan: mean in metres, and variance in square metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bias {
    pub m: f32,
    variance: f32,
    /// The latest jump, in sigma.
    sigmas: f32,
    sensor: usize,
}

impl Bias {
    pub fn unknown(of: &ReflexParameters) -> Self {
        Self { m: 0.0, variance: of.planned_sigma_m * of.planned_sigma_m, sigmas: 0.0, sensor: usize::MAX }
    }
}

/// A neighbour in sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track {
    /// Its centre in body space, metres.
    pub at: Point,
    /// Its velocity over the floor, along the axes of body space, m/s.
    pub velocity: Point,
    pub covariance: Covariance,
    /// Index of the planned neighbour it is taken for.
    pub planned: Option<u8>,
    /// Steps in a row in which a sensor that should see it did not.
    pub missed: u8,
    /// Sensors that saw it in the latest step, one bit each.
    pub seen_by: u8,
    /// By how much it is read farther than the plan says, lately.
    pub bias: Bias,
    /// Steps until the plan counts again, after it has done something the plan does not know.
    pub shaken: u8,
    /// The planned neighbour that it was before it did something that the plan does not know.
    pub left: Option<u8>,
    /// Steps since it came into sight, at most 255.
    pub age: u8,
}

impl Track {
    /// Whether it is a neighbour that has left its plan.
    pub fn strays(&self) -> bool {
        self.left.is_some() && self.planned.is_none()
    }

    /// Whether it is the planned neighbour of this number, or was until that left its plan.
    pub fn stands_for(&self, index: u8) -> bool {
        self.planned == Some(index) || self.left == Some(index)
    }

    /// Whether a sensor saw it in the latest step.
    pub fn is_seen_by(&self, sensor: usize) -> bool {
        self.seen_by >> sensor & 1 == 1
    }

    /// The sensors that saw it in the latest step.
    pub fn sensors(&self) -> impl Iterator<Item = usize> + use<> {
        let seen_by = self.seen_by;
        (0..SENSORS).filter(move |sensor| seen_by >> sensor & 1 == 1)
    }

    /// Takes a reading.
    pub fn take(&mut self, sensor: usize, read_m: f32, sensors: &Sensors) {
        let expected = sensors.expected(sensor, self.at);
        let (off_m, variance) = self.innovation(&expected, read_m, sensors);
        self.correct(expected.towards, off_m, variance);
    }

    /// Distance from rim to rim, metres.
    pub fn gap_m(&self, sensors: &Sensors) -> f32 {
        self.at.length() - sensors.contact_m()
    }

    /// Carries the state over a step in which the robot itself moved.
    pub fn predict(&mut self, own: &OwnMotion, of: &ReflexParameters) {
        let middle = Point::of_small_angle(-0.5 * own.turn_rad);
        let moved = self.velocity.times(own.dt).minus(Point::new(own.way_m, 0.0).rotated(
            // The own way bends by half the turn.
            Point { x: middle.x, y: -middle.y },
        ));
        let turn = Point::of_small_angle(-own.turn_rad);
        self.at = self.at.plus(moved).rotated(turn);
        self.velocity = self.velocity.rotated(turn);
        let known = self.planned.is_some();
        let accel_mps2 = if known { of.accel_sigma_mps2 } else { of.unplanned_accel_mps2 };
        self.covariance.predict(own.dt, accel_mps2 * own.dt);
        let odometry_m = of.odometry_share * own.way_m;
        self.covariance.add_place(odometry_m * odometry_m);
        self.covariance.rotate(turn);
    }

    /// Watches readings of a neighbour that the plan names for a change of motion that the plan does not know, such as a
    /// robot that stops dead: `off_m` is how much farther it is read than the plan says, `variance` that of the reading.
    /// The two are off by much the same from step to step; a jump of `manoeuvre_sigmas` is a change.
    pub fn is_shaken_by(&mut self, sensor: usize, off_m: f32, variance: f32, of: &ReflexParameters) -> bool {
        if self.bias.sensor != sensor {
            self.bias = Bias { sensor, ..Bias::unknown(of) };
        }
        let bias = &mut self.bias;
        bias.variance += of.planned_drift_m * of.planned_drift_m;
        let (jump_m, sum) = (off_m - bias.m, bias.variance + variance);
        let sigmas = jump_m / libm::sqrtf(sum);
        let is_jump = (sigmas + STEP_BEFORE * bias.sigmas).abs() > of.manoeuvre_sigmas;
        bias.sigmas = sigmas;
        if !is_jump {
            let gain = bias.variance / sum;
            bias.m += gain * jump_m;
            bias.variance *= 1.0 - gain;
        }
        is_jump
    }

    /// It has changed its motion: nearer than expected, it most likely stopped.
    pub fn loosen(&mut self, is_nearer: bool, sigma_mps: f32, dt: f32) {
        let speed_mps = self.velocity.length();
        if speed_mps <= sigma_mps {
            return self.covariance.kick(sigma_mps, dt);
        }
        let along = self.velocity.times(1.0 / speed_mps);
        if is_nearer {
            self.velocity = self.velocity.times(STOPPED_SHARE);
        }
        self.covariance.kick_along(along, STOPPED_SIGMA * speed_mps, 2.0 * dt);
    }

    /// Innovation of a reading, metres, and its variance, square metres.
    pub fn innovation(&self, expected: &Expected, read_m: f32, sensors: &Sensors) -> (f32, f32) {
        let across = expected.towards.left();
        // The reading bends with the place across: second-order mean and variance.
        let bend_m = 0.5 * self.covariance.place_along(across) / expected.far_m;
        let variance = self.covariance.place_along(expected.towards)
            + sensors.variance_m2(expected.gap_m)
            + 2.0 * bend_m * bend_m;
        (read_m - expected.gap_m - bend_m, variance)
    }

    /// Takes a measurement with this innovation and variance that changes with the place as `gradient` says.
    fn correct(&mut self, gradient: Point, innovation: f32, variance: f32) {
        let (place, velocity) = self.covariance.correct(gradient, innovation, variance);
        self.at = self.at.plus(place);
        self.velocity = self.velocity.plus(velocity);
    }

    /// Something else than the readings bounds the place along a unit vector: it is at `at` within `sigma_m`. Taken only
    /// as far as the place is less sure than that, so that saying it at every step makes nothing surer.
    pub fn bound_place(&mut self, unit: Point, at: Point, sigma_m: f32) {
        let (known, bound) = (self.covariance.place_along(unit), sigma_m * sigma_m);
        if known > bound {
            let noise = known * bound / (known - bound).max(1e-12);
            self.correct(unit, at.minus(self.at).dot(unit), known + noise);
        }
    }

    /// Something that is off by `sigma_m` for `CORRELATED_STEPS` on end says where it is along a unit vector.
    pub fn learn_place(&mut self, unit: Point, at: Point, sigma_m: f32) {
        let variance = self.covariance.place_along(unit) + CORRELATED_STEPS * sigma_m * sigma_m;
        self.correct(unit, at.minus(self.at).dot(unit), variance);
    }

    /// The same for the velocity.
    pub fn learn_velocity(&mut self, unit: Point, velocity: Point, sigma_mps: f32) {
        let variance = self.covariance.velocity_along(unit) + CORRELATED_STEPS * sigma_mps * sigma_mps;
        let off = velocity.minus(self.velocity).dot(unit);
        let (place, velocity) = self.covariance.correct_velocity(unit, off, variance);
        self.at = self.at.plus(place);
        self.velocity = self.velocity.plus(velocity);
    }

    /// Whether it is where the plan has it, and moves as the plan says, as far as can be told.
    pub fn keeps_to(&self, at: Point, velocity: Point, of: &ReflexParameters) -> bool {
        let agrees = |off: Point, planned_sigma: f32, variance: &dyn Fn(Point) -> f32| {
            let size = off.length().max(1e-6);
            let known = variance(off.times(1.0 / size)).max(0.0);
            size * size < RECOGNISED_SIGMAS * RECOGNISED_SIGMAS * (known + planned_sigma * planned_sigma)
        };
        agrees(self.at.minus(at), of.planned_sigma_m, &|unit| self.covariance.place_along(unit))
            && agrees(self.velocity.minus(velocity), of.planned_sigma_mps, &|unit| {
                self.covariance.velocity_along(unit)
            })
    }

    /// The estimate is on the wrong side of the edge of a cone: it moves to the edge, and is no surer for that, as the
    /// next steps will say the same again.
    pub fn stay_within(&mut self, across: Point, gradient: Point, inside_m: f32) {
        let slope = gradient.dot(across);
        let known = self.covariance.place_along(across);
        let share = known / (known + EDGE_SIGMA_M * EDGE_SIGMA_M);
        if slope.abs() > 0.2 {
            self.at = self.at.minus(across.times(share * inside_m / slope));
        }
    }
}
