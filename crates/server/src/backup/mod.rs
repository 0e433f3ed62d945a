//! Saves the data folder in one file, a zip with a list of its files, and restores it.

mod paths;
mod restore;
mod save;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use restore::restore;
pub use save::save;

/// Name of the zip entry that lists the files of a backup.
const LIST: &str = "lightbots-backup.json";
/// Version of backups that this program writes, and the newest that it reads.
const VERSION: u32 = 1;
/// Most files of a backup: ten times the files of 200 shows with 50 earlier states each. Bounds the memory for names.
const FILES_MAX: usize = 100_000;

/// List of what a backup holds. The list is the last entry of the zip, because it describes the files as they were saved.
#[derive(Debug, Serialize, Deserialize)]
struct BackupList {
    /// [`VERSION`].
    lightbots_backup: u32,
    /// Version of the program that made the backup.
    program: String,
    /// Time at which the backup was begun, milliseconds since the start of 1970 (UTC).
    began_ms: u64,
    /// The files by their paths in the data folder, with `/` between folders.
    files: BTreeMap<String, BackupFile>,
}

/// A file in a backup.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct BackupFile {
    bytes: u64,
    /// Time of the last change of the file, milliseconds since the start of 1970 (UTC).
    modified_ms: u64,
    /// Whether only the owner of the file had any rights to it. Always false on systems other than Unix.
    is_private: bool,
}
