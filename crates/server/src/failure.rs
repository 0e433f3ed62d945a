//! Why a command ends early.

use std::fmt::Display;
use std::path::Path;

/// One line for people, and the exit code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What is wrong and what to do.
    pub line: String,
    /// 1 or 2.
    pub code: i32,
}

/// How a command ends: `Ok(true)` fine, `Ok(false)` with problems that were printed.
pub type Outcome = Result<bool, Failure>;

impl Failure {
    /// Wrong use or unreadable input.
    pub fn input(line: impl Into<String>) -> Self {
        Self { line: line.into(), code: 2 }
    }

    /// A file that was asked for cannot be written.
    pub fn unwritable(path: &Path, error: &dyn Display) -> Self {
        Self::input(format!("{}: cannot be written: {error}", path.display()))
    }

    /// It was asked for rightly, but could not be done.
    pub fn problem(line: impl Into<String>) -> Self {
        Self { line: line.into(), code: 1 }
    }
}

impl From<lightbots_link::ArgumentsError> for Failure {
    fn from(error: lightbots_link::ArgumentsError) -> Self {
        Self::input(error.to_string())
    }
}
