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
    assert_eq!((entry.title.as_str(), entry.frames, entry.pixels, entry.example), ("Dot", 1, 1, false));
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

#[test]
fn a_given_show_hides_a_saved_one_until_it_is_saved() {
    let temporary = Temporary::new("given");
    let library = &temporary.library;
    library.put("a", DOT, &Condition::Any).unwrap();
    let mut show = library.get("a").unwrap().show;
    show.name = "Given".into();
    library.give("a", &show);
    assert_eq!(library.get("a").unwrap().show.name, "Given");
    assert!(library.list()[0].example);
    library.put("a", DOT, &Condition::Any).unwrap();
    assert_eq!(library.get("a").unwrap().show.name, "Dot");
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
    assert_eq!(library.list().len(), examples::all().len());
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
