//! Tests of earlier states of shows, and of other files in the folder.

use super::*;

/// Saves `DOT` under a title as the version after the present one.
fn save(library: &Library, name: &str, title: &str) {
    let bytes = LIGHTBOTS.write(&titled(title), None).bytes;
    let now = library.get(name).map_or(Condition::IsNew, |kept| Condition::Is(kept.etag));
    library.put(name, &bytes, &now).unwrap();
}

fn titles(library: &Library, name: &str) -> Vec<String> {
    library.states(name).unwrap().into_iter().map(|state| state.title).collect()
}

#[test]
fn the_last_saved_states_can_be_looked_at_and_restored_and_nothing_is_lost_by_it() {
    let temporary = Temporary::new("states");
    let library = &temporary.library;
    for number in 1..=30 {
        save(library, "mine", &format!("v{number}"));
    }
    // Saving an unchanged show adds no state.
    save(library, "mine", "v30");
    let last: Vec<_> = (10..=30).rev().map(|number| format!("v{number}")).collect();
    assert_eq!(titles(library, "mine"), last);
    let state = library.states("mine").unwrap()[10].clone();
    let (number, before) = (state.number.unwrap(), library.get("mine").unwrap());
    let old = library.state("mine", number).unwrap();
    assert_eq!((old.show.name.as_str(), &old.etag), ("v20", &state.etag));
    library.put("mine", &old.bytes, &Condition::Is(before.etag)).unwrap();
    assert_eq!(library.get("mine").unwrap().show.name, "v20");
    let after: Vec<_> = ["v20".into()].into_iter().chain(last[..20].iter().cloned()).collect();
    assert_eq!(titles(library, "mine"), after);
    assert!(matches!(library.state("mine", 1), Err(LibraryError::Missing(_))), "it made room");
    assert!(matches!(library.state("../mine", 1), Err(LibraryError::BadName(_))));
    assert!(matches!(library.states("nobody"), Err(LibraryError::Missing(_))));
}

#[test]
fn states_follow_a_new_name_and_outlive_a_deletion() {
    let temporary = Temporary::new("states-renamed");
    let library = &temporary.library;
    save(library, "one", "v1");
    save(library, "one", "v2");
    library.put("two", &library.get("one").unwrap().bytes, &Condition::IsNew).unwrap();
    library.delete("one", &Condition::Any, Some("two")).unwrap();
    assert_eq!(titles(library, "two"), ["v2", "v1"]);
    library.delete("two", &Condition::Any, None).unwrap();
    save(library, "two", "v3");
    assert_eq!(titles(library, "two"), ["v3", "v2", "v1"]);
    save(library, "one", "v4");
    assert_eq!(titles(library, "one"), ["v4"], "its states went with its name");
}

#[test]
fn the_files_of_an_earlier_state_are_kept() {
    let temporary = Temporary::new("states-assets");
    let library = &temporary.library;
    library.put("Picture", &ARCHIVE.write(&with_picture(), None).bytes, &Condition::IsNew).unwrap();
    save(library, "Picture", "without");
    let file = temporary.folder.join("assets").join(hash_of(b"picture").to_string());
    let month_ago = std::time::SystemTime::now() - std::time::Duration::from_secs(31 * 24 * 3600);
    std::fs::File::options().append(true).open(&file).unwrap().set_modified(month_ago).unwrap();
    library.tidy_up();
    assert!(file.exists());
}

#[test]
fn an_archive_that_a_save_replaces_is_a_state_too() {
    let temporary = Temporary::new("states-archive");
    let library = &temporary.library;
    std::fs::create_dir_all(&temporary.folder).unwrap();
    std::fs::write(temporary.folder.join("Mine.lightbots.zip"), ARCHIVE.write(&with_picture(), None).bytes)
        .unwrap();
    save(library, "Mine", "without");
    assert_eq!(titles(library, "Mine"), ["without", "Picture"]);
    let number = library.states("Mine").unwrap()[1].number.unwrap();
    let old = library.state("Mine", number).unwrap();
    library.put("Mine", &old.bytes, &Condition::Any).unwrap();
    assert_eq!(picture(library, "Mine"), Some(b"picture".to_vec()));
}

#[test]
fn a_crash_leaves_no_draft_behind_the_next_start() {
    let temporary = Temporary::new("drafts");
    let library = &temporary.library;
    save(library, "a", "v1");
    save(library, "a", "v2");
    let drafts = [".b.lightbots.json.3.saving", "assets/.c.saving", "history/a/.2.lightbots.json.0.saving"]
        .map(|name| temporary.folder.join(name));
    std::fs::create_dir_all(temporary.folder.join("assets")).unwrap();
    drafts.iter().for_each(|draft| std::fs::write(draft, b"half").unwrap());
    library.tidy_up();
    assert!(drafts.iter().all(|draft| !draft.exists()));
    assert_eq!(titles(library, "a"), ["v2", "v1"]);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_no_show() {
    let temporary = Temporary::new("pipes");
    let library = &temporary.library;
    save(library, "mine", "v1");
    let pipe = |name: &str| {
        let path = temporary.folder.join(name);
        assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
    };
    pipe("pipe.lightbots.json");
    pipe(".open");
    std::os::unix::fs::symlink("/dev/zero", temporary.folder.join("endless.lightbots.json")).unwrap();
    std::fs::create_dir(temporary.folder.join("folder.lightbots.json")).unwrap();
    assert_eq!(names(library), [("mine".to_owned(), ShowOrigin::Saved)]);
    for name in ["pipe", "endless", "folder"] {
        assert!(matches!(library.get(name), Err(LibraryError::Disk(_))), "{name}");
    }
    assert_eq!(library.remembered(), None);
    library.tidy_up();
}
