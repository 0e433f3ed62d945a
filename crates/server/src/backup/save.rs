//! Saves a data folder as a backup, also while a program uses the folder.
//!
//! Files of the folder are replaced whole or only grow. Each file that is opened is thus consistent: the old or the new
//! version, or the beginning of a log. Files that are created during the copying are found by looking again.

use std::collections::BTreeMap;
use std::fs::{File, Metadata};
use std::io::{self, BufWriter, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::{BackupFile, BackupList, FILES_MAX, LIST, VERSION, paths};
use crate::disk::{self, Readers};
use crate::failure::Failure;

/// Largest number of passes over the folder. Each pass after the first saves files that were created during the pass before.
const ROUNDS_MAX: usize = 5;
/// Length in bytes from which on a file is stored with 64-bit sizes in the zip. It is half of what 32-bit sizes hold,
/// because compressed data may be longer than the file.
const LARGE: u64 = 2 << 30;

/// What was saved.
#[derive(Debug, Default)]
pub struct Saved {
    pub files: usize,
    pub bytes: u64,
    /// Paths in the folder that cannot be saved, such as links.
    pub left_out: Vec<PathBuf>,
}

/// Why a backup failed.
enum BackupError {
    /// This file or folder of the data cannot be read.
    Read(PathBuf, io::Error),
    /// The backup cannot be written.
    Write(io::Error),
    /// There are more than [`FILES_MAX`] files.
    TooMany,
}

impl From<io::Error> for BackupError {
    fn from(error: io::Error) -> Self {
        Self::Write(error)
    }
}

/// Saves a data folder into the file `out`, all or nothing.
pub fn save(data: &Path, out: &Path) -> Result<Saved, Failure> {
    check_places(data, out)?;
    let mut saved = Saved::default();
    let written = disk::replace_with(out, Readers::Owner, |file| {
        saved = write(data, BufWriter::new(file))?;
        Ok(())
    });
    written.map_err(|error| match error {
        BackupError::Read(path, error) => {
            Failure::problem(format!("{} cannot be read: {error}; nothing was saved", path.display()))
        }
        BackupError::Write(error) => Failure::problem(format!(
            "{} cannot be written: {error}; free the disk or name another file",
            out.display()
        )),
        BackupError::TooMany => Failure::problem(format!(
            "{} holds more than {FILES_MAX} files: take out what is not of LightBots; nothing was saved",
            data.display()
        )),
    })?;
    Ok(saved)
}

/// Checks that `data` is a folder and that `out` is not in it. A backup in the data folder would be part of the next backup.
fn check_places(data: &Path, out: &Path) -> Result<(), Failure> {
    let folder = data.canonicalize().ok().filter(|folder| folder.is_dir()).ok_or_else(|| {
        Failure::input(format!("there is no data folder {}: name it with --data DIR", data.display()))
    })?;
    let place = out.parent().filter(|place| !place.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let place = place.canonicalize().map_err(|error| {
        Failure::input(format!("the folder {} cannot be used: {error}; make it first", place.display()))
    })?;
    if place.starts_with(&folder) {
        let line = format!("{} is in the data folder itself: name a file elsewhere", out.display());
        return Err(Failure::input(line));
    }
    Ok(())
}

fn write(data: &Path, out: impl Write + Seek) -> Result<Saved, BackupError> {
    let began_ms = unix_ms(Some(SystemTime::now()));
    let mut archive = ZipWriter::new(out);
    let mut files = BTreeMap::new();
    let mut left_out = Default::default();
    for _ in 0..ROUNDS_MAX {
        let found = paths::find(data).map_err(|(path, error)| BackupError::Read(path, error))?;
        left_out = found.odd;
        if found.files.len() + files.len() > 2 * FILES_MAX {
            return Err(BackupError::TooMany);
        }
        let new: Vec<String> = found.files.into_iter().filter(|path| !files.contains_key(path)).collect();
        if new.is_empty() {
            break;
        }
        for path in new {
            if let Some(about) = add(&mut archive, data, &path)? {
                files.insert(path, about);
            }
        }
    }
    if files.len() > FILES_MAX {
        return Err(BackupError::TooMany);
    }
    let bytes = files.values().map(|file| file.bytes).sum();
    let saved = Saved { files: files.len(), bytes, left_out: left_out.into_iter().collect() };
    let program = env!("CARGO_PKG_VERSION").to_owned();
    let list = BackupList { lightbots_backup: VERSION, program, began_ms, files };
    archive.start_file(LIST, options(0)).map_err(io::Error::from)?;
    serde_json::to_writer_pretty(&mut archive, &list).map_err(io::Error::from)?;
    archive.finish().map_err(io::Error::from)?.flush()?;
    Ok(saved)
}

fn options(bytes: u64) -> SimpleFileOptions {
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    options.large_file(bytes >= LARGE).unix_permissions(0o600)
}

/// Adds the file `path` of the data folder to the archive, with its present content. `None` if the file no longer exists.
fn add(
    archive: &mut ZipWriter<impl Write + Seek>,
    data: &Path,
    path: &str,
) -> Result<Option<BackupFile>, BackupError> {
    let full = data.join(path);
    let failed = |error| BackupError::Read(full.clone(), error);
    let mut file = match File::open(&full) {
        Ok(file) => file,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(failed(error)),
    };
    let about = file.metadata().map_err(failed)?;
    archive.start_file(path, options(about.len())).map_err(io::Error::from)?;
    let mut bytes = 0;
    let mut buffer = vec![0; 1 << 16];
    // Of a log that grows meanwhile, only the part is saved that existed when it was opened.
    while bytes < about.len() {
        let most = usize::try_from(about.len() - bytes).unwrap_or(usize::MAX).min(buffer.len());
        let count = match file.read(&mut buffer[..most]) {
            Ok(0) => break,
            Ok(count) => count,
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) => return Err(failed(error)),
        };
        archive.write_all(&buffer[..count])?;
        bytes += count as u64;
    }
    let (modified_ms, is_private) = (unix_ms(about.modified().ok()), is_private(&about));
    Ok(Some(BackupFile { bytes, modified_ms, is_private }))
}

fn unix_ms(time: Option<SystemTime>) -> u64 {
    let since = time.and_then(|time| time.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
    u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
}

#[cfg(unix)]
fn is_private(about: &Metadata) -> bool {
    std::os::unix::fs::PermissionsExt::mode(&about.permissions()) & 0o077 == 0
}

#[cfg(not(unix))]
fn is_private(_: &Metadata) -> bool {
    false
}
