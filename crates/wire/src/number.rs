//! Reads and writes numbers as text, with a fast path for the numbers that frequent messages hold. `R8` and the like
//! are rules of docs/protocol.md.

use core::fmt::{self, Write};

use lightbots_base::{Instant, Span};

use crate::text_buffer::TextBuffer;

/// Longest text read as a number, bytes (R8). `Double.toString` needs at most 24.
const MAX_NUMBER: usize = 32;
/// Largest mantissa that an `f64` holds exactly (IEEE 754, 53 bits). Up to it, one division by a power of ten rounds
/// correctly.
const EXACT_MAX: u64 = 1 << 53;
/// Powers of ten by exponent, 10⁰ to 10¹⁵. An `f64` holds each of them exactly, as it does all up to 10²² (IEEE 754).
const POWERS_OF_TEN: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
/// Latest instant that is read, microseconds. The difference of two instants up to this one always fits into an `i64`.
const INSTANT_MAX_US: u64 = i64::MAX as u64;
/// Longest duration on the wire: one hour (R22, R31).
const DURATION_MAX: Span = Span(3_600_000_000);
/// Largest absolute coordinate of a route, metres (R31).
const COORDINATE_MAX_M: f64 = 1000.0;
/// Largest absolute value of a number in a report, in the unit of its field (R9). A position with a larger coordinate
/// counts as unknown.
pub(crate) const DOUBLE_MAX: f64 = 1e6;

/// Reads a number as Rust reads an `f64`, such as `-1.5E3`, `NaN` or `Infinity`; a comma may stand for the decimal
/// point. `None` for all other texts and for texts longer than `MAX_NUMBER`.
pub fn number(text: &str) -> Option<f64> {
    let bytes = text.as_bytes();
    if bytes.len() > MAX_NUMBER {
        return None;
    }
    plain_decimal(bytes).or_else(|| any_number(bytes))
}

/// Reads `[-]digits[.,]digits[E-digit]` with a mantissa of at most `EXACT_MAX`, correctly rounded. `None` for other
/// texts, and if decimals and exponent together exceed 15.
fn plain_decimal(bytes: &[u8]) -> Option<f64> {
    let (negative, digits) = match bytes {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, bytes),
    };
    // `Double.toString` writes numbers below a thousandth in this form.
    let (digits, smaller) = match digits {
        [digits @ .., b'E', b'-', exponent @ b'0'..=b'9'] => (digits, usize::from(exponent - b'0')),
        _ => (digits, 0),
    };
    let mut mantissa = 0u64;
    let mut point = None;
    let mut count = 0usize;
    for &byte in digits {
        match byte {
            b'0'..=b'9' if mantissa < EXACT_MAX / 10 => {
                mantissa = mantissa * 10 + u64::from(byte - b'0');
                count += 1;
            }
            b'.' | b',' if point.is_none() => point = Some(count),
            _ => return None,
        }
    }
    let decimals = count - point.unwrap_or(count);
    let scale = POWERS_OF_TEN.get(decimals + smaller).filter(|_| count > 0)?;
    let value = mantissa as f64 / scale;
    Some(if negative { -value } else { value })
}

/// Reads any other number with the parser of the standard library, after each comma was replaced by a point.
fn any_number(bytes: &[u8]) -> Option<f64> {
    let mut buffer = [0; MAX_NUMBER];
    let copy = &mut buffer[..bytes.len()];
    copy.copy_from_slice(bytes);
    for byte in copy.iter_mut().filter(|byte| **byte == b',') {
        *byte = b'.';
    }
    core::str::from_utf8(copy).ok()?.parse().ok()
}

/// Reads an instant in microseconds. `None` if the text is not a whole number from 0 to `INSTANT_MAX_US`.
pub(crate) fn instant(text: &str) -> Option<Instant> {
    text.parse().ok().filter(|&us| us <= INSTANT_MAX_US).map(Instant)
}

/// Reads a duration in microseconds. `None` if the text is not a whole number from 0 to `DURATION_MAX`.
pub(crate) fn span(text: &str) -> Option<Span> {
    text.parse().ok().map(Span).filter(|span| (Span::ZERO..=DURATION_MAX).contains(span))
}

