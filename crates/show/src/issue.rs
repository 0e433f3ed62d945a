//! What is wrong with a show, said so that people can mend it and screens can draw it.

use serde::{Deserialize, Serialize};

/// One thing that is wrong or worth knowing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Issue {
    /// What it is, for programs: lower case words with hyphens, such as `pixel-off-floor`.
    pub code: String,
    /// How bad it is.
    pub severity: Severity,
    /// Which frame, counted from 0 in playing order.
    pub frame: Option<usize>,
    /// Ids of the pixels it is about; may be empty.
    pub pixels: Vec<u32>,
    /// One line for people: what is wrong where, and what to do. Frames are named and counted from 1.
    pub message: String,
}

/// A list of issues in the order they were found.
pub type Issues = Vec<Issue>;

/// How bad an issue is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Good to know.
    Note,
    /// The show plays, but not as well as it could.
    Warning,
    /// The show must not be played like this.
    Error,
}

impl Issue {
    /// An error that concerns the whole show.
    pub fn error(code: &str, message: impl Into<String>) -> Self {
        Self {
            code: code.into(),
            severity: Severity::Error,
            frame: None,
            pixels: Vec::new(),
            message: message.into(),
        }
    }

    /// A warning that concerns the whole show.
    pub fn warning(code: &str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// The same, in a frame (counted from 0).
    pub fn in_frame(self, frame: usize) -> Self {
        Self { frame: Some(frame), ..self }
    }

    /// The same, about pixels.
    pub fn with_pixels(self, pixels: impl IntoIterator<Item = u32>) -> Self {
        Self { pixels: pixels.into_iter().collect(), ..self }
    }

    /// Whether the show must not be played with it.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
