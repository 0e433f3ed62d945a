//! Progress of all robots over time: the share of its straight line that each robot has driven, from 0 to 1.

use super::{turn_time, whole_millis};
use crate::Path;
use lightbots_base::{Limits, Piece, Span, Vec2};
use lightbots_show::Easing;

/// The progress of a drive: a rest at 0 in which robots turn, then a motion from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Profile {
    /// Duration of the rest.
    rest: Span,
    /// Parts of the motion from 0 to 1, in order; empty if no robot moves.
    beats: Vec<Beat>,
}

/// A part of the progress: a cubic Bézier function of time. It begins at the `end` of the part before it, the first
/// part at 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Beat {
    duration: Span,
    c1: f64,
    c2: f64,
    end: f64,
}

impl Profile {
    /// The fastest legal profile with this easing, in whole milliseconds, if the longest line has a length of
    /// `length_m` metres. Without any rest or motion if that length is below 1e-9 m. Limits below 0.001 count as 0.001.
    pub(crate) fn quickest(length_m: f64, easing: Easing, limits: &Limits) -> Self {
        if length_m < 1e-9 {
            return Self { rest: Span::ZERO, beats: Vec::new() };
        }
        let rest = turn_time(core::f64::consts::FRAC_PI_2, limits);
        let (speed, accel) = (limits.speed_mps.max(1e-3), limits.accel_mps2.max(1e-3));
        let beats = match easing {
            Easing::Swift => swift(length_m, speed, accel),
            Easing::Gentle => gentle(length_m, speed, accel),
        };
        Self { rest, beats }
    }

    /// The profile without its rest.
    pub(crate) fn without_rest(self) -> Self {
        Self { rest: Span::ZERO, ..self }
    }

    /// Duration of the profile, including its rest.
    pub(crate) fn duration(&self) -> Span {
        self.beats.iter().fold(self.rest, |sum, beat| sum + beat.duration)
    }

    /// The same profile, slowed down so that it lasts `total`; unchanged if it lasts that long already. The rest keeps
    /// its duration, except in a profile without motion, which becomes one rest.
    pub(crate) fn stretched(&self, total: Span) -> Self {
        let before = self.duration();
        if total <= before {
            return self.clone();
        }
        if self.beats.is_empty() {
            return Self { rest: total, beats: Vec::new() };
        }
        let factor = (total - self.rest).as_secs() / (before - self.rest).as_secs();
        let (mut old_end, mut new_end) = (Span::ZERO, Span::ZERO);
        let mut beats = self.beats.clone();
        for beat in &mut beats {
            old_end += beat.duration;
            let end = Span::from_secs(old_end.as_secs() * factor);
            beat.duration = end - new_end;
            new_end = end;
        }
        Self { rest: self.rest, beats }
    }

    /// The timed path of a robot on the straight line from `from` to `to` with this progress.
    pub(crate) fn path(&self, from: Vec2, to: Vec2) -> Path {
        let total = self.duration();
        if from == to {
            let pieces = if total > Span::ZERO { vec![Piece::rest(from, total)] } else { Vec::new() };
            return Path { start: from, pieces };
        }
        let mut pieces = Vec::with_capacity(self.beats.len() + 1);
        if self.rest > Span::ZERO {
            pieces.push(Piece::rest(from, self.rest));
        }
        pieces.extend(self.beats.iter().map(|beat| Piece {
            duration: beat.duration,
            c1: along(from, to, beat.c1),
            c2: along(from, to, beat.c2),
            end: along(from, to, beat.end),
        }));
        Path { start: from, pieces }
    }
}

/// `from.lerp(to, share)`, but exactly `to` at 1.
fn along(from: Vec2, to: Vec2, share: f64) -> Vec2 {
    if share >= 1.0 { to } else { from.lerp(to, share) }
}