/// Reads a coordinate in whole tenths of a millimetre and returns it in metres. `None` if the text is not a whole
/// number or the coordinate exceeds ±`COORDINATE_MAX_M`.
pub(crate) fn metres(text: &str) -> Option<f64> {
    let tenths: i32 = text.parse().ok()?;
    let metres = f64::from(tenths) / 1e4;
    (metres.abs() <= COORDINATE_MAX_M).then_some(metres)
}

/// Metres in whole tenths of a millimetre, clamped to the range of [`metres`]; NaN gives 0.
pub(crate) fn tenths(metres: f64) -> i32 {
    round(metres.clamp(-COORDINATE_MAX_M, COORDINATE_MAX_M) * 1e4) as i32
}

/// Returns the nearest whole number; halves are rounded away from zero. Before Rust 1.90, `core` has no `f64::round` on
/// bare metal.
fn round(value: f64) -> i64 {
    (value + if value < 0.0 { -0.5 } else { 0.5 }) as i64
}

/// Writes a whole number.
pub(crate) fn write_int(out: &mut TextBuffer<'_>, value: i64) -> fmt::Result {
    if value < 0 {
        out.write_str("-")?;
    }
    write_digits(out, value.unsigned_abs(), 1)
}

/// Writes a whole number with leading zeros up to `width` digits, which is at most 20. Longer numbers are written in
/// full.
pub(crate) fn write_digits(out: &mut TextBuffer<'_>, mut value: u64, width: usize) -> fmt::Result {
    if value < 10 && width <= 1 {
        return out.bytes(&[b'0' + value as u8]);
    }
    let mut digits = [b'0'; 20];
    let mut first = digits.len();
    while value >= 10 {
        first -= 2;
        let two = (value % 100) as u8;
        (digits[first], digits[first + 1]) = (b'0' + two / 10, b'0' + two % 10);
        value /= 100;
    }
    if value > 0 {
        first -= 1;
        digits[first] = b'0' + value as u8;
    }
    first = first.min(digits.len() - width.clamp(1, 20));
    out.bytes(&digits[first..])
}

/// Writes a number as C and Java print it with `%f` in an English locale: with six decimals. Finite values beyond ±10¹²
/// are written as ±10¹². Values that are not finite are written as `NaN`, `Infinity` or `-Infinity`.
pub(crate) fn write_six_decimals(out: &mut TextBuffer<'_>, value: f64) -> fmt::Result {
    if !value.is_finite() {
        return write_not_finite(out, value);
    }
    let millionths = round(value.clamp(-1e12, 1e12) * 1e6);
    if value.is_sign_negative() {
        out.write_str("-")?;
    }
    write_digits(out, millionths.unsigned_abs() / 1_000_000, 1)?;
    out.write_str(".")?;
    write_digits(out, millionths.unsigned_abs() % 1_000_000, 6)
}

/// Writes a number as Java's `Double.toString` prints it, after rounding it to four decimals: `1.3`, `-0.73`, `1.0E-4`.
/// Places in metres are thus rounded to a tenth of a millimetre. Finite numbers beyond ±`DOUBLE_MAX` are written as
/// `NaN`. Values that are not finite are written as `NaN`, `Infinity` or `-Infinity`.
pub(crate) fn write_double(out: &mut TextBuffer<'_>, value: f64) -> fmt::Result {
    if !value.is_finite() || value.abs() > DOUBLE_MAX {
        return write_not_finite(out, if value.is_finite() { f64::NAN } else { value });
    }
    let scaled = round(value * 1e4);
    if scaled < 0 {
        out.write_str("-")?;
    }
    let scaled = scaled.unsigned_abs();
    if (1..10).contains(&scaled) {
        write_digits(out, scaled, 1)?;
        return out.write_str(".0E-4");
    }
    write_digits(out, scaled / 10_000, 1)?;
    out.write_str(".")?;
    let (mut decimals, mut width) = (scaled % 10_000, 4);
    while width > 1 && decimals % 10 == 0 {
        decimals /= 10;
        width -= 1;
    }
    write_digits(out, decimals, width)
}

