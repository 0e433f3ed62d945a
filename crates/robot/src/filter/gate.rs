//! Which fixes count: one far from what wheels and fixes before it say is an outlier, until so many agree with each other
//! that they must be the truth.

use lightbots_base::{Instant, Span, Vec2};

/// A fix further off than so many standard deviations, and than these floors, is an outlier.
const GATE: f64 = 5.0;
const GATE_FLOOR_M: f64 = 0.006;
const GATE_FLOOR_RAD: f64 = 0.1;
/// So many outliers in a row that agree are the truth: the pose jumps to it.
const OUTLIERS: u8 = 10;
/// Two jumps within this time make no sense.
const JUMPS_APART: Span = Span::from_millis(1000);

/// What to make of a fix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// It is left alone.
    Outlier,
    /// It says how far the filter is off.
    Inlier,
    /// It is the truth, whatever was believed.
    Jump,
}

/// What was odd lately, and when fixes came that were not.
#[derive(Debug, Default)]
pub(super) struct OutlierGate {
    odd_off: Vec2,
    last_jump: Option<Instant>,
    /// When the last fix of the place and of the heading came that counted.
    last_place: Option<Instant>,
    last_heading: Option<Instant>,
    odd_places: u8,
    odd_headings: u8,
    senseless: bool,
}

impl OutlierGate {
    /// A place is so far off; by how much it may be is the variance of what is believed and of the fix's noise.
    #[inline]
    pub(super) fn place(&mut self, now: Instant, off: Vec2, believed: f64, noise: f64) -> Verdict {
        let square = off.length_squared();
        let odd = square > GATE * GATE * (believed + noise) && square > GATE_FLOOR_M * GATE_FLOOR_M;
        let first = self.last_place.is_none();
        if odd && !first {
            let agrees = (off - self.odd_off).length_squared() < GATE * GATE * 2.0 * noise;
            // Those that agree with none count against those that agree with each other.
            self.odd_places = if agrees { self.odd_places + 1 } else { self.odd_places.saturating_sub(1) };
            if agrees || self.odd_places == 0 {
                self.odd_off = off;
                self.odd_places = self.odd_places.max(1);
            }
            if self.odd_places < OUTLIERS {
                return Verdict::Outlier;
            }
            self.senseless = self.last_jump.is_some_and(|jump| now - jump < JUMPS_APART);
            self.last_jump = Some(now);
        }
        self.odd_places = 0;
        self.last_place = Some(now);
        if odd || first { Verdict::Jump } else { Verdict::Inlier }
    }

    /// A heading is so far off, likewise; the first is the truth.
    #[inline]
    pub(super) fn heading(&mut self, now: Instant, off: f64, variance: f64, first: bool) -> Verdict {
        let odd = off * off > GATE * GATE * variance && off * off > GATE_FLOOR_RAD * GATE_FLOOR_RAD;
        if odd && !first {
            self.odd_headings += 1;
            if self.odd_headings < OUTLIERS {
                return Verdict::Outlier;
            }
        }
        self.odd_headings = 0;
        self.last_heading = Some(now);
        if odd || first { Verdict::Jump } else { Verdict::Inlier }
    }

    /// When the last fix of the place came that counted.
    pub(super) fn last_place(&self) -> Option<Instant> {
        self.last_place
    }

    /// When the last fix of the heading came that counted.
    pub(super) fn last_heading(&self) -> Option<Instant> {
        self.last_heading
    }

    /// Whether fixes and wheels have contradicted each other for longer than a shove explains. Asking clears it.
    pub(super) fn take_senseless(&mut self) -> bool {
        core::mem::take(&mut self.senseless)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOISE: f64 = 1e-6;

    #[test]
    fn what_is_far_off_ten_times_in_a_row_is_the_truth() {
        let mut judge = OutlierGate::default();
        let mut place = |ms: u64, x: f64| judge.place(Instant(ms * 1000), Vec2::new(x, 0.0), 0.0, NOISE);
        assert_eq!(place(0, 3.0), Verdict::Jump);
        assert_eq!(place(1, 0.004), Verdict::Inlier);
        assert!((2..11).all(|ms| place(ms, 0.5) == Verdict::Outlier));
        assert_eq!(place(11, 0.5), Verdict::Jump);
        assert_eq!(place(12, 0.004), Verdict::Inlier);
        assert!(!judge.take_senseless());
        let again = |ms: u64| judge.place(Instant(ms * 1000), Vec2::new(0.5, 0.0), 0.0, NOISE);
        assert_eq!((20..30).map(again).last(), Some(Verdict::Jump));
        assert!(judge.take_senseless() && !judge.take_senseless());
    }

    #[test]
    fn headings_are_judged_likewise() {
        let mut judge = OutlierGate::default();
        assert_eq!(judge.heading(Instant(1), 2.0, NOISE, true), Verdict::Jump);
        assert_eq!(judge.heading(Instant(2), 0.05, NOISE, false), Verdict::Inlier);
        assert_eq!(judge.heading(Instant(3), 0.2, NOISE, false), Verdict::Outlier);
        assert_eq!(judge.last_heading(), Some(Instant(2)));
        let last = (0..9).map(|n| judge.heading(Instant(4 + n), 0.2, NOISE, false)).last();
        assert_eq!(last, Some(Verdict::Jump));
    }
}
