//! A file that grows while something is computed.

use std::io::{BufWriter, Write};
use std::path::Path;

use crate::failure::Failure;

/// A file to which bytes are appended while something is computed. The old content of a regular file stays until the
/// first call of `append` or `finish`, so that unusable input does not destroy it.
#[derive(Debug)]
pub struct GrowingFile<'a> {
    path: &'a Path,
    file: BufWriter<std::fs::File>,
    /// Whether the old content was removed.
    is_begun: bool,
    /// The first error. After it, nothing more is written. `None`: writing has not failed.
    failure: Option<std::io::Error>,
}

impl<'a> GrowingFile<'a> {
    /// Opens the file at `path`, or makes it. Error if it cannot be written.
    pub fn create(path: &'a Path) -> Result<Self, Failure> {
        let options = std::fs::OpenOptions::new().write(true).create(true).truncate(false).open(path);
        let file = options.map_err(|error| Failure::unwritable(path, &error))?;
        Ok(Self { path, file: BufWriter::new(file), is_begun: false, failure: None })
    }

    /// Appends bytes, unless writing failed before.
    pub fn append(&mut self, bytes: &[u8]) {
        if self.failure.is_none() {
            self.failure = self.begin().and_then(|()| self.file.write_all(bytes)).err();
        }
    }

    /// Writes what is still buffered. Error if any bytes, now or in an earlier call of `append`, could not be written.
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

/// Empties a regular file. A pipe or `/dev/null` is left as it is, because it cannot be truncated.
fn empty(file: &std::fs::File) -> std::io::Result<()> {
    if file.metadata()?.is_file() { file.set_len(0) } else { Ok(()) }
}
