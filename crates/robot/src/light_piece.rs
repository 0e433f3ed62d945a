//! A piece of light that needs no look at stretches, fades or faults: a straight line of colours over a part of the show
//! clock.
//!
//! Most steps lie within one. What [`LightAhead`](crate::light_ahead::LightAhead) has to do for a colour would make them a
//! quarter slower.

use lightbots_base::{Instant, Rgb, Span};

/// Colours from one moment of the show clock to another, if no message comes between.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightPiece {
    /// First moment, and the one after the last.
    from: Instant,
    until: Instant,
    /// When its line begins; not after `from`.
    begins: Instant,
    /// One over the duration of the line, in microseconds.
    per_us: f64,
    start: Rgb,
    end: Rgb,
}

impl LightPiece {
    /// A piece without a moment.
    pub(crate) const NONE: Self = Self {
        from: Instant::FAR,
        until: Instant::ZERO,
        begins: Instant::ZERO,
        per_us: 0.0,
        start: Rgb::BLACK,
        end: Rgb::BLACK,
    };

    /// A line of colours that takes `lasts` from `begins` on, as far as it lies within `from..until`.
    pub(crate) fn new(
        (from, until): (Instant, Instant),
        (begins, lasts): (Instant, Span),
        (start, end): (Rgb, Rgb),
    ) -> Self {
        let until = until.min(begins + lasts);
        Self { from, until, begins, per_us: 1.0 / lasts.0.max(1) as f64, start, end }
    }

    /// Whether it has no moment.
    pub(crate) fn is_none(&self) -> bool {
        self.until <= self.from
    }

    /// The colour at a moment of the show clock; `None`: the piece says nothing about it.
    #[inline]
    pub(crate) fn colour(&self, show: Instant) -> Option<Rgb> {
        if show < self.from || show >= self.until {
            return None;
        }
        Some(self.start.mixed(self.end, (show - self.begins).0 as f64 * self.per_us))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_has_the_colours_of_its_line_and_none_outside_of_its_moments() {
        let line = (Instant(1_000), Span(1_000));
        let piece =
            LightPiece::new((Instant(1_500), Instant(1_800)), line, (Rgb::BLACK, Rgb::new(200, 0, 100)));
        let at = |us: u64| piece.colour(Instant(us));
        assert_eq!(
            [1_499, 1_500, 1_799, 1_800].map(at),
            [None, Some(Rgb::new(100, 0, 50)), Some(Rgb::new(160, 0, 80)), None]
        );
        let long = LightPiece::new((Instant(1_500), Instant::FAR), line, (Rgb::BLACK, Rgb::BLACK));
        assert_eq!([1_999, 2_000].map(|us| long.colour(Instant(us))), [Some(Rgb::BLACK), None]);
        assert_eq!(LightPiece::NONE.colour(Instant(5)), None);
    }
}
