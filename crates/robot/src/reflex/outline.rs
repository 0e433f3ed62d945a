//! The outline of a standing object: a straight edge, the end of an edge, or a disc of a robot's size. An extended
//! Kalman filter estimates where it is.
//!
//! The state is relative to the robot. It consists of the distance to the edge, the direction of the edge's normal, and
//! the place of the end along the edge. For a disc, the place of its centre is used instead of the end. The object does
//! not move, so its motion in body space comes only from the robot's own motion.

use super::covariance::{CommonError, Covariance};
use super::motion::OwnMotion;
use super::point::Point;
use crate::config::NeighbourModel;

/// Uncertainty of the place at which a sensor begins to see an edge, metres, 1 sigma: what the robot drives in half a
/// step.
const SEEN_SIGMA_M: f32 = 0.002;

/// Kind of standing object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    /// A straight edge without an end in sight.
    Edge,
    /// An edge that extends from its end to the left, as the robot sees it.
    EdgeToLeft,
    /// An edge that extends from its end to the right, as the robot sees it.
    EdgeToRight,
    /// A disc of a robot's size.
    Disc,
}

/// Estimated outline of a standing object, in body space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outline {
    pub form: Form,
    /// Distance from the robot's centre along the normal, metres: to the edge, or to the disc's centre.
    pub distance_m: f32,
    /// Unit vector in body space: perpendicular to the edge, from the robot to the edge. For a disc: the line of sight
    /// at first.
    pub normal: Point,
    /// Place of the edge's end, or of the disc's centre, metres to the left of the normal through the robot's centre.
    pub along_m: f32,
    /// Covariance of distance (metres), direction of the normal (radians) and `along_m` (metres).
    variance: [[f32; 3]; 3],
}

/// The nearest point of an object, the motion of that point, and their covariance.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NearestPoint {
    /// Place of the point in body space, metres.
    pub at: Point,
    /// Velocity over the floor along the axes of body space, m/s.
    pub velocity: Point,
    pub covariance: Covariance,
}

impl NearestPoint {
    /// Moves the point away from the robot by `by_m` metres, in the same direction, with its covariance.
    pub fn behind(self, by_m: f32) -> Self {
        let far_m = self.at.length().max(1e-3);
        let factor = (1.0 + by_m / far_m).max(0.1);
        let across = self.at.times(1.0 / far_m).left();
        Self { at: self.at.times(factor), covariance: self.covariance.stretched(across, factor), ..self }
    }
}

impl Outline {
    /// A straight edge. `sigma_m` and `sigma_rad`: independent errors of distance and direction, 1 sigma.
    pub fn edge(distance_m: f32, normal: Point, sigma_m: f32, sigma_rad: f32) -> Self {
        let variance = [[sigma_m * sigma_m, 0.0, 0.0], [0.0, sigma_rad * sigma_rad, 0.0], [0.0; 3]];
        Self { form: Form::Edge, distance_m, normal, along_m: 0.0, variance }
    }

    /// A disc centred at `at`. `towards`: unit vector from a sensor to the disc's centre; `along_m` and `across_m`:
    /// errors of the centre along and across this vector, metres, 1 sigma.
    pub fn disc(at: Point, towards: Point, along_m: f32, across_m: f32) -> Self {
        let variance = [[along_m * along_m, 0.0, 0.0], [0.0; 3], [0.0, 0.0, across_m * across_m]];
        let form = Form::Disc;
        Self { form, distance_m: at.dot(towards), normal: towards, along_m: at.dot(towards.left()), variance }
    }

