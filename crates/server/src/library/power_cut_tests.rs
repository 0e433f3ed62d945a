//! Tests of power cuts during saves: whatever was not synchronised may be missing.

use std::collections::BTreeMap;

use super::*;
use crate::disk::power_cut::{self, Disk, Operation, restore};

/// Power cuts that are tried after each operation on the disk.
const CUTS: u64 = 3;
/// Number of things that the user does in one test.
const STEPS: usize = 25;

/// Random numbers, the same each time (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, most: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % most
    }
}

/// For each show, by name: the titles of what was saved, the newest last, and whether the show still exists.
type Saved = BTreeMap<String, (Vec<String>, bool)>;

/// Does one step of the user: saves, renames or deletes a show. Returns what is saved afterwards.
fn step(library: &Library, random: &mut Random, number: usize, saved: &Saved) -> Saved {
    let names = ["one", "two", "three"];
    let name = names[random.below(3) as usize];
    let other =
        names.into_iter().find(|other| *other != name && !saved.get(*other).is_some_and(|state| state.1));
    let mut next = saved.clone();
    let is_there = saved.get(name).is_some_and(|state| state.1);
    match (random.below(6), other) {
        (0, Some(other)) if is_there => {
            library.put(other, &library.get(name).unwrap().bytes, &Condition::IsNew).unwrap();
            library.delete(name, &Condition::Any, Some(other)).unwrap();
            let (states, _) = next.remove(name).unwrap();
            let (before, is_there) = next.entry(other.to_owned()).or_default();
            before.extend(states);
            *is_there = true;
        }
        (1, _) if is_there => {
            library.delete(name, &Condition::Any, None).unwrap();
            next.get_mut(name).unwrap().1 = false;
        }
        (what, _) => {
            let title = format!("{name} {number}");
            let show =
                Show { name: title.clone(), ..if what == 2 { with_picture() } else { titled(&title) } };
            library.put(name, &ARCHIVE.write(&show, None).bytes, &Condition::Any).unwrap();
            let (states, is_there) = next.entry(name.to_owned()).or_default();
            states.push(title);
            *is_there = true;
        }
    }
    next
}

/// Returns titles in a folder that a power cut left: of the present show, and of all its states.
fn found(library: &Library, name: &str) -> (Option<String>, Vec<String>) {
    let now = library.get(name).ok().map(|kept| kept.show.name);
    let states =
        library.states.of(name).into_iter().filter_map(|(number, _)| library.state(name, number).ok());
    (now, states.map(|kept| kept.show.name).collect())
}

/// Checks that everything in `done` is there. Of `next`, which was under way, any part may be there.
fn check(library: &Library, done: &Saved, next: &Saved) {
    for (name, (titles, is_there)) in done {
        let (now, states) = found(library, name);
        let after = next.get(name);
        let is_left = *is_there && after.is_some_and(|after| after.1);
        let may_be = [Some(titles), after.map(|after| &after.0)]
            .into_iter()
            .flatten()
            .filter_map(|titles| titles.last());
        let is_right = now.as_ref().is_some_and(|now| may_be.clone().any(|title| title == now));
        assert!(
            is_right || now.is_none() && !is_left,
            "{name}: {now:?} instead of {titles:?}, then {after:?}"
        );
        let everywhere: Vec<String> = next
            .keys()
            .flat_map(|other| {
                let (now, states) = found(library, other);
                now.into_iter().chain(states)
            })
            .chain(states)
            .chain(now)
            .collect();
        for title in titles.iter().rev().take(20) {
            assert!(everywhere.contains(title), "{title} of {name} is lost, of {everywhere:?}");
        }
    }
}

fn cut_at_every_operation(seed: u64) {
    let temporary = Temporary::new(&format!("power-{seed}"));
    let after = Temporary::new(&format!("power-{seed}-after"));
    let (mut random, mut disk, mut done) = (Random(seed), Disk::default(), Saved::new());
    power_cut::begin();
    for number in 0..STEPS {
        let next = step(&temporary.library, &mut random, number, &done);
        for operation in power_cut::take() {
            disk.apply(&within(&temporary.folder, operation));
            for _ in 0..CUTS {
                let _ = std::fs::remove_dir_all(&after.folder);
                restore(&disk.cut(|| random.below(2) == 0), &after.folder);
                after.library.tidy_up();
                check(&after.library, &done, &next);
                power_cut::take();
            }
        }
        done = next;
        let _ = std::fs::remove_dir_all(&after.folder);
        restore(&disk.cut(|| false), &after.folder);
        check(&after.library, &done, &done);
        power_cut::take();
    }
}

/// Returns an operation with its paths relative to a folder, which exists already.
fn within(folder: &Path, operation: Operation) -> Operation {
    let below = |path: PathBuf| path.strip_prefix(folder).map_or(path.clone(), PathBuf::from);
    match operation {
        Operation::MadeFolder(path) => Operation::MadeFolder(below(path)),
        Operation::Wrote(path, bytes) => Operation::Wrote(below(path), bytes),
        Operation::SyncedFile(path) => Operation::SyncedFile(below(path)),
        Operation::SyncedFolder(path) => Operation::SyncedFolder(below(path)),
        Operation::Moved(from, to) => Operation::Moved(below(from), below(to)),
        Operation::Linked(from, to) => Operation::Linked(below(from), below(to)),
        Operation::Removed(path) => Operation::Removed(below(path)),
    }
}

#[test]
fn a_power_cut_at_any_moment_loses_no_save() {
    (1..=4).for_each(cut_at_every_operation);
}
