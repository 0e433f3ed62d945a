//! Covariance of the extended Kalman filter over place, heading and the slip of both wheels (Thrun, Burgard and Fox,
//! "Probabilistic Robotics", 2005, section 3.3).
//!
//! The Kalman gains change slowly. So the covariance is propagated over several steps at once, and the last gains are
//! used in between. The filter then costs only a few multiplications a step.

use lightbots_base::Vec2;

/// Index of stage x in a row. The slip of the right wheel has no index: it is stored apart, so that a row fits a vector
/// register.
const X: usize = 0;
/// Index of stage y in a row.
const Y: usize = 1;
/// Index of the heading in a row.
const HEADING: usize = 2;
/// Index of the left wheel's slip in a row.
const LEFT: usize = 3;

/// Process noise of the place in each step, even if the robot stands, metres, 1 sigma. With a smaller value, a robot
/// that was pushed rejects its fixes. With a larger value, noise of the fixes moves a robot that stands.
const STANDING_M: f64 = 1e-5;
/// Process noise of the heading in each step, even if the robot stands, radians, 1 sigma. See [`STANDING_M`].
const STANDING_RAD: f64 = 5e-5;
/// Process noise of the place besides slip, 1 sigma, as a share of the distance driven, because wheels are not quite
/// round.
const WAY: f64 = 0.01;
/// Process noise of the heading, 1 sigma, as a share of the rotation, because the effective distance between the wheels
/// varies: see docs/simulator.md.
const TURN: f64 = 0.03;

/// Covariances of one state with x, y, heading and the slip of the left wheel. Single precision is enough, because the
/// values are not known precisely, and halves the work.
pub(crate) type Row = [f32; 4];

/// Motion since the covariance was last propagated.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MotionSegment {
    /// Displacement in the stage, metres.
    pub moved: Vec2,
    /// Distance that the left and the right wheel would have covered without slip, metres.
    pub ways_m: [f64; 2],
    /// Rotation of the robot, radians counter-clockwise.
    pub turn: f64,
    /// Number of steps.
    pub steps: u32,
    /// Number of these steps in which a wheel turned.
    pub driven: u32,
}

/// Model of how the slip changes over a [`MotionSegment`]: a first-order Gauss-Markov process.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drift {
    /// Share of a deviation from the mean that remains at the end of the segment, 0 to 1.
    pub left: f64,
    /// Variance of the deviation in the long run.
    pub variance: f64,
}

/// Variance of the mean of all measurements in a [`MotionSegment`]: of the place in each coordinate (square metres),
/// and of the heading (radians squared). Infinite without measurements.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    pub place: f64,
    pub heading: f64,
}

/// Kalman gains of one measured coordinate: the correction of each state per unit of innovation.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Gain {
    /// Corrections of stage x and y, heading, and slip of the left wheel.
    pub by: Row,
    /// Correction of the slip of the right wheel.
    pub right: f32,
}

/// Returns the corrections of x, y, heading and the left wheel's slip for the innovations of x, y and heading.
// Not inlined, see `PoseCovariance::update_one`.
#[inline(never)]
pub(crate) fn correction(gains: &[Gain; 3], innovation: [f32; 3]) -> Row {
    let mut sum = [0.0; 4];
    for (gain, off) in gains.iter().zip(innovation) {
        add(&mut sum, off, &gain.by);
    }
    sum
}

/// Returns the correction of the right wheel's slip for the innovations of x, y and heading.
#[inline]
pub(crate) fn right_correction(gains: &[Gain; 3], innovation: [f32; 3]) -> f32 {
    gains.iter().zip(innovation).fold(0.0, |sum, (gain, off)| sum + gain.right * off)
}

/// Covariance of place, heading and the slip of both wheels. Units: metres, radians, and slip as a share.
#[derive(Debug)]
pub(crate) struct PoseCovariance {
    /// The larger one of the variances of x and y, square metres. It is copied from `rows`, because every step reads
    /// it.
    place: f64,
    heading: f64,
    rows: [Row; 4],
    /// Covariances of the right wheel's slip with x, y, heading and the left wheel's slip.
    right: Row,
    /// Variance of the right wheel's slip.
    right_own: f32,
}

impl PoseCovariance {
    /// The covariance of an unknown pose. `slip`: standard deviation of each wheel's slip.
    pub(crate) fn new(slip: f64) -> Self {
        let mut rows = [[0.0; 4]; 4];
        let slip = (slip * slip) as f32;
        let turn = core::f32::consts::PI * core::f32::consts::PI;
        for (state, variance) in [1.0, 1.0, turn, slip].into_iter().enumerate() {
            rows[state][state] = variance;
        }
        let mut covariance = Self { place: 0.0, heading: 0.0, rows, right: [0.0; 4], right_own: slip };
        covariance.sum_up();
        covariance
    }

    fn sum_up(&mut self) {
        self.place = f64::from(self.rows[X][X].max(self.rows[Y][Y]));
        self.heading = f64::from(self.rows[HEADING][HEADING]);
    }

