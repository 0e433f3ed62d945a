//! Why a command ends early.

use std::fmt::Display;
use std::path::Path;

/// Error of a command: a text for people, and the exit code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What is wrong and what to do.
    pub line: String,
    /// Exit code: 1 for a problem, 2 for wrong use or unreadable input, 130 after a cancellation.
    pub code: i32,
}

/// How a command ends: `Ok(true)` fine, `Ok(false)` with problems that were printed, `Err` with a line that is not printed
/// yet.
pub type Outcome = Result<bool, Failure>;

impl Failure {
    /// Makes an error for wrong use or unreadable input, exit code 2.
    pub fn input(line: impl Into<String>) -> Self {
        Self { line: line.into(), code: 2 }
    }

    /// Makes an error for a file that cannot be written, exit code 2.
    pub fn unwritable(path: &Path, error: &dyn Display) -> Self {
        Self::input(format!("{}: cannot be written: {error}", path.display()))
    }

    /// Makes an error for a correct command that could not be done, exit code 1.
    pub fn problem(line: impl Into<String>) -> Self {
        Self { line: line.into(), code: 1 }
    }
}

impl From<lightbots_link::ArgumentsError> for Failure {
    fn from(error: lightbots_link::ArgumentsError) -> Self {
        Self::input(error.to_string())
    }
}
