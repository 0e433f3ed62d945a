//! Issues of a show, for people to mend and for screens to draw.

use serde::{Deserialize, Serialize};

/// An error, a warning or a note about a show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Issue {
    /// Kind of issue for programs: lower case words with hyphens, such as `pixel-off-floor`.
    pub code: String,
    /// Severity.
    pub severity: Severity,
    /// Index of the frame, counted from 0; `None`: the issue concerns the whole show.
    pub frame: Option<usize>,
    /// Ids of the pixels concerned; may be empty.
    pub pixels: Vec<u32>,
    /// One line for people: place, cause and, where there is one, remedy. The text counts frames from 1.
    pub message: String,
}

/// A list of issues.
pub type Issues = Vec<Issue>;

/// Severity of an issue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The show plays well; the note is for information.
    Note,
    /// The show plays, but it could play better, or a part of it is left out.
    Warning,
    /// The show must not be played.
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

    /// Returns the issue as one about the frame with the index `frame`, counted from 0.
    pub fn in_frame(self, frame: usize) -> Self {
        Self { frame: Some(frame), ..self }
    }

    /// Returns the issue as one about the pixels with these ids.
    pub fn with_pixels(self, pixels: impl IntoIterator<Item = u32>) -> Self {
        Self { pixels: pixels.into_iter().collect(), ..self }
    }

    /// Whether the issue forbids playing the show.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
