//! The playlist in two files of the data folder: one for the entries, one for what happened to them.
//!
//! A backup leaves the second one out (`backup/paths.rs`): robots must not start to drive because an old folder was
//! restored.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use chrono::Local;
use lightbots_api::{PlaylistChange, PlaylistEntry, PlaylistState};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::day::{DayLog, PlaylistAct, TurnEnd, TurnKey, TurnStage, next_act};
use super::list::{self, PlaylistTurn};
use super::times::clock_text;
use super::view;
use crate::disk::{self, Readers};
use crate::live::clock::unix_ms;

/// Name of the file with the entries.
const FILE: &str = "playlist.json";
/// Name of the file with what happened to the entries.
const DAY_FILE: &str = "playlist-day.json";
/// Longest of either file that is read, bytes: an entry has at most 500. A longer file is an error.
const FILE_MAX: u64 = 256 << 10;

/// The playlist of a data folder. Clones share it.
#[derive(Clone, Debug)]
pub struct PlaylistStore {
    folder: PathBuf,
    kept: Arc<Mutex<Kept>>,
}

/// Why a playlist was not changed, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChangeRefused {
    /// An entry is invalid.
    Wrong(String),
    /// Another client changed the playlist first.
    Stale(String),
    /// One of the two files cannot be read.
    Fault(String),
    /// The playlist cannot be saved.
    Disk(String),
}

#[derive(Debug, Default)]
struct Kept {
    revision: u64,
    list: Vec<PlaylistTurn>,
    log: DayLog,
    /// Why the files cannot be read, with file, place and remedy; `None` if they were read.
    fault: Option<String>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaylistFile {
    #[serde(default)]
    entries: Vec<PlaylistEntry>,
}

impl PlaylistStore {
    /// Reads the playlist of a data folder. Without files, the playlist is empty. A file that cannot be read is kept, and
    /// nothing is played until it can be read.
    pub fn load(folder: &Path) -> Self {
        let store = Self { folder: folder.to_owned(), kept: Arc::default() };
        let mut kept = store.lock();
        store.read(&mut kept);
        // Revisions begin at the time of the start, so that a client from before a restart has another one.
        kept.revision = unix_ms();
        if let Some(fault) = &kept.fault {
            tracing::error!("{fault}");
        }
        drop(kept);
        store
    }

    /// Returns the playlist for clients.
    pub fn state(&self) -> PlaylistState {
        let kept = self.refreshed();
        let now = (now_s(), &Local);
        PlaylistState {
            revision: kept.revision,
            on: kept.log.on_since_s.is_some(),
            entries: kept.list.iter().map(list::entry).collect(),
            today: view::today(&kept.list, &kept.log, now),
            next: view::next(&kept.list, &kept.log, now),
            held: kept.log.held.clone(),
            fault: kept.fault.clone(),
            now: clock_text(&Local, now.0),
        }
    }

    /// Replaces the entries, and switches the playlist on or off. Switching it off also ends a hold. An entry whose
    /// show or start has changed loses the record of its latest turn, unless it is playing.
    pub fn change(&self, change: PlaylistChange) -> Result<(), ChangeRefused> {
        let mut kept = self.refreshed();
        if let Some(fault) = &kept.fault {
            return Err(ChangeRefused::Fault(fault.clone()));
        }
        if change.revision != kept.revision {
            let line = "the playlist was changed meanwhile: read it again, then change it";
            return Err(ChangeRefused::Stale(line.into()));
        }
        let mut list = list::read(&change.entries).map_err(ChangeRefused::Wrong)?;
        renew(&mut list, &kept);
        number(&mut list, &kept);
        let mut log = kept.log.clone();
        log.turns.retain(|id, _| list.iter().any(|turn| turn.id == *id));
        match (change.on, log.on_since_s) {
            (true, None) => log.on_since_s = Some(now_s()),
            (false, Some(_)) => (log.on_since_s, log.held) = (None, None),
            _ => {}
        }
        let disk = |error: io::Error| ChangeRefused::Disk(self.unwritable(&error));
        self.write_list(&list).map_err(disk)?;
        self.write_log(&log).map_err(disk)?;
        (kept.list, kept.log) = (list, log);
        kept.revision += 1;
        Ok(())
    }

    /// Whether the playlist is on, or one of its shows is still playing.
    pub fn is_on(&self) -> bool {
        let kept = self.refreshed();
        kept.log.on_since_s.is_some() || kept.log.playing().is_some()
    }

    /// Whether the playlist is held, so that a person has to resume it.
    pub fn is_held(&self) -> bool {
        self.lock().log.held.is_some()
    }

    /// Returns what to do at present. `is_free`: robots do nothing at present, so that a show could begin.
    pub fn next_act(&self, is_free: bool) -> PlaylistAct {
        let kept = self.refreshed();
        next_act(&kept.list, &kept.log, (now_s(), &Local), is_free)
    }

    /// Returns the entry with this number.
    pub fn turn(&self, id: u32) -> Option<PlaylistTurn> {
        self.lock().list.iter().find(|turn| turn.id == id).cloned()
    }

