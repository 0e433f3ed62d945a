//! The first guess: everybody drives their shortest way with common progress, through each other if need be.

use lightbots_base::{Limits, Vec2};
use lightbots_show::Easing;

use super::scene::Scene;
use super::weave::Weave;

/// Spans aim at this long, seconds: as long as the smallest bend at full speed takes.
const SPAN_S: f64 = 0.25;
/// Spans a weave may have: a path holds 128 pieces.
pub(super) const MOST_SPANS: usize = 124;

/// How far everybody is at each moment, for a longest way.
pub(super) struct Pace {
    /// From start to end, seconds.
    pub drive_s: f64,
    ramp_s: f64,
}

impl Pace {
    /// The swiftest, or gentlest, for a longest way, stretched by `stretch`.
    pub fn new(longest_m: f64, limits: &Limits, easing: Easing, stretch: f64) -> Self {
        let (speed, accel) = (limits.speed_mps, limits.accel_mps2);
        let halves = 2.0 * (longest_m / accel).sqrt();
        let least = match easing {
            Easing::Swift if longest_m > speed * speed / accel => longest_m / speed + speed / accel,
            Easing::Swift => halves,
            Easing::Gentle => halves.max(2.0 * longest_m / speed),
        };
        let drive_s = least.max(0.4) * stretch;
        let ramp_s = match easing {
            Easing::Swift => (speed / accel).min(drive_s / 2.0),
            Easing::Gentle => drive_s / 2.0,
        };
        Self { drive_s, ramp_s }
    }

    /// The share of the way done after `t` seconds.
    pub fn share(&self, t: f64) -> f64 {
        let top = 1.0 / (self.drive_s - self.ramp_s);
        let ramp = |t: f64| top * t * t / (2.0 * self.ramp_s);
        if t <= 0.0 {
            0.0
        } else if t < self.ramp_s {
            ramp(t)
        } else if t <= self.drive_s - self.ramp_s {
            top * (t - self.ramp_s / 2.0)
        } else {
            1.0 - ramp((self.drive_s - t).max(0.0))
        }
    }
}

/// Everybody along their course at a pace. Straight courses bow to the right by `bow` of their length, to the left where that is negative, so that crowds
/// that meet head-on pass each other.
pub(super) fn along(scene: &Scene, courses: &[Vec<Vec2>], pace: &Pace, bow: f64) -> Weave {
    let spans = ((pace.drive_s / SPAN_S).ceil() as usize).clamp(6, MOST_SPANS);
    let span_s = pace.drive_s / spans as f64;
    let lengths: Vec<f64> = courses.iter().map(|course| length(course)).collect();
    Weave::new(scene, spans, span_s, |robot, step| {
        let (course, share) = (&courses[robot], pace.share(step as f64 * span_s));
        let place = point_along(course, lengths[robot] * share);
        // A bow that begins and ends straight ahead: 16 s²(1 − s)² is 1 half way.
        let aside = 16.0 * (share * (1.0 - share)) * (share * (1.0 - share)) * bow;
        match course[..] {
            [from, to] if bow != 0.0 => scene.on_floor(robot, place - (to - from).left() * aside),
            _ => place,
        }
    })
}

/// The length of a line through corners, metres.
pub(super) fn length(course: &[Vec2]) -> f64 {
    course.windows(2).map(|leg| leg[0].distance(leg[1])).sum()
}

/// The place `way_m` along a line through corners; a course has at least one.
pub(super) fn point_along(course: &[Vec2], mut way_m: f64) -> Vec2 {
    for leg in course.windows(2) {
        let length = leg[0].distance(leg[1]);
        if way_m < length {
            return leg[0].lerp(leg[1], way_m / length);
        }
        way_m -= length;
    }
    course.last().copied().unwrap_or(Vec2::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_keeps_the_limits_it_is_made_for() {
        for (longest, easing) in [(2.0, Easing::Swift), (0.05, Easing::Swift), (2.0, Easing::Gentle)] {
            let pace = Pace::new(longest, &Limits::ELISA_3, easing, 1.0);
            let at = |i: i32| longest * pace.share(pace.drive_s * f64::from(i) / 1000.0);
            let step = pace.drive_s / 1000.0;
            for i in 1..1000 {
                assert!((at(i + 1) - at(i)) / step <= 0.27 * 1.0001);
                assert!((at(i + 1) - 2.0 * at(i) + at(i - 1)).abs() / (step * step) <= 1.001);
            }
            assert!(at(0) == 0.0 && (at(1000) - longest).abs() < 1e-12);
        }
    }
}
