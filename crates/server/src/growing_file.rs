//! A file that grows while something is computed.

use std::io::{BufWriter, Write};
use std::path::Path;

use crate::failure::Failure;

/// A file that is written while a rehearsal or replay goes on. What it held before stays until the first byte is written, so
/// that input which cannot be used costs nothing.
#[derive(Debug)]
pub struct GrowingFile<'a> {
    path: &'a Path,
    file: BufWriter<std::fs::File>,
    /// What it held before is gone.
    is_begun: bool,
    /// The first failure, after which nothing is written.
    failure: Option<std::io::Error>,
}

impl<'a> GrowingFile<'a> {
    /// A file at a path, which must be writable.
    pub fn create(path: &'a Path) -> Result<Self, Failure> {
        let options = std::fs::OpenOptions::new().write(true).create(true).truncate(false).open(path);
        let file = options.map_err(|error| Failure::unwritable(path, &error))?;
        Ok(Self { path, file: BufWriter::new(file), is_begun: false, failure: None })
    }

    /// Writes on, unless writing failed before.
    pub fn append(&mut self, bytes: &[u8]) {
        if self.failure.is_none() {
            self.failure = self.begin().and_then(|()| self.file.write_all(bytes)).err();
        }
    }

    /// Waits for the disk; an error if any of it was not written.
    pub fn finish(mut self) -> Result<(), Failure> {
        if self.failure.is_none() {
            self.failure = self.begin().and_then(|()| self.file.flush()).err();
        }
        self.failure.map_or(Ok(()), |error| Err(Failure::unwritable(self.path, &error)))
    }

    fn begin(&mut self) -> std::io::Result<()> {
        if self.is_begun {
            return Ok(());
        }
        self.is_begun = true;
        empty(self.file.get_ref())
    }
}

/// Empties a file. What is no regular file (a pipe, `/dev/null`) has nothing to lose and cannot be cut.
fn empty(file: &std::fs::File) -> std::io::Result<()> {
    if file.metadata()?.is_file() { file.set_len(0) } else { Ok(()) }
}