    /// Returns the turn that is playing; `None` if none is.
    pub fn playing(&self) -> Option<TurnKey> {
        self.lock().log.playing()
    }

    /// Records that the drive to the starting places before a turn is being ordered.
    pub fn sent_home(&self, key: TurnKey) {
        self.note(|log| log.note(key, TurnStage::SentHome, now_s(), None));
    }

    /// Records that a turn has begun to play.
    pub fn begins(&self, key: TurnKey) {
        self.note(|log| log.note(key, TurnStage::Playing, now_s(), None));
    }

    /// Records how a turn ended, and when: `at_s`, seconds since 1970.
    pub fn ends(&self, key: TurnKey, end: TurnEnd, at_s: i64) {
        let (stage, line) = match end {
            TurnEnd::Played => (TurnStage::Played, None),
            TurnEnd::Failed(line) => (TurnStage::Failed, Some(line)),
            TurnEnd::Skipped(line) => (TurnStage::Skipped, Some(line)),
        };
        self.note(|log| log.note(key, stage, at_s, line));
    }

    /// Holds the playlist, if it is on and not held already: keeps `line`, which says why, and returns `true`. No turn
    /// begins until [`Self::release`] is called or the playlist is switched off. Otherwise changes nothing and returns
    /// `false`.
    pub fn hold(&self, line: &str) -> bool {
        let is_new = {
            let kept = self.lock();
            kept.log.on_since_s.is_some() && kept.log.held.is_none()
        };
        if is_new {
            self.note(|log| log.held = Some(line.to_owned()));
        }
        is_new
    }

    /// Releases a held playlist. Returns whether it was held.
    pub fn release(&self) -> bool {
        let was_held = self.is_held();
        if was_held {
            self.note(|log| log.held = None);
        }
        was_held
    }

    /// Changes the records in memory and on the disk. If writing fails, the change lasts only until the program ends.
    fn note(&self, change: impl FnOnce(&mut DayLog)) {
        let mut kept = self.lock();
        change(&mut kept.log);
        if let Err(error) = self.write_log(&kept.log) {
            tracing::warn!("{}", self.unwritable(&error));
        }
    }

    /// Locks the playlist. Files that could not be read before are read again.
    fn refreshed(&self) -> MutexGuard<'_, Kept> {
        let mut kept = self.lock();
        if kept.fault.is_some() {
            self.read(&mut kept);
        }
        kept
    }

    fn read(&self, kept: &mut Kept) {
        match self.read_files() {
            Ok((list, log)) => (kept.list, kept.log, kept.fault) = (list, log, None),
            Err(fault) => kept.fault = Some(fault),
        }
        kept.revision += 1;
    }

    fn read_files(&self) -> Result<(Vec<PlaylistTurn>, DayLog), String> {
        let file: PlaylistFile = self.file(FILE, "mend it or move it away")?;
        let wrong = |fault| {
            let path = self.folder.join(FILE);
            format!(
                "{}: {fault}. Mend it or move it away; nothing is played by schedule meanwhile",
                path.display()
            )
        };
        let mut list = list::read(&file.entries).map_err(wrong)?;
        let log: DayLog = self.file(DAY_FILE, "move it away, which switches the playlist off")?;
        if list.iter().any(|turn| turn.id == 0) {
            let kept = Kept { log: log.clone(), ..Kept::default() };
            number(&mut list, &kept);
            // The numbers are saved, because records refer to entries by number.
            self.write_list(&list).map_err(|error| self.unwritable(&error))?;
        }
        Ok((list, log))
    }

