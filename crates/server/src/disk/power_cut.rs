//! Models for tests what a power cut leaves of files. The disk operations of this thread are recorded as they happen,
//! and the model computes what may be on the disk after any of them.
//!
//! The model is that of POSIX: bytes are surely on the disk once their file was synced, and a name once its folder was.
//! Any part of what was not synced may be on the disk, in any order. Source: Pillai and others, *All File Systems Are
//! Not Created Equal*, OSDI 2014. A name moves within a folder as a whole or not at all; between two folders it may be
//! in both for a while.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// One operation on the disk.
#[derive(Clone, Debug)]
pub enum Operation {
    MadeFolder(PathBuf),
    /// A file was written with these bytes, which need not be on the disk yet.
    Wrote(PathBuf, Vec<u8>),
    SyncedFile(PathBuf),
    SyncedFolder(PathBuf),
    Moved(PathBuf, PathBuf),
    Linked(PathBuf, PathBuf),
    Removed(PathBuf),
}

thread_local! {
    static NOTED: RefCell<Option<Vec<Operation>>> = const { RefCell::new(None) };
}

/// Begins to record the operations of this thread.
pub fn begin() {
    NOTED.with(|noted| *noted.borrow_mut() = Some(Vec::new()));
}

/// Returns the operations that were recorded since the last call of `begin` or of this function.
pub fn take() -> Vec<Operation> {
    NOTED.with(|noted| noted.borrow_mut().as_mut().map(std::mem::take).unwrap_or_default())
}

/// Records an operation, if recording has begun.
pub fn note(operation: impl FnOnce() -> Operation) {
    NOTED.with(|noted| {
        if let Some(noted) = noted.borrow_mut().as_mut() {
            noted.push(operation());
        }
    });
}

/// A change of names in one folder.
#[derive(Clone, Debug)]
struct Renaming {
    removed: Option<PathBuf>,
    added: Option<(PathBuf, Node)>,
    /// The change takes effect only if this name exists; `None`: in any case.
    after: Option<PathBuf>,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Node {
    Folder,
    /// Index of the file.
    File(usize),
}

/// The bytes of a file.
#[derive(Clone, Debug, Default)]
struct Content {
    now: Vec<u8>,
    synced: Option<Vec<u8>>,
}

/// State of a disk: what is surely on it, and what may be.
#[derive(Clone, Debug, Default)]
pub struct Disk {
    files: Vec<Content>,
    /// Names as programs see them.
    now: BTreeMap<PathBuf, Node>,
    /// Names that are surely on the disk.
    synced: BTreeMap<PathBuf, Node>,
    pending: Vec<Renaming>,
}

impl Disk {
    /// Carries out an operation.
    pub fn apply(&mut self, operation: &Operation) {
        match operation {
            Operation::MadeFolder(path) => self.rename(None, Some((path.clone(), Node::Folder))),
            Operation::Wrote(path, bytes) => {
                self.files.push(Content { now: bytes.clone(), synced: None });
                self.rename(None, Some((path.clone(), Node::File(self.files.len() - 1))));
            }
            Operation::SyncedFile(path) => {
                if let Some(Node::File(file)) = self.now.get(path) {
                    let content = &mut self.files[*file];
                    content.synced = Some(content.now.clone());
                }
            }
            Operation::SyncedFolder(folder) => self.sync_folder(folder),
            Operation::Moved(from, to) => {
                let added = Some((to.clone(), self.now[from]));
                if from.parent() == to.parent() {
                    return self.rename(Some(from.clone()), added);
                }
                self.rename(None, added);
                self.change(Renaming { removed: Some(from.clone()), added: None, after: Some(to.clone()) });
            }
            Operation::Linked(from, to) => {
                let node = self.now[from];
                self.rename(None, Some((to.clone(), node)));
            }
            Operation::Removed(path) => self.rename(Some(path.clone()), None),
        }
    }

    fn rename(&mut self, removed: Option<PathBuf>, added: Option<(PathBuf, Node)>) {
        self.change(Renaming { removed, added, after: None });
    }

