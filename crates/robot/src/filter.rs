//! The pose that wheel turns carry from step to step and fixes pull back, and how much the wheels slip, which both teach:
//! so it finds its way while fixes stay away.
//!
//! An extended Kalman filter over place, heading and the slip of both wheels; wild fixes are left alone.

mod gate;
#[cfg(test)]
mod tests;

use lightbots_base::{Instant, Limits, Span, Vec2, difference, wrap};

use crate::bearing::Bearing;
use crate::config::{Config, Fix};
use crate::covariance::{Gain, Noise, PoseCovariance, Stretch, correction, right_correction};
use crate::noise::NoiseEstimate;
use crate::slip::Slip;
use gate::{OutlierGate, Verdict};

/// Steps after which the covariance is carried on, …
const STRETCH: u32 = 4;
/// … but at once for so many fixes after a gap, as each of them teaches much.
const TEACHING: u8 = 8;
/// Fixes count as no better than this, because no positioning system is.
const BEST_FIX_M: f64 = 0.000_3;
const BEST_HEADING_RAD: f64 = 0.002;
/// Without a heading fix for so long, heading comes from motion.
const NO_COMPASS: Span = Span::from_millis(500);
/// A heading read from the way is as good as this, and only one further off than that is news to the filter, radians.
const BEARING_RAD: f64 = 0.03;
const BEARING_OFF_RAD: f64 = 0.2;

/// The pose, the slip, and how sure both are.
#[derive(Debug)]
pub(crate) struct Filter {
    at: Vec2,
    /// Unit vector of `heading`, turned along step by step: far cheaper than a sine and a cosine each time.
    facing: Vec2,
    heading: f64,
    aligned: bool,
    teaching: u8,
    wheel_radius_m: f64,
    track_m: f64,
    /// All the way by wheels, stage metres.
    way: Vec2,
    /// Since the covariance was carried on, and the fixes within: of places and of headings.
    stretch: Stretch,
    fixes: [u32; 2],
    slip: Slip,
    gate: OutlierGate,
    place_noise: NoiseEstimate,
    heading_noise: NoiseEstimate,
    /// What the fix before was off by, where it was no outlier.
    off: Option<(Vec2, f64)>,
    gains: [Gain; 3],
    covariance: PoseCovariance,
    bearing: Bearing,
}

impl Filter {
    pub(crate) fn new(config: &Config) -> Self {
        let Limits { wheel_radius_m, track_m, .. } = config.limits;
        let trust = |sigma: f64, best: f64| {
            NoiseEstimate::new(if sigma > best { sigma * sigma } else { best * best })
        };
        Self {
            at: Vec2::ZERO,
            heading: 0.0,
            facing: Vec2::new(1.0, 0.0),
            slip: Slip::new(config.slip),
            covariance: PoseCovariance::new(config.slip),
            gains: [Gain::default(); 3],
            stretch: Stretch::default(),
            fixes: [0; 2],
            teaching: TEACHING,
            place_noise: trust(config.fix_sigma_m, BEST_FIX_M),
            heading_noise: trust(config.heading_sigma_rad, BEST_HEADING_RAD),
            off: None,
            gate: OutlierGate::default(),
            aligned: false,
            way: Vec2::ZERO,
            bearing: Bearing::default(),
            wheel_radius_m,
            track_m,
        }
    }

