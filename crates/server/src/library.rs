//! The library: a folder of shows, and the shows that are given with the program.
//!
//! Given shows are the examples, and the file `run` was started with. They are read-only and in no folder:
//! - Saving one makes a copy in the folder under a free name of its own, such as "heart 2".
//! - Deleting one is refused. Renaming is saving under another name and deleting, so that it is refused too.
//! - A file of which only a part is understood (see `Loaded::unread`) is kept byte for byte. It is never replaced; it can
//!   be deleted, and read with [`Library::file`].
//! - Documents are kept as `NAME.lightbots.json`, the files that belong to them once in `assets`. A `NAME.lightbots.zip`
//!   that lies in the folder is read too, and becomes a document when it is saved.
//! - A file of the folder always keeps its name. Where it has the name of a given show, such as one that an older version
//!   saved, the given show is listed under another: "heart (example)" or "my show (file)".

mod asset_store;
mod names;
mod outcome;
mod replace;
mod version;

use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard};

use lightbots_api::{ShowEntry, ShowOrigin};
use lightbots_exchange::{ARCHIVE, Format, LIGHTBOTS, Loaded, hash_of, read, sniff};
use lightbots_show::{AssetHash, Show, most_pixels};

use crate::examples;
use asset_store::AssetStore;
pub use names::name_of_file;
use names::tidy_name;
pub use outcome::{Condition, Kept, LibraryError};
use replace::replace_file;
use version::{etag, modified_ms};

/// The file that names the show that was open last.
const OPEN: &str = ".open";
/// The most shows that are listed and kept.
const SHOWS_MAX: usize = 10_000;

/// Shows by name. Clones share it.
#[derive(Clone, Debug)]
pub struct Library {
    folder: PathBuf,
    /// Shows that are in no folder, by the name they are listed under.
    given: Arc<Mutex<BTreeMap<String, Given>>>,
    /// Held while a file is compared and replaced.
    writing: Arc<Mutex<()>>,
    /// Files that belong to the shows.
    assets: AssetStore,
}

/// A read-only show that is in no folder.
#[derive(Clone, Debug)]
struct Given {
    /// What it is called where no file has that name, and what its copies are named after.
    base: String,
    origin: ShowOrigin,
    /// Its document in our format.
    bytes: Vec<u8>,
    /// Why its file holds more than the document.
    unread: Option<String>,
}

