//! How sure the pose is: the covariance of an extended Kalman filter over place, heading and the slip of both wheels.
//!
//! What a fix corrects changes slowly, so the covariance is carried over several steps at once and its gains are used
//! in between: the filter then costs a few multiplications a step.

use core::hint::black_box;

use lightbots_base::Vec2;

/// Stage x and y, heading, slip of the left and the right wheel.
const X: usize = 0;
const Y: usize = 1;
const HEADING: usize = 2;
const LEFT: usize = 3;
const RIGHT: usize = 4;
const STATES: usize = 5;

/// Growth of the error of a robot that stands, for who is pushed, metres and radians a step.
const STANDING_M: f64 = 1e-5;
const STANDING_RAD: f64 = 5e-5;
/// Growth with the way and the turn beside slip, as shares: wheels are not quite round, nor at one distance.
const WAY: f64 = 0.01;
const TURN: f64 = 0.03;

type Row = [f64; STATES];

/// What the wheels did since the covariance was last carried on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stretch {
    /// Way in the stage, metres.
    pub moved: Vec2,
    /// How far the left and the right wheel would have gone without slip, metres.
    pub ways_m: [f64; 2],
    /// Turn, radians.
    pub turn: f64,
    /// Steps it took, and those of them in which the wheels turned.
    pub steps: u32,
    pub driven: u32,
}

/// Slip as it is expected to change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drift {
    /// What is left of a deviation from its mean after the stretch, 0 to 1.
    pub left: f64,
    /// Variance of the deviation in the long run.
    pub variance: f64,
}

/// Noise of what was measured during a stretch: its variance, over the number of measurements; infinite for none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    pub place: f64,
    pub heading: f64,
}

/// What a place off by one along x or y, or a heading off by one, corrects.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Gain {
    pub at: Vec2,
    pub turn: f64,
    pub slip: [f64; 2],
}

/// The covariance.
#[derive(Debug)]
#[repr(C)] // See `Robot`.
pub(crate) struct Doubt {
    /// What is asked for at every step, of the covariance as it is.
    place: f64,
    heading: f64,
    p: [Row; STATES],
}

impl Doubt {
    /// Nothing is known of the pose, and slip up to this (1 sigma).
    pub(crate) fn new(slip: f64) -> Self {
        let mut p = [[0.0; STATES]; STATES];
        for (state, sigma) in [1.0, 1.0, core::f64::consts::PI, slip, slip].into_iter().enumerate() {
            p[state][state] = sigma * sigma;
        }
        Self { place: p[X][X], heading: p[HEADING][HEADING], p }
    }

    fn sum_up(&mut self) {
        self.place = self.p[X][X].max(self.p[Y][Y]);
        self.heading = self.p[HEADING][HEADING];
    }

    /// Carries it over a stretch that ended facing this way.
    pub(crate) fn carry(&mut self, stretch: &Stretch, facing: Vec2, track_m: f64, drift: Drift) {
        let [left, right] = stretch.ways_m;
        let (half_left, half_right, by) = (-0.5 * left, -0.5 * right, 1.0 / track_m);
        let rows = [
            [-stretch.moved.y, facing.x * half_left, facing.x * half_right],
            [stretch.moved.x, facing.y * half_left, facing.y * half_right],
            [0.0, left * by, -right * by],
        ];
        let p = &mut self.p;
        let sources = [p[HEADING], p[LEFT], p[RIGHT]];
        for (row, factors) in p.iter_mut().zip(&rows) {
            for (source, factor) in sources.iter().zip(factors) {
                row.iter_mut().zip(source).for_each(|(value, with)| *value += factor * with);
            }
        }
        for row in p.iter_mut() {
            for (column, factors) in rows.iter().enumerate() {
                row[column] += factors[0] * row[HEADING] + factors[1] * row[LEFT] + factors[2] * row[RIGHT];
            }
            row[LEFT] *= drift.left;
            row[RIGHT] *= drift.left;
        }
        for wheel in [LEFT, RIGHT] {
            p[wheel].iter_mut().for_each(|both| *both *= drift.left);
            p[wheel][wheel] += (1.0 - drift.left * drift.left) * drift.variance;
        }
        let way = WAY * WAY * stretch.moved.length_squared();
        let steps = f64::from(stretch.steps);
        p[X][X] += way + steps * (STANDING_M * STANDING_M);
        p[Y][Y] += way + steps * (STANDING_M * STANDING_M);
        p[HEADING][HEADING] +=
            TURN * TURN * stretch.turn * stretch.turn + steps * (STANDING_RAD * STANDING_RAD);
        self.sum_up();
    }

    /// Takes in measurements of this noise.
    pub(crate) fn learn(&mut self, noise: Noise) {
        for (state, variance) in [(X, noise.place), (Y, noise.place), (HEADING, noise.heading)] {
            if variance.is_finite() {
                let seen = self.p[state];
                let share = 1.0 / (seen[state] + variance);
                for (row, &with) in self.p.iter_mut().zip(&seen) {
                    let gain = with * share;
                    for (both, &with) in row.iter_mut().zip(&seen) {
                        *both -= gain * with;
                    }
                }
            }
        }
        self.sum_up();
    }

    /// What one measurement of x, y and heading corrects, each by its variance.
    pub(crate) fn gains(&self, place: f64, heading: f64) -> [Gain; 3] {
        [(X, place), (Y, place), (HEADING, heading)].map(|(state, variance)| {
            let by = 1.0 / variance;
            let [x, y, turn, left, right] = self.p[state];
            Gain { at: Vec2::new(x, y) * by, turn: turn * by, slip: [left * by, right * by] }
        })
    }

    /// A new place, as sure as this variance, that has nothing to do with what was believed.
    pub(crate) fn set_place(&mut self, variance: f64) {
        self.set(X, variance);
        self.set(Y, variance);
    }

    /// A new heading, likewise.
    pub(crate) fn set_heading(&mut self, variance: f64) {
        self.set(HEADING, variance);
    }

    fn set(&mut self, state: usize, variance: f64) {
        self.p[state] = [0.0; STATES];
        self.p.iter_mut().for_each(|row| row[state] = 0.0);
        self.p[state][state] = variance;
        self.sum_up();
    }

    /// Variance of the place, the greater of both coordinates.
    pub(crate) fn place(&self) -> f64 {
        self.place
    }

    /// Reads a little of each cache line, in order: see `Robot::fetch`.
    #[inline]
    pub(crate) fn fetch(&self) {
        black_box((self.place, self.p[1][2], self.p[2][4], self.p[4][1], self.p[4][4]));
    }

    /// Variance of the heading.
    pub(crate) fn heading(&self) -> f64 {
        self.heading
    }

    /// Variance of the wheels' slip, in the mean of both.
    pub(crate) fn slip(&self) -> f64 {
        0.5 * (self.p[LEFT][LEFT] + self.p[RIGHT][RIGHT])
    }
}
