//! The files of shows in the library's folder: `NAME.lightbots.json`, or `NAME.lightbots.zip` where there is no document.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use lightbots_exchange::{ARCHIVE, Format, LIGHTBOTS, MAX_BYTES};

use super::names;
use crate::disk::{self, Readers};

/// Both formats of a show's file. If both files exist, the first is read.
const FORMATS: [&Format; 2] = [&LIGHTBOTS, &ARCHIVE];

/// Files of shows in one folder.
#[derive(Clone, Debug)]
pub struct ShowFiles(PathBuf);

impl ShowFiles {
    /// Returns the show files of a folder. The folder is made when the first file is written.
    pub fn new(folder: PathBuf) -> Self {
        Self(folder)
    }

    /// Returns the folder of the files.
    pub fn folder(&self) -> &Path {
        &self.0
    }

    /// Names of the shows in the folder, each once.
    pub fn names(&self) -> BTreeSet<String> {
        let Ok(files) = std::fs::read_dir(&self.0) else { return BTreeSet::new() };
        let name = |file: std::fs::DirEntry| {
            let file = file.file_name();
            let file = file.to_str()?;
            FORMATS.iter().find_map(|format| file.strip_suffix(format.ending())).map(str::to_owned)
        };
        files.flatten().filter_map(name).filter(|name| names::checked(name).is_ok()).collect()
    }

    /// Returns the path of a show's file: its document, or the archive if there is no document.
    pub fn present(&self, name: &str) -> PathBuf {
        let [document, archive] = FORMATS.map(|format| self.path(name, format));
        if !document.exists() && archive.exists() { archive } else { document }
    }

    /// Reads the bytes of a show's file.
    pub fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        read(&self.present(name))
    }

    /// Writes a show's file in `format`, and removes the show's file in the other format.
    pub fn replace(&self, name: &str, format: &Format, bytes: &[u8]) -> io::Result<()> {
        disk::replace(&self.path(name, format), bytes, Readers::All)?;
        let others = FORMATS.into_iter().filter(|other| other.ending() != format.ending());
        others.into_iter().try_for_each(|other| disk::remove(&self.path(name, other)))
    }

    /// Removes the files of a show.
    pub fn remove(&self, name: &str) -> io::Result<()> {
        FORMATS.into_iter().try_for_each(|format| disk::remove(&self.path(name, format)))
    }

    fn path(&self, name: &str, format: &Format) -> PathBuf {
        self.0.join(format!("{name}{}", format.ending()))
    }
}

/// Reads a file that is not too long to be a show.
pub fn read(file: &Path) -> io::Result<Vec<u8>> {
    disk::read_regular(file, MAX_BYTES as u64)
}