impl Library {
    /// The library in a folder; the folder is made when the first show is saved.
    pub fn new(folder: PathBuf) -> Self {
        let assets = AssetStore::new(folder.join("assets"));
        let library = Self { folder, given: Arc::default(), writing: Arc::default(), assets };
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

    /// The folder the user's data belongs in on this system.
    pub fn default_folder() -> PathBuf {
        let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let data = set("XDG_DATA_HOME")
            .or_else(|| set("APPDATA"))
            .or_else(|| set("HOME").map(|home| home.join(".local/share")));
        data.map_or_else(|| PathBuf::from("lightbots-data"), |data| data.join("lightbots"))
    }

    /// Makes the folder, so that a disk that does not want to says so before anybody draws. The line says what to do.
    pub fn prepare(&self) -> Result<(), String> {
        let probe = self.folder.join(format!(".probe-{}", std::process::id()));
        std::fs::create_dir_all(&self.folder)
            .and_then(|()| std::fs::write(&probe, b""))
            .and_then(|()| std::fs::remove_file(&probe))
            .inspect(|()| self.sweep())
            .map_err(|error| {
                format!(
                    "shows cannot be kept in {}: {error}; name another folder with --data DIR",
                    self.folder.display()
                )
            })
    }

    /// Adds a read-only show that is in no folder; answers the name it is listed under, as close to `name` as it may be.
    /// The file of the command line takes its name from an example, which is then listed under another. `unread`: why the
    /// show's file holds more than the show.
    pub fn give(&self, name: &str, origin: ShowOrigin, show: &Show, unread: Option<String>) -> String {
        let base = tidy_name(name);
        let bytes = LIGHTBOTS.write(show, None).bytes;
        self.assets.give(show);
        let mut given = lock(&self.given);
        let displaces = given.get(&base).is_some_and(|other| other.origin < origin);
        let listed = if displaces { base.clone() } else { self.listed_name(&base, origin, &given) };
        if let Some(moved) = given.insert(listed.clone(), Given { base, origin, bytes, unread }) {
            let elsewhere = self.listed_name(&moved.base, moved.origin, &given);
            given.insert(elsewhere, moved);
        }
        listed
    }

    /// Remembers which show is open, for the next start. A disk that does not want to is no reason to fail.
    pub fn remember(&self, name: &str) {
        let kept = std::fs::create_dir_all(&self.folder)
            .and_then(|()| std::fs::write(self.folder.join(OPEN), name.as_bytes()));
        if let Err(error) = kept {
            tracing::debug!("the open show is not remembered: {error}");
        }
    }

    /// The show that was open last, if it is still there.
    pub fn remembered(&self) -> Option<String> {
        let name = std::fs::read_to_string(self.folder.join(OPEN)).ok()?;
        self.get(&name).is_ok().then_some(name)
    }

    /// Every show, by name.
    pub fn list(&self) -> Vec<ShowEntry> {
        let given: Vec<String> = lock(&self.given).keys().cloned().collect();
        let names = self.saved().into_iter().take(SHOWS_MAX).chain(given);
        let entries = names.filter_map(|name| Some((name.clone(), self.entry(&name).ok()?)));
        entries.collect::<BTreeMap<_, _>>().into_values().collect()
    }

    /// A show by its name: the file of that name, else the given show.
    pub fn get(&self, name: &str) -> Result<Kept, LibraryError> {
        let name = checked(name)?;
        let (bytes, mut unread) = self.stored(name)?;
        let loaded = read(&bytes, None)
            .map_err(|error| LibraryError::NoShow(format!("\"{name}\" cannot be read: {error}")))?;
        let Loaded { mut show, unread: unread_fields, .. } = loaded;
        // What an archive in the folder holds is needed when a screen saves its document.
        if sniff(&bytes) == Some(&ARCHIVE)
            && let Err(error) = self.assets.keep(&show)
        {
            tracing::warn!("files of \"{name}\" cannot be kept: {error}");
        }
        show.assets.values_mut().for_each(|asset| asset.content = None);
        unread = unread.or(unread_fields);
        let etag = etag(&bytes);
        let is_document = sniff(&bytes) == Some(&LIGHTBOTS) && unread.is_none();
        let bytes = if is_document { bytes } else { LIGHTBOTS.write(&show, None).bytes };
        let read_only = unread.map(|reason| read_only_line(name, &reason));
        Ok(Kept { etag, bytes, show, read_only })
    }

    /// The file of a show as it is kept, and its format. Of a given show, the document.
    pub fn file(&self, name: &str) -> Result<(Vec<u8>, &'static Format), LibraryError> {
        let (bytes, _) = self.stored(checked(name)?)?;
        let format = sniff(&bytes).unwrap_or(&LIGHTBOTS);
        Ok((bytes, format))
    }

    /// Gives a show the files that it names, as far as the library has them.
    pub fn attach(&self, show: &mut Show) {
        self.assets.attach(show);
    }

    /// A file that a show may name by its hash.
    pub fn asset(&self, hash: &str) -> Result<Arc<[u8]>, LibraryError> {
        let content = self.assets.get(asset_hash(hash)?);
        content.ok_or_else(|| LibraryError::Missing(format!("there is no file {hash} in the library")))
    }

    /// Adds a file that shows can name by its hash.
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

    /// The bytes of a show, and for a given show why its file holds more.
    fn stored(&self, name: &str) -> Result<(Vec<u8>, Option<String>), LibraryError> {
        match std::fs::read(self.present(name)) {
            Ok(bytes) => Ok((bytes, None)),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let given = lock(&self.given);
                let given = given.get(name).map(|given| (given.bytes.clone(), given.unread.clone()));
                given.ok_or_else(|| {
                    LibraryError::Missing(format!("there is no show \"{name}\" in the library"))
                })
            }
            Err(error) => Err(LibraryError::Disk(format!("the show \"{name}\" cannot be read: {error}"))),
        }
    }

