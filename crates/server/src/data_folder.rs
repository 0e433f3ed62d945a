//! The folder of a program's data. A lock lets one program at a time use it.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

use crate::disk;
use crate::failure::Failure;

/// Name of the file whose lock shows that a program uses the folder. The operating system holds the lock. A program
/// that ends leaves the file, because another program may open it at that moment.
const LOCK: &str = ".lock";
/// Most bytes that are read from a lock file.
const LONGEST: u64 = 200;

/// A data folder that only this program uses while the value exists. A file system without locks cannot prevent a second
/// program. The lock ends with the process, however the process ends.
#[derive(Debug)]
pub struct DataFolder {
    path: PathBuf,
    lock: File,
}

impl DataFolder {
    /// Returns the default data folder: `lightbots` in the user's data folder, or `lightbots-data` in the working
    /// folder if no data folder of the user is known.
    pub fn usual() -> PathBuf {
        let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let data = set("XDG_DATA_HOME")
            .or_else(|| set("APPDATA"))
            .or_else(|| set("HOME").map(|home| home.join(".local/share")));
        data.map_or_else(|| PathBuf::from("lightbots-data"), |data| data.join("lightbots"))
    }

    /// Makes the folder, if it is missing, and locks it. The error says which program uses the folder, or why shows cannot
    /// be kept there, and what to do.
    pub fn take(path: &Path) -> Result<Self, Failure> {
        let lock = open(path).map_err(|error| {
            let path = path.display();
            Failure::problem(format!(
                "shows cannot be kept in {path}: {error}; name another folder with --data DIR"
            ))
        })?;
        let folder = Self { path: path.to_owned(), lock };
        match folder.lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(folder.in_use()),
            // Some network file systems have no locks.
            Err(TryLockError::Error(error)) => {
                tracing::warn!("{} cannot be locked against a second program: {error}", path.display());
            }
        }
        folder.note(&format!("process {}", std::process::id()));
        Ok(folder)
    }

    /// Writes the address `url` of this program's web app to the lock file, for the error message of a second program
    /// that wants the folder.
    pub fn tell_address(&self, url: &str) {
        self.note(&format!("process {} ({url})", std::process::id()));
    }

    fn note(&self, text: &str) {
        let mut file = &self.lock;
        let written =
            file.set_len(0).and_then(|()| file.rewind()).and_then(|()| file.write_all(text.as_bytes()));
        if let Err(error) = written {
            tracing::debug!("the lock of {} says nothing: {error}", self.path.display());
        }
    }

    fn in_use(&self) -> Failure {
        let mut text = String::new();
        // Some systems do not allow a locked file to be read.
        let _ = (&self.lock).take(LONGEST).read_to_string(&mut text);
        let text: String = text.chars().filter(|letter| !letter.is_control()).collect();
        let who = if text.is_empty() { "another program" } else { &text };
        Failure::problem(format!(
            "the folder {} is in use by {who}: use that program, stop it, or name another folder with --data DIR",
            self.path.display()
        ))
    }
}

/// Opens the lock file in a data folder. First writes and removes another file there, to check that shows can be saved.
fn open(folder: &Path) -> std::io::Result<File> {
    disk::create_folder(folder)?;
    let path = folder.join(LOCK);
    if path.exists() && !path.is_file() {
        return Err(std::io::Error::new(ErrorKind::InvalidInput, format!("{LOCK} is not a regular file")));
    }
    let probe = folder.join(format!(".probe-{}.saving", std::process::id()));
    std::fs::write(&probe, b"")?;
    // The file may be gone, because a program that has just taken the folder removes drafts.
    disk::remove(&probe)?;
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_one_program_which_the_second_one_names() {
        let path = std::env::temp_dir().join(format!("lightbots-data-folder-{}", std::process::id()));
        let first = DataFolder::take(&path).unwrap();
        let own = format!("process {}", std::process::id());
        let refused = DataFolder::take(&path).unwrap_err();
        assert_eq!(refused.code, 1);
        assert!(refused.line.contains(&own) && refused.line.contains("--data DIR"), "{}", refused.line);
        first.tell_address("http://127.0.0.1:8080");
        let refused = DataFolder::take(&path).unwrap_err();
        assert!(refused.line.contains(&format!("{own} (http://127.0.0.1:8080)")), "{}", refused.line);
        drop(first);
        drop(DataFolder::take(&path).unwrap());
        std::fs::remove_dir_all(path).unwrap();
    }
}
