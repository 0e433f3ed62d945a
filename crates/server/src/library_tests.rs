use std::path::Path;

use lightbots_exchange::asset_of;

use super::*;

#[path = "library/power_cut_tests.rs"]
mod power_cut_tests;
#[path = "library/state_tests.rs"]
mod state_tests;

const DOT: &[u8] =
    br##"{"lightbots":1,"name":"Dot","frames":[{"pixels":[{"id":0,"place":[0,0],"color":"#ffffff"}]}]}"##;

/// A library in a temporary folder, which is removed when this value is dropped.
struct Temporary {
    library: Library,
    folder: PathBuf,
}

impl Temporary {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("lightbots-library-{}-{name}", std::process::id()));
        let library = Library::without_examples(folder.clone());
        Self { library, folder }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

#[test]
fn what_is_saved_is_there() {
    let temporary = Temporary::new("saved");
    let library = &temporary.library;
    let entry = library.put("My dot", DOT, &Condition::IsNew).unwrap();
    assert_eq!(
        (entry.title.as_str(), entry.frames, entry.pixels, entry.origin),
        ("Dot", 1, 1, ShowOrigin::Saved)
    );
    assert_eq!(library.get("My dot").unwrap().etag, entry.etag);
    assert_eq!(library.list(), [entry]);
    library.delete("My dot", &Condition::Any, None).unwrap();
    assert!(matches!(library.get("My dot"), Err(LibraryError::Missing(_))));
}

#[test]
fn no_client_overwrites_another_silently() {
    let temporary = Temporary::new("conflict");
    let library = &temporary.library;
    let first = library.put("a", DOT, &Condition::Any).unwrap();
    let changed = String::from_utf8_lossy(DOT).replace("Dot", "Spot");
    let second = library.put("a", changed.as_bytes(), &Condition::Is(first.etag.clone())).unwrap();
    assert_ne!(first.etag, second.etag);
    let late = library.put("a", DOT, &Condition::Is(first.etag.clone()));
    assert!(matches!(late, Err(LibraryError::Conflict(_))));
    assert!(matches!(library.put("a", DOT, &Condition::IsNew), Err(LibraryError::Conflict(_))));
    assert!(matches!(library.delete("a", &Condition::Is(first.etag), None), Err(LibraryError::Conflict(_))));
    assert_eq!(library.get("a").unwrap().show.name, "Spot");
}

#[test]
fn names_never_leave_the_folder() {
    let temporary = Temporary::new("names");
    for name in
        ["", "..", "../a", "a/b", "a\\b", ".a", " a", "a ", "a.", "a\0", "a\nb", "C:", &"x".repeat(81)]
    {
        assert!(matches!(temporary.library.get(name), Err(LibraryError::BadName(_))), "{name:?}");
        assert!(temporary.library.put(name, DOT, &Condition::Any).is_err(), "{name:?}");
    }
    assert!(!temporary.folder.exists());
}

/// The show `DOT` under another title.
fn titled(title: &str) -> Show {
    let show = read(DOT, None).unwrap().show;
    Show { name: title.into(), ..show }
}

fn names(library: &Library) -> Vec<(String, ShowOrigin)> {
    library.list().into_iter().map(|entry| (entry.name, entry.origin)).collect()
}

#[test]
fn a_given_show_stays_as_it_is_and_saving_it_makes_copies() {
    let temporary = Temporary::new("given");
    let library = &temporary.library;
    assert_eq!(library.give("heart", ShowOrigin::Example, &titled("Given"), None), "heart");
    library.put("Heart 3", DOT, &Condition::IsNew).unwrap();
    let etag = library.get("heart").unwrap().etag;
    let first = library.put("heart", DOT, &Condition::Is(etag)).unwrap();
    assert_eq!((first.name.as_str(), first.copy_of), ("heart 2", Some(ShowOrigin::Example)));
    assert_eq!((first.origin, library.get("heart 2").unwrap().etag), (ShowOrigin::Saved, first.etag.clone()));
    // A built-in show cannot change, so any version of it is accepted: nothing is overwritten.
    let second = library.put("heart", DOT, &Condition::Is("\"old\"".into())).unwrap();
    assert_eq!(second.name, "heart 4");
    assert_eq!(library.get("heart").unwrap().show.name, "Given");
    let again = library.put("heart 2", DOT, &Condition::Is(first.etag)).unwrap();
    assert_eq!((again.name.as_str(), again.copy_of), ("heart 2", None));
    assert!(matches!(library.put("heart", DOT, &Condition::IsNew), Err(LibraryError::Conflict(_))));
    let kept = library.delete("heart", &Condition::Any, None).unwrap_err();
    assert!(matches!(&kept, LibraryError::ReadOnly(line) if line.contains("example")), "{kept:?}");
    assert_eq!(library.get("heart").unwrap().show.name, "Given");
}

