//! From an archive to a show.

use std::collections::BTreeMap;
use std::sync::Arc;

use lightbots_show::{AssetHash, Issue, excerpt};

use super::{ASSETS, DOCUMENT, ENTRIES_MAX, hash_of};
use crate::error::ReadError;
use crate::format::Loaded;
use crate::lightbots;
use crate::zip_files::{damaged, unpack};

/// What an archive holds.
#[derive(Default)]
struct Files {
    document: Option<Vec<u8>>,
    assets: BTreeMap<AssetHash, Arc<[u8]>>,
    /// Names of files that are neither the document nor assets.
    unknown: Vec<String>,
}

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let mut files = Files::default();
    unpack(bytes, ENTRIES_MAX, |name, content| take(&mut files, name, content))?;
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

/// Adds one file of the archive to `files`. Fails for a second document, and for an asset whose content does not have
/// the hash in its name.
fn take(files: &mut Files, name: String, content: Vec<u8>) -> Result<(), ReadError> {
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

/// Adds the archive's files to the show's assets, and issues about missing and unknown files to the result. Files that
/// the show does not name are unknown, and count as unread. Fails if the length of a file differs from the length that
/// the show states.
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
