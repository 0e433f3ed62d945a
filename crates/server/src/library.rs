//! The library: a folder of shows, and the built-in shows.
//!
//! Built-in shows (`Given` in the code) are the examples, and the file that `run` was started with. They are read-only
//! and in no folder:
//! - Saving one makes a copy in the folder under a free name, such as "heart 2".
//! - Deleting one is refused. Renaming one is refused too, because it means saving under another name and deleting.
//!
//! Shows in the folder:
//! - A file that is only partly understood (see `Loaded::unread`) is kept byte for byte. It is never replaced; it can
//!   be deleted, and read with [`Library::file`].
//! - Documents are kept as `NAME.lightbots.json`, and the files that belong to them in `assets`, each once. A
//!   `NAME.lightbots.zip` in the folder is read too, and becomes a document when it is saved.
//! - Each save keeps the file that it replaces as an earlier state (`states`), so that any of the last saves can come
//!   back.
//! - A file in the folder always keeps its name. If a built-in show has the same name, the built-in show is listed
//!   under another, such as "heart (example)" or "my show (file)".

mod asset_store;
mod facts;
mod given;
mod lock;
mod names;
mod outcome;
mod saving;
mod show_files;
mod states;
mod version;

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use lightbots_api::{ShowEntry, ShowOrigin, ShowState};
use lightbots_exchange::{ARCHIVE, Format, LIGHTBOTS, Loaded, hash_of, read, sniff};
use lightbots_show::{AssetHash, Issues, Show};

use crate::disk::{self, Readers};
use crate::examples;
use crate::layer_pictures::LayerPictures;
use asset_store::AssetStore;
use facts::{FileFacts, ListFacts};
use given::{Given, GivenShows};
pub use names::name_of_file;
use names::tidy_name;
pub use outcome::{Condition, Kept, LibraryError};
use show_files::ShowFiles;
use states::States;
use version::{etag, modified_ms};

/// Name of the file that holds the name of the show that was open last.
const OPEN: &str = ".open";
/// Most bytes that are read from [`OPEN`]: more than any name has.
const NAME_BYTES_MAX: u64 = 1_000;
/// Most shows of the folder that are listed.
const SHOWS_MAX: usize = 10_000;

/// The library of shows. Clones share its content.
#[derive(Clone, Debug)]
pub struct Library {
    files: ShowFiles,
    /// Earlier states of the files.
    states: States,
    /// Facts about the files that lists display.
    facts: FileFacts,
    /// Built-in shows, which are in no folder, by the names under which they are listed.
    given: GivenShows,
    /// Lock that is held while a file is compared and replaced.
    writing: Arc<Mutex<()>>,
    /// Assets: files that belong to the shows.
    assets: AssetStore,
    pictures: LayerPictures,
}

impl Library {
    /// Returns the library in a folder, with the examples. The folder is made when the first show is saved.
    pub fn new(folder: PathBuf) -> Self {
        let library = Self::without_examples(folder);
        for (name, bytes) in examples::all() {
            match read(bytes, None) {
                Ok(loaded) => {
                    library.give(name, ShowOrigin::Example, &loaded.show, None);
                }
                Err(error) => tracing::error!("the example {name} is no show: {error}"),
            }
        }
        library
    }

    /// Folder of the library.
    pub fn folder(&self) -> &Path {
        self.files.folder()
    }

    fn without_examples(folder: PathBuf) -> Self {
        Self {
            states: States::new(folder.join("history")),
            assets: AssetStore::new(folder.join("assets")),
            pictures: LayerPictures::default(),
            files: ShowFiles::new(folder),
            facts: FileFacts::default(),
            given: GivenShows::default(),
            writing: Arc::default(),
        }
    }

    /// Removes drafts that a crash left, states of shows that were deleted long ago, and old assets that neither a show nor
    /// a state names. To be called only while no other program uses the folder.
    pub fn tidy_up(&self) {
        disk::remove_drafts(self.files.folder());
        self.assets.remove_drafts();
        for show in self.states.shows() {
            self.states.remove_drafts(&show);
        }
        self.states.sweep(&self.files.names());
        self.sweep();
    }

    /// Adds a built-in show and returns the name under which it is listed, as close to `name` as possible. If `show` is
    /// the file of the command line and an example has its name, the file gets the name. The example is then listed
    /// under another name. `unread` says why the show's file holds more than the show; `None`: it does not.
    pub fn give(&self, name: &str, origin: ShowOrigin, show: &Show, unread: Option<String>) -> String {
        self.assets.give(show);
        self.given.add(Given::new(tidy_name(name), origin, show, unread), &self.files.names())
    }

    /// Saves the name of the open show for later starts. A failure is only logged.
    pub fn remember(&self, name: &str) {
        let folder = self.files.folder();
        let kept = disk::replace(&folder.join(OPEN), name.as_bytes(), Readers::All);
        if let Err(error) = kept {
            tracing::debug!("the open show is not remembered: {error}");
        }
    }

