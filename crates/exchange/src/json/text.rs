//! JSON text for files: laid out so that differences between versions read well.

use lightbots_base::Vec2;

/// Factor by which numbers are rounded to four decimals: tenths of a millimetre, as in the original's files. With fewer
/// decimals, pixels would move by more than sensors notice. More would only lengthen files.
const DECIMALS_SCALE: f64 = 1e4;
/// Magnitude from which numbers are not rounded, because a double has no four decimals: 2^53 / `DECIMALS_SCALE`,
/// rounded down.
const WITHOUT_DECIMALS: f64 = 9e11;

/// A number with at most four decimals. A number that is not finite becomes `null`, which readers refuse.
pub(crate) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "null".into();
    }
    let is_small = value.abs() < WITHOUT_DECIMALS;
    // Adding 0 turns -0 into 0.
    let rounded = if is_small { (value * DECIMALS_SCALE).round() / DECIMALS_SCALE + 0.0 } else { value };
    rounded.to_string()
}

/// Magnitude below which a number is written with an exponent, so that it stays short.
const IN_FULL_FROM: f64 = 1e-7;
/// Magnitude from which a number is written with an exponent. JavaScript has the same two limits.
const IN_FULL_BELOW: f64 = 1e21;

/// A number with all its digits, so that it is read back the same. A number that is not finite becomes `null`, which
/// readers refuse.
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

/// A list with one item per line. Its closing bracket is indented by `indent`.
pub(crate) fn lines(items: impl ExactSizeIterator<Item = String>, indent: &str) -> String {
    if items.len() == 0 {
        return "[]".into();
    }
    let items: Vec<String> = items.map(|item| format!("{indent}  {item}")).collect();
    format!("[\n{}\n{indent}]", items.join(",\n"))
}
