//! What the library gives, refuses and asks for.

use lightbots_show::{Issues, Show};

/// A show as the library keeps it.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Its document in our format.
    pub bytes: Vec<u8>,
    /// The same in memory, without the files that belong to it.
    pub show: Show,
    /// Its version, in quotes.
    pub etag: String,
    /// Why the show cannot be replaced, for people: its file holds more than the document.
    pub read_only: Option<String>,
    /// What is wrong with the pictures of its layers, once they were decoded.
    pub issues: Issues,
}

/// Why the library does not do as it is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LibraryError {
    /// The name cannot be one.
    BadName(String),
    /// There is no such show.
    Missing(String),
    /// It was saved elsewhere first.
    Conflict(String),
    /// It is given with the program or only partly understood, and stays as it is.
    ReadOnly(String),
    /// It is no show, or no file of its hash.
    NoShow(String),
    /// The disk does not want to.
    Disk(String),
}

/// What must be so for a show to be replaced or deleted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Condition {
    /// Nothing.
    #[default]
    Any,
    /// It has this version.
    Is(String),
    /// There is none yet.
    IsNew,
}

impl LibraryError {
    /// There is no show of that name.
    pub(super) fn missing(name: &str) -> Self {
        Self::Missing(format!("there is no show \"{name}\" in the library"))
    }

    /// The disk does not give the file of a show.
    pub(super) fn unreadable(name: &str, error: &std::io::Error) -> Self {
        Self::Disk(format!("the show \"{name}\" cannot be read: {error}"))
    }

    /// One line for people.
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
