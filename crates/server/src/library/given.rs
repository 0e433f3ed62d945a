//! Built-in shows, which are read-only and in no folder: the examples, and the file that the program was started with.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};

use lightbots_api::ShowOrigin;
use lightbots_exchange::LIGHTBOTS;
use lightbots_show::Show;

use super::facts::ListFacts;
use super::lock::lock;
use super::version::etag;

/// A built-in show, which is read-only and in no folder.
#[derive(Clone, Debug)]
pub struct Given {
    /// Name under which the show is listed if it is free. Names of its copies begin with it.
    pub base: String,
    /// Origin of the show: an example, or the file of the command line.
    pub origin: ShowOrigin,
    /// Document of the show in our format.
    pub bytes: Vec<u8>,
    /// Facts that lists display. `unread` in them says why the show's original file holds more than the document.
    pub facts: ListFacts,
}

impl Given {
    /// Makes a built-in show with the name `base`. `unread` says why the show's original file holds more than `show`;
    /// `None`: it does not.
    pub fn new(base: String, origin: ShowOrigin, show: &Show, unread: Option<String>) -> Self {
        let bytes = LIGHTBOTS.write(show, None).bytes;
        let facts = ListFacts { etag: etag(&bytes), ..ListFacts::of_show(show, unread) };
        Self { base, origin, bytes, facts }
    }
}

/// The built-in shows by the name they are listed under. Clones share them.
#[derive(Clone, Debug, Default)]
pub struct GivenShows(Arc<Mutex<BTreeMap<String, Given>>>);

impl GivenShows {
    /// Names of the shows.
    pub fn names(&self) -> Vec<String> {
        lock(&self.0).keys().cloned().collect()
    }

    /// Returns a show by the name it is listed under.
    pub fn get(&self, name: &str) -> Option<Given> {
        lock(&self.0).get(name).cloned()
    }

    /// Adds a show and returns the name under which it is listed: its base name if that is free, else a variant of it.
    /// If `show` is the file of the command line and an example has its name, the file gets the name, and the example a
    /// variant. `saved` has the names of the shows in the folder.
    pub fn add(&self, show: Given, saved: &BTreeSet<String>) -> String {
        let (base, origin) = (show.base.clone(), show.origin);
        let mut given = lock(&self.0);
        let displaces = given.get(&base).is_some_and(|other| other.origin < origin);
        let listed = if displaces { base } else { listed_name(&base, origin, &given, saved) };
        if let Some(moved) = given.insert(listed.clone(), show) {
            let elsewhere = listed_name(&moved.base, moved.origin, &given, saved);
            given.insert(elsewhere, moved);
        }
        listed
    }

    /// Returns the first free name of `base 2`, `base 3` and so on. `saved` has the names of the shows in the folder.
    pub fn copy_name(&self, base: &str, saved: &BTreeSet<String>) -> String {
        first_free((2..).map(|number| format!("{base} {number}")), &lock(&self.0), saved)
    }
}

/// Returns `base` if no show has that name. Otherwise returns the first free name of `base (example)`, `base (example
/// 2)` and so on. For the file of the command line, the word is `file` instead of `example`.
fn listed_name(
    base: &str,
    origin: ShowOrigin,
    given: &BTreeMap<String, Given>,
    saved: &BTreeSet<String>,
) -> String {
    let word = if origin == ShowOrigin::StartFile { "file" } else { "example" };
    let others = (2..).map(|number| format!("{base} ({word} {number})"));
    let names = [base.to_owned(), format!("{base} ({word})")].into_iter().chain(others);
    first_free(names, given, saved)
}

/// Returns the first of the endless `names` that no show has. Capital and small letters count as the same letter.
fn first_free(
    mut names: impl Iterator<Item = String>,
    given: &BTreeMap<String, Given>,
    saved: &BTreeSet<String>,
) -> String {
    let taken: BTreeSet<String> = saved.iter().chain(given.keys()).map(|name| name.to_lowercase()).collect();
    names.find(|name| !taken.contains(&name.to_lowercase())).unwrap_or_default()
}
