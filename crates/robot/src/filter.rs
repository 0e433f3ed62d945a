//! An extended Kalman filter over place, heading and the slip of both wheels (Thrun, Burgard and Fox, "Probabilistic
//! Robotics", 2005, section 3.3).
//!
//! Odometry predicts the state, position and heading fixes correct it, and an outlier gate rejects implausible fixes.
//! Because the slip is part of the state, dead reckoning stays good while no fixes come.

mod gate;
#[cfg(test)]
mod tests;

use lightbots_base::{Instant, Limits, Span, Vec2, difference, wrap};

use crate::bearing::Bearing;
use crate::config::{Config, Fix};
use crate::covariance::{Gain, MotionSegment, Noise, PoseCovariance, correction, right_correction};
use crate::noise::NoiseEstimate;
use crate::slip::SlipEstimate;
use gate::{GateResult, OutlierGate};

/// Largest number of steps between two propagations of the covariance. With a smaller value, the filter costs more
/// time. With a larger value, the Kalman gains in use are too old.
const STRETCH: u32 = 4;
/// After power-on, a gap without fixes, or a jump, the covariance is propagated at each of this number of fixes. These
/// fixes change the Kalman gains a lot. With a larger value, the filter costs more time after each gap.
const TEACHING: u8 = 8;
/// Lower bound of the assumed noise of a position fix, metres, 1 sigma. With a smaller value, a configuration with too
/// little noise makes the filter reject good fixes.
const BEST_FIX_M: f64 = 0.000_3;
/// Lower bound of the assumed noise of a heading fix, radians, 1 sigma. See [`BEST_FIX_M`].
const BEST_HEADING_RAD: f64 = 0.002;
/// Time without a heading fix after which the heading is computed from the robot's motion.
const NO_COMPASS: Span = Span::from_millis(500);
/// Error of a heading that is computed from motion, radians, 1 sigma: 2 mm of noise over 60 mm.
const BEARING_RAD: f64 = 0.03;
/// A heading from motion replaces a known heading only if both differ by more than this, radians. With a smaller value,
/// noise of the motion spoils a heading that is known.
const BEARING_OFF_RAD: f64 = 0.2;

/// Estimate of the pose and of the wheels' slip, with its covariance.
#[derive(Debug)]
pub(crate) struct Filter {
    at: Vec2,
    /// Unit vector of `heading`. Rotating it step by step is far cheaper than a sine and a cosine.
    facing: Vec2,
    heading: f64,
    aligned: bool,
    teaching: u8,
    wheel_radius_m: f64,
    track_m: f64,
    /// Displacement of the robot since power-on by odometry, without corrections by position fixes, stage metres.
    way: Vec2,
    /// Motion of the robot since the covariance was last propagated.
    stretch: MotionSegment,
    /// Number of inlier fixes since the covariance was last propagated: of the place, of the heading.
    fixes: [u32; 2],
    slip: SlipEstimate,
    gate: OutlierGate,
    place_noise: NoiseEstimate,
    heading_noise: NoiseEstimate,
    /// Innovations of the fix before the present one: place in metres and heading in radians, zero for an outlier or a
    /// jump. `None` before the first fix and after a gap without fixes.
    off: Option<(Vec2, f64)>,
    gains: [Gain; 3],
    covariance: PoseCovariance,
    bearing: Bearing,
}

impl Filter {
    pub(crate) fn new(config: &Config) -> Self {
        let Limits { wheel_radius_m, track_m, .. } = config.limits;
        let noise = |sigma: f64, best: f64| {
            NoiseEstimate::new(if sigma > best { sigma * sigma } else { best * best })
        };
        Self {
            at: Vec2::ZERO,
            heading: 0.0,
            facing: Vec2::new(1.0, 0.0),
            slip: SlipEstimate::new(config.slip),
            covariance: PoseCovariance::new(config.slip),
            gains: [Gain::default(); 3],
            stretch: MotionSegment::default(),
            fixes: [0; 2],
            teaching: TEACHING,
            place_noise: noise(config.fix_sigma_m, BEST_FIX_M),
            heading_noise: noise(config.heading_sigma_rad, BEST_HEADING_RAD),
            off: None,
            gate: OutlierGate::default(),
            aligned: false,
            way: Vec2::ZERO,
            bearing: Bearing::default(),
            wheel_radius_m,
            track_m,
        }
    }