    /// An edge with its end at `at`. Its normal is turned by `turn_rad` counter-clockwise from the line of sight
    /// `towards`, with an error of `sigma_rad`. `along_m` and `across_m`: errors of the end along and across the line
    /// of sight, metres, 1 sigma.
    pub fn end(
        at: Point,
        towards: Point,
        (along_m, across_m): (f32, f32),
        turn_rad: f32,
        sigma_rad: f32,
    ) -> Self {
        let form = if turn_rad < 0.0 { Form::EdgeToLeft } else { Form::EdgeToRight };
        let turn = Point::unit(turn_rad);
        let normal = towards.rotated(turn);
        let (far_m, end_m) = (at.dot(normal), at.dot(normal.left()));
        let mut variance = [[0.0; 3]; 3];
        add_square(&mut variance, [turn.x * along_m, 0.0, -turn.y * along_m]);
        add_square(&mut variance, [turn.y * across_m, 0.0, turn.x * across_m]);
        // The edge turns about its end.
        add_square(&mut variance, [end_m * sigma_rad, sigma_rad, -far_m * sigma_rad]);
        Self { form, distance_m: far_m, normal, along_m: end_m, variance }
    }

    /// Returns this edge with an end that lies anywhere between two places along the edge, metres to the left of the
    /// normal.
    pub fn ending(&self, form: Form, from_m: f32, to_m: f32) -> Self {
        // An even spread over a length has a standard deviation of 0.29 of it.
        let sigma_m = (0.29 * (to_m - from_m).abs()).max(SEEN_SIGMA_M);
        let mut variance = self.variance;
        variance[2] = [0.0, 0.0, sigma_m * sigma_m];
        (0..2).for_each(|row| variance[row][2] = 0.0);
        Self { form, along_m: 0.5 * (from_m + to_m), variance, ..*self }
    }

    /// Side to which the edge extends from its end: 1 left, −1 right; 0 if it has no end.
    pub fn side(&self) -> f32 {
        match self.form {
            Form::EdgeToLeft => 1.0,
            Form::EdgeToRight => -1.0,
            Form::Edge | Form::Disc => 0.0,
        }
    }

    /// Predicts the outline in body space after a step in which the robot itself moved.
    pub fn predict(&mut self, own: &OwnMotion, of: &NeighbourModel) {
        let moved = Point::of_small_angle(0.5 * own.turn_rad).times(own.way_m);
        let (across_m, along_m) = (moved.dot(self.normal), moved.dot(self.normal.left()));
        let (has_end, is_edge) = (self.form != Form::Edge, self.form != Form::Disc);
        self.distance_m -= across_m;
        self.normal = self.normal.rotated(Point::of_small_angle(-own.turn_rad));
        if has_end {
            self.along_m -= along_m;
        }
        // Distance and end change with the direction.
        let levers = [-along_m, 0.0, if has_end { across_m } else { 0.0 }];
        let by_direction = self.variance[1];
        for row in 0..3 {
            for column in 0..3 {
                self.variance[row][column] += levers[row] * by_direction[column]
                    + levers[column] * by_direction[row]
                    + levers[row] * levers[column] * by_direction[1];
            }
        }
        let square = |value: f32| value * value;
        let still = square(of.standing_sigma_m);
        self.variance[0][0] += square(of.odometry_share * across_m) + still;
        if is_edge {
            self.variance[1][1] += square(of.odometry_share * own.turn_rad) + square(of.standing_sigma_rad);
        }
        if has_end {
            self.variance[2][2] += square(of.odometry_share * along_m) + still;
        }
    }

    /// Variance of a quantity whose gradient over distance, direction and end is `gradient`.
    pub fn variance_of(&self, gradient: [f32; 3]) -> f32 {
        dot(self.covariance_with(gradient), gradient)
    }

    fn covariance_with(&self, gradient: [f32; 3]) -> [f32; 3] {
        self.variance.map(|row| dot(row, gradient))
    }

    /// Corrects the outline by a measurement whose gradient over distance, direction and end is `gradient`. `variance`:
    /// variance of the innovation.
    pub fn correct(&mut self, gradient: [f32; 3], innovation: f32, variance: f32) {
        let moved = self.covariance_with(gradient);
        let share = 1.0 / variance;
        for row in 0..3 {
            for column in 0..3 {
                self.variance[row][column] -= moved[row] * moved[column] * share;
            }
        }
        let [distance_m, turn_rad, along_m] = moved.map(|value| value * innovation * share);
        self.distance_m += distance_m;
        self.along_m += along_m;
        let normal = self.normal.plus(self.normal.left().times(turn_rad));
        self.normal = normal.times(1.0 / normal.length());
    }

