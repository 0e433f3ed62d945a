//! From an archive to a show. Nothing that an archive says of itself is trusted: files are counted, and their bytes are
//! counted while they are unpacked.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::sync::Arc;

use lightbots_show::{AssetHash, Issue, excerpt};
use zip::ZipArchive;

use super::{ASSETS, DOCUMENT, ENTRIES_MAX, hash_of};
use crate::error::ReadError;
use crate::format::Loaded;
use crate::lightbots;
use crate::limits::MAX_BYTES;

/// First bytes of a record of the archive's directory.
const DIRECTORY_RECORD: &[u8] = b"PK\x01\x02";

/// What an archive holds.
#[derive(Default)]
struct Files {
    document: Option<Vec<u8>>,
    assets: BTreeMap<AssetHash, Arc<[u8]>>,
    /// Names of files that no show has.
    unknown: Vec<String>,
    /// Bytes that further files may take.
    room: usize,
}

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let files = unpack(bytes)?;
    let document = files.document.as_ref().ok_or_else(|| {
        let what = format!("the archive has no file {DOCUMENT}, so it is no show; open another file");
        ReadError::whole("not-a-show", what)
    })?;
    if !lightbots::sniff(document) {
        let what = format!("{DOCUMENT} in the archive is no show of LightBots; open another file");
        return Err(ReadError::whole("not-a-show", what));
    }
    let loaded = lightbots::read(document).map_err(|error| {
        let what = format!("{} (in {DOCUMENT} of the archive)", error.what);
        ReadError { what, ..error }
    })?;
    with_files(loaded, files)
}

fn unpack(bytes: &[u8]) -> Result<Files, ReadError> {
    // The library keeps the whole directory in memory before it can be counted.
    let records = bytes.windows(DIRECTORY_RECORD.len()).filter(|bytes| *bytes == DIRECTORY_RECORD);
    if records.take(2 * ENTRIES_MAX).count() == 2 * ENTRIES_MAX {
        return Err(too_many());
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
    if archive.len() > ENTRIES_MAX {
        return Err(too_many());
    }
    let mut files = Files { room: MAX_BYTES, ..Files::default() };
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).map_err(|error| damaged(&error.to_string()))?;
        let name = file.name().map_err(|error| damaged(&error.to_string()))?.into_owned();
        if leaves_the_archive(&name) {
            let what = format!("the archive holds \"{}\", a path out of it; do not trust it", excerpt(&name));
            return Err(ReadError::whole("bad-path", what));
        }
        if !file.is_dir() {
            take(&mut files, name, &mut file)?;
        }
    }
    Ok(files)
}

fn leaves_the_archive(name: &str) -> bool {
    name.starts_with('/') || name.contains(['\\', ':', '\0']) || name.split('/').any(|part| part == "..")
}

/// Unpacks one file.
fn take(files: &mut Files, name: String, file: &mut impl Read) -> Result<(), ReadError> {
    let mut content = Vec::new();
    let most = files.room as u64 + 1;
    file.take(most)
        .read_to_end(&mut content)
        .map_err(|error| damaged(&format!("\"{}\": {error}", excerpt(&name))))?;
    files.room = files.room.checked_sub(content.len()).ok_or_else(|| {
        let mib = MAX_BYTES >> 20;
        ReadError::whole(
            "too-big",
            format!("the archive unpacks to more than {mib} MiB; take files out of it"),
        )
    })?;
    if name == DOCUMENT {
        return match files.document.replace(content) {
            None => Ok(()),
            Some(_) => Err(damaged(&format!("{DOCUMENT} is there twice"))),
        };
    }
    let Some(stated) = name.strip_prefix(ASSETS).and_then(AssetHash::from_hex) else {
        files.unknown.push(name);
        return Ok(());
    };
    let hash = hash_of(&content);
    if hash != stated {
        let what = format!("the file {name} was changed: its SHA-256 is {hash}; save or copy the show again");
        return Err(ReadError::whole("wrong-hash", what));
    }
    files.assets.insert(hash, content.into());
    Ok(())
}

/// The show with the files that it names, and with issues about the others.
fn with_files(mut loaded: Loaded, mut files: Files) -> Result<Loaded, ReadError> {
    for (hash, asset) in &mut loaded.show.assets {
        asset.content = files.assets.remove(hash);
        match &asset.content {
            Some(content) if content.len() as u64 != asset.bytes => {
                let what = format!(
                    "the show says that its file \"{}\" has {} bytes, but it has {}; save or copy the show again",
                    excerpt(&asset.name),
                    asset.bytes,
                    content.len()
                );
                return Err(ReadError::whole("wrong-length", what));
            }
            Some(_) => {}
            None => {
                let what = format!(
                    "the file \"{}\" of the show is not in the archive; add it again",
                    excerpt(&asset.name)
                );
                loaded.issues.push(Issue::warning("missing-file", what));
            }
        }
    }
    let unnamed = files.assets.keys().map(|hash| format!("{ASSETS}{hash}"));
    let unknown: Vec<String> = files.unknown.iter().cloned().chain(unnamed).collect();
    if let Some(first) = unknown.first() {
        let others = match unknown.len() - 1 {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let what =
            format!("the archive holds files that the show does not name (\"{}\"{others})", excerpt(first));
        loaded
            .issues
            .push(Issue::warning("unknown-file", format!("{what}; they are neither played nor converted")));
        let reason = "it holds files that are not known".to_owned();
        loaded.unread = Some(loaded.unread.map_or(reason.clone(), |fields| format!("{fields} and {reason}")));
    }
    Ok(loaded)
}

fn too_many() -> ReadError {
    let what = format!("the archive holds more than {ENTRIES_MAX} files; take some out of it");
    ReadError::whole("too-many-files", what)
}

fn damaged(why: &str) -> ReadError {
    let what = format!("the archive is damaged ({}); save or copy it again", excerpt(why));
    ReadError::whole("bad-archive", what)
}