    /// Saves a show of any format; what is kept is ours, or the file itself where it is not understood whole. A given show
    /// is not changed: unless a new show is wanted, a copy of a free name is made, and the entry tells that name and
    /// `copy_of`.
    pub fn put(&self, name: &str, bytes: &[u8], condition: &Condition) -> Result<ShowEntry, LibraryError> {
        let name = checked(name)?;
        let loaded = read(bytes, None).map_err(|error| LibraryError::NoShow(error.to_string()))?;
        let _guard = lock(&self.writing);
        let given = self.given_show(name).filter(|_| *condition != Condition::IsNew);
        let now = self.get(name);
        if given.is_none() {
            check(name, condition, &now)?;
        }
        // A copy of a given show would lose what was not understood, too.
        if let Some(line) = now.ok().and_then(|kept| kept.read_only) {
            return Err(LibraryError::ReadOnly(line));
        }
        let target = given.as_ref().map_or(name.to_owned(), |given| self.copy_name(&given.base));
        self.store(&target, bytes, &loaded).map_err(|error| {
            LibraryError::Disk(format!("\"{target}\" cannot be saved in {}: {error}", self.folder.display()))
        })?;
        Ok(ShowEntry { copy_of: given.map(|given| given.origin), ..self.entry(&target)? })
    }

    fn store(&self, name: &str, bytes: &[u8], loaded: &Loaded) -> std::io::Result<()> {
        let (document, archive) = (self.path(name, &LIGHTBOTS), self.path(name, &ARCHIVE));
        if loaded.unread.is_some() {
            let is_archive = sniff(bytes) == Some(&ARCHIVE);
            let (new, old) = if is_archive { (archive, document) } else { (document, archive) };
            replace_file(&new, bytes)?;
            return remove(&old);
        }
        // First the files, so that there is never a document whose files are lost.
        self.assets.keep(&loaded.show)?;
        replace_file(&document, &LIGHTBOTS.write(&loaded.show, None).bytes)?;
        remove(&archive)
    }

    /// Deletes a show of the folder. Given shows stay.
    pub fn delete(&self, name: &str, condition: &Condition) -> Result<(), LibraryError> {
        let name = checked(name)?;
        let _guard = lock(&self.writing);
        if let Some(given) = self.given_show(name) {
            let what = match given.origin {
                ShowOrigin::StartFile => "is the file LightBots was started with",
                _ => "is an example",
            };
            let line = format!("\"{name}\" {what}, which cannot be deleted or renamed: save a copy instead");
            return Err(LibraryError::ReadOnly(line));
        }
        check(name, condition, &Ok(self.get(name)?))?;
        let removed = remove(&self.path(name, &LIGHTBOTS)).and_then(|()| remove(&self.path(name, &ARCHIVE)));
        removed.map_err(|error| LibraryError::Disk(format!("\"{name}\" cannot be deleted: {error}")))
    }

    /// Deletes files that no show of the folder names any more.
    fn sweep(&self) {
        // Shows are many and large: they are read only where there is something to delete.
        if !self.assets.has_old() {
            return;
        }
        let shows = self.saved().into_iter().take(SHOWS_MAX).map(|name| self.get(&name));
        // A show that cannot be read may name any file.
        if let Ok(shows) = shows.collect::<Result<Vec<_>, _>>() {
            self.assets.sweep(&shows.iter().flat_map(|kept| kept.show.assets.keys().copied()).collect());
        }
    }

    /// The given show of that name, unless a file has the name.
    fn given_show(&self, name: &str) -> Option<Given> {
        lock(&self.given).get(name).filter(|_| !self.present(name).exists()).cloned()
    }

    /// `base`, or where that is taken `base (example)`, `base (example 2)`…, or `base (file)` and so on.
    fn listed_name(&self, base: &str, origin: ShowOrigin, given: &BTreeMap<String, Given>) -> String {
        let word = if origin == ShowOrigin::StartFile { "file" } else { "example" };
        let others = (2..).map(|number| format!("{base} ({word} {number})"));
        let names = [base.to_owned(), format!("{base} ({word})")].into_iter().chain(others);
        self.first_free(names, given)
    }