    /// Reads a value from a file; returns the default value if there is no file. `remedy` becomes part of the error.
    fn file<T: DeserializeOwned + Default>(&self, name: &str, remedy: &str) -> Result<T, String> {
        let path = self.folder.join(name);
        let fault = |why: String| {
            format!("{}: {why}. To go on, {remedy}; nothing is played by schedule meanwhile", path.display())
        };
        match disk::read_regular(&path, FILE_MAX) {
            Ok(bytes) => serde_json::from_slice(&bytes).map_err(|error| fault(error.to_string())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(T::default()),
            Err(error) => Err(fault(error.to_string())),
        }
    }

    fn write_list(&self, list: &[PlaylistTurn]) -> io::Result<()> {
        let file = PlaylistFile { entries: list.iter().map(list::entry).collect() };
        disk::replace(&self.folder.join(FILE), &serde_json::to_vec_pretty(&file)?, Readers::Owner)
    }

    fn write_log(&self, log: &DayLog) -> io::Result<()> {
        disk::replace(&self.folder.join(DAY_FILE), &serde_json::to_vec_pretty(log)?, Readers::Owner)
    }

    fn unwritable(&self, error: &io::Error) -> String {
        format!("the playlist cannot be saved in {}: {error}; make room on the disk", self.folder.display())
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Sets the number of an entry to 0 if its show or its start has changed. The records under its old number then no longer
/// apply. The entry that is playing keeps its number.
fn renew(list: &mut [PlaylistTurn], kept: &Kept) {
    let playing = kept.log.playing().map(|key| key.id);
    for turn in list.iter_mut().filter(|turn| Some(turn.id) != playing) {
        let is_same = |old: &PlaylistTurn| old.show == turn.show && old.start == turn.start;
        if !kept.list.iter().any(|old| old.id == turn.id && is_same(old)) {
            turn.id = 0;
        }
    }
}

/// Numbers the entries that have the number 0.
fn number(list: &mut [PlaylistTurn], kept: &Kept) {
    let known = list.iter().chain(&kept.list).map(|turn| turn.id);
    let mut last = known.chain(kept.log.turns.keys().copied()).max().unwrap_or(0);
    for turn in list.iter_mut().filter(|turn| turn.id == 0) {
        // After four thousand million changes numbers begin again.
        last = last.checked_add(1).unwrap_or(1);
        turn.id = last;
    }
}

/// Seconds since 1970.
pub fn now_s() -> i64 {
    (unix_ms() / 1_000) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lightbots-playlist-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn entry(id: u32, show: &str, at: &str) -> PlaylistEntry {
        let at = Some(at.to_owned());
        PlaylistEntry { id, show: show.into(), at, speed_percent: 100, ..PlaylistEntry::default() }
    }

    fn change(store: &PlaylistStore, on: bool, entries: Vec<PlaylistEntry>) -> Result<(), ChangeRefused> {
        store.change(PlaylistChange { revision: store.state().revision, on, entries })
    }

    #[test]
    fn switch_entries_and_what_happened_come_back_at_the_next_start() {
        let folder = folder("back");
        let store = PlaylistStore::load(&folder);
        change(&store, true, vec![entry(0, "heart", "19:00"), entry(0, "star", "20:00")]).unwrap();
        let ids: Vec<u32> = store.state().entries.iter().map(|entry| entry.id).collect();
        assert_eq!(ids, [1, 2]);
        let key = TurnKey { id: 2, date: chrono::NaiveDate::MIN };
        store.begins(key);
        assert!(store.hold("Stop all was pressed.") && !store.hold("again"));
        let store = PlaylistStore::load(&folder);
        let state = store.state();
        assert!(state.on && state.held.as_deref() == Some("Stop all was pressed."));
        assert_eq!(store.playing(), Some(key));
        assert!(store.release() && !store.release());
        assert!(PlaylistStore::load(&folder).state().held.is_none());
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn an_entry_with_another_time_is_a_new_one_and_a_stale_change_is_refused() {
        let folder = folder("stale");
        let store = PlaylistStore::load(&folder);
        change(&store, true, vec![entry(0, "heart", "19:00"), entry(0, "star", "20:00")]).unwrap();
        let stale = store.state().revision;
        let slower = PlaylistEntry { speed_percent: 50, ..entry(2, "star", "20:00") };
        change(&store, true, vec![slower, entry(1, "heart", "19:30")]).unwrap();
        let ids: Vec<u32> = store.state().entries.iter().map(|entry| entry.id).collect();
        assert_eq!(ids, [2, 3]);
        let late = store.change(PlaylistChange { revision: stale, on: false, entries: Vec::new() });
        assert!(matches!(late, Err(ChangeRefused::Stale(_))), "{late:?}");
        assert!(store.state().on);
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_file_that_cannot_be_read_is_kept_named_and_read_once_it_is_mended() {
        let folder = folder("fault");
        let path = folder.join(FILE);
        let file = |entry: &str| format!("{{\"entries\": [\n  {{{entry}}}\n]}}");
        let good = r#""show": "heart", "at": "19:00", "speed_percent": 100"#;
        for (text, part) in [
            (file(&format!("{good}, \"spede\": 1")), "unknown field `spede`"),
            (file(&format!("{good}, \"spede\": 1")), "line 2"),
            (file(&good.replace("19:00", "19.00")), "entry 1: at is"),
            ("{\"entries\": [".to_owned(), "EOF while parsing"),
            (" ".repeat(FILE_MAX as usize + 1), "it is longer than"),
        ] {
            std::fs::write(&path, &text).unwrap();
            let store = PlaylistStore::load(&folder);
            let fault = store.state().fault.unwrap();
            assert!(fault.contains("playlist.json") && fault.contains(part), "{fault}");
            assert!(fault.to_lowercase().contains("move it away"), "{fault}");
            let refused = change(&store, true, Vec::new());
            assert!(matches!(refused, Err(ChangeRefused::Fault(_))), "{refused:?}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text, "the file is kept");
            std::fs::write(&path, file(good)).unwrap();
            assert_eq!((store.state().fault, store.state().entries.len()), (None, 1));
        }
        std::fs::write(folder.join(DAY_FILE), r#"{"helt": null}"#).unwrap();
        assert!(PlaylistStore::load(&folder).state().fault.unwrap().contains("playlist-day.json"));
        std::fs::remove_dir_all(folder).unwrap();
    }
}
