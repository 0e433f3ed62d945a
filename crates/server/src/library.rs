//! The library: a folder of shows, and the shows that are given with the program.
//!
//! Given shows are the examples, and the file `run` was started with. They are read-only and in no folder:
//! - Saving one makes a copy in the folder under a free name of its own, such as "heart 2".
//! - Deleting one is refused. Renaming is saving under another name and deleting, so that it is refused too.
//! - A file of the folder always keeps its name. Where it has the name of a given show, such as one that an older version
//!   saved, the given show is listed under another: "heart (example)" or "my show (file)".

use std::collections::{BTreeMap, BTreeSet};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::UNIX_EPOCH;

use lightbots_api::{ShowEntry, ShowOrigin};
use lightbots_exchange::{LIGHTBOTS, read, stem};
use lightbots_show::{Show, most_pixels};

use crate::examples;

/// The file that names the show that was open last.
const OPEN: &str = ".open";
/// The longest name, in characters.
const NAME_MAX: usize = 80;
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
}

/// A read-only show that is in no folder.
#[derive(Clone, Debug)]
struct Given {
    /// What it is called where no file has that name, and what its copies are named after.
    base: String,
    origin: ShowOrigin,
    /// Its document in our format.
    bytes: Vec<u8>,
}

/// A show as the library keeps it.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Its document in our format.
    pub bytes: Vec<u8>,
    /// The same in memory.
    pub show: Show,
    /// Its version, in quotes.
    pub etag: String,
}

/// Why the library does not do as it is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LibraryError {
    /// The name cannot be one.
    BadName(String),
    /// There is no such show.
    Missing(String),
    /// It was saved elsewhere first.
    Conflict(String),
    /// It is given with the program, and stays as it is.
    ReadOnly(String),
    /// It is no show.
    NoShow(String),
    /// The disk does not want to.
    Disk(String),
}

/// What must be so for a show to be replaced or deleted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Condition {
    /// Nothing.
    #[default]
    Any,
    /// It has this version.
    Is(String),
    /// There is none yet.
    IsNew,
}

impl LibraryError {
    /// One line for people.
    pub fn line(&self) -> &str {
        match self {
            Self::BadName(line)
            | Self::Missing(line)
            | Self::Conflict(line)
            | Self::ReadOnly(line)
            | Self::NoShow(line)
            | Self::Disk(line) => line,
        }
    }
}

