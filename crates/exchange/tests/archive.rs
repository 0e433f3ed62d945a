//! Archives of a show and its files. They can be read again. An archive that was changed, is too large or names paths
//! outside of itself is refused.

mod extras;
#[path = "../../show/tests/rows/mod.rs"]
mod rows;
mod zipped;

use extras::with_every_part;
use lightbots_exchange::{ARCHIVE, LIGHTBOTS, Loaded, ReadError, asset_of, hash_of, read, sniff};
use lightbots_show::Show;
use rows::{row, show};
use zipped::archive;

/// The only file of the show.
const LOGO: &[u8] = b"<svg xmlns=\"http://www.w3.org/2000/svg\"/>";

/// A show with one file.
fn with_logo() -> Show {
    let mut show = with_every_part(show(vec![row(3)]));
    let (hash, logo) = asset_of("logo.svg", "image/svg+xml", LOGO.into());
    show.assets = [(hash, logo)].into();
    show.frames[0].sources[0].asset = Some(hash);
    show
}

fn document() -> Vec<u8> {
    LIGHTBOTS.write(&with_logo(), None).bytes
}

fn open(bytes: &[u8]) -> Result<Loaded, ReadError> {
    read(bytes, Some("a.lightbots.zip"))
}

/// The code of the refusal. Panics if the bytes are read.
fn code(bytes: &[u8]) -> &'static str {
    let error = open(bytes).expect_err("must not be read");
    assert!(!error.to_string().contains('\n') && error.to_string().len() < 400, "{error}");
    error.code
}

#[test]
fn a_show_and_its_files_come_back() {
    let show = with_logo();
    let written = ARCHIVE.write(&show, None);
    assert_eq!((&written.issues, sniff(&written.bytes)), (&Vec::new(), Some(&ARCHIVE)));
    let loaded = open(&written.bytes).unwrap();
    assert_eq!((loaded.issues, loaded.unread, loaded.has_stage), (Vec::new(), None, true));
    // Places of pixels are rounded, so the test compares the text of the show and the bytes of its files.
    assert_eq!(LIGHTBOTS.write(&loaded.show, None).bytes, document());
    assert_eq!(loaded.show.assets, show.assets);
    assert_eq!(ARCHIVE.write(&loaded.show, None), written, "the same show gives the same bytes");
    let lost = LIGHTBOTS.write(&show, None).issues;
    assert_eq!(lost.len(), 1, "a document does not hold the file: {lost:?}");
}

#[test]
fn a_file_that_is_not_at_hand_is_a_warning() {
    let loaded = read(&document(), None).unwrap();
    let written = ARCHIVE.write(&loaded.show, None);
    assert_eq!(written.issues[0].code, "missing-file");
    let again = open(&written.bytes).unwrap();
    assert_eq!((again.issues[0].code.as_str(), again.unread), ("missing-file", None));
    assert_eq!(again.show, loaded.show);
}

#[test]
fn every_prefix_is_refused() {
    let whole = ARCHIVE.write(&with_logo(), None).bytes;
    for end in 1..whole.len() {
        assert!(open(&whole[..end]).is_err(), "cut at {end}");
    }
}

#[test]
fn every_changed_byte_is_refused_or_changes_nothing_that_counts() {
    let whole = ARCHIVE.write(&with_logo(), None).bytes;
    for at in 0..whole.len() {
        let mut changed = whole.clone();
        changed[at] ^= 0x10;
        if let Ok(loaded) = open(&changed)
            && loaded.unread.is_none()
        {
            assert_eq!(LIGHTBOTS.write(&loaded.show, None).bytes, document(), "byte {at}");
        }
    }
}

#[test]
fn a_file_with_another_hash_or_length_is_refused() {
    let name = format!("assets/{}", hash_of(LOGO));
    assert_eq!(code(&archive(&[("show.lightbots.json", &document()), (&name, b"<svg/>")])), "wrong-hash");
    let length = format!("\"bytes\": {}", LOGO.len());
    let document = String::from_utf8(document()).unwrap().replace(&length, "\"bytes\": 7");
    assert_eq!(
        code(&archive(&[("show.lightbots.json", document.as_bytes()), (&name, LOGO)])),
        "wrong-length"
    );
}

#[test]
fn paths_out_of_the_archive_are_refused() {
    for path in ["../a", "/etc/passwd", "assets/../../a", "a\\b", "C:a", "assets/.."] {
        assert_eq!(
            code(&archive(&[("show.lightbots.json", &document()), (path, b"x")])),
            "bad-path",
            "{path}"
        );
    }
}

#[test]
fn files_that_no_show_has_keep_the_archive_from_being_replaced() {
    let other = format!("assets/{}", hash_of(b"other"));
    for (name, content) in [("notes.txt", b"other".as_slice()), (&other, b"other"), ("assets/logo.svg", LOGO)]
    {
        let loaded = open(&archive(&[("show.lightbots.json", &document()), (name, content)])).unwrap();
        assert_eq!(loaded.unread.as_deref(), Some("it holds files that are not known"), "{name}");
        assert!(loaded.issues.iter().any(|issue| issue.message.contains(&name[..9])), "{:?}", loaded.issues);
    }
}

#[test]
fn what_is_no_show_says_so() {
    assert_eq!(code(&archive(&[])), "not-a-show");
    assert_eq!(code(&archive(&[("readme.txt", b"x")])), "not-a-show");
    assert_eq!(code(&archive(&[("show.lightbots.json", b"[]")])), "not-a-show");
    let broken = open(&archive(&[("show.lightbots.json", b"{\"lightbots\": 2")])).unwrap_err();
    assert!(broken.to_string().contains("(in show.lightbots.json of the archive)"), "{broken}");
    assert_eq!(code(b"PK\x03\x04"), "bad-archive");
    assert_eq!(code(b"PK\x05\x06"), "bad-archive");
}

#[test]
fn bombs_are_refused() {
    let zeros = vec![0; 40 << 20];
    let two = archive(&[("show.lightbots.json", &document()), ("a", &zeros), ("b", &zeros)]);
    assert!(two.len() < 1 << 20, "80 MiB in {} bytes", two.len());
    assert_eq!(code(&two), "too-big");

    let names: Vec<String> = (0..1_001).map(|nth| format!("{nth}")).collect();
    let files: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), b"".as_slice())).collect();
    assert_eq!(code(&archive(&files)), "too-many-files");
    let record = b"PK\x01\x02".repeat(1_000_000);
    assert_eq!(code(&[b"PK\x03\x04".as_slice(), &record].concat()), "too-many-files");
}

#[test]
fn a_file_that_claims_another_size_is_counted_while_it_is_unpacked() {
    let zeros = vec![0; 65 << 20];
    let mut bomb = archive(&[("show.lightbots.json", &zeros)]);
    // Changes the size in the local header and in the directory to 40 bytes.
    let size = (zeros.len() as u32).to_le_bytes();
    let mut places = 0;
    for at in 0..bomb.len() - 4 {
        if bomb[at..at + 4] == size {
            bomb[at..at + 4].copy_from_slice(&40u32.to_le_bytes());
            places += 1;
        }
    }
    assert!(places >= 1, "the size stands in the archive");
    let code = code(&bomb);
    assert!(code == "too-big" || code == "bad-archive", "{code}");
}
