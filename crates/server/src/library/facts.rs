//! Facts about shows that lists display. They are remembered by file, and read again after the file has changed.

use std::collections::BTreeMap;
use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};

use lightbots_exchange::read;
use lightbots_show::{Show, most_pixels};

use super::lock::lock;
use super::show_files;
use super::version::etag;

/// Most files whose facts are remembered: 10,000 shows with room for many of their states. When a further file comes,
/// all facts are forgotten.
const FILES_MAX: usize = 30_000;
/// Age from which the facts of a file are remembered. A file that was written more recently is read each time, because a
/// second change may not alter its time of change. Some file systems count that time in steps of two seconds.
const SETTLED_AFTER: Duration = Duration::from_secs(3);

/// Facts about a show that a list displays.
#[derive(Clone, Debug, PartialEq)]
pub struct ListFacts {
    /// Name that the author gave the show; may be empty.
    pub title: String,
    /// Number of frames.
    pub frames: usize,
    /// Number of pixels of the largest frame.
    pub pixels: usize,
    /// Version of the file, in quotes.
    pub etag: String,
    /// Why the file holds more than the show; `None`: it does not.
    pub unread: Option<String>,
}

impl ListFacts {
    /// Reads the facts of a file of any format. The error says why the file is no show.
    pub fn of(bytes: &[u8]) -> Result<Self, String> {
        let loaded = read(bytes, None).map_err(|error| error.to_string())?;
        Ok(Self { etag: etag(bytes), ..Self::of_show(&loaded.show, loaded.unread) })
    }

    /// Returns the facts of a show without a file; `etag` stays empty.
    pub fn of_show(show: &Show, unread: Option<String>) -> Self {
        let (frames, pixels) = (show.frames.len(), most_pixels(show));
        Self { title: show.name.clone(), frames, pixels, etag: String::new(), unread }
    }
}

/// State of a file by which a change is detected.
#[derive(Clone, Debug, PartialEq)]
struct Stamp {
    bytes: u64,
    modified: SystemTime,
    /// On Unix: the inode number, and the time of the last change of any kind, in seconds and nanoseconds. They reveal that
    /// a file with the same time of change replaced another. On other systems: zeros.
    identity: (u64, i64, i64),
}

impl Stamp {
    fn of(about: &Metadata) -> Option<Self> {
        #[cfg(unix)]
        let identity = {
            use std::os::unix::fs::MetadataExt;
            (about.ino(), about.ctime(), about.ctime_nsec())
        };
        #[cfg(not(unix))]
        let identity = (0, 0, 0);
        Some(Self { bytes: about.len(), modified: about.modified().ok()?, identity })
    }

    fn is_settled(&self) -> bool {
        SystemTime::now().duration_since(self.modified).is_ok_and(|age| age > SETTLED_AFTER)
    }
}

/// [`ListFacts`] of files by path. Clones share them.
#[derive(Clone, Debug, Default)]
pub struct FileFacts(Arc<Mutex<BTreeMap<PathBuf, (Stamp, ListFacts)>>>);

impl FileFacts {
    /// Returns the facts of a file, from memory if they are remembered and the file has not changed. The error says why
    /// the file cannot be read or is no show.
    pub fn get(&self, file: &Path) -> Result<ListFacts, String> {
        let before = std::fs::metadata(file).ok().and_then(|about| Stamp::of(&about));
        if let Some((stamp, facts)) = lock(&self.0).get(file)
            && before.as_ref() == Some(stamp)
        {
            return Ok(facts.clone());
        }
        let bytes = show_files::read(file).map_err(|error| error.to_string())?;
        let facts = ListFacts::of(&bytes)?;
        if let Some(stamp) = before.filter(Stamp::is_settled) {
            let mut known = lock(&self.0);
            if known.len() >= FILES_MAX {
                known.clear();
            }
            known.insert(file.to_owned(), (stamp, facts.clone()));
        }
        Ok(facts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_again_only_after_it_has_changed() {
        let file = std::env::temp_dir().join(format!("lightbots-facts-{}.json", std::process::id()));
        std::fs::write(&file, br#"{"lightbots":1,"name":"Dot","frames":[]}"#).unwrap();
        let files = FileFacts::default();
        assert_eq!(files.get(&file).unwrap().title, "Dot");
        assert!(lock(&files.0).is_empty(), "a file that was written a moment ago may change unseen");
        let hour_ago = SystemTime::now() - Duration::from_secs(3_600);
        std::fs::File::options().append(true).open(&file).unwrap().set_modified(hour_ago).unwrap();
        assert_eq!(files.get(&file).unwrap().title, "Dot");
        lock(&files.0).get_mut(&file).unwrap().1.title = "remembered".into();
        assert_eq!(files.get(&file).unwrap().title, "remembered");
        std::fs::write(&file, br#"{"lightbots":1,"name":"Dog","frames":[]}"#).unwrap();
        assert_eq!(files.get(&file).unwrap().title, "Dog");
        std::fs::remove_file(file).unwrap();
    }
}
