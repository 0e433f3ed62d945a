//! Files in a zip archive, in memory. Sizes that an archive states are not trusted: files are counted, and their bytes
//! are counted while they are unpacked.

use std::io::{Cursor, Read, Write};

use lightbots_show::{Issue, excerpt};
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

use crate::error::ReadError;
use crate::limits::MAX_BYTES;

/// First bytes of a record of the archive's directory.
const DIRECTORY_RECORD: &[u8] = b"PK\x01\x02";
/// Offset of the length of the file's name in a record of the directory, bytes (APPNOTE 6.3.10, 4.3.12).
const NAME_LENGTH_AT: usize = 28;
/// Offset of the file's name: see [`NAME_LENGTH_AT`].
const NAME_AT: usize = 46;

/// Whether the bytes begin like an archive: `PK` and the kind of its first record, an entry or the end.
pub(crate) fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Whether the directory of an archive seems to hold a file whose name `is_wanted` accepts. Unpacks nothing.
pub(crate) fn holds(bytes: &[u8], is_wanted: impl Fn(&[u8]) -> bool) -> bool {
    is_zip(bytes) && records(bytes).any(|record| name_of(record).is_some_and(&is_wanted))
}

/// For each position where the bytes look like the start of a directory record, the bytes from there on. File contents
/// may also look so.
fn records(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let begins = bytes.windows(DIRECTORY_RECORD.len()).enumerate();
    begins.filter(|(_, window)| *window == DIRECTORY_RECORD).map(|(at, _)| &bytes[at..])
}

fn name_of(record: &[u8]) -> Option<&[u8]> {
    let length = record.get(NAME_LENGTH_AT..NAME_LENGTH_AT + 2)?;
    let length = usize::from(u16::from_le_bytes([length[0], length[1]]));
    record.get(NAME_AT..NAME_AT + length)
}

/// Unpacks the files of an archive, and calls `take` with the name and the bytes of each. Folders are skipped. Fails if
/// `take` does, for a name that leads out of the archive, for more than `entries_max` entries, and for more than
/// [`MAX_BYTES`] of files.
pub(crate) fn unpack(
    bytes: &[u8],
    entries_max: usize,
    mut take: impl FnMut(String, Vec<u8>) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    // Records are counted first, because the library keeps the whole directory in memory.
    if records(bytes).take(2 * entries_max).count() == 2 * entries_max {
        return Err(too_many(entries_max));
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
    if archive.len() > entries_max {
        return Err(too_many(entries_max));
    }
    let mut room = MAX_BYTES;
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).map_err(|error| damaged(&error.to_string()))?;
        let name = file.name().map_err(|error| damaged(&error.to_string()))?.into_owned();
        if leaves_the_archive(&name) {
            let what = format!("the archive holds \"{}\", a path out of it; do not trust it", excerpt(&name));
            return Err(ReadError::whole("bad-path", what));
        }
        if !file.is_dir() {
            let content = content(&name, &mut file, &mut room)?;
            take(name, content)?;
        }
    }
    Ok(())
}

fn leaves_the_archive(name: &str) -> bool {
    name.starts_with('/') || name.contains(['\\', ':', '\0']) || name.split('/').any(|part| part == "..")
}

/// Unpacks one file. `room` is the number of bytes that all remaining files together may have.
fn content(name: &str, file: &mut impl Read, room: &mut usize) -> Result<Vec<u8>, ReadError> {
    let mut content = Vec::new();
    file.take(*room as u64 + 1)
        .read_to_end(&mut content)
        .map_err(|error| damaged(&format!("\"{}\": {error}", excerpt(name))))?;
    *room = room.checked_sub(content.len()).ok_or_else(|| {
        let mib = MAX_BYTES >> 20;
        ReadError::whole(
            "too-big",
            format!("the archive unpacks to more than {mib} MiB; take files out of it"),
        )
    })?;
    Ok(content)
}

fn too_many(entries_max: usize) -> ReadError {
    let what = format!("the archive holds more than {entries_max} files; take some out of it");
    ReadError::whole("too-many-files", what)
}

/// The error for an archive that cannot be unpacked, because of `why`.
pub(crate) fn damaged(why: &str) -> ReadError {
    let what = format!("the archive is damaged ({}); save or copy it again", excerpt(why));
    ReadError::whole("bad-archive", what)
}

/// Packs files with their names into an archive. Equal files give equal bytes, because entries have no date.
pub(crate) fn pack<'a>(files: impl IntoIterator<Item = (String, &'a [u8])>) -> Result<Vec<u8>, Issue> {
    let cannot = |error| Issue::error("not-packed", format!("the archive could not be made: {error}"));
    packed(files).map_err(cannot)
}

fn packed<'a>(files: impl IntoIterator<Item = (String, &'a [u8])>) -> ZipResult<Vec<u8>> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        archive.start_file(name, options)?;
        archive.write_all(content)?;
    }
    Ok(archive.finish()?.into_inner())
}