#[test]
fn a_file_of_an_older_version_keeps_the_name_of_an_example() {
    let temporary = Temporary::new("older");
    let library = &temporary.library;
    library.put("heart", DOT, &Condition::Any).unwrap();
    library.put("heart (example)", DOT, &Condition::Any).unwrap();
    assert_eq!(library.give("heart", ShowOrigin::Example, &titled("Given"), None), "heart (example 2)");
    let saved = |name: &str| (name.to_owned(), ShowOrigin::Saved);
    let example = ("heart (example 2)".to_owned(), ShowOrigin::Example);
    assert_eq!(names(library), [saved("heart"), example, saved("heart (example)")]);
    assert_eq!(library.get("heart").unwrap().show.name, "Dot");
    assert_eq!(library.get("heart (example 2)").unwrap().show.name, "Given");
    assert_eq!(library.put("heart (example 2)", DOT, &Condition::Any).unwrap().name, "heart 2");
    assert_eq!(library.put("heart", DOT, &Condition::Any).unwrap().name, "heart");
    library.delete("heart", &Condition::Any, None).unwrap();
}

#[test]
fn the_file_of_the_command_line_hides_nothing_and_is_not_hidden() {
    let temporary = Temporary::new("start-file");
    let library = &temporary.library;
    library.give("heart", ShowOrigin::Example, &titled("Given"), None);
    assert_eq!(library.give("heart", ShowOrigin::StartFile, &titled("File"), None), "heart");
    let listed = [("heart", ShowOrigin::StartFile), ("heart (example)", ShowOrigin::Example)];
    assert_eq!(names(library), listed.map(|(name, origin)| (name.to_owned(), origin)));
    assert_eq!(library.get("heart").unwrap().show.name, "File");
    let copy = library.put("heart", DOT, &Condition::Any).unwrap();
    assert_eq!((copy.name.as_str(), copy.copy_of), ("heart 2", Some(ShowOrigin::StartFile)));
    // A library as after the next start with the same file.
    let next = Library { given: GivenShows::default(), ..library.clone() };
    assert_eq!(next.give("heart", ShowOrigin::StartFile, &titled("File"), None), "heart");
    assert_eq!(next.get("heart 2").unwrap().show.name, "Dot");
    next.put("mine", DOT, &Condition::Any).unwrap();
    assert_eq!(next.give("mine", ShowOrigin::StartFile, &titled("File"), None), "mine (file)");
    assert_eq!(next.get("mine").unwrap().show.name, "Dot");
}

#[test]
fn junk_is_not_saved() {
    let temporary = Temporary::new("junk");
    assert!(matches!(temporary.library.put("a", b"{", &Condition::Any), Err(LibraryError::NoShow(_))));
    assert!(temporary.library.list().is_empty());
}

#[test]
fn files_give_names() {
    assert_eq!(name_of_file(Path::new("/x/3210.json")), "3210");
    assert_eq!(name_of_file(Path::new("Heart beat.lightbots.json")), "Heart beat");
    assert_eq!(name_of_file(Path::new("a:b?.json")), "a-b-");
    assert_eq!(name_of_file(Path::new("..json")), "show");
}

#[test]
fn every_example_is_a_show() {
    let library = Library::new(PathBuf::from("nowhere"));
    assert_eq!(library.list().len(), examples::all().count());
}

#[test]
fn the_show_that_was_open_is_remembered_while_it_is_there() {
    let temporary = Temporary::new("remembered");
    let library = &temporary.library;
    assert_eq!(library.remembered(), None);
    library.put("Mine", DOT, &Condition::Any).unwrap();
    library.remember("Mine");
    assert_eq!(library.remembered().as_deref(), Some("Mine"));
    assert_eq!(library.list().len(), 1);
    library.delete("Mine", &Condition::Any, None).unwrap();
    assert_eq!(library.remembered(), None);
    library.remember("../../etc/passwd");
    assert_eq!(library.remembered(), None);
}

/// The show `DOT` with a field that this version does not know.
fn of_the_future() -> Vec<u8> {
    String::from_utf8_lossy(DOT)
        .replacen("{\"lightbots\":1", "{\"lightbots\":3,\"glow\":{\"a\":1}", 1)
        .into_bytes()
}

