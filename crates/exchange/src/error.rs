//! Why bytes are not a show.

use std::fmt;

use lightbots_show::{Issue, frame_label};

/// Why bytes cannot be read as a show. `Display` gives one line: place, cause and remedy. The line does not have the
/// name of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The kind of error for programs: lower case words with hyphens, such as `not-json`.
    pub code: &'static str,
    /// Line and column in the file, or in the part of it that `what` names, such as a table. Both are counted from 1,
    /// the column in characters. `None` if the error concerns the whole file or part.
    pub place: Option<(usize, usize)>,
    /// Index of the frame, counted from 0, and the frame's name, which may be empty. `None` if the error concerns no
    /// single frame.
    pub frame: Option<(usize, String)>,
    /// The pixel of that frame; `None` if the error concerns no single pixel.
    pub pixel: Option<PixelName>,
    /// Cause and remedy, without the place.
    pub what: String,
}

/// How an error names a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelName {
    /// The pixel's id.
    Id(u32),
    /// The pixel's position in the frame's list of pixels, counted from 0. Used if the pixel has no readable id.
    Nth(usize),
}

impl ReadError {
    /// An error that concerns the whole file.
    pub(crate) fn whole(code: &'static str, what: impl Into<String>) -> Self {
        Self { code, place: None, frame: None, pixel: None, what: what.into() }
    }

    /// An error at the byte with index `byte` of `text`, counted from 0. Sets line and column of the error.
    pub(crate) fn at(code: &'static str, text: &str, byte: usize, what: impl Into<String>) -> Self {
        let before = &text.as_bytes()[..byte.min(text.len())];
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        let line_start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        // Continuation bytes of UTF-8 do not count as characters.
        let column = before[line_start..].iter().filter(|byte| **byte & 0xc0 != 0x80).count() + 1;
        Self { place: Some((line, column)), ..Self::whole(code, what) }
    }

    /// Returns the error with ` (in PART)` after its message. `part` names the part of the file that has the error.
    pub(crate) fn within(self, part: &str) -> Self {
        Self { what: format!("{} (in {part})", self.what), ..self }
    }

    /// Returns the error with `THING NUMBER: ` before its message, such as "drone 3: ". `index` counts things from 0,
    /// the message counts them from 1.
    pub(crate) fn of_nth(self, thing: &str, index: usize) -> Self {
        Self { what: format!("{thing} {}: {}", index + 1, self.what), ..self }
    }

    /// Converts the error into an issue, for lists of issues.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let error = ReadError::at("not-json", "é\nöx!", 6, "bad");
        assert_eq!(error.to_string(), "line 2, column 3: bad");
    }
}
