//! Assets of the shows in the library: files `assets/HASH` in its folder, each shared by all shows that name it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use lightbots_exchange::hash_of;
use lightbots_show::{Asset, AssetHash, Show};

use crate::disk::{self, Readers};

/// Time since an asset was written after which it is deleted at the next start of the program, if no show names it.
/// Until then, a show that names the asset can come back: after an undone deletion, or from a draft in a browser.
const UNUSED_FOR: Duration = Duration::from_secs(30 * 24 * 3600);

/// Files by hash. Clones share them.
#[derive(Clone, Debug)]
pub struct AssetStore {
    folder: PathBuf,
    /// Assets of built-in shows. They are kept in memory, because these shows are in no folder.
    given: Arc<Mutex<BTreeMap<AssetHash, Arc<[u8]>>>>,
}

impl AssetStore {
    /// Returns the store in a folder. The folder is made with the first file.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder, given: Arc::default() }
    }

    /// Remembers the files of a built-in show.
    pub fn give(&self, show: &Show) {
        let mut given = self.given.lock().unwrap_or_else(PoisonError::into_inner);
        let contents = show.assets.iter().filter_map(|(hash, asset)| Some((*hash, asset.content.clone()?)));
        given.extend(contents);
    }

    /// Writes the assets of a show to the folder, unless they are there. An asset without content is taken from the built-in
    /// shows, if one of them has it.
    pub fn keep(&self, show: &Show) -> std::io::Result<()> {
        for (hash, asset) in &show.assets {
            if let Some(content) = asset.content.clone().or_else(|| self.given_content(hash)) {
                self.add(*hash, &content)?;
            }
        }
        Ok(())
    }

    /// Writes a file, unless the folder has it. `hash` is the hash of `content`.
    pub fn add(&self, hash: AssetHash, content: &[u8]) -> std::io::Result<()> {
        if self.content(hash, content.len() as u64).is_some() {
            return Ok(());
        }
        disk::replace(&self.folder.join(hash.to_string()), content, Readers::All)
    }

    /// Fills in the content of a show's assets from the store. A missing or damaged asset stays without content.
    pub fn attach(&self, show: &mut Show) {
        for (hash, asset) in show.assets.iter_mut().filter(|(_, asset)| asset.content.is_none()) {
            asset.content = self.of(*hash, asset);
        }
    }

    /// Returns the content of an asset that a show names. `None` if it is missing or damaged.
    pub fn of(&self, hash: AssetHash, asset: &Asset) -> Option<Arc<[u8]>> {
        self.content(hash, asset.bytes).or_else(|| self.given_content(&hash))
    }

    /// Returns the file with this hash and this length in bytes from the folder. `None` if it is missing or damaged.
    fn content(&self, hash: AssetHash, length: u64) -> Option<Arc<[u8]>> {
        let path = self.folder.join(hash.to_string());
        let about = std::fs::metadata(&path).ok()?;
        if about.len() != length {
            return None;
        }
        disk::read_regular(&path, length).ok().filter(|bytes| hash_of(bytes) == hash).map(Arc::from)
    }

    /// Returns the content of the asset with this hash. `None` if it is missing or damaged.
    pub fn get(&self, hash: AssetHash) -> Option<Arc<[u8]>> {
        let length = std::fs::metadata(self.folder.join(hash.to_string())).map(|about| about.len()).ok();
        length.and_then(|length| self.content(hash, length)).or_else(|| self.given_content(&hash))
    }

    /// Removes the drafts that a crash left.
    pub fn remove_drafts(&self) {
        disk::remove_drafts(&self.folder);
    }

    /// Whether there are files that are old enough to be deleted if no show names them.
    pub fn has_old(&self) -> bool {
        self.old().next().is_some()
    }

    /// Deletes old files whose hashes are not in `named`.
    pub fn sweep(&self, named: &BTreeSet<AssetHash>) {
        for file in self.old() {
            let hash = file.file_name().to_str().and_then(AssetHash::from_hex);
            if hash.is_some_and(|hash| !named.contains(&hash))
                && let Err(error) = std::fs::remove_file(file.path())
            {
                tracing::debug!("an unused file stays: {error}");
            }
        }
    }

    fn old(&self) -> impl Iterator<Item = std::fs::DirEntry> {
        let is_old = |file: &std::fs::DirEntry| {
            let modified = file.metadata().and_then(|about| about.modified()).ok();
            let age = modified.and_then(|time| SystemTime::now().duration_since(time).ok());
            age.is_some_and(|age| age > UNUSED_FOR)
        };
        std::fs::read_dir(&self.folder).into_iter().flatten().flatten().filter(is_old)
    }

    fn given_content(&self, hash: &AssetHash) -> Option<Arc<[u8]>> {
        self.given.lock().unwrap_or_else(PoisonError::into_inner).get(hash).cloned()
    }
}