fn write_not_finite(out: &mut TextBuffer<'_>, value: f64) -> fmt::Result {
    out.write_str(match value {
        f64::INFINITY => "Infinity",
        f64::NEG_INFINITY => "-Infinity",
        _ => "NaN",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    type Text = heapless::String<64>;

    fn written(write: impl FnOnce(&mut TextBuffer<'_>) -> fmt::Result) -> Text {
        let mut text = Text::new();
        let mut buffer = TextBuffer::new(&mut text);
        write(&mut buffer).and_then(|()| buffer.finish()).unwrap();
        text
    }

    #[test]
    fn numbers_are_read_for_what_they_are() {
        let cases = [
            ("0,500000", 0.5),
            ("-1.250000", -1.25),
            ("1.0E-4", 1e-4),
            ("-7,0E-4", -7e-4),
            ("1E-22", 1e-22),
            ("123456789.0123E-9", 0.123_456_789_012_3),
            ("-2,5e3", -2500.0),
            ("+3", 3.0),
            (".5", 0.5),
            ("Infinity", f64::INFINITY),
            ("-Infinity", f64::NEG_INFINITY),
            ("0.30000000000000004", 0.1 + 0.2),
            ("123456789012345678", 123_456_789_012_345_678.0),
        ];
        for (text, value) in cases {
            assert_eq!(number(text), Some(value), "{text}");
        }
        assert!(number("NaN").unwrap().is_nan());
        assert!(number("-0.0").unwrap().is_sign_negative());
    }

    #[test]
    fn what_is_no_number_is_none() {
        for text in [
            "",
            "-",
            ".",
            ",",
            "1.2,3",
            "1,2,3",
            "0x10",
            "1_000",
            "1 ",
            "ü",
            "--1",
            "E-4",
            "1E-",
            "1E-4.0",
            "000000000000000000000000000000001",
        ] {
            assert_eq!(number(text), None, "{text:?}");
        }
    }

    #[test]
    fn the_fast_way_agrees_with_the_standard_library() {
        let mut seed = 1u64;
        for _ in 0..5000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from((seed >> 33) as u32) / [1.0, 7.0, 1e4, 1e9][(seed >> 13) as usize % 4];
            let mut text = Text::new();
            write!(text, "{value}").unwrap();
            assert_eq!(number(&text), Some(value), "{text}");
        }
    }

    #[test]
    fn what_is_below_a_thousandth_is_read_as_by_the_standard_library() {
        for mantissa in (0..10_000_000u64).step_by(977) {
            for exponent in 0..10 {
                let mut text = Text::new();
                write!(text, "-{}.{:04}E-{exponent}", mantissa / 10_000, mantissa % 10_000).unwrap();
                assert_eq!(number(&text), text.parse().ok(), "{text}");
            }
        }
    }

    #[test]
    fn whole_numbers_have_all_their_digits() {
        let around = |power: u64| [power - 1, power, power + 1, power * 5 / 2];
        for value in (0..19).flat_map(|power| around(10u64.pow(power))).chain([u64::MAX]) {
            let mut text = Text::new();
            write!(text, "{value:03}").unwrap();
            assert_eq!(written(|buffer| write_digits(buffer, value, 3)), text);
        }
    }

    #[test]
    fn doubles_look_like_javas() {
        let cases = [
            (1.3, "1.3"),
            (-0.73, "-0.73"),
            (1e-4, "1.0E-4"),
            (-0.000_51, "-5.0E-4"),
            (0.001, "0.001"),
            (-0.000_04, "0.0"),
            (0.0, "0.0"),
            (12.0, "12.0"),
            (0.999_96, "1.0"),
            (1.02, "1.02"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-Infinity"),
            (1e9, "NaN"),
        ];
        for (value, expected) in cases {
            assert_eq!(written(|buffer| write_double(buffer, value)).as_str(), expected);
        }
    }

    #[test]
    fn six_decimals_look_like_printf() {
        let cases = [
            (0.5, "0.500000"),
            (-1.25, "-1.250000"),
            (-0.000_001_4, "-0.000001"),
            (0.999_999_6, "1.000000"),
            (f64::NAN, "NaN"),
        ];
        for (value, expected) in cases {
            assert_eq!(written(|buffer| write_six_decimals(buffer, value)).as_str(), expected);
        }
    }

    #[test]
    fn instants_and_spans_outside_their_range_are_refused() {
        assert_eq!(instant("9223372036854775807"), Some(Instant(i64::MAX as u64)));
        assert_eq!(instant("9223372036854775808"), None);
        assert_eq!(instant("-1"), None);
        assert_eq!(span("3600000001"), None);
        assert_eq!(metres("10000001"), None);
        assert_eq!(tenths(f64::NAN), 0);
    }
}
