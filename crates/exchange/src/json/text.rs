//! JSON text for files: laid out so that differences between versions read well.

use lightbots_base::Vec2;

/// Factor that rounds numbers to four decimals: metres to tenths of a millimetre, as in the original's files. With a
/// smaller factor, places would be less exact. With a larger one, files would be longer.
const DECIMALS_SCALE: f64 = 1e4;
/// Magnitude from which numbers are not rounded, because a double cannot hold four decimals there: 2^53 /
/// `DECIMALS_SCALE`, rounded down.
const WITHOUT_DECIMALS: f64 = 9e11;

/// A number as text with at most four decimals. Infinities and NaN become `null`, which readers refuse.
pub(crate) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "null".into();
    }
    let is_small = value.abs() < WITHOUT_DECIMALS;
    // Adding 0 turns -0 into 0.
    let rounded = if is_small { (value * DECIMALS_SCALE).round() / DECIMALS_SCALE + 0.0 } else { value };
    rounded.to_string()
}

/// Magnitude below which a number other than 0 is written with an exponent, so that the text stays short.
const IN_FULL_FROM: f64 = 1e-7;
/// Magnitude from which a number is written with an exponent. JavaScript has this limit and that of `IN_FULL_FROM`.
const IN_FULL_BELOW: f64 = 1e21;

/// A number as text with all its digits, so that reading the text gives the same number; only −0 becomes 0. Infinities
/// and NaN become `null`, which readers refuse.
pub(crate) fn exact(value: f64) -> String {
    // Adding 0 turns -0 into 0.
    let value = value + 0.0;
    match value.abs() {
        size if !size.is_finite() => "null".into(),
        size if size == 0.0 || (IN_FULL_FROM..IN_FULL_BELOW).contains(&size) => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// A place `[x, y]` with all digits.
pub(crate) fn place_text(at: Vec2) -> String {
    format!("[{}, {}]", exact(at.x), exact(at.y))
}

/// A text in double quotes.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for char in text.chars() {
        match char {
            '"' | '\\' => out.extend(['\\', char]),
            '\n' => out.push_str("\\n"),
            char if char.is_control() => out.push_str(&format!("\\u{:04x}", char as u32)),
            char => out.push(char),
        }
    }
    out.push('"');
    out
}

/// A JSON list with one item per line. `indent` is put before the closing bracket, and with two more spaces before each
/// item.
pub(crate) fn lines(items: impl ExactSizeIterator<Item = String>, indent: &str) -> String {
    if items.len() == 0 {
        return "[]".into();
    }
    let items: Vec<String> = items.map(|item| format!("{indent}  {item}")).collect();
    format!("[\n{}\n{indent}]", items.join(",\n"))
}
