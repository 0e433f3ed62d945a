//! Changes of files that survive a crash and a full disk. [`replace`] replaces a file whole or not at all. What
//! [`create_folder`], [`replace`], [`rename`], [`link`] and [`remove`] have done is on the disk when they return, on
//! Unix.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

#[cfg(test)]
pub mod power_cut;

#[cfg(test)]
use power_cut::{Operation, note};

/// Ending of drafts: temporary files that replace other files once they are complete.
const DRAFT: &str = ".saving";

/// Users that may read a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Readers {
    /// Every user that the system's file mode mask admits.
    All,
    /// The user that runs this program. On systems other than Unix, the same as `All`.
    Owner,
}

/// Makes a folder and the missing folders above it. The new folders are on the disk when this returns.
pub fn create_folder(folder: &Path) -> io::Result<()> {
    if folder.as_os_str().is_empty() || folder.is_dir() {
        return Ok(());
    }
    create_folder(folder_of(folder))?;
    match fs::create_dir(folder) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists && folder.is_dir() => Ok(()),
        Err(error) => Err(error),
        Ok(()) => {
            #[cfg(test)]
            note(|| Operation::MadeFolder(folder.to_owned()));
            sync_folder(folder_of(folder))
        }
    }
}

/// Writes a file, all or nothing, and makes its folder if that is missing. After a crash, the old or the new file
/// exists. After an error, the old file exists, unless only the last synchronisation failed.
pub fn replace(path: &Path, bytes: &[u8], readers: Readers) -> io::Result<()> {
    replace_with(path, readers, |file| file.write_all(bytes))
}

/// Replaces a file as [`replace`] does. The function `write` writes the content of the new file.
pub fn replace_with<E: From<io::Error>>(
    path: &Path,
    readers: Readers,
    write: impl FnOnce(&mut File) -> Result<(), E>,
) -> Result<(), E> {
    create_folder(folder_of(path))?;
    let draft = Draft::beside(path);
    let mut file = draft.create(readers)?;
    write(&mut file)?;
    drop(file);
    Ok(draft.finish(path)?)
}

/// Gives a file another name in the same file system. A file of that name is replaced.
pub fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to)?;
    #[cfg(test)]
    note(|| Operation::Moved(from.to_owned(), to.to_owned()));
    sync_folder(folder_of(to))?;
    if folder_of(from) == folder_of(to) { Ok(()) } else { sync_folder(folder_of(from)) }
}

/// Gives a file a second name in the same file system.
pub fn link(from: &Path, to: &Path) -> io::Result<()> {
    fs::hard_link(from, to)?;
    #[cfg(test)]
    note(|| Operation::Linked(from.to_owned(), to.to_owned()));
    sync_folder(folder_of(to))
}

/// Removes a file. A missing file is no error.
pub fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Ok(()) => {
            #[cfg(test)]
            note(|| Operation::Removed(path.to_owned()));
            sync_folder(folder_of(path))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(error),
    }
}

/// Reads a regular file; more than `most` bytes are an error. A pipe or a device is refused before it is opened,
/// because reading it may wait for ever or never end.
pub fn read_regular(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    open_regular(path).and_then(|file| read_to_end(file, most))
}

/// Opens a regular file for reading; anything else, and a missing file, is an error.
pub fn open_regular(path: &Path) -> io::Result<File> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(ErrorKind::InvalidInput, "it is not a regular file"));
    }
    File::open(path)
}

/// Reads a file of any kind; more than `most` bytes are an error.
pub fn read_bounded(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    read_to_end(File::open(path)?, most)
}

fn read_to_end(file: File, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let line = format!("it is longer than {:.0} MB", most as f64 / 1e6);
        return Err(io::Error::new(ErrorKind::FileTooLarge, line));
    }
    Ok(bytes)
}