impl Library {
    /// The library in a folder; the folder is made when the first show is saved.
    pub fn new(folder: PathBuf) -> Self {
        let library = Self { folder, given: Arc::default(), writing: Arc::default() };
        for (name, bytes) in examples::all() {
            match read(bytes, None) {
                Ok(loaded) => {
                    library.give(name, ShowOrigin::Example, &loaded.show);
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
            .map_err(|error| {
                format!(
                    "shows cannot be kept in {}: {error}; name another folder with --data DIR",
                    self.folder.display()
                )
            })
    }

    /// Adds a read-only show that is in no folder; answers the name it is listed under, as close to `name` as it may be.
    /// The file of the command line takes its name from an example, which is then listed under another.
    pub fn give(&self, name: &str, origin: ShowOrigin, show: &Show) -> String {
        let base = tidy_name(name);
        let bytes = LIGHTBOTS.write(show, None).bytes;
        let mut given = lock(&self.given);
        let displaces = given.get(&base).is_some_and(|other| other.origin < origin);
        let listed = if displaces { base.clone() } else { self.listed_name(&base, origin, &given) };
        if let Some(moved) = given.insert(listed.clone(), Given { base, origin, bytes }) {
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
        let bytes = match std::fs::read(self.path(name)) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                lock(&self.given).get(name).map(|given| given.bytes.clone()).ok_or_else(|| {
                    LibraryError::Missing(format!("there is no show \"{name}\" in the library"))
                })?
            }
            Err(error) => {
                return Err(LibraryError::Disk(format!("the show \"{name}\" cannot be read: {error}")));
            }
        };
        let show = read(&bytes, None)
            .map_err(|error| LibraryError::NoShow(format!("\"{name}\" cannot be read: {error}")))?
            .show;
        Ok(Kept { etag: etag(&bytes), bytes, show })
    }

    /// Saves a show in either format; what is kept is ours. A given show is not changed: unless a new show is wanted, a
    /// copy of a free name is made, and the entry tells that name and `copy_of`.
    pub fn put(&self, name: &str, bytes: &[u8], condition: &Condition) -> Result<ShowEntry, LibraryError> {
        let name = checked(name)?;
        let loaded = read(bytes, None).map_err(|error| LibraryError::NoShow(error.to_string()))?;
        let document = LIGHTBOTS.write(&loaded.show, None).bytes;
        let _guard = lock(&self.writing);
        let given = self.given_show(name).filter(|_| *condition != Condition::IsNew);
        let target = match &given {
            Some(given) => self.copy_name(&given.base),
            None => {
                self.check(name, condition)?;
                name.to_owned()
            }
        };
        self.replace(&target, &document).map_err(|error| {
            LibraryError::Disk(format!("\"{target}\" cannot be saved in {}: {error}", self.folder.display()))
        })?;
        Ok(ShowEntry { copy_of: given.map(|given| given.origin), ..self.entry(&target)? })
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
        self.get(name)?;
        self.check(name, condition)?;
        std::fs::remove_file(self.path(name))
            .map_err(|error| LibraryError::Disk(format!("\"{name}\" cannot be deleted: {error}")))
    }

    /// The given show of that name, unless a file has the name.
    fn given_show(&self, name: &str) -> Option<Given> {
        lock(&self.given).get(name).filter(|_| !self.path(name).exists()).cloned()
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

    fn check(&self, name: &str, condition: &Condition) -> Result<(), LibraryError> {
        let now = self.get(name).map(|kept| kept.etag);
        let conflict = |why: &str| Err(LibraryError::Conflict(format!("\"{name}\" {why}")));
        match (condition, now) {
            (Condition::Any, _) | (Condition::IsNew, Err(LibraryError::Missing(_))) => Ok(()),
            (Condition::IsNew, _) => conflict("is there already: choose another name"),
            (Condition::Is(wanted), Ok(now)) if *wanted == now => Ok(()),
            (Condition::Is(_), _) => {
                conflict("was changed by somebody else: look at their version, or save under another name")
            }
        }
    }

    /// All or nothing: a crash leaves the old file or the new one.
    fn replace(&self, name: &str, bytes: &[u8]) -> std::io::Result<()> {
        std::fs::create_dir_all(&self.folder)?;
        let draft = self.folder.join(format!(".{name}.saving"));
        let mut file = std::fs::File::create(&draft)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        std::fs::rename(&draft, self.path(name))
    }

    fn entry(&self, name: &str) -> Result<ShowEntry, LibraryError> {
        let kept = self.get(name)?;
        let given = self.given_show(name);
        Ok(ShowEntry {
            name: name.to_owned(),
            title: kept.show.name.clone(),
            frames: kept.show.frames.len(),
            pixels: most_pixels(&kept.show),
            modified_ms: if given.is_some() { 0 } else { modified_ms(&self.path(name)) },
            etag: kept.etag,
            origin: given.map_or(ShowOrigin::Saved, |given| given.origin),
            copy_of: None,
        })
    }

    fn saved(&self) -> Vec<String> {
        let Ok(files) = std::fs::read_dir(&self.folder) else { return Vec::new() };
        let name = |file: std::fs::DirEntry| {
            file.file_name().to_str()?.strip_suffix(LIGHTBOTS.ending()).map(str::to_owned)
        };
        files.flatten().filter_map(name).filter(|name| checked(name).is_ok()).collect()
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}{}", LIGHTBOTS.ending()))
    }
}

/// The version of a document.
fn etag(bytes: &[u8]) -> String {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    format!("\"{:016x}-{:x}\"", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step), bytes.len())
}

fn modified_ms(path: &Path) -> u64 {
    let modified = std::fs::metadata(path).and_then(|about| about.modified()).ok();
    modified.and_then(|time| time.duration_since(UNIX_EPOCH).ok()).map_or(0, |since| since.as_millis() as u64)
}

fn may_hold(letter: char) -> bool {
    letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_' | '.' | ',' | '(' | ')' | '!' | '\'' | '+')
}

/// The name, if it is one on every system.
fn checked(name: &str) -> Result<&str, LibraryError> {
    let fits = (1..=NAME_MAX).contains(&name.chars().count())
        && name.len() <= 200
        && name.chars().all(may_hold)
        && !name.starts_with(['.', ' '])
        && !name.ends_with(['.', ' ']);
    if fits {
        return Ok(name);
    }
    let line = format!("a show's name has 1 to {NAME_MAX} letters, digits, spaces and . , - _ ( ) ! ' +");
    Err(LibraryError::BadName(line))
}

/// The closest name to a text that is one.
fn tidy_name(text: &str) -> String {
    let letters: String = text.chars().map(|letter| if may_hold(letter) { letter } else { '-' }).collect();
    let short: String = letters.trim_matches(['.', ' ']).chars().take(40).collect();
    let short = short.trim_end_matches(['.', ' ']);
    if short.is_empty() { "show".into() } else { short.to_owned() }
}

/// The name a file's show gets in the library.
pub fn name_of_file(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    tidy_name(stem(&name))
}

/// A panic elsewhere leaves whole values behind: each is replaced in one step.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

#[cfg(test)]
#[path = "library_tests.rs"]
mod tests;