#[test]
fn a_show_with_unknown_fields_is_kept_byte_for_byte_and_never_replaced() {
    let temporary = Temporary::new("unread");
    let library = &temporary.library;
    let entry = library.put("Future", &of_the_future(), &Condition::IsNew).unwrap();
    let line = entry.read_only.clone().unwrap();
    assert!(line.contains("format version 3") && line.contains("\"glow\" of the show"), "{line}");
    assert!(line.contains("save a copy under another name"), "{line}");
    let kept = library.get("Future").unwrap();
    assert_eq!((kept.read_only.as_ref(), kept.show.name.as_str()), (Some(&line), "Dot"));
    assert!(!String::from_utf8_lossy(&kept.bytes).contains("glow"), "screens get what is known");
    for condition in [Condition::Any, Condition::Is(entry.etag.clone())] {
        for bytes in [DOT, &of_the_future(), &kept.bytes] {
            let refused = library.put("Future", bytes, &condition).unwrap_err();
            assert_eq!(refused, LibraryError::ReadOnly(line.clone()));
        }
    }
    assert_eq!(library.file("Future").unwrap(), (of_the_future(), &LIGHTBOTS));
    // A copy has the known fields only; the file itself can have another name, and can be deleted.
    assert_eq!(library.put("Copy", &kept.bytes, &Condition::IsNew).unwrap().read_only, None);
    let renamed = library.put("Later", &library.file("Future").unwrap().0, &Condition::IsNew).unwrap();
    library.delete("Future", &Condition::Is(entry.etag), None).unwrap();
    assert!(renamed.read_only.is_some() && library.get("Future").is_err());
    assert_eq!(library.file("Later").unwrap().0, of_the_future());
}

#[test]
fn a_start_file_with_unknown_fields_has_no_copies_by_itself() {
    let temporary = Temporary::new("unread-given");
    let library = &temporary.library;
    let unread = read(&of_the_future(), None).unwrap().unread;
    library.give("mine", ShowOrigin::StartFile, &titled("File"), unread);
    assert!(library.get("mine").unwrap().read_only.unwrap().contains("glow"));
    assert!(matches!(library.put("mine", DOT, &Condition::Any), Err(LibraryError::ReadOnly(_))));
    assert_eq!(library.list().len(), 1);
}

/// The show `DOT` with one file.
fn with_picture() -> Show {
    let content: Arc<[u8]> = b"picture".as_slice().into();
    Show { assets: [asset_of("a.png", "image/png", content)].into(), ..titled("Picture") }
}

/// The bytes of the only file of a show of the library.
fn picture(library: &Library, name: &str) -> Option<Vec<u8>> {
    let mut show = library.get(name).unwrap().show;
    assert!(show.assets.values().all(|asset| asset.content.is_none()), "files are read when they are needed");
    library.attach(&mut show);
    show.assets.values().next().unwrap().content.as_ref().map(|content| content.to_vec())
}

#[test]
fn files_of_an_archive_are_kept_once_and_outlive_saves_of_the_document() {
    let temporary = Temporary::new("archive");
    let library = &temporary.library;
    let archive = ARCHIVE.write(&with_picture(), None).bytes;
    let entry = library.put("Picture", &archive, &Condition::IsNew).unwrap();
    assert_eq!((entry.read_only, picture(library, "Picture")), (None, Some(b"picture".to_vec())));
    let kept = library.get("Picture").unwrap();
    library.put("Picture", &kept.bytes, &Condition::Is(kept.etag)).unwrap();
    library.put("Copy", &kept.bytes, &Condition::IsNew).unwrap();
    library.delete("Picture", &Condition::Any, None).unwrap();
    assert_eq!(picture(library, "Copy"), Some(b"picture".to_vec()));
    let assets = temporary.folder.join("assets");
    assert_eq!(std::fs::read_dir(&assets).unwrap().count(), 1);
    // A file that was damaged on the disk counts as missing.
    let file = std::fs::read_dir(&assets).unwrap().next().unwrap().unwrap().path();
    std::fs::write(&file, b"pictUre").unwrap();
    assert_eq!(picture(library, "Copy"), None);
}

#[test]
fn an_archive_that_lies_in_the_folder_is_a_show() {
    let temporary = Temporary::new("archive-file");
    let library = &temporary.library;
    std::fs::create_dir_all(&temporary.folder).unwrap();
    let file = temporary.folder.join("Mine.lightbots.zip");
    std::fs::write(&file, ARCHIVE.write(&with_picture(), None).bytes).unwrap();
    assert_eq!(names(library), [("Mine".to_owned(), ShowOrigin::Saved)]);
    let kept = library.get("Mine").unwrap();
    assert_eq!(library.file("Mine").unwrap().1, &ARCHIVE);
    library.put("Mine", &kept.bytes, &Condition::Is(kept.etag)).unwrap();
    assert_eq!((file.exists(), library.file("Mine").unwrap().1), (false, &LIGHTBOTS));
    assert_eq!((names(library).len(), picture(library, "Mine")), (1, Some(b"picture".to_vec())));
    library.delete("Mine", &Condition::Any, None).unwrap();
    assert!(library.list().is_empty());
}

