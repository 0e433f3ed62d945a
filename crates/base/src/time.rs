//! Instants and spans, in whole microseconds: exact, ordered, the same on every machine. Sums, differences and products
//! saturate instead of wrapping.

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A point in time: microseconds since a start that all compared instants share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Instant(pub u64);

/// A length of time in microseconds; negative means backwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Span(pub i64);

impl Instant {
    /// The start of the count.
    pub const ZERO: Self = Self(0);
    /// The latest instant, for what never happens.
    pub const FAR: Self = Self(u64::MAX);

    /// Seconds since the start.
    pub const fn as_secs(self) -> f64 {
        self.0 as f64 / 1e6
    }

    /// The instant `seconds` after the start, rounded to the microsecond. Negative values and NaN give the start.
    pub fn from_secs(seconds: f64) -> Self {
        Self(libm::round(seconds * 1e6) as u64)
    }

    /// Time from `earlier` to this instant; negative if `earlier` is later. Saturates if a [`Span`] cannot hold it.
    pub const fn since(self, earlier: Self) -> Span {
        let (apart, is_ahead) = self.0.overflowing_sub(earlier.0);
        let apart = apart as i64;
        // The difference fits where its sign agrees with the order. Both are the usual case and cost one comparison.
        if (apart < 0) == is_ahead {
            return Span(apart);
        }
        Span(if is_ahead { -i64::MAX } else { i64::MAX })
    }
}

impl Span {
    /// A span of zero length.
    pub const ZERO: Self = Self(0);

    /// A span of whole milliseconds.
    pub const fn from_millis(millis: i64) -> Self {
        Self(millis * 1000)
    }

    /// A span of `seconds`, rounded to the microsecond; NaN gives zero.
    pub fn from_secs(seconds: f64) -> Self {
        Self(libm::round(seconds * 1e6) as i64)
    }

    /// The length in seconds.
    pub const fn as_secs(self) -> f64 {
        self.0 as f64 / 1e6
    }
}

impl Add<Span> for Instant {
    type Output = Self;
    fn add(self, span: Span) -> Self {
        Self(self.0.saturating_add_signed(span.0))
    }
}

impl AddAssign<Span> for Instant {
    fn add_assign(&mut self, span: Span) {
        *self = *self + span;
    }
}

impl Sub<Span> for Instant {
    type Output = Self;
    fn sub(self, span: Span) -> Self {
        Self(self.0.saturating_add_signed(span.0.saturating_neg()))
    }
}

impl Sub for Instant {
    type Output = Span;
    fn sub(self, earlier: Self) -> Span {
        self.since(earlier)
    }
}

impl Add for Span {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl AddAssign for Span {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Span {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

impl SubAssign for Span {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Neg for Span {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.saturating_neg())
    }
}

impl Mul<i64> for Span {
    type Output = Self;
    fn mul(self, times: i64) -> Self {
        Self(self.0.saturating_mul(times))
    }
}

impl Div<i64> for Span {
    type Output = Self;
    fn div(self, parts: i64) -> Self {
        Self(self.0 / parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_past_and_the_end_are_reached_without_wrapping() {
        assert_eq!(Instant(5) - Span(9), Instant::ZERO);
        assert_eq!(Instant::FAR + Span(1), Instant::FAR);
        assert_eq!(Instant(5) - Instant(9), Span(-4));
        assert_eq!(Instant::FAR - Instant::ZERO, Span(i64::MAX));
        assert_eq!(Instant::ZERO - Instant::FAR, Span(-i64::MAX));
    }

    #[test]
    fn seconds_are_rounded() {
        assert_eq!(Span::from_secs(-0.000_001_4), Span(-1));
        assert_eq!(Span::from_secs(f64::NAN), Span::ZERO);
        assert_eq!(Instant::from_secs(-1.0), Instant::ZERO);
    }
}
