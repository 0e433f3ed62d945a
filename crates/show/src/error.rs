//! Why bytes are no show.

use std::fmt;

use crate::Issue;

/// Why bytes cannot be read as a show. Its `Display` is one line that says where, what, and what to do; it does not
/// say which file: the one who opened it knows.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// What it is, for programs: lower case words with hyphens, such as `not-json`.
    pub code: &'static str,
    /// Line and column, both counted from 1, the column in characters; `None` where the whole file is concerned.
    pub place: Option<(usize, usize)>,
    /// Which frame, counted from 0, and its name if it is known.
    pub frame: Option<(usize, String)>,
    /// Which pixel.
    pub pixel: Option<PixelName>,
    /// What is wrong and what to do, without the place.
    pub what: String,
}

/// How an error names a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelName {
    /// By its id.
    Id(u32),
    /// By its position in the frame's list, counted from 0, where it has no readable id.
    Nth(usize),
}

impl ReadError {
    /// An error that concerns the whole file.
    pub(crate) fn whole(code: &'static str, what: impl Into<String>) -> Self {
        Self { code, place: None, frame: None, pixel: None, what: what.into() }
    }

    /// An error at a byte of `text`.
    pub(crate) fn at(code: &'static str, text: &str, byte: usize, what: impl Into<String>) -> Self {
        let before = &text.as_bytes()[..byte.min(text.len())];
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        let line_start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        // Continuation bytes are no characters of their own.
        let column = before[line_start..].iter().filter(|byte| **byte & 0xc0 != 0x80).count() + 1;
        Self { place: Some((line, column)), ..Self::whole(code, what) }
    }

    /// The same as an issue, for lists of issues.
    pub fn issue(&self) -> Issue {
        let mut issue = Issue::error(self.code, self.to_string());
        issue.frame = self.frame.as_ref().map(|(index, _)| *index);
        if let Some(PixelName::Id(id)) = self.pixel {
            issue.pixels.push(id);
        }
        issue
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        if let Some((line, column)) = self.place {
            write!(f, "line {line}, column {column}")?;
            separator = ", ";
        }
        if let Some((index, name)) = &self.frame {
            write!(f, "{separator}{}", frame_label(*index, name))?;
            separator = ", ";
        }
        match self.pixel {
            Some(PixelName::Id(id)) => write!(f, "{separator}pixel {id}")?,
            Some(PixelName::Nth(nth)) => write!(f, "{separator}pixel number {} of the list", nth + 1)?,
            None => {}
        }
        let colon = if self.place.is_some() || self.frame.is_some() { ": " } else { "" };
        write!(f, "{colon}{}", self.what)
    }
}

impl std::error::Error for ReadError {}

/// How messages name a frame: `frame 3 "Heart"`, counted from 1.
pub fn frame_label(index: usize, name: &str) -> String {
    if name.is_empty() {
        return format!("frame {}", index + 1);
    }
    format!("frame {} \"{}\"", index + 1, shown(name))
}

/// Text of a file as a message may show it: short, and without what would break the line.
pub(crate) fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut short: String =
        text.chars().take(LONGEST).map(|char| if char.is_control() { '\u{fffd}' } else { char }).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let error = ReadError::at("not-json", "é\nöx!", 6, "bad");
        assert_eq!(error.to_string(), "line 2, column 3: bad");
    }

    #[test]
    fn names_cannot_break_the_line() {
        assert_eq!(frame_label(0, "a\nb"), "frame 1 \"a\u{fffd}b\"");
        assert!(frame_label(0, &"x".repeat(1000)).len() < 60);
    }
}
