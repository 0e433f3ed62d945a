//! A file that grows while something is computed.

use std::io::{BufWriter, Write};
use std::path::Path;

use crate::failure::Failure;

/// A file that is written while a rehearsal or replay goes on.
#[derive(Debug)]
pub struct GrowingFile<'a> {
    path: &'a Path,
    file: BufWriter<std::fs::File>,
    /// The first failure, after which nothing is written.
    failure: Option<std::io::Error>,
}

impl<'a> GrowingFile<'a> {
    /// An empty file at a path.
    pub fn create(path: &'a Path) -> Result<Self, Failure> {
        let file = std::fs::File::create(path).map_err(|error| Failure::unwritable(path, &error))?;
        Ok(Self { path, file: BufWriter::new(file), failure: None })
    }

    /// Writes on, unless writing failed before.
    pub fn append(&mut self, bytes: &[u8]) {
        if self.failure.is_none() {
            self.failure = self.file.write_all(bytes).err();
        }
    }

    /// Waits for the disk; an error if any of it was not written.
    pub fn finish(mut self) -> Result<(), Failure> {
        let failure = self.failure.or_else(|| self.file.flush().err());
        failure.map_or(Ok(()), |error| Err(Failure::unwritable(self.path, &error)))
    }
}