/// Removes the drafts that a crash left in a folder. To be called only while no other program saves in that folder.
pub fn remove_drafts(folder: &Path) {
    let Ok(files) = fs::read_dir(folder) else { return };
    let is_draft = |file: &fs::DirEntry| file.file_name().to_string_lossy().ends_with(DRAFT);
    for file in files.flatten().filter(is_draft) {
        if let Err(error) = fs::remove_file(file.path()) {
            tracing::debug!("the draft {} stays: {error}", file.path().display());
        }
    }
}

/// The path of a temporary file. When this value is dropped, the file is removed, unless it was renamed before.
pub struct Draft(PathBuf);

impl Draft {
    /// Returns the draft of the file at `path`, in the same folder, under a name that no other draft of this process
    /// has. Nothing is written yet.
    pub fn beside(path: &Path) -> Self {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Self(folder_of(path).join(format!(".{name}.{number}{DRAFT}")))
    }

    /// Path of the draft.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Synchronises the draft to the disk and renames it to `path`.
    pub fn finish(self, path: &Path) -> io::Result<()> {
        #[cfg(test)]
        note(|| Operation::Wrote(self.0.clone(), fs::read(&self.0).unwrap_or_default()));
        // The file is opened for writing, because some systems synchronise only such files.
        OpenOptions::new().write(true).open(&self.0)?.sync_all()?;
        #[cfg(test)]
        note(|| Operation::SyncedFile(self.0.clone()));
        rename(&self.0, path)
    }

    fn create(&self, readers: Readers) -> io::Result<File> {
        // A draft that a crash left may have other rights.
        let _ = fs::remove_file(&self.0);
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        if readers == Readers::Owner {
            std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        }
        #[cfg(not(unix))]
        let _ = readers;
        options.open(&self.0)
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // Fails if the draft was renamed, which is usual.
        let _ = fs::remove_file(&self.0);
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Synchronises the names in a folder to the disk, on Unix. Without this, a crash may undo a rename although the content of
/// the file is on the disk.
fn sync_folder(folder: &Path) -> io::Result<()> {
    #[cfg(unix)]
    File::open(folder)?.sync_all()?;
    #[cfg(test)]
    note(|| Operation::SyncedFolder(folder.to_owned()));
    #[cfg(not(unix))]
    let _ = folder;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lightbots-disk-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        let files = fs::read_dir(folder).unwrap().flatten();
        let mut names: Vec<_> = files.map(|file| file.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_and_no_draft_is_left_of_it_or_of_a_crash() {
        let folder = folder("replace");
        let file = folder.join("below/a");
        replace(&file, b"one", Readers::All).unwrap();
        replace(&file, b"two", Readers::All).unwrap();
        assert_eq!(read_regular(&file, 3).unwrap(), b"two");
        fs::write(file.with_file_name(".b.7.saving"), b"half").unwrap();
        fs::write(file.with_file_name(".b.saving"), b"of an older version").unwrap();
        remove_drafts(file.parent().unwrap());
        assert_eq!(names(file.parent().unwrap()), ["a"]);
        remove(&file).unwrap();
        remove(&file).unwrap();
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_failed_save_leaves_the_old_file_and_no_draft() {
        let folder = folder("failed");
        // A folder with something in it cannot be replaced by a file.
        let taken = folder.join("taken");
        replace(&taken.join("inside"), b"one", Readers::All).unwrap();
        assert!(replace(&taken, b"two", Readers::All).is_err());
        assert_eq!((names(&folder), names(&taken)), (vec!["taken".into()], vec!["inside".into()]));
        fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn only_regular_files_of_bounded_length_are_read() {
        let folder = folder("regular");
        create_folder(&folder).unwrap();
        let pipe = folder.join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let endless = folder.join("endless");
        std::os::unix::fs::symlink("/dev/zero", &endless).unwrap();
        for path in [&pipe, &endless, &folder] {
            assert_eq!(read_regular(path, 10).unwrap_err().kind(), ErrorKind::InvalidInput, "{path:?}");
        }
        assert_eq!(read_bounded(&endless, 10).unwrap_err().kind(), ErrorKind::FileTooLarge);
        fs::remove_dir_all(folder).unwrap();
    }
}
