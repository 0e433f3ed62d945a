//! Restores a data folder from a backup, all or nothing. Files are unpacked into a new folder beside the data folder. The
//! new folder is then renamed to the data folder's name.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, UNIX_EPOCH};

use zip::ZipArchive;

use super::{BackupFile, BackupList, FILES_MAX, LIST, VERSION, paths};
use crate::data_folder::DataFolder;
use crate::disk::{self, Readers};
use crate::failure::Failure;

/// Longest list of files that is read, bytes; enough for [`FILES_MAX`] files with long names.
const LIST_MAX: u64 = 64 << 20;

/// What was restored.
#[derive(Debug)]
pub struct Restored {
    pub files: usize,
    pub bytes: u64,
    /// New path of the folder that `data` named before; `None` if there was no folder, or if it held no files.
    pub before: Option<PathBuf>,
}

/// A backup whose list was read and fits its files.
struct Backup {
    file: PathBuf,
    archive: ZipArchive<BufReader<File>>,
    list: BackupList,
}

/// Restores the backup `file` as the data folder `data`. Error if a running program uses `data`, or if `data` holds files
/// already. With `replace`, a folder with files is renamed instead, and keeps its files.
pub fn restore(file: &Path, data: &Path, replace: bool) -> Result<Restored, Failure> {
    let mut backup = Backup::open(file)?;
    let folder = if fs::symlink_metadata(data).is_ok() { Some(DataFolder::take(data)?) } else { None };
    let holds_files = folder.is_some() && holds_files(data)?;
    if holds_files && !replace {
        return Err(Failure::problem(format!(
            "{} holds files already: name another folder with --data DIR, or say --replace, which moves them aside",
            data.display()
        )));
    }
    let staging = Staging::beside(data)?;
    let mut bytes = 0;
    let files = std::mem::take(&mut backup.list.files);
    for (path, about) in &files {
        backup.unpack(path, about, &staging.0)?;
        bytes += about.bytes;
    }
    // Some systems do not rename a folder with an open file.
    drop(folder);
    let before = put_in_place(&staging.0, data, holds_files)?;
    Ok(Restored { files: files.len(), bytes, before })
}

impl Backup {
    fn open(file: &Path) -> Result<Self, Failure> {
        let unfit = |why: String| Failure::input(format!("{} cannot be restored: {why}", file.display()));
        if fs::metadata(file).is_ok_and(|about| !about.is_file()) {
            return Err(unfit("it is not a regular file".into()));
        }
        let opened = File::open(file).map_err(|error| unfit(error.to_string()))?;
        let none = |why: &dyn std::fmt::Display| {
            unfit(format!("it is no backup of LightBots, or not all of one ({why}); choose another file"))
        };
        let mut archive = ZipArchive::new(BufReader::new(opened)).map_err(|error| none(&error))?;
        if archive.len() > FILES_MAX + 1 {
            return Err(none(&"too many files"));
        }
        let mut text = Vec::new();
        let entry = archive.by_name(LIST).map_err(|error| none(&format!("{LIST}: {error}")))?;
        entry.take(LIST_MAX).read_to_end(&mut text).map_err(|error| none(&error))?;
        let list: BackupList = serde_json::from_slice(&text).map_err(|error| none(&error))?;
        if list.lightbots_backup > VERSION {
            let program: String =
                list.program.chars().filter(|letter| !letter.is_control()).take(20).collect();
            return Err(unfit(format!("a newer program made it: use LightBots {program} or a later one")));
        }
        check(&archive, &list).map_err(unfit)?;
        Ok(Self { file: file.to_owned(), archive, list })
    }

    /// Unpacks one file below a folder.
    fn unpack(&mut self, path: &str, about: &BackupFile, folder: &Path) -> Result<(), Failure> {
        let damaged = |why: &dyn std::fmt::Display| {
            Failure::input(format!("{path} in {} is damaged: {why}; use another backup", self.file.display()))
        };
        let mut entry = self.archive.by_name(path).map_err(|error| damaged(&error))?;
        let readers = if about.is_private { Readers::Owner } else { Readers::All };
        let target = folder.join(path);
        let mut source = None;
        let written = disk::replace_with(&target, readers, |file| {
            let mut counted =
                Counted { entry: (&mut entry).take(about.bytes.saturating_add(1)), failure: None };
            let copied = io::copy(&mut counted, file);
            if let Some(error) = counted.failure {
                source = Some(error.to_string());
            } else if copied.as_ref().is_ok_and(|bytes| *bytes != about.bytes) {
                source = Some(format!("it has not the stated {} bytes", about.bytes));
            }
            copied?;
            let modified = UNIX_EPOCH.checked_add(Duration::from_millis(about.modified_ms));
            // Some file systems do not keep times of changes.
            let _ = modified.map(|time| file.set_modified(time));
            Ok::<(), io::Error>(())
        });
        match (source, written) {
            (Some(why), _) => Err(damaged(&why)),
            (None, Ok(())) => Ok(()),
            (None, Err(error)) => Err(Failure::problem(format!(
                "{} cannot be written: {error}; nothing was restored",
                target.display()
            ))),
        }
    }
}

