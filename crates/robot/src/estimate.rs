//! Where the robot is: wheel turns carry the pose from step to step, fixes pull it back.
//!
//! Place and heading are two scalar Kalman filters. Wheel slip is not white noise: it leans the same way for a while, so
//! it makes the standard deviation (not the variance) grow with the way, which keeps the error estimate honest when
//! fixes drop out.

use lightbots_base::{Instant, Limits, Pose, Span, Vec2, difference, wrap};

use crate::bearing::Bearing;
use crate::config::{Config, Fix};
use crate::trail::Trail;

/// Growth of the error with the way. Wheels may slip by 3 %, but seldom both the same way.
const SLIP: f64 = 0.02;
/// Growth of the error of a robot that stands, for who is pushed, metres and radians a step.
const STANDING_M: f64 = 4e-6;
const STANDING_RAD: f64 = 2e-5;
/// A heading known no better than this bends the reckoned way more than slip does.
const CALM_RAD: f64 = 0.015;
/// A fix further off than so many standard deviations, and than these floors, is an outlier.
const GATE: f64 = 5.0;
const GATE_FLOOR_M: f64 = 0.006;
const GATE_FLOOR_RAD: f64 = 0.1;
/// So many outliers in a row are the truth: the pose jumps to it.
const OUTLIERS: u8 = 10;
/// Two jumps within this time make no sense.
const JUMPS_APART: Span = Span::from_millis(1000);
/// Lost with an error estimate above this, metres, or without a fix for so long.
const LOST_M: f64 = 0.015;
const LOST_AFTER: Span = Span::from_millis(3000);
/// Fixes count as no better than this, because no positioning system is.
const BEST_FIX_M: f64 = 0.000_3;
const BEST_HEADING_RAD: f64 = 0.002;
/// Without a heading fix for so long, heading comes from motion.
const NO_COMPASS: Span = Span::from_millis(500);

/// The estimated pose and how sure it is.
#[derive(Debug)]
pub(crate) struct Estimate {
    at: Vec2,
    heading: f64,
    /// Unit vector of `heading`, turned along step by step: far cheaper than a sine and a cosine each time.
    facing: Vec2,
    sigma_m: f64,
    sigma_rad: f64,
    last_fix: Option<Instant>,
    last_heading: Option<Instant>,
    aligned: bool,
    odd_places: u8,
    odd_headings: u8,
    last_jump: Option<Instant>,
    senseless: bool,
    trail: Trail,
    bearing: Bearing,
    wheel_radius_m: f64,
    track_m: f64,
    fix_variance: f64,
    heading_variance: f64,
}

impl Estimate {
    pub(crate) fn new(config: &Config) -> Self {
        let Limits { wheel_radius_m, track_m, .. } = config.limits;
        let square = |sigma: f64, best: f64| if sigma > best { sigma * sigma } else { best * best };
        Self {
            at: Vec2::ZERO,
            heading: 0.0,
            facing: Vec2::new(1.0, 0.0),
            sigma_m: 1.0,
            sigma_rad: core::f64::consts::PI,
            last_fix: None,
            last_heading: None,
            aligned: false,
            odd_places: 0,
            odd_headings: 0,
            last_jump: None,
            senseless: false,
            trail: Trail::new(config.fix_delay),
            bearing: Bearing::default(),
            wheel_radius_m,
            track_m,
            fix_variance: square(config.fix_sigma_m, BEST_FIX_M),
            heading_variance: square(config.heading_sigma_rad, BEST_HEADING_RAD),
        }
    }

    /// Carries the pose over one step by wheel turns, radians.
    pub(crate) fn advance(&mut self, now: Instant, turns_rad: [f64; 2]) {
        let [left, right] = turns_rad.map(|turn| turn * self.wheel_radius_m);
        let (way, turn) = ((left + right) * 0.5, (right - left) / self.track_m);
        let before = self.facing;
        if turn != 0.0 {
            self.turn_by(turn);
        }
        let moved = (before + self.facing) * (0.5 * way);
        self.at += moved;
        let (way, turned) = (way.abs(), turn.abs());
        self.sigma_m += way * (SLIP + (self.sigma_rad - CALM_RAD).max(0.0)) + STANDING_M;
        self.sigma_rad +=
            SLIP * (turned + way * core::f64::consts::FRAC_1_SQRT_2 / self.track_m) + STANDING_RAD;
        self.trail.add(now, moved, turn);
    }

    /// Pulls the pose towards a fix. What is not a number is no fix.
    pub(crate) fn correct(&mut self, now: Instant, fix: &Fix) {
        let then = self.trail.before();
        let travelled = self.trail.now();
        if fix.at.is_finite() && fix.at.x.abs() < 1e3 && fix.at.y.abs() < 1e3 {
            self.correct_place(now, fix.at + (travelled.way - then.way));
            self.learn_heading(now, then.way, fix.at);
        }
        if let Some(heading) = fix.heading.filter(|heading| heading.is_finite()) {
            self.correct_heading(now, heading + (travelled.turn - then.turn));
        }
    }

    fn correct_place(&mut self, now: Instant, seen: Vec2) {
        let off = seen - self.at;
        let variance = self.sigma_m * self.sigma_m;
        let sum = variance + self.fix_variance;
        let odd = off.length_squared() > (GATE * GATE * sum).max(GATE_FLOOR_M * GATE_FLOOR_M);
        if odd && self.last_fix.is_some() {
            self.odd_places += 1;
            if self.odd_places < OUTLIERS {
                return;
            }
            self.senseless = self.last_jump.is_some_and(|jump| now - jump < JUMPS_APART);
            self.last_jump = Some(now);
            self.bearing.clear();
        }
        self.odd_places = 0;
        let gain = if odd || self.last_fix.is_none() { 1.0 } else { variance / sum };
        self.at += off * gain;
        self.sigma_m =
            if gain < 1.0 { self.sigma_m * libm::sqrt(1.0 - gain) } else { libm::sqrt(self.fix_variance) };
        self.last_fix = Some(now);
    }