    /// Propagates the covariance over a motion segment. `facing`: unit vector of the heading at the end of the segment.
    /// `track_m`: distance between the wheels.
    pub(crate) fn propagate(&mut self, stretch: &MotionSegment, facing: Vec2, track_m: f64, drift: Drift) {
        let [left, right] = stretch.ways_m;
        let (half_left, half_right, by) = (-0.5 * left, -0.5 * right, 1.0 / track_m);
        // Jacobian: change of x, y and heading with the heading and with each wheel's slip.
        let by_heading = [-stretch.moved.y, stretch.moved.x, 0.0, 0.0].map(|share| share as f32);
        let by_left = [facing.x * half_left, facing.y * half_left, left * by, 0.0].map(|share| share as f32);
        let by_right =
            [facing.x * half_right, facing.y * half_right, -right * by, 0.0].map(|share| share as f32);
        let [.., heading_row, left_row] = self.rows;
        let mut with_right = self.right;
        for state in [X, Y, HEADING] {
            let (turn, left, right) = (by_heading[state], by_left[state], by_right[state]);
            add(&mut self.rows[state], turn, &heading_row);
            add(&mut self.rows[state], left, &left_row);
            add(&mut self.rows[state], right, &self.right);
            with_right[state] +=
                turn * self.right[HEADING] + left * self.right[LEFT] + right * self.right_own;
        }
        let by = [by_heading, by_left, by_right];
        self.rows.iter_mut().zip(with_right).for_each(|(row, with_right)| add_columns(row, with_right, &by));
        add_columns(&mut self.right, self.right_own, &by);
        self.let_slip_drift(drift);
        let way = WAY * WAY * stretch.moved.length_squared();
        let steps = f64::from(stretch.steps);
        let place = (way + steps * (STANDING_M * STANDING_M)) as f32;
        self.rows[X][X] += place;
        self.rows[Y][Y] += place;
        self.rows[HEADING][HEADING] +=
            (TURN * TURN * stretch.turn * stretch.turn + steps * (STANDING_RAD * STANDING_RAD)) as f32;
        self.sum_up();
    }

    fn let_slip_drift(&mut self, drift: Drift) {
        let (left, variance) = (drift.left as f32, drift.variance as f32);
        let fresh = (1.0 - left * left) * variance;
        for row in &mut self.rows {
            row[LEFT] *= left;
        }
        self.rows[LEFT].iter_mut().for_each(|both| *both *= left);
        self.right.iter_mut().for_each(|both| *both *= left);
        self.right[LEFT] *= left;
        self.rows[LEFT][LEFT] += fresh;
        self.right_own = self.right_own * left * left + fresh;
    }

    /// Updates the covariance by measurements of place and heading with these variances. An infinite variance means no
    /// measurement.
    pub(crate) fn update(&mut self, noise: Noise) {
        for (state, variance) in [(X, noise.place), (Y, noise.place), (HEADING, noise.heading)] {
            if variance.is_finite() {
                self.update_one(state, variance as f32);
            }
        }
        self.sum_up();
    }

    /// Updates the covariance by one measurement of the state with this index and variance. Not inlined, because three
    /// copies in one function compile to slower code.
    #[inline(never)]
    fn update_one(&mut self, state: usize, variance: f32) {
        let (seen, seen_right) = (self.rows[state], self.right[state]);
        let share = -1.0 / (seen[state] + variance);
        for (row, with) in self.rows.iter_mut().zip(seen) {
            add(row, with * share, &seen);
        }
        add(&mut self.right, seen_right * share, &seen);
        self.right_own += seen_right * share * seen_right;
    }

    /// Kalman gains of measurements of x, y and heading with these variances, from the covariance after
    /// [`update`](Self::update).
    pub(crate) fn gains(&self, place: f64, heading: f64) -> [Gain; 3] {
        [(X, place), (Y, place), (HEADING, heading)].map(|(state, variance)| {
            let by = (1.0 / variance) as f32;
            Gain { by: self.rows[state].map(|with| with * by), right: self.right[state] * by }
        })
    }

    /// Sets the variance of x and of y, square metres, and makes both uncorrelated with all other states.
    pub(crate) fn set_place(&mut self, variance: f64) {
        self.set(X, variance);
        self.set(Y, variance);
    }

    /// Sets the variance of the heading, radians squared, and makes it uncorrelated with all other states.
    pub(crate) fn set_heading(&mut self, variance: f64) {
        self.set(HEADING, variance);
    }

    fn set(&mut self, state: usize, variance: f64) {
        self.rows[state] = [0.0; 4];
        self.rows.iter_mut().for_each(|row| row[state] = 0.0);
        self.right[state] = 0.0;
        self.rows[state][state] = variance as f32;
        self.sum_up();
    }

    /// Variance of the place, square metres: the larger one of the variances of x and y.
    pub(crate) fn place(&self) -> f64 {
        self.place
    }

    /// Variance of the heading, radians squared.
    pub(crate) fn heading(&self) -> f64 {
        self.heading
    }

    /// Variance of the slip: the mean of the variances of both wheels.
    pub(crate) fn slip(&self) -> f64 {
        0.5 * f64::from(self.rows[LEFT][LEFT] + self.right_own)
    }
}

/// Adds `share` times another row to a row.
#[inline]
fn add(row: &mut Row, share: f32, other: &Row) {
    row.iter_mut().zip(other).for_each(|(value, with)| *value += share * with);
}

/// Multiplies one row by the transposed Jacobian `by`. Not inlined, see [`PoseCovariance::update_one`].
#[inline(never)]
fn add_columns(row: &mut Row, with_right: f32, by: &[Row; 3]) {
    let (turn, left) = (row[HEADING], row[LEFT]);
    add(row, turn, &by[0]);
    add(row, left, &by[1]);
    add(row, with_right, &by[2]);
}
