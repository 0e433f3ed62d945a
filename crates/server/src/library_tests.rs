use super::*;

const DOT: &[u8] =
    br##"{"lightbots":1,"name":"Dot","frames":[{"pixels":[{"id":0,"place":[0,0],"color":"#ffffff"}]}]}"##;

/// A library in a folder of its own, gone with the value.
struct Temporary {
    library: Library,
    folder: PathBuf,
}

impl Temporary {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("lightbots-library-{}-{name}", std::process::id()));
        let library = Library { folder: folder.clone(), given: Arc::default(), writing: Arc::default() };
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
    library.delete("My dot", &Condition::Any).unwrap();
    assert!(matches!(library.get("My dot"), Err(LibraryError::Missing(_))));
}

#[test]
fn nobody_overwrites_anybody_silently() {
    let temporary = Temporary::new("conflict");
    let library = &temporary.library;
    let first = library.put("a", DOT, &Condition::Any).unwrap();
    let changed = String::from_utf8_lossy(DOT).replace("Dot", "Spot");
    let second = library.put("a", changed.as_bytes(), &Condition::Is(first.etag.clone())).unwrap();
    assert_ne!(first.etag, second.etag);
    let late = library.put("a", DOT, &Condition::Is(first.etag.clone()));
    assert!(matches!(late, Err(LibraryError::Conflict(_))));
    assert!(matches!(library.put("a", DOT, &Condition::IsNew), Err(LibraryError::Conflict(_))));
    assert!(matches!(library.delete("a", &Condition::Is(first.etag)), Err(LibraryError::Conflict(_))));
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
    assert_eq!(library.give("heart", ShowOrigin::Example, &titled("Given")), "heart");
    library.put("Heart 3", DOT, &Condition::IsNew).unwrap();
    let etag = library.get("heart").unwrap().etag;
    let first = library.put("heart", DOT, &Condition::Is(etag)).unwrap();
    assert_eq!((first.name.as_str(), first.copy_of), ("heart 2", Some(ShowOrigin::Example)));
    assert_eq!((first.origin, library.get("heart 2").unwrap().etag), (ShowOrigin::Saved, first.etag.clone()));
    // Whatever version a screen knows of what cannot change: nothing is overwritten, so that nothing is refused.
    let second = library.put("heart", DOT, &Condition::Is("\"old\"".into())).unwrap();
    assert_eq!(second.name, "heart 4");
    assert_eq!(library.get("heart").unwrap().show.name, "Given");
    let again = library.put("heart 2", DOT, &Condition::Is(first.etag)).unwrap();
    assert_eq!((again.name.as_str(), again.copy_of), ("heart 2", None));
    assert!(matches!(library.put("heart", DOT, &Condition::IsNew), Err(LibraryError::Conflict(_))));
    let kept = library.delete("heart", &Condition::Any).unwrap_err();
    assert!(matches!(&kept, LibraryError::ReadOnly(line) if line.contains("example")), "{kept:?}");
    assert_eq!(library.get("heart").unwrap().show.name, "Given");
}

#[test]
fn a_file_of_an_older_version_keeps_the_name_of_an_example() {
    let temporary = Temporary::new("older");
    let library = &temporary.library;
    library.put("heart", DOT, &Condition::Any).unwrap();
    library.put("heart (example)", DOT, &Condition::Any).unwrap();
    assert_eq!(library.give("heart", ShowOrigin::Example, &titled("Given")), "heart (example 2)");
    let saved = |name: &str| (name.to_owned(), ShowOrigin::Saved);
    let example = ("heart (example 2)".to_owned(), ShowOrigin::Example);
    assert_eq!(names(library), [saved("heart"), example, saved("heart (example)")]);
    assert_eq!(library.get("heart").unwrap().show.name, "Dot");
    assert_eq!(library.get("heart (example 2)").unwrap().show.name, "Given");
    assert_eq!(library.put("heart (example 2)", DOT, &Condition::Any).unwrap().name, "heart 2");
    assert_eq!(library.put("heart", DOT, &Condition::Any).unwrap().name, "heart");
    library.delete("heart", &Condition::Any).unwrap();
}

#[test]
fn the_file_of_the_command_line_hides_nothing_and_is_not_hidden() {
    let temporary = Temporary::new("start-file");
    let library = &temporary.library;
    library.give("heart", ShowOrigin::Example, &titled("Given"));
    assert_eq!(library.give("heart", ShowOrigin::StartFile, &titled("File")), "heart");
    let listed = [("heart", ShowOrigin::StartFile), ("heart (example)", ShowOrigin::Example)];
    assert_eq!(names(library), listed.map(|(name, origin)| (name.to_owned(), origin)));
    assert_eq!(library.get("heart").unwrap().show.name, "File");
    let copy = library.put("heart", DOT, &Condition::Any).unwrap();
    assert_eq!((copy.name.as_str(), copy.copy_of), ("heart 2", Some(ShowOrigin::StartFile)));
    // The next start with the same file.
    let next = Library { given: Arc::default(), ..library.clone() };
    assert_eq!(next.give("heart", ShowOrigin::StartFile, &titled("File")), "heart");
    assert_eq!(next.get("heart 2").unwrap().show.name, "Dot");
    next.put("mine", DOT, &Condition::Any).unwrap();
    assert_eq!(next.give("mine", ShowOrigin::StartFile, &titled("File")), "mine (file)");
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
    library.delete("Mine", &Condition::Any).unwrap();
    assert_eq!(library.remembered(), None);
    library.remember("../../etc/passwd");
    assert_eq!(library.remembered(), None);
}
