//! Results, errors and conditions of operations of the library.

use lightbots_show::{Issues, Show};

/// A show as the library keeps it.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Document of the show in our format.
    pub bytes: Vec<u8>,
    /// The show in memory, without the content of its assets.
    pub show: Show,
    /// Version of the show, in quotes.
    pub etag: String,
    /// A line for people that says why the show cannot be replaced: its file holds more than the document. `None`: it
    /// can be replaced.
    pub read_only: Option<String>,
    /// Issues of the pictures of the show's layers; empty until these pictures are decoded.
    pub issues: Issues,
}

/// Why the library refuses an operation: one line for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LibraryError {
    /// The name is not allowed.
    BadName(String),
    /// There is no such show, state or asset.
    Missing(String),
    /// The show does not have the version that the client expects, or the name is taken.
    Conflict(String),
    /// The show cannot be replaced or deleted, because it is built-in or only partly understood.
    ReadOnly(String),
    /// The bytes are no show, or an asset does not have the stated hash.
    NoShow(String),
    /// The disk cannot be read or written.
    Disk(String),
}

/// Condition under which a show is replaced or deleted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Condition {
    /// No condition.
    #[default]
    Any,
    /// The show has this version.
    Is(String),
    /// There is no show of this name.
    IsNew,
}

impl LibraryError {
    /// Returns the error that there is no show of this name.
    pub(super) fn missing(name: &str) -> Self {
        Self::Missing(format!("there is no show \"{name}\" in the library"))
    }

    /// Returns the error that the file of a show cannot be read.
    pub(super) fn unreadable(name: &str, error: &std::io::Error) -> Self {
        Self::Disk(format!("the show \"{name}\" cannot be read: {error}"))
    }

    /// Returns the error as one line for people.
    pub fn line(&self) -> &str {
        match self {
            Self::BadName(line)
            | Self::Missing(line)
            | Self::Conflict(line)
            | Self::ReadOnly(line)
            | Self::NoShow(line)
            | Self::Disk(line) => line,
        }
    }
}