    /// Returns the name of the show that was open last, if that name was saved and the show can still be read.
    pub fn remembered(&self) -> Option<String> {
        let name = disk::read_regular(&self.files.folder().join(OPEN), NAME_BYTES_MAX).ok()?;
        let name = String::from_utf8(name).ok()?;
        self.get(&name).is_ok().then_some(name)
    }

    /// Returns the entries of the readable shows, sorted by name: the built-in ones, and of the folder at most
    /// `SHOWS_MAX`.
    pub fn list(&self) -> Vec<ShowEntry> {
        let names = self.files.names().into_iter().take(SHOWS_MAX).chain(self.given.names());
        let entries = names.filter_map(|name| Some((name.clone(), self.entry(&name).ok()?)));
        entries.collect::<BTreeMap<_, _>>().into_values().collect()
    }

    /// Reads a show by its name: the file of that name, else the built-in show.
    pub fn get(&self, name: &str) -> Result<Kept, LibraryError> {
        let name = checked(name)?;
        let (bytes, unread) = self.stored(name)?;
        self.kept(name, bytes, unread)
    }

    /// Reads the show in a file's bytes, and copies the files of an archive to the assets. `unread` says why the original
    /// file of a built-in show holds more than `bytes`; `None`: it does not, or the show is not built-in.
    fn kept(&self, name: &str, bytes: Vec<u8>, unread: Option<String>) -> Result<Kept, LibraryError> {
        let loaded = read(&bytes, None)
            .map_err(|error| LibraryError::NoShow(format!("\"{name}\" cannot be read: {error}")))?;
        let Loaded { mut show, unread: unread_fields, .. } = loaded;
        // The files in an archive are kept, because they are needed when a screen saves the document.
        if sniff(&bytes) == Some(&ARCHIVE)
            && let Err(error) = self.assets.keep(&show)
        {
            tracing::warn!("files of \"{name}\" cannot be kept: {error}");
        }
        show.assets.values_mut().for_each(|asset| asset.content = None);
        let unread = unread.or(unread_fields);
        let etag = etag(&bytes);
        let is_document = sniff(&bytes) == Some(&LIGHTBOTS) && unread.is_none();
        let bytes = if is_document { bytes } else { LIGHTBOTS.write(&show, None).bytes };
        let read_only = unread.map(|reason| read_only_line(name, &reason));
        Ok(Kept { etag, bytes, show, read_only, issues: Issues::new() })
    }

    /// Returns the states of a show, the newest first: the present one, and the earlier ones that can be read. An
    /// earlier state that equals the next newer one is left out.
    pub fn states(&self, name: &str) -> Result<Vec<ShowState>, LibraryError> {
        let name = checked(name)?;
        let now = self.entry(name)?;
        let mut states = vec![ShowState {
            number: None,
            saved_ms: now.modified_ms,
            title: now.title,
            frames: now.frames,
            pixels: now.pixels,
            etag: now.etag,
        }];
        for (number, file) in self.states.of(name) {
            let Ok(facts) = self.facts.get(&file) else { continue };
            // A crash may leave a state twice.
            if states.last().is_some_and(|newer| newer.etag == facts.etag) {
                continue;
            }
            let ListFacts { title, frames, pixels, etag, .. } = facts;
            let saved_ms = modified_ms(&file);
            states.push(ShowState { number: Some(number), saved_ms, title, frames, pixels, etag });
        }
        Ok(states)
    }

    /// Reads an earlier state of a show.
    pub fn state(&self, name: &str, number: u32) -> Result<Kept, LibraryError> {
        let name = checked(name)?;
        let missing = || LibraryError::Missing(format!("\"{name}\" has no state {number} any more"));
        let file = self.states.file(name, number).ok_or_else(missing)?;
        let bytes = show_files::read(&file).map_err(|error| LibraryError::unreadable(name, &error))?;
        self.kept(name, bytes, None)
    }

    /// Returns the bytes of a show's file as the library keeps it, and its format. A built-in show gives the bytes of its
    /// document.
    pub fn file(&self, name: &str) -> Result<(Vec<u8>, &'static Format), LibraryError> {
        let (bytes, _) = self.stored(checked(name)?)?;
        let format = sniff(&bytes).unwrap_or(&LIGHTBOTS);
        Ok((bytes, format))
    }

    /// Fills in the content of the assets that a show names. Assets that the library lacks stay without content.
    pub fn attach(&self, show: &mut Show) {
        self.assets.attach(show);
    }

    /// Decodes the pictures of a show's layers and stores them in the show. Returns a warning for each file that cannot be
    /// shown; layers with that file stay dark.
    pub fn attach_pictures(&self, show: &mut Show) -> Issues {
        self.pictures.attach(show, |hash, asset| self.assets.of(hash, asset))
    }