    fn change(&mut self, renaming: Renaming) {
        renaming.apply(&mut self.now);
        self.pending.push(renaming);
    }

    fn sync_folder(&mut self, folder: &Path) {
        let is_in = |path: &PathBuf| path.parent() == Some(folder);
        let all = std::mem::take(&mut self.pending).into_iter();
        let (done, pending): (Vec<_>, Vec<_>) = all.partition(|renaming| {
            let removed = renaming.removed.iter();
            removed.chain(renaming.added.iter().map(|(path, _)| path)).all(is_in)
        });
        self.pending = pending;
        done.iter().for_each(|renaming| renaming.apply(&mut self.synced));
    }

    /// Returns what is found after a power cut: the bytes of each file, and `None` for each folder. `chance` is asked about
    /// each unsynced change of a name whether the disk has it. For each unsynced file, it decides between all bytes and the
    /// first half.
    pub fn cut(&self, mut chance: impl FnMut() -> bool) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
        let mut names = self.synced.clone();
        for renaming in self.pending.iter().filter(|_| chance()) {
            renaming.apply(&mut names);
        }
        let folders: BTreeSet<PathBuf> =
            names.iter().filter(|(_, node)| **node == Node::Folder).map(|(path, _)| path.clone()).collect();
        let is_reachable = |path: &Path| {
            path.ancestors().skip(1).all(|above| above == Path::new("") || folders.contains(above))
        };
        let mut found = BTreeMap::new();
        for (path, node) in names.into_iter().filter(|(path, _)| is_reachable(path)) {
            let bytes = match node {
                Node::Folder => None,
                Node::File(file) => {
                    let content = &self.files[file];
                    let torn = || content.now[..content.now.len() / 2].to_vec();
                    Some(
                        content
                            .synced
                            .clone()
                            .unwrap_or_else(|| if chance() { content.now.clone() } else { torn() }),
                    )
                }
            };
            found.insert(path, bytes);
        }
        found
    }
}

impl Renaming {
    fn apply(&self, names: &mut BTreeMap<PathBuf, Node>) {
        if self.after.as_ref().is_some_and(|path| !names.contains_key(path)) {
            return;
        }
        if let Some(path) = &self.removed {
            names.remove(path);
        }
        if let Some((path, node)) = &self.added {
            names.insert(path.clone(), *node);
        }
    }
}

/// Writes what a power cut left into a folder of the real disk.
pub fn restore(found: &BTreeMap<PathBuf, Option<Vec<u8>>>, folder: &Path) {
    fs::create_dir_all(folder).unwrap();
    for (path, bytes) in found {
        match bytes {
            None => fs::create_dir_all(folder.join(path)).unwrap(),
            Some(bytes) => fs::write(folder.join(path), bytes).unwrap(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replaced(syncs: &[&str]) -> Disk {
        let path = PathBuf::from;
        let mut disk = Disk::default();
        let operations = [
            Operation::Wrote(path("a"), b"old!".to_vec()),
            Operation::SyncedFile(path("a")),
            Operation::SyncedFolder(path("")),
            Operation::Wrote(path("draft"), b"new!".to_vec()),
        ];
        operations.iter().for_each(|operation| disk.apply(operation));
        if syncs.contains(&"file") {
            disk.apply(&Operation::SyncedFile(path("draft")));
        }
        disk.apply(&Operation::Moved(path("draft"), path("a")));
        if syncs.contains(&"folder") {
            disk.apply(&Operation::SyncedFolder(path("")));
        }
        disk
    }

    #[test]
    fn what_is_not_synced_may_be_lost_or_torn() {
        let a = |disk: &Disk, is_there: bool| disk.cut(|| is_there)[Path::new("a")].clone().unwrap();
        assert_eq!(
            (a(&replaced(&["file"]), false), a(&replaced(&["file"]), true)),
            (b"old!".to_vec(), b"new!".to_vec())
        );
        assert_eq!(a(&replaced(&["file", "folder"]), false), b"new!");
        assert_eq!(a(&replaced(&["folder"]), false), b"ne", "the name came before the bytes");
    }
}
