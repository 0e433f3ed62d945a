//! A piece of light: a linear change of colour over a time of the show clock. A step within the piece need not look at
//! stretches and fades.
//!
//! While a stretch plays, most steps lie within a piece. They would be a quarter slower if
//! [`LightAhead`](crate::light_ahead::LightAhead) computed each colour.

use lightbots_base::{Instant, Rgb, Span};

/// Number of fractional bits of the fixed-point numbers in which colour codes are computed. Integers are quicker than
/// floating-point numbers.
const PARTS_BITS: u32 = 40;

/// The colours from one moment of the show clock to another, if no message and no fault comes in between.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightPiece {
    /// First moment of the piece, show clock. The piece lasts `lasts_us` microseconds, 0 if it covers no moment.
    from: Instant,
    lasts_us: u64,
    /// Code of each colour channel at `from` plus one half (for rounding), in fixed point. `changes`: change of the
    /// code in a microsecond.
    codes: [i64; 3],
    changes: [i64; 3],
}

impl LightPiece {
    /// A piece that covers no moment.
    pub(crate) const NONE: Self = Self { from: Instant::ZERO, lasts_us: 0, codes: [0; 3], changes: [0; 3] };

    /// The part within `from..until` (show clock) of a line of colours from `start` to `end`. The line begins at
    /// `begins` and takes `lasts`.
    pub(crate) fn new(
        (from, until): (Instant, Instant),
        (begins, lasts): (Instant, Span),
        (start, end): (Rgb, Rgb),
    ) -> Self {
        // One division: it takes longer than all else here.
        let parts_in_us = ((1u64 << PARTS_BITS) as f64 / lasts.0.max(1) as f64) as i64;
        let passed_us = (from - begins).0.clamp(0, lasts.0.max(0));
        let channels = [(start.r, end.r), (start.g, end.g), (start.b, end.b)];
        let changes = channels.map(|(start, end)| (i64::from(end) - i64::from(start)) * parts_in_us);
        let half = 1i64 << (PARTS_BITS - 1);
        let code = |channel: usize| {
            (i64::from(channels[channel].0) << PARTS_BITS) + half + changes[channel] * passed_us
        };
        let codes = [code(0), code(1), code(2)];
        let lasts_us = until.min(begins + lasts).0.saturating_sub(from.0);
        Self { from, lasts_us, codes, changes }
    }

    /// Whether the piece covers no moment.
    pub(crate) fn is_none(&self) -> bool {
        self.lasts_us == 0
    }

    /// The colour at a moment of the show clock; `None` if the piece does not cover that moment.
    #[inline]
    pub(crate) fn colour(&self, show: Instant) -> Option<Rgb> {
        // A moment before the piece wraps around to a large number.
        let passed_us = show.0.wrapping_sub(self.from.0);
        if passed_us >= self.lasts_us {
            return None;
        }
        let passed_us = passed_us as i64;
        let code =
            |channel: usize| ((self.codes[channel] + self.changes[channel] * passed_us) >> PARTS_BITS) as u8;
        Some(Rgb::new(code(0), code(1), code(2)))
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