    /// Moves the end towards `bound_m` along the edge (metres) if it is on the wrong side of that place. The end
    /// becomes no more certain, because the next steps repeat the same information. `sense`: 1 if the edge does not
    /// reach as far as `bound_m`, −1 if it does.
    pub fn move_end(&mut self, bound_m: f32, sense: f32) {
        let off_m = bound_m - self.along_m;
        if off_m * self.side() * sense > 0.0 {
            let known = self.variance[2][2];
            self.along_m += off_m * known / (known + SEEN_SIGMA_M * SEEN_SIGMA_M);
        }
    }

    /// Probability that the edge does not reach as far as the place `bound_m` along it, metres; `None` if the edge has
    /// no end.
    pub fn ends_before(&self, bound_m: f32) -> Option<f32> {
        let side = self.side();
        let sigma_m = libm::sqrtf(self.variance[2][2].max(1e-8));
        (side != 0.0).then(|| super::likelihood::cumulative((self.along_m - bound_m) * side / sigma_m))
    }

    /// Whether the point of the object that is nearest to the robot lies on a straight edge. `false` if it is the end
    /// of an edge, and for a disc.
    pub fn is_flat(&self) -> bool {
        match self.form {
            Form::Edge => true,
            Form::EdgeToLeft | Form::EdgeToRight => self.along_m * self.side() <= 0.0,
            Form::Disc => false,
        }
    }

    /// The point of the object that is nearest to the robot's centre. On an edge, this point slides along the edge as
    /// the robot drives.
    pub fn nearest(&self, own: &OwnMotion, of: &NeighbourModel, radius_m: f32) -> NearestPoint {
        let (normal, left) = (self.normal, self.normal.left());
        let flat = self.is_flat();
        let (along_m, slides_mps) = if flat { (0.0, own.way_m / own.dt) } else { (self.along_m, 0.0) };
        let turned = left.times(self.distance_m).minus(normal.times(along_m));
        let turned_mps = normal.times(left.x).plus(left.times(normal.x)).times(-slides_mps);
        let along = if flat { Point::ZERO } else { left };
        let mut covariance = Covariance::new(normal, 0.0, 0.0, of.standing_sigma_mps * of.standing_sigma_mps);
        for [distance, direction, end] in factors(&self.variance) {
            let place = normal.times(distance).plus(turned.times(direction)).plus(along.times(end));
            covariance.add(&CommonError { place, velocity: turned_mps.times(direction) });
        }
        let slip = left.times(left.x * slides_mps * of.odometry_share);
        covariance.add(&CommonError { place: Point::ZERO, velocity: slip });
        let at = normal.times(self.distance_m).plus(left.times(along_m));
        let estimate = NearestPoint { at, velocity: left.times(left.x * slides_mps), covariance };
        if self.form == Form::Disc { estimate.behind(-radius_m) } else { estimate }
    }

    /// Whether both outlines have the same form and nearly the same state, so that one hypothesis is enough.
    pub fn is_like(&self, other: &Self, of: &NeighbourModel) -> bool {
        self.form == other.form
            && (self.distance_m - other.distance_m).abs() < of.alike_m
            && (self.along_m - other.along_m).abs() < 2.0 * of.alike_m
            && self.normal.minus(other.normal).length() < 2.0 * of.alike_m / self.distance_m.max(of.alike_m)
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn add_square(to: &mut [[f32; 3]; 3], of: [f32; 3]) {
    for (row, value) in to.iter_mut().zip(of) {
        row.iter_mut().zip(of).for_each(|(sum, other)| *sum += value * other);
    }
}

/// Returns the columns of the lower triangular (Cholesky) factor of a covariance. Each column is an independent error,
/// 1 sigma.
fn factors(of: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    let mut rest = *of;
    core::array::from_fn(|pivot| {
        let root = libm::sqrtf(rest[pivot][pivot].max(0.0));
        if root < 1e-9 {
            return [0.0; 3];
        }
        let column = rest.map(|row| row[pivot] / root);
        for row in 0..3 {
            for beside in 0..3 {
                rest[row][beside] -= column[row] * column[beside];
            }
        }
        column
    })
}
