//! The covariance of a track's place and velocity, with two axes each.

use super::point::Point;

/// A symmetric matrix of two by two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Symmetric {
    xx: f32,
    xy: f32,
    yy: f32,
}

impl Symmetric {
    fn diagonal(value: f32) -> Self {
        Self { xx: value, xy: 0.0, yy: value }
    }

    fn times(self, by: Point) -> Point {
        Point { x: self.xx * by.x + self.xy * by.y, y: self.xy * by.x + self.yy * by.y }
    }

    fn rotated(self, by: Point) -> Self {
        let (cc, ss, cs) = (by.x * by.x, by.y * by.y, by.x * by.y);
        Self {
            xx: cc * self.xx - 2.0 * cs * self.xy + ss * self.yy,
            xy: cs * (self.xx - self.yy) + (cc - ss) * self.xy,
            yy: ss * self.xx + 2.0 * cs * self.xy + cc * self.yy,
        }
    }

    fn minus_outer(&mut self, of: Point, share: f32) {
        self.xx -= of.x * of.x * share;
        self.xy -= of.x * of.y * share;
        self.yy -= of.y * of.y * share;
    }
}

/// An independent source of error that changes place (metres) and velocity (m/s) together, 1 sigma.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CommonError {
    pub place: Point,
    pub velocity: Point,
}

/// Covariance of place (metres) and velocity (m/s) in body space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Covariance {
    place: Symmetric,
    velocity: Symmetric,
    /// Covariance of place with velocity: a row for the place's x and one for its y, each with the velocity's x and y.
    both: [Point; 2],
}

impl Covariance {
    /// Covariance of independent place and velocity. `along_m2` and `across_m2`: variances of the place along and
    /// across the unit vector `along`; `velocity_m2ps2`: variance of the velocity in each axis.
    pub fn new(along: Point, along_m2: f32, across_m2: f32, velocity_m2ps2: f32) -> Self {
        let place = Symmetric { xx: along_m2, xy: 0.0, yy: across_m2 }.rotated(along);
        Self { place, velocity: Symmetric::diagonal(velocity_m2ps2), both: [Point::ZERO; 2] }
    }

    /// Variance of the place along a unit vector, square metres.
    pub fn place_along(&self, unit: Point) -> f32 {
        unit.dot(self.place.times(unit))
    }

    /// Variance of the velocity along a unit vector, m²/s².
    pub fn velocity_along(&self, unit: Point) -> f32 {
        unit.dot(self.velocity.times(unit))
    }

    /// Variance, along a unit vector, of the place `after_s` seconds from now at constant velocity, square metres.
    pub fn place_after(&self, unit: Point, after_s: f32) -> f32 {
        let both = unit.x * self.both[0].dot(unit) + unit.y * self.both[1].dot(unit);
        self.place_along(unit) + after_s * (2.0 * both + after_s * self.velocity_along(unit))
    }

    /// Propagates the covariance over a step of `dt` seconds at constant velocity. Halfway, the velocity changes in an
    /// unknown way by `change_mps` (1 sigma in each axis).
    pub fn predict(&mut self, dt: f32, change_mps: f32) {
        let [x, y] = &mut self.both;
        let velocity = self.velocity;
        self.place.xx += dt * (2.0 * x.x + dt * velocity.xx);
        self.place.xy += dt * (x.y + y.x + dt * velocity.xy);
        self.place.yy += dt * (2.0 * y.y + dt * velocity.yy);
        *x = x.plus(Point { x: velocity.xx, y: velocity.xy }.times(dt));
        *y = y.plus(Point { x: velocity.xy, y: velocity.yy }.times(dt));
        self.kick(change_mps, 0.5 * dt);
    }

    /// Adds the effect of an unknown change of velocity by `sigma_mps` (1 sigma in each axis) that took place `ago_s`
    /// seconds ago.
    pub fn kick(&mut self, sigma_mps: f32, ago_s: f32) {
        let variance = sigma_mps * sigma_mps;
        self.velocity.xx += variance;
        self.velocity.yy += variance;
        self.both[0].x += variance * ago_s;
        self.both[1].y += variance * ago_s;
        self.add_place(variance * ago_s * ago_s);
    }

    /// Adds an independent error of place and velocity.
    pub fn add(&mut self, by: &CommonError) {
        self.place.minus_outer(by.place, -1.0);
        self.velocity.minus_outer(by.velocity, -1.0);
        self.both[0] = self.both[0].plus(by.velocity.times(by.place.x));
        self.both[1] = self.both[1].plus(by.velocity.times(by.place.y));
    }