/// Speed as a trapezoid over time: two ramps of equal duration, and a cruise between them unless the line is short.
fn swift(length_m: f64, speed: f64, accel: f64) -> Vec<Beat> {
    let short = length_m * accel < speed * speed;
    let ramp = whole_millis(if short { (length_m / accel).sqrt() } else { speed / accel });
    let cruise = if short { Span::ZERO } else { whole_millis(length_m / speed - ramp.as_secs()) };
    // A ramp makes half the progress of a cruise of the same duration.
    let unit = (ramp + cruise).as_secs();
    let (ramp_gain, cruise_gain) = (0.5 * ramp.as_secs() / unit, cruise.as_secs() / unit);
    let brake = ramp_gain + cruise_gain;
    // A quadratic a·u² as a cubic: control values 0, 0, a/3, a.
    let mut beats = vec![Beat { duration: ramp, c1: 0.0, c2: ramp_gain / 3.0, end: ramp_gain }];
    if cruise > Span::ZERO {
        let third = cruise_gain / 3.0;
        beats.push(Beat { duration: cruise, c1: ramp_gain + third, c2: brake - third, end: brake });
    }
    beats.push(Beat { duration: ramp, c1: 1.0 - ramp_gain / 3.0, c2: 1.0, end: 1.0 });
    beats
}

/// The cubic 3u² − 2u³ as progress: speed has no corner, and its peak is 1.5 times its mean.
fn gentle(length_m: f64, speed: f64, accel: f64) -> Vec<Beat> {
    let seconds = (1.5 * length_m / speed).max((6.0 * length_m / accel).sqrt());
    vec![Beat { duration: whole_millis(seconds), c1: 0.0, c2: 1.0, end: 1.0 }]
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits::ELISA_3;

    #[test]
    fn a_long_way_takes_the_bound_plus_turn_and_ramp() {
        // 2.7 m at 0.27 m/s: 10 s, a quarter turn of 0.35 s, a ramp of 0.27 s.
        let profile = Profile::quickest(2.7, Easing::Swift, &LIMITS);
        assert_eq!(profile.duration(), Span::from_millis(10_620));
    }

    #[test]
    fn speed_and_acceleration_stay_legal_at_every_length() {
        for easing in [Easing::Swift, Easing::Gentle] {
            for step in 1..400 {
                let length = f64::from(step) * 0.003_7;
                let profile = Profile::quickest(length, easing, &LIMITS);
                let path = profile.path(Vec2::ZERO, Vec2::new(length, 0.0));
                assert_eq!(path.as_ref().end(), Vec2::new(length, 0.0));
                let total = profile.duration();
                let mut before = 0.0;
                for part in 0..=100 {
                    let motion = path.as_ref().at(Span(total.0 * part / 100));
                    assert!(motion.velocity.x <= LIMITS.speed_mps + 1e-9);
                    assert!(motion.acceleration.x.abs() <= LIMITS.accel_mps2 + 1e-9);
                    assert!(motion.position.x >= before);
                    before = motion.position.x;
                }
            }
        }
    }

    #[test]
    fn pieces_join_without_a_step_in_speed() {
        let profile = Profile::quickest(0.5, Easing::Swift, &LIMITS).stretched(Span::from_secs(4.123_457));
        let path = profile.path(Vec2::new(0.1, -0.2), Vec2::new(0.5, 0.1));
        let mut before = Vec2::ZERO;
        for (start, _, piece) in path.as_ref().timed() {
            assert!((piece.at(start, Span::ZERO).velocity - before).length() < 1e-5);
            before = piece.at(start, piece.duration).velocity;
        }
        assert!(before.length() < 1e-9);
        assert_eq!(path.as_ref().duration(), Span::from_secs(4.123_457));
    }

    #[test]
    fn a_robot_that_stays_rests_as_long_as_the_others_drive() {
        let profile = Profile::quickest(1.0, Easing::Gentle, &LIMITS);
        let path = profile.path(Vec2::ZERO, Vec2::ZERO);
        assert_eq!(path.pieces, [Piece::rest(Vec2::ZERO, profile.duration())]);
        assert!(
            Profile::quickest(0.0, Easing::Swift, &LIMITS).path(Vec2::ZERO, Vec2::ZERO).pieces.is_empty()
        );
    }
}
