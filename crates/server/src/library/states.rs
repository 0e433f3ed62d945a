//! Earlier saved states of shows: `history/NAME/NUMBER.lightbots.json` or `.lightbots.zip` in the library's folder.
//! Numbers count up.
//!
//! Before a show's file is replaced or deleted, a hard link to it is made there. Where hard links fail, the file is
//! copied. A crash in between may leave one state twice. The last [`STATES`] states are kept. Of older ones, the last
//! of each day is kept if it is less than [`DAYS`] days older than the newest state. A screen saves after every change,
//! so the last states alone may span only a minute.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::names;
use super::version::modified_ms;
use crate::disk;

/// Number of the latest states of a show that are kept whatever their age.
pub const STATES: usize = 20;
/// Number of days before the newest state in which the last state of each day is kept. The states of a deleted show are
/// kept for at least this number of days after the deletion.
const DAYS: u64 = 30;
/// Length of a day, milliseconds. Days are those of UTC.
const DAY_MS: u64 = 24 * 3600 * 1000;

/// States of all shows in one folder.
#[derive(Clone, Debug)]
pub struct States(PathBuf);

impl States {
    /// Returns the states of a folder. The folder is made when the first state is kept.
    pub fn new(folder: PathBuf) -> Self {
        Self(folder)
    }

    /// Numbers and files of a show's states, the newest first.
    pub fn of(&self, show: &str) -> Vec<(u32, PathBuf)> {
        let Ok(files) = fs::read_dir(self.0.join(show)) else { return Vec::new() };
        let numbered = |file: fs::DirEntry| {
            let name = file.file_name();
            let (number, _) = name.to_str()?.split_once('.')?;
            Some((number.parse().ok()?, file.path()))
        };
        let mut states: Vec<_> = files.flatten().filter_map(numbered).collect();
        states.sort_by_key(|(number, _)| std::cmp::Reverse(*number));
        states
    }

    /// Returns the file of a state, if there is one.
    pub fn file(&self, show: &str, number: u32) -> Option<PathBuf> {
        self.of(show).into_iter().find_map(|(other, file)| (other == number).then_some(file))
    }

    /// Keeps a show's file as a further state, and removes surplus states. The file itself stays in its place. Does
    /// nothing if there is no file.
    pub fn keep(&self, show: &str, file: &Path) -> io::Result<()> {
        if !file.is_file() {
            return Ok(());
        }
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let ending = name.strip_prefix(show).unwrap_or_default();
        let number = self.of(show).first().map_or(1, |(last, _)| last.saturating_add(1));
        let folder = self.0.join(show);
        disk::create_folder(&folder)?;
        let state = folder.join(format!("{number}{ending}"));
        if disk::link(file, &state).is_err() {
            copy(file, &state)?;
        }
        for state in too_many(&self.of(show), modified_ms) {
            disk::remove(&state)?;
        }
        Ok(())
    }

    /// Gives the states of the show `from` to its new name `to`. They are numbered after the states that `to` has already.
    pub fn hand_over(&self, from: &str, to: &str) -> io::Result<()> {
        if from == to {
            return Ok(());
        }
        let own = self.of(to);
        let after = own.first().map_or(0, |(last, _)| *last);
        for (number, file) in self.of(from) {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let ending = name.trim_start_matches(|letter: char| letter.is_ascii_digit());
            let number = after.saturating_add(number);
            disk::create_folder(&self.0.join(to))?;
            disk::rename(&file, &self.0.join(to).join(format!("{number}{ending}")))?;
        }
        let _ = fs::remove_dir(self.0.join(from));
        Ok(())
    }

    /// Names of all shows that have states.
    pub fn shows(&self) -> Vec<String> {
        let Ok(folders) = fs::read_dir(&self.0) else { return Vec::new() };
        let names = folders.flatten().filter_map(|folder| folder.file_name().into_string().ok());
        names.filter(|name| names::checked(name).is_ok()).collect()
    }

    /// Removes the drafts that a crash left among the states of a show.
    pub fn remove_drafts(&self, show: &str) {
        disk::remove_drafts(&self.0.join(show));
    }

    /// Removes the states of shows that do not exist and whose states have not changed for more than [`DAYS`] days.
    /// `there` has the names of all shows that exist.
    pub fn sweep(&self, there: &BTreeSet<String>) {
        let longest = Duration::from_millis(DAYS * DAY_MS);
        for show in self.shows().into_iter().filter(|show| !there.contains(show)) {
            let folder = self.0.join(show);
            let changed = fs::metadata(&folder).and_then(|about| about.modified());
            let age = changed.ok().and_then(|changed| SystemTime::now().duration_since(changed).ok());
            if age.is_some_and(|age| age > longest)
                && let Err(error) = fs::remove_dir_all(&folder)
            {
                tracing::debug!("{} stays: {error}", folder.display());
            }
        }
    }
}

/// Returns the files among `states` that are to be removed. `states` begins with the newest. `saved_ms` returns when a
/// file was saved, milliseconds since the start of 1970 (UTC).
fn too_many(states: &[(u32, PathBuf)], saved_ms: impl Fn(&Path) -> u64) -> Vec<PathBuf> {
    let newest = states.first().map_or(0, |(_, file)| saved_ms(file));
    let mut days = BTreeSet::new();
    let mut dropped = Vec::new();
    for (index, (_, file)) in states.iter().enumerate() {
        let at = saved_ms(file);
        let is_last_of_day = days.insert(at / DAY_MS);
        let is_recent = at.saturating_add(DAYS * DAY_MS) > newest;
        if index >= STATES && !(is_last_of_day && is_recent) {
            dropped.push(file.clone());
        }
    }
    dropped
}

/// Copies a file with its time of change, for file systems without hard links.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    let modified = fs::metadata(from)?.modified()?;
    disk::replace(to, &super::show_files::read(from)?, disk::Readers::All)?;
    File::options().write(true).open(to)?.set_modified(modified)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_states_are_kept_and_the_last_of_each_earlier_day() {
        // Three a day, the newest first, for 40 days.
        let states: Vec<_> = (0..120).map(|age| (120 - age, PathBuf::from(age.to_string()))).collect();
        let age = |file: &Path| file.to_string_lossy().parse::<u64>().unwrap();
        let saved_ms = |file: &Path| 100 * DAY_MS - age(file) * DAY_MS / 3 - 1;
        let dropped = too_many(&states, saved_ms);
        let kept: Vec<u64> = states
            .iter()
            .map(|(_, file)| file)
            .filter(|file| !dropped.contains(file))
            .map(|file| age(file))
            .collect();
        let expected: Vec<u64> = (0..20).chain((21..90).step_by(3)).collect();
        assert_eq!(kept, expected);
    }
}
