//! The example shows equal the output of their generator, are valid, and leave robots room to drive straight.

#[path = "../examples/shows/programme.rs"]
mod programme;

use std::path::Path;

use lightbots_base::Vec2;
use lightbots_exchange::{ORIGINAL, read, sniff};
use lightbots_show::{close_pairs, validate};
use programme::Entry;

/// Least distance between the pixels of a frame, metres. More than 76.4 mm keeps synchronised straight lines apart.
const LEAST_GAP_M: f64 = 0.08;

#[test]
fn the_files_are_current() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shows");
    for entry in programme::all() {
        let kept = std::fs::read(folder.join(entry.file)).unwrap_or_default();
        let hint = "run `cargo run -p lightbots-exchange --example shows`";
        assert!(kept == entry.bytes(), "{} is not what its generator writes; {hint}", entry.file);
    }
}

#[test]
fn they_are_sound_and_spacious() {
    for entry in programme::all() {
        let loaded = read(&entry.bytes(), Some(entry.file)).unwrap();
        assert_eq!((sniff(&entry.bytes()), loaded.issues.len()), (Some(entry.format), 0), "{}", entry.file);
        assert_eq!(validate(&loaded.show), [], "{}", entry.file);
        for frame in &loaded.show.frames {
            let places: Vec<Vec2> = frame.pixels.iter().map(|pixel| pixel.at).collect();
            let close = close_pairs(&places, LEAST_GAP_M, 10);
            assert!(close.is_empty(), "{}, {}: {close:?}", entry.file, frame.name);
        }
    }
}

#[test]
fn those_in_the_originals_format_suit_its_thirty_robots() {
    let originals: Vec<_> = programme::all().into_iter().filter(|entry| *entry.format == ORIGINAL).collect();
    assert!(originals.len() >= 2);
    for entry in originals {
        for frame in &entry.show.frames {
            let ids: Vec<u32> = frame.pixels.iter().map(|pixel| pixel.id).collect();
            assert_eq!(ids, (0..30).collect::<Vec<_>>(), "{}, {}", entry.file, frame.name);
        }
    }
}

#[test]
fn the_gallery_has_a_film_a_contact_sheet_and_words_for_each_show() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let words = std::fs::read_to_string(docs.join("gallery.md")).unwrap();
    let shown: Vec<_> = programme::all().into_iter().filter(|entry| *entry.format != ORIGINAL).collect();
    assert_eq!(shown.len(), 10);
    for Entry { file, show, .. } in shown {
        let name = file.split('.').next().unwrap_or_default();
        assert!(words.contains(&format!("## {}\n", show.name)), "{file} has no words");
        for part in [format!("../shows/{file}"), format!("gallery/{name}.mp4"), format!("gallery/{name}.png")]
        {
            assert!(words.contains(&part) && docs.join(&part).is_file(), "{file} lacks {part}");
        }
    }
}