    /// Decodes the pictures of the show's layers and stores them in `kept.show`. Sets `kept.issues` to the warnings
    /// about files that cannot be shown.
    pub fn with_pictures(&self, mut kept: Kept) -> Kept {
        kept.issues = self.attach_pictures(&mut kept.show);
        kept
    }

    /// Returns an asset by its hash, the SHA-256 in hexadecimal digits. Error if the library does not have it.
    pub fn asset(&self, hash: &str) -> Result<Arc<[u8]>, LibraryError> {
        let content = self.assets.get(asset_hash(hash)?);
        content.ok_or_else(|| LibraryError::Missing(format!("there is no file {hash} in the library")))
    }

    /// Adds an asset, which shows can then name by its hash. Error if `hash` is no SHA-256 in hexadecimal digits, if
    /// the content has another hash, or if the disk cannot be written.
    pub fn put_asset(&self, hash: &str, content: &[u8]) -> Result<(), LibraryError> {
        let stated = asset_hash(hash)?;
        let found = hash_of(content);
        if found != stated {
            let line = format!("the file has the SHA-256 {found}: it was changed on its way; send it again");
            return Err(LibraryError::NoShow(line));
        }
        let kept = self.assets.add(stated, content);
        kept.map_err(|error| LibraryError::Disk(format!("the file {hash} cannot be saved: {error}")))
    }

    /// Returns the bytes of a show. For a built-in show, also returns why its original file holds more than these bytes, if
    /// it does.
    fn stored(&self, name: &str) -> Result<(Vec<u8>, Option<String>), LibraryError> {
        match self.files.read(name) {
            Ok(bytes) => Ok((bytes, None)),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let given = self.given.get(name).ok_or_else(|| LibraryError::missing(name))?;
                Ok((given.bytes, given.facts.unread))
            }
            Err(error) => Err(LibraryError::unreadable(name, &error)),
        }
    }

    /// Deletes old assets that no show of the folder and no earlier state names. Deletes nothing if one of these files
    /// cannot be read.
    fn sweep(&self) {
        // Shows are many and large, so they are read only if there is something to delete.
        if !self.assets.has_old() {
            return;
        }
        let shows = self.files.names().into_iter().map(|name| self.files.present(&name));
        let states = self.states.shows().into_iter().flat_map(|show| self.states.of(&show));
        let files = shows.chain(states.map(|(_, file)| file));
        let named = files.map(|file| {
            let loaded = show_files::read(&file).ok().and_then(|bytes| read(&bytes, None).ok());
            loaded.map(|loaded| loaded.show.assets.into_keys().collect::<Vec<_>>())
        });
        // A show that cannot be read may name any file, so nothing is deleted then.
        if let Some(named) = named.collect::<Option<Vec<_>>>() {
            self.assets.sweep(&named.into_iter().flatten().collect());
        }
    }

    /// Returns the built-in show of this name, unless a file has the name.
    fn given_show(&self, name: &str) -> Option<Given> {
        self.given.get(name).filter(|_| !self.files.present(name).exists())
    }

    fn entry(&self, name: &str) -> Result<ShowEntry, LibraryError> {
        let file = self.files.present(name);
        let (facts, origin, modified_ms) = if file.exists() {
            let facts = self.facts.get(&file);
            let facts =
                facts.map_err(|why| LibraryError::NoShow(format!("\"{name}\" cannot be read: {why}")))?;
            (facts, ShowOrigin::Saved, modified_ms(&file))
        } else {
            let given = self.given.get(name).ok_or_else(|| LibraryError::missing(name))?;
            (given.facts, given.origin, 0)
        };
        Ok(ShowEntry {
            name: name.to_owned(),
            title: facts.title,
            frames: facts.frames,
            pixels: facts.pixels,
            modified_ms,
            etag: facts.etag,
            origin,
            read_only: facts.unread.map(|reason| read_only_line(name, &reason)),
            copy_of: None,
            issues: Vec::new(),
        })
    }
}

/// Returns a line that says why a show cannot be replaced, and what to do.
fn read_only_line(name: &str, reason: &str) -> String {
    format!(
        "\"{name}\" is read-only, because {reason}: update LightBots, or save a copy under another name, which will be \
         without them"
    )
}

fn asset_hash(text: &str) -> Result<AssetHash, LibraryError> {
    AssetHash::from_hex(text).ok_or_else(|| {
        LibraryError::BadName("a file is named by its SHA-256: 64 digits from 0 to 9 and a to f".to_owned())
    })
}

fn checked(name: &str) -> Result<&str, LibraryError> {
    names::checked(name).map_err(LibraryError::BadName)
}

#[cfg(test)]
#[path = "library_tests.rs"]
mod tests;