    /// Adds another covariance times `share`.
    pub fn mix(&mut self, other: &Self, share: f32) {
        for (to, from) in [(&mut self.place, &other.place), (&mut self.velocity, &other.velocity)] {
            to.xx += share * from.xx;
            to.xy += share * from.xy;
            to.yy += share * from.yy;
        }
        self.both = [0, 1].map(|row| self.both[row].plus(other.both[row].times(share)));
    }

    /// The covariance after places were stretched by `factor` along the unit vector `along`. Velocities are not
    /// stretched.
    pub fn stretched(mut self, along: Point, factor: f32) -> Self {
        let stretch = |point: Point| point.plus(along.times((factor - 1.0) * point.dot(along)));
        let rows = [Point::new(1.0, 0.0), Point::new(0.0, 1.0)].map(stretch);
        let [x, y] = rows.map(|row| self.place.times(row));
        self.place = Symmetric { xx: x.dot(rows[0]), xy: x.dot(rows[1]), yy: y.dot(rows[1]) };
        self.both = rows.map(|row| self.both[0].times(row.x).plus(self.both[1].times(row.y)));
        self
    }

    /// Adds a variance to the place in all directions, square metres.
    pub fn add_place(&mut self, variance_m2: f32) {
        self.place.xx += variance_m2;
        self.place.yy += variance_m2;
    }

    /// Rotates places and velocities by the angle of the unit vector `by`, because body space has turned.
    pub fn rotate(&mut self, by: Point) {
        self.place = self.place.rotated(by);
        self.velocity = self.velocity.rotated(by);
        let [x, y] = self.both.map(|row| row.rotated(by));
        self.both = [x.times(by.x).minus(y.times(by.y)), x.times(by.y).plus(y.times(by.x))];
    }

    /// Updates the covariance by a scalar measurement whose gradient over the place is `gradient`. `variance`: variance
    /// of the innovation. Returns the corrections of place and velocity.
    pub fn correct(&mut self, gradient: Point, innovation: f32, variance: f32) -> (Point, Point) {
        let place = self.place.times(gradient);
        let velocity = self.both[0].times(gradient.x).plus(self.both[1].times(gradient.y));
        self.gain(place, velocity, innovation, variance)
    }

    /// Updates the covariance by a measurement and returns the corrections of place and velocity. The arguments `place`
    /// and `velocity` are the covariances of place and velocity with the measurement. `variance`: variance of the
    /// innovation.
    fn gain(&mut self, place: Point, velocity: Point, innovation: f32, variance: f32) -> (Point, Point) {
        let share = 1.0 / variance;
        self.place.minus_outer(place, share);
        self.velocity.minus_outer(velocity, share);
        self.both[0] = self.both[0].minus(velocity.times(place.x * share));
        self.both[1] = self.both[1].minus(velocity.times(place.y * share));
        (place.times(innovation * share), velocity.times(innovation * share))
    }

    /// Updates the covariance by a scalar measurement of the velocity along a unit vector. `variance`: variance of the
    /// innovation. Returns the corrections of place and velocity.
    pub fn correct_velocity(&mut self, unit: Point, innovation: f32, variance: f32) -> (Point, Point) {
        let velocity = self.velocity.times(unit);
        let place = Point { x: self.both[0].dot(unit), y: self.both[1].dot(unit) };
        self.gain(place, velocity, innovation, variance)
    }

    /// Squared Mahalanobis distance of an error in place and velocity. It has a chi-square distribution with four
    /// degrees of freedom.
    #[cfg(test)]
    pub fn mahalanobis2(&self, place: Point, velocity: Point) -> f64 {
        let [bx, by] = self.both;
        let (p, v) = (self.place, self.velocity);
        let matrix = [
            [p.xx, p.xy, bx.x, bx.y],
            [p.xy, p.yy, by.x, by.y],
            [bx.x, by.x, v.xx, v.xy],
            [bx.y, by.y, v.xy, v.yy],
        ];
        let mut rows = matrix.map(|row| row.map(f64::from));
        let error = [place.x, place.y, velocity.x, velocity.y].map(f64::from);
        let mut solved = error;
        // Gaussian elimination: the matrix is positive definite.
        for pivot in 0..4 {
            for row in pivot + 1..4 {
                let factor = rows[row][pivot] / rows[pivot][pivot];
                let above = rows[pivot];
                rows[row].iter_mut().zip(above).for_each(|(value, above)| *value -= factor * above);
                solved[row] -= factor * solved[pivot];
            }
        }
        for row in (0..4).rev() {
            let known: f64 = (row + 1..4).map(|column| rows[row][column] * solved[column]).sum();
            solved[row] = (solved[row] - known) / rows[row][row];
        }
        error.iter().zip(solved).map(|(error, solved)| error * solved).sum()
    }
}