    /// Predicts the pose over one step from the turns of the left and the right wheel, radians.
    pub(crate) fn advance(&mut self, turns_rad: [f64; 2]) {
        if self.stretch.steps >= STRETCH {
            self.propagate();
        }
        self.stretch.steps += 1;
        self.slip.predict();
        if turns_rad == [0.0; 2] {
            return;
        }
        let (way, turn) = self.motion(turns_rad);
        let before = self.facing;
        if turn != 0.0 {
            self.turn_by(turn);
        }
        let moved = (before + self.facing) * (0.5 * way);
        self.at += moved;
        self.way += moved;
        self.stretch.moved += moved;
        self.stretch.ways_m[0] += turns_rad[0] * self.wheel_radius_m;
        self.stretch.ways_m[1] += turns_rad[1] * self.wheel_radius_m;
        self.stretch.turn += turn;
        self.stretch.driven += 1;
    }

    /// Distance (metres, forwards) and rotation (radians, counter-clockwise) of the robot for turns of the left and the
    /// right wheel, radians. The estimated slip is subtracted.
    pub(crate) fn motion(&self, turns_rad: [f64; 2]) -> (f64, f64) {
        let [left, right] = self.slip.ground_m(turns_rad.map(|turn| turn * self.wheel_radius_m));
        ((left + right) * 0.5, (right - left) / self.track_m)
    }

    /// Corrects the state by a fix that arrived at `now`. A heading that is not finite is ignored, and so is a place
    /// with a coordinate that is NaN or at least 1 km.
    pub(crate) fn correct(&mut self, now: Instant, fix: &Fix) {
        let mut off = (Vec2::ZERO, 0.0);
        if fix.at.x.abs() < 1e3 && fix.at.y.abs() < 1e3 {
            off.0 = self.gate_place(now, fix.at - self.at);
            self.learn_heading(now, fix.at);
        }
        if let Some(heading) = fix.heading.filter(|heading| heading.is_finite()) {
            off.1 = self.gate_heading(now, difference(heading, self.heading));
        }
        self.apply(off);
    }

    /// Corrects pose and slip by the innovations of place (metres) and heading (radians) times the Kalman gains. Also
    /// updates the noise estimates. Does nothing if all fixes since the last propagation were outliers or jumps.
    fn apply(&mut self, off: (Vec2, f64)) {
        let [places, headings] = self.fixes;
        if places + headings == 0 {
            return;
        }
        if let Some(before) = self.off.replace(off) {
            self.place_noise.update(0.5 * (off.0 - before.0).length_squared());
            self.heading_noise.update((off.1 - before.1) * (off.1 - before.1));
        }
        if self.teaching > 0 || self.stretch.steps >= STRETCH {
            self.teaching = self.teaching.saturating_sub(1);
            self.propagate();
        }
        let (place, angle) = off;
        let innovation = [place.x, place.y, angle].map(|off| off as f32);
        let [x, y, turn, left] = correction(&self.gains, innovation);
        let right = right_correction(&self.gains, innovation);
        self.at += Vec2::new(f64::from(x), f64::from(y));
        self.slip.correct([f64::from(left), f64::from(right)]);
        self.turn_by(f64::from(turn));
    }

    /// Propagates the covariance over the steps since the last propagation, updates it by the fixes of these steps, and
    /// computes the Kalman gains.
    fn propagate(&mut self) {
        let stretch = core::mem::take(&mut self.stretch);
        let [places, headings] = core::mem::take(&mut self.fixes);
        if places + headings == 0 {
            self.teaching = TEACHING;
            self.off = None;
        }
        self.covariance.propagate(&stretch, self.facing, self.track_m, self.slip.drift(stretch.steps));
        let (place, heading) = (self.place_noise.variance(), self.heading_noise.variance());
        let share =
            |variance: f64, count: u32| if count > 0 { variance / f64::from(count) } else { f64::INFINITY };
        self.covariance.update(Noise { place: share(place, places), heading: share(heading, headings) });
        self.gains = self.covariance.gains(place, heading);
        if stretch.driven > 0 {
            self.slip.learn(stretch.moved.length(), self.covariance.slip());
        }
    }

    /// Tests a position fix by its innovation `off`, metres. Returns the innovation to apply: zero for an outlier. For
    /// a jump, moves the estimated place to the fix and also returns zero.
    fn gate_place(&mut self, now: Instant, off: Vec2) -> Vec2 {
        let noise = self.place_noise.variance();
        match self.gate.place(now, off, self.covariance.place(), noise) {
            GateResult::Outlier => Vec2::ZERO,
            GateResult::Inlier => {
                self.fixes[0] += 1;
                off
            }
            GateResult::Jump => {
                self.at += off;
                self.covariance.set_place(noise);
                self.teaching = TEACHING;
                self.bearing.clear();
                Vec2::ZERO
            }
        }
    }