/// Reads an entry of the zip and keeps an error of reading, so that it is not taken for an error of writing.
struct Counted<R> {
    entry: R,
    failure: Option<io::Error>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.entry.read(buffer).map_err(|error| {
            let kind = error.kind();
            self.failure = Some(error);
            io::Error::from(kind)
        })
    }
}

/// Returns an error if the list and the archive name different files, or if a path is not allowed.
fn check(archive: &ZipArchive<BufReader<File>>, list: &BackupList) -> Result<(), String> {
    let shown = |path: &str| path.chars().filter(|letter| !letter.is_control()).take(100).collect::<String>();
    let mut names = BTreeSet::new();
    for name in archive.file_names() {
        let name = name.map_err(|error| error.to_string())?;
        if name != LIST {
            paths::check_restored(&name)
                .map_err(|why| format!("it holds \"{}\", and {why}; do not trust it", shown(&name)))?;
            names.insert(name.into_owned());
        }
    }
    let listed: BTreeSet<String> = list.files.keys().cloned().collect();
    match names.symmetric_difference(&listed).next() {
        None => Ok(()),
        Some(path) => {
            Err(format!("its list and its files differ in \"{}\"; use another backup", shown(path)))
        }
    }
}

/// Whether a folder holds any file or folder, except those files of `paths::OF_A_RUNNING_PROGRAM` that lie directly in it. A
/// program leaves them in an empty data folder. The journal lies deeper: a folder with an unfinished run holds files, so
/// that the run is moved aside and not deleted.
fn holds_files(data: &Path) -> Result<bool, Failure> {
    let failed = |error: io::Error| {
        Failure::problem(format!(
            "{} cannot be read: {error}; name another folder with --data DIR",
            data.display()
        ))
    };
    for entry in fs::read_dir(data).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name();
        if !name.to_str().is_some_and(|name| paths::OF_A_RUNNING_PROGRAM.contains(&name)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Gives the folder `staging` the name `data`. If `holds_files`, the old folder `data` is first renamed, and its new path is
/// returned. Otherwise the old folder is deleted first if it exists, and the result is `None`.
fn put_in_place(staging: &Path, data: &Path, holds_files: bool) -> Result<Option<PathBuf>, Failure> {
    let failed = |error: io::Error| {
        Failure::problem(format!(
            "{} cannot be put in place: {error}; name another folder with --data DIR",
            data.display()
        ))
    };
    if !holds_files {
        if data.exists() {
            for path in paths::OF_A_RUNNING_PROGRAM {
                disk::remove(&data.join(path)).map_err(failed)?;
            }
            fs::remove_dir(data).map_err(failed)?;
        }
        disk::rename(staging, data).map_err(failed)?;
        return Ok(None);
    }
    let before = (1..).map(|number| beside(data, &format!("before-{number}"))).find(|path| !path.exists());
    let before = before.unwrap_or_else(|| beside(data, "before"));
    disk::rename(data, &before).map_err(failed)?;
    if let Err(error) = disk::rename(staging, data) {
        // Restores the folder that was there before.
        let _ = disk::rename(&before, data);
        return Err(failed(error));
    }
    Ok(Some(before))
}

/// Returns a path beside a folder: the folder's name, a dot and `ending`.
fn beside(folder: &Path, ending: &str) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{ending}"));
    folder.with_file_name(name)
}

/// The folder into which a backup is unpacked. It is removed when this value is dropped, unless it was renamed before.
struct Staging(PathBuf);

impl Staging {
    fn beside(data: &Path) -> Result<Self, Failure> {
        let name_it = "name a folder with --data DIR";
        if data.file_name().is_none() {
            return Err(Failure::input(format!("{} has no name of its own: {name_it}", data.display())));
        }
        let path = beside(data, &format!("restoring-{}", std::process::id()));
        // An earlier process with the same id may have been killed and have left the folder behind.
        let _ = fs::remove_dir_all(&path);
        disk::create_folder(&path).map_err(|error| {
            Failure::problem(format!("{} cannot be made: {error}; {name_it} elsewhere", path.display()))
        })?;
        Ok(Self(path))
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // Fails if the folder was renamed, which is usual.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_with_an_unfinished_run_holds_files_and_one_with_lock_files_does_not() {
        let folder = std::env::temp_dir().join(format!("lightbots-restore-{}", std::process::id()));
        fs::create_dir_all(folder.join("runs")).unwrap();
        fs::write(folder.join("runs/present.lbjournal"), b"run").unwrap();
        assert!(holds_files(&folder).unwrap());
        fs::remove_dir_all(folder.join("runs")).unwrap();
        fs::write(folder.join(".lock"), b"process 1").unwrap();
        assert!(!holds_files(&folder).unwrap());
        fs::remove_dir_all(&folder).unwrap();
    }
}