    /// `base 2`, `base 3`…, the first that is free.
    fn copy_name(&self, base: &str) -> String {
        self.first_free((2..).map(|number| format!("{base} {number}")), &lock(&self.given))
    }

    /// The first of endless `names` that no show has, whatever the case of its letters.
    fn first_free(&self, mut names: impl Iterator<Item = String>, given: &BTreeMap<String, Given>) -> String {
        let saved = self.saved();
        let taken: BTreeSet<String> =
            saved.iter().chain(given.keys()).map(|name| name.to_lowercase()).collect();
        names.find(|name| !taken.contains(&name.to_lowercase())).unwrap_or_default()
    }

    fn entry(&self, name: &str) -> Result<ShowEntry, LibraryError> {
        let kept = self.get(name)?;
        let given = self.given_show(name);
        Ok(ShowEntry {
            name: name.to_owned(),
            title: kept.show.name.clone(),
            frames: kept.show.frames.len(),
            pixels: most_pixels(&kept.show),
            modified_ms: if given.is_some() { 0 } else { modified_ms(&self.present(name)) },
            etag: kept.etag,
            origin: given.map_or(ShowOrigin::Saved, |given| given.origin),
            read_only: kept.read_only,
            copy_of: None,
        })
    }

    /// Names of the shows in the folder, each once.
    fn saved(&self) -> BTreeSet<String> {
        let Ok(files) = std::fs::read_dir(&self.folder) else { return BTreeSet::new() };
        let name = |file: std::fs::DirEntry| {
            let file = file.file_name();
            let file = file.to_str()?;
            [&LIGHTBOTS, &ARCHIVE]
                .iter()
                .find_map(|format| file.strip_suffix(format.ending()))
                .map(str::to_owned)
        };
        files.flatten().filter_map(name).filter(|name| checked(name).is_ok()).collect()
    }

    /// The file of a show: its document, or the archive where there is no document.
    fn present(&self, name: &str) -> PathBuf {
        let (document, archive) = (self.path(name, &LIGHTBOTS), self.path(name, &ARCHIVE));
        if !document.exists() && archive.exists() { archive } else { document }
    }

    fn path(&self, name: &str, format: &Format) -> PathBuf {
        self.folder.join(format!("{name}{}", format.ending()))
    }
}

fn check(name: &str, condition: &Condition, now: &Result<Kept, LibraryError>) -> Result<(), LibraryError> {
    let conflict = |why: &str| Err(LibraryError::Conflict(format!("\"{name}\" {why}")));
    match (condition, now) {
        (Condition::Any, _) | (Condition::IsNew, Err(LibraryError::Missing(_))) => Ok(()),
        (Condition::IsNew, _) => conflict("is there already: choose another name"),
        (Condition::Is(wanted), Ok(now)) if *wanted == now.etag => Ok(()),
        (Condition::Is(_), _) => {
            conflict("was changed by somebody else: look at their version, or save under another name")
        }
    }
}

/// Why a show cannot be replaced, with the remedy.
fn read_only_line(name: &str, reason: &str) -> String {
    format!(
        "\"{name}\" is read-only, because {reason}: update LightBots, or save a copy under another name, which will be \
         without them"
    )
}

/// Removes a file that may not be there.
fn remove(path: &Path) -> std::io::Result<()> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

fn asset_hash(text: &str) -> Result<AssetHash, LibraryError> {
    AssetHash::from_hex(text).ok_or_else(|| {
        LibraryError::BadName("a file is named by its SHA-256: 64 digits from 0 to 9 and a to f".to_owned())
    })
}

fn checked(name: &str) -> Result<&str, LibraryError> {
    names::checked(name).map_err(LibraryError::BadName)
}

/// A panic elsewhere leaves whole values behind: each is replaced in one step.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

#[cfg(test)]
#[path = "library_tests.rs"]
mod tests;