#[test]
fn an_archive_that_is_not_understood_whole_stays_an_archive() {
    let temporary = Temporary::new("archive-unread");
    let library = &temporary.library;
    // The document `DOT`, and a file "notes.txt".
    let bytes = include_bytes!("library/unknown_file.lightbots.zip");
    let entry = library.put("Show", bytes, &Condition::IsNew).unwrap();
    assert!(entry.read_only.unwrap().contains("files that are not known"));
    assert!(temporary.folder.join("Show.lightbots.zip").exists());
    assert_eq!(library.file("Show").unwrap(), (bytes.to_vec(), &ARCHIVE));
    assert!(matches!(library.put("Show", DOT, &Condition::Any), Err(LibraryError::ReadOnly(_))));
}

#[test]
fn the_files_of_a_start_file_go_with_its_copy() {
    let temporary = Temporary::new("archive-given");
    let library = &temporary.library;
    library.give("mine", ShowOrigin::StartFile, &with_picture(), None);
    assert_eq!(picture(library, "mine"), Some(b"picture".to_vec()));
    assert!(!temporary.folder.exists(), "nothing is written before something is saved");
    let kept = library.get("mine").unwrap();
    let copy = library.put("mine", &kept.bytes, &Condition::Any).unwrap();
    // A library as after the next start without that file.
    let assets = AssetStore::new(temporary.folder.join("assets"));
    let later = Library { given: GivenShows::default(), assets, ..library.clone() };
    assert_eq!(picture(&later, &copy.name), Some(b"picture".to_vec()));
}

#[test]
fn a_file_is_added_once_under_its_own_hash_only() {
    let temporary = Temporary::new("asset");
    let library = &temporary.library;
    let hash = hash_of(b"picture").to_string();
    assert!(matches!(library.asset(&hash), Err(LibraryError::Missing(_))));
    assert!(matches!(library.put_asset(&hash, b"other"), Err(LibraryError::NoShow(_))));
    for name in ["../a", "", &hash.to_uppercase()] {
        assert!(matches!(library.put_asset(name, b"picture"), Err(LibraryError::BadName(_))), "{name}");
        assert!(matches!(library.asset(name), Err(LibraryError::BadName(_))), "{name}");
    }
    assert!(!temporary.folder.exists());
    library.put_asset(&hash, b"picture").unwrap();
    library.put_asset(&hash, b"picture").unwrap();
    assert_eq!(&*library.asset(&hash).unwrap(), b"picture");
    // A show that names the file and is saved without its content has the content afterwards.
    let mut show = with_picture();
    show.assets.values_mut().for_each(|asset| asset.content = None);
    library.put("Picture", &LIGHTBOTS.write(&show, None).bytes, &Condition::IsNew).unwrap();
    assert_eq!(picture(library, "Picture"), Some(b"picture".to_vec()));
    // A damaged file is written again.
    std::fs::write(temporary.folder.join("assets").join(&hash), b"pictUre").unwrap();
    assert!(library.asset(&hash).is_err());
    library.put_asset(&hash, b"picture").unwrap();
    assert_eq!(&*library.asset(&hash).unwrap(), b"picture");
}

#[test]
fn files_that_no_show_names_go_after_a_month() {
    let temporary = Temporary::new("sweep");
    let library = &temporary.library;
    library.put("Picture", &ARCHIVE.write(&with_picture(), None).bytes, &Condition::IsNew).unwrap();
    let assets = temporary.folder.join("assets");
    let (used, old, new) = (hash_of(b"picture"), "0a".repeat(32), "0b".repeat(32));
    std::fs::write(assets.join(&old), b"old").unwrap();
    std::fs::write(assets.join(&new), b"new").unwrap();
    let month_ago = std::time::SystemTime::now() - std::time::Duration::from_secs(31 * 24 * 3600);
    for name in [used.to_string(), old.clone()] {
        std::fs::File::options()
            .append(true)
            .open(assets.join(name))
            .unwrap()
            .set_modified(month_ago)
            .unwrap();
    }
    library.tidy_up();
    let is_there = [used.to_string(), old, new].map(|name| assets.join(name).exists());
    assert_eq!(is_there, [true, false, true]);
}
