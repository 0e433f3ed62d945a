//! Errors about sources that cannot be drawn, and notes about what is missing from a drawing.

use std::fmt;

use crate::drawing::Drawing;

/// A source that cannot be drawn at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawError {
    /// Stable name for programs, such as `picture-cut-off`.
    pub code: &'static str,
    /// Text for people: what is wrong, where, and how to correct it.
    pub message: String,
}

/// Something that is missing from a drawing, such as a picture inside an SVG, or that differs from the source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Stable name for programs, such as `svg-image`.
    pub code: &'static str,
    /// Text for people: what is missing, how often, and what can be done.
    pub message: String,
}

/// A drawing, and notes about it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Made {
    /// The drawing.
    pub drawing: Drawing,
    /// Notes about what is missing from the drawing or differs from the source.
    pub notes: Vec<Note>,
}

impl DrawError {
    /// Makes an error with a code for programs and a message for people. The message is joined into one line.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        // Messages of libraries may end with a line break.
        let message = message.into().replace("\n.", ".").lines().collect::<Vec<_>>().join(" ");
        Self { code, message }
    }
}

impl Note {
    /// A note with a code for programs and a message for people.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for DrawError {}
