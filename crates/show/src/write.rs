//! From a show to a file's bytes: the same bytes for the same show, laid out so that differences read well.

mod lightbots;
mod original;

use crate::read::Format;
use crate::{Issues, Show};

/// The bytes of a file that holds the show. Places are kept to a tenth of a millimetre. What the original's format
/// cannot hold is left out: [`losses`] says what.
pub fn write(show: &Show, format: Format) -> Vec<u8> {
    let text = match format {
        Format::LightBots => lightbots::text(show),
        Format::Original => original::text(show),
    };
    text.into_bytes()
}

/// What of the show the format cannot hold, as warnings.
pub fn losses(show: &Show, format: Format) -> Issues {
    match format {
        Format::LightBots => Vec::new(),
        Format::Original => original::losses(show),
    }
}

/// A number with at most four decimals; what is not finite becomes `null`, which no reader takes for a number.
fn number(value: f64) -> String {
    if !value.is_finite() {
        return "null".into();
    }
    // Beyond 2^53 / 10^4 there are no such decimals.
    let rounded = if value.abs() < 9e11 { (value * 1e4).round() / 1e4 + 0.0 } else { value };
    rounded.to_string()
}

/// A text in double quotes.
fn quoted(text: &str) -> String {
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

/// `items` one a line, indented by `indent`, in brackets.
fn lines(items: impl ExactSizeIterator<Item = String>, indent: &str) -> String {
    if items.len() == 0 {
        return "[]".into();
    }
    let items: Vec<String> = items.map(|item| format!("{indent}  {item}")).collect();
    format!("[\n{}\n{indent}]", items.join(",\n"))
}