    /// Carries the pose over one step by wheel turns, radians.
    pub(crate) fn advance(&mut self, turns_rad: [f64; 2]) {
        if self.stretch.steps >= STRETCH {
            self.carry();
        }
        self.stretch.steps += 1;
        self.slip.pass();
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

    /// Way (metres) and turn (radians) by wheel turns, with what is known of slip.
    pub(crate) fn motion(&self, turns_rad: [f64; 2]) -> (f64, f64) {
        let [left, right] = self.slip.ground(turns_rad.map(|turn| turn * self.wheel_radius_m));
        ((left + right) * 0.5, (right - left) / self.track_m)
    }

    /// Pulls the pose towards a fix. What is not a number is no fix.
    pub(crate) fn correct(&mut self, now: Instant, fix: &Fix) {
        let mut off = (Vec2::ZERO, 0.0);
        if fix.at.x.abs() < 1e3 && fix.at.y.abs() < 1e3 {
            off.0 = self.gate_place(now, fix.at - self.at);
            self.learn_heading(now, fix.at);
        }
        if let Some(heading) = fix.heading.filter(|heading| heading.is_finite()) {
            off.1 = self.gate_heading(now, difference(heading, self.heading));
        }
        self.pull(off);
    }

    /// Corrects all that a fix says something about by how far it is off.
    fn pull(&mut self, off: (Vec2, f64)) {
        let [places, headings] = self.fixes;
        if places + headings == 0 {
            return;
        }
        if let Some(before) = self.off.replace(off) {
            self.place_noise.learn(0.5 * (off.0 - before.0).length_squared());
            self.heading_noise.learn((off.1 - before.1) * (off.1 - before.1));
        }
        if self.teaching > 0 || self.stretch.steps >= STRETCH {
            self.teaching = self.teaching.saturating_sub(1);
            self.carry();
        }
        let (place, angle) = off;
        let innovation = [place.x, place.y, angle].map(|off| off as f32);
        let [x, y, turn, left] = correction(&self.gains, innovation);
        let right = right_correction(&self.gains, innovation);
        self.at += Vec2::new(f64::from(x), f64::from(y));
        self.slip.correct([f64::from(left), f64::from(right)]);
        self.turn_by(f64::from(turn));
    }

    /// Carries the covariance over the stretch behind and takes in what was measured on it.
    fn carry(&mut self) {
        let stretch = core::mem::take(&mut self.stretch);
        let [places, headings] = core::mem::take(&mut self.fixes);
        if places + headings == 0 {
            self.teaching = TEACHING;
            self.off = None;
        }
        self.covariance.carry(&stretch, self.facing, self.track_m, self.slip.drift(stretch.steps));
        let (place, heading) = (self.place_noise.variance(), self.heading_noise.variance());
        let share =
            |variance: f64, count: u32| if count > 0 { variance / f64::from(count) } else { f64::INFINITY };
        self.covariance.learn(Noise { place: share(place, places), heading: share(heading, headings) });
        self.gains = self.covariance.gains(place, heading);
        if stretch.driven > 0 {
            self.slip.learn(stretch.moved.length(), self.covariance.slip());
        }
    }

    /// How far the place is off by a fix that counts; nothing by one that does not.
    fn gate_place(&mut self, now: Instant, off: Vec2) -> Vec2 {
        let noise = self.place_noise.variance();
        match self.gate.place(now, off, self.covariance.place(), noise) {
            Verdict::Outlier => Vec2::ZERO,
            Verdict::Inlier => {
                self.fixes[0] += 1;
                off
            }
            Verdict::Jump => {
                self.at += off;
                self.covariance.set_place(noise);
                self.teaching = TEACHING;
                self.bearing.clear();
                Vec2::ZERO
            }
        }
    }

    /// How far the heading is off by a fix that counts; nothing by one that does not.
    fn gate_heading(&mut self, now: Instant, off: f64) -> f64 {
        let noise = self.heading_noise.variance();
        match self.gate.heading(now, off, self.covariance.heading() + noise, !self.aligned) {
            Verdict::Outlier => 0.0,
            Verdict::Inlier => {
                self.fixes[1] += 1;
                off
            }
            Verdict::Jump => {
                self.aligned = true;
                self.turn_by(off);
                self.covariance.set_heading(noise);
                self.teaching = TEACHING;
                0.0
            }
        }
    }

    /// Without a compass: reads the heading from the way until the filter can follow it.
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

    /// What of their turning the wheels lose, left and right.
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

    /// When the last fix came that counted.
    pub(crate) fn last_fix(&self) -> Option<Instant> {
        self.gate.last_place()
    }

    /// Variance of the place in each coordinate.
    pub(crate) fn variance(&self) -> f64 {
        self.covariance.place()
    }

    /// How far so much way without a fix leads aside, metres, 1 sigma: by the heading, and by slip that bends it.
    pub(crate) fn strays_m(&self, way_m: f64) -> f64 {
        let bend = way_m / self.track_m * core::f64::consts::FRAC_1_SQRT_2;
        way_m * (libm::sqrt(self.covariance.heading()) + bend * libm::sqrt(self.covariance.slip()))
    }

    /// What so much way without a fix adds to the variance of the place: the heading leads it astray, and slip that
    /// nobody sees bends the way further.
    pub(crate) fn drift(&self, way_m: f64) -> f64 {
        let bend_m = way_m / self.track_m * way_m;
        way_m * way_m * self.covariance.heading() + 0.5 * bend_m * bend_m * self.covariance.slip()
    }

    /// Whether fixes and wheels have contradicted each other for longer than a shove explains. Asking clears it.
    pub(crate) fn take_senseless(&mut self) -> bool {
        self.gate.take_senseless()
    }
}

/// `facing` turned by a small angle: series to the fifth order, right to 1e-9 below 0.1 rad, brought back to length 1.
pub(crate) fn turned(facing: Vec2, turn: f64) -> Vec2 {
    let square = turn * turn;
    let sin = turn * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)));
    let cos = 1.0 - square * (0.5 - square * (1.0 / 24.0));
    let new = Vec2::new(facing.x * cos - facing.y * sin, facing.x * sin + facing.y * cos);
    new * (1.5 - 0.5 * new.length_squared())
}