    /// Tests a heading fix by its innovation `off`, radians. Returns the innovation to apply: zero for an outlier. For
    /// a jump, sets the estimated heading to the fix and also returns zero.
    fn gate_heading(&mut self, now: Instant, off: f64) -> f64 {
        let noise = self.heading_noise.variance();
        match self.gate.heading(now, off, self.covariance.heading(), noise, !self.aligned) {
            GateResult::Outlier => 0.0,
            GateResult::Inlier => {
                self.fixes[1] += 1;
                off
            }
            GateResult::Jump => {
                self.aligned = true;
                self.turn_by(off);
                self.covariance.set_heading(noise);
                self.teaching = TEACHING;
                0.0
            }
        }
    }

    /// If no heading fix came for [`NO_COMPASS`], sets the heading from the robot's motion: if the heading is unknown,
    /// or wrong by more than [`BEARING_OFF_RAD`]. `by_fix`: place of the present fix, stage metres.
    fn learn_heading(&mut self, now: Instant, by_fix: Vec2) {
        if self.gate.last_heading().is_some_and(|seen| now - seen < NO_COMPASS) {
            return;
        }
        if let Some(turn) = self.bearing.add(self.way, by_fix)
            && (!self.aligned || turn.abs() > BEARING_OFF_RAD)
        {
            self.turn_by(turn);
            self.covariance.set_heading(BEARING_RAD * BEARING_RAD);
            self.aligned = true;
        }
    }

    fn turn_by(&mut self, turn: f64) {
        self.heading = wrap(self.heading + turn);
        self.facing = if turn.abs() < 0.1 { turned(self.facing, turn) } else { Vec2::unit(self.heading) };
    }

    /// Estimated slip of the left and the right wheel: the share of their turning that does not move the robot.
    pub(crate) fn slip(&self) -> [f64; 2] {
        self.slip.now()
    }

    /// The place, stage metres.
    pub(crate) fn at(&self) -> Vec2 {
        self.at
    }

    /// The heading, radians in the stage.
    pub(crate) fn heading(&self) -> f64 {
        self.heading
    }

    /// Unit vector of the heading.
    pub(crate) fn facing(&self) -> Vec2 {
        self.facing
    }

    /// Whether the heading is known.
    pub(crate) fn aligned(&self) -> bool {
        self.aligned
    }

    /// When the last position fix arrived that was no outlier; `None` if there was none.
    pub(crate) fn last_fix(&self) -> Option<Instant> {
        self.gate.last_place()
    }

    /// Variance of the estimated place, square metres: the larger one of the variances of x and y.
    pub(crate) fn variance(&self) -> f64 {
        self.covariance.place()
    }

    /// Error that driving `way_m` metres without a fix adds to the place, metres, 1 sigma. It assumes that heading
    /// error and slip error stay constant, and adds both linearly.
    pub(crate) fn strays_m(&self, way_m: f64) -> f64 {
        let bend = way_m / self.track_m * core::f64::consts::FRAC_1_SQRT_2;
        way_m * (libm::sqrt(self.covariance.heading()) + bend * libm::sqrt(self.covariance.slip()))
    }

    /// Variance that driving `way_m` metres without a fix adds to the place, square metres. It comes from the heading
    /// error and from the slip error, which count as independent.
    pub(crate) fn drift(&self, way_m: f64) -> f64 {
        let bend_m = way_m / self.track_m * way_m;
        way_m * way_m * self.covariance.heading() + 0.5 * bend_m * bend_m * self.covariance.slip()
    }

    /// Returns how far outlier fixes have moved the place by jumps since the last call, metres; 0 if there was no jump.
    pub(crate) fn take_jump_m(&mut self) -> f64 {
        self.gate.take_jump_m()
    }

    /// Returns whether the place jumped twice within a second, which no push of the robot explains. The call clears the
    /// flag.
    pub(crate) fn take_senseless(&mut self) -> bool {
        self.gate.take_senseless()
    }
}

/// Returns the unit vector `facing` rotated by a small angle `turn`, radians. It uses a Taylor series (error below 1e-9
/// up to 0.1 rad) and scales the result to length 1.
pub(crate) fn turned(facing: Vec2, turn: f64) -> Vec2 {
    let square = turn * turn;
    let sin = turn * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)));
    let cos = 1.0 - square * (0.5 - square * (1.0 / 24.0));
    let new = Vec2::new(facing.x * cos - facing.y * sin, facing.x * sin + facing.y * cos);
    new * (1.5 - 0.5 * new.length_squared())
}
