//! How messages quote a show.

/// Largest number of characters of a text from a show that a message quotes. A longer text is cut, so that the message
/// stays one line on a screen.
const EXCERPT_CHARS: usize = 40;

/// How messages name a frame: `frame 3 "Heart"`, or `frame 3` without a name. `index` counts frames from 0, the text
/// counts them from 1. A long name is cut as by [`excerpt`].
pub fn frame_label(index: usize, name: &str) -> String {
    if name.is_empty() {
        return format!("frame {}", index + 1);
    }
    format!("frame {} \"{}\"", index + 1, excerpt(name))
}

/// A time in seconds as minutes and seconds, rounded to tenths, such as `1:02.5`. Times before 0 become 0.
pub fn clock_label(seconds: f64) -> String {
    let tenths = (seconds.max(0.0) * 10.0).round() as u64;
    format!("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10)
}

/// The first 40 characters of a text, for messages, with `…` after them if the text is longer. Control characters become
/// U+FFFD, because they would break the line.
pub fn excerpt(text: &str) -> String {
    let printable = |char: char| if char.is_control() { char::REPLACEMENT_CHARACTER } else { char };
    let mut short: String = text.chars().take(EXCERPT_CHARS).map(printable).collect();
    if text.chars().nth(EXCERPT_CHARS).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_are_rounded_to_tenths() {
        assert_eq!((clock_label(64.84), clock_label(59.96)), ("1:04.8".into(), "1:00.0".into()));
        assert_eq!((clock_label(62.46), clock_label(-3.0)), ("1:02.5".into(), "0:00.0".into()));
    }

    #[test]
    fn names_cannot_break_the_line() {
        assert_eq!(frame_label(0, "a\nb"), "frame 1 \"a\u{fffd}b\"");
        assert!(frame_label(0, &"x".repeat(1000)).len() < 60);
    }
}
