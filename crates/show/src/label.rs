//! How messages quote a show.

/// Longest text of a file in a message, characters. Longer texts are cut, so that a message stays one line on a screen.
const EXCERPT_CHARS: usize = 40;

/// The name of a frame in messages: `frame 3 "Heart"`, counted from 1 (`index` counts from 0).
pub fn frame_label(index: usize, name: &str) -> String {
    if name.is_empty() {
        return format!("frame {}", index + 1);
    }
    format!("frame {} \"{}\"", index + 1, excerpt(name))
}

/// The beginning of a text, for messages. Control characters become U+FFFD, because they would break the line.
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
    fn names_cannot_break_the_line() {
        assert_eq!(frame_label(0, "a\nb"), "frame 1 \"a\u{fffd}b\"");
        assert!(frame_label(0, &"x".repeat(1000)).len() < 60);
    }
}