    fn correct_heading(&mut self, now: Instant, seen: f64) {
        let off = difference(seen, self.heading);
        let variance = self.sigma_rad * self.sigma_rad;
        let sum = variance + self.heading_variance;
        let odd = off * off > (GATE * GATE * sum).max(GATE_FLOOR_RAD * GATE_FLOOR_RAD);
        if odd && self.aligned {
            self.odd_headings += 1;
            if self.odd_headings < OUTLIERS {
                return;
            }
        }
        self.odd_headings = 0;
        let fresh = odd || !self.aligned;
        let gain = if fresh { 1.0 } else { variance / sum };
        self.turn_by(off * gain);
        self.sigma_rad =
            if fresh { libm::sqrt(self.heading_variance) } else { self.sigma_rad * libm::sqrt(1.0 - gain) };
        self.aligned = true;
        self.last_heading = Some(now);
    }

    /// Without a compass: reads the heading from the way.
    fn learn_heading(&mut self, now: Instant, by_wheels: Vec2, by_fix: Vec2) {
        if self.last_heading.is_some_and(|seen| now - seen < NO_COMPASS) {
            return;
        }
        if let Some(turn) = self.bearing.add(by_wheels, by_fix) {
            self.turn_by(if self.aligned { turn * 0.5 } else { turn });
            self.sigma_rad = 0.03;
            self.aligned = true;
        }
    }

    fn turn_by(&mut self, turn: f64) {
        self.heading = wrap(self.heading + turn);
        self.facing = if turn.abs() < 0.1 { turned(self.facing, turn) } else { Vec2::unit(self.heading) };
    }

    /// The place, unless the robot is lost.
    pub(crate) fn place(&self, now: Instant) -> Option<Vec2> {
        (!self.lost(now)).then_some(self.at)
    }

    /// The place as far as it is known.
    pub(crate) fn at(&self) -> Vec2 {
        self.at
    }

    /// Unit vector of the heading.
    pub(crate) fn facing(&self) -> Vec2 {
        self.facing
    }

    /// Whether the heading is known.
    pub(crate) fn aligned(&self) -> bool {
        self.aligned
    }

    /// The pose, unless the robot is lost or does not know its heading yet.
    pub(crate) fn pose(&self, now: Instant) -> Option<Pose> {
        (self.aligned && !self.lost(now)).then_some(Pose::new(self.at, self.heading))
    }

    /// Expected error of the place, 1 sigma in each coordinate, metres.
    pub(crate) fn error_m(&self) -> f64 {
        self.sigma_m
    }

    /// Whether it knows too little to drive.
    pub(crate) fn lost(&self, now: Instant) -> bool {
        self.sigma_m > LOST_M || self.last_fix.is_none_or(|fix| now - fix > LOST_AFTER)
    }

    /// Whether fixes and wheels have contradicted each other for longer than a shove explains. Asking clears it.
    pub(crate) fn take_senseless(&mut self) -> bool {
        core::mem::take(&mut self.senseless)
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

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::RobotId;

    fn estimate() -> Estimate {
        Estimate::new(&Config::new(RobotId::new("r").unwrap()))
    }

    fn fix(x: f64, heading: f64) -> Fix {
        Fix { at: Vec2::new(x, 0.0), heading: Some(heading) }
    }

    #[test]
    fn turning_in_small_steps_keeps_facing_and_heading_together() {
        let mut one = estimate();
        for step in 0..100_000u64 {
            one.advance(Instant(step * 16_000), [-0.3, 0.31]);
        }
        assert!((one.facing - Vec2::unit(one.heading)).length() < 1e-6);
    }

    #[test]
    fn one_wild_fix_is_left_alone_and_ten_are_believed() {
        let mut one = estimate();
        for step in 0..50 {
            one.correct(Instant(step), &fix(0.1, 0.0));
        }
        one.correct(Instant(60), &fix(0.9, 0.0));
        assert!((one.at.x - 0.1).abs() < 1e-9);
        for step in 0..10 {
            one.correct(Instant(61 + step), &fix(0.9, 2.0));
        }
        assert!((one.at.x - 0.9).abs() < 1e-9);
        assert!((one.heading - 2.0).abs() < 1e-9);
        assert!(!one.take_senseless());
    }

    #[test]
    fn dead_reckoning_ends_in_being_lost() {
        let mut one = estimate();
        assert!(one.lost(Instant(0)));
        one.correct(Instant(0), &fix(0.0, 0.0));
        assert!(!one.lost(Instant(2_900_000)));
        assert!(one.lost(Instant(3_100_000)));
        let mut steps = 0;
        while !one.lost(Instant(0)) {
            steps += 1;
            one.advance(Instant(steps * 16_000), [0.96, 0.96]);
        }
        assert!((20..120).contains(&steps), "{steps}");
        assert!(one.error_m() > LOST_M);
    }

    #[test]
    fn what_is_not_a_number_is_no_fix() {
        let mut one = estimate();
        one.correct(Instant(0), &Fix { at: Vec2::new(f64::NAN, 0.0), heading: Some(f64::INFINITY) });
        assert!(one.lost(Instant(0)) && !one.aligned());
    }
}
