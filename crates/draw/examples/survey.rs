//! Draws every file below folders and counts the outcomes: `cargo run --release --example survey -- FOLDER…`. Suitable
//! files that this project did not make are icon sets and test suites of package registries.
#![allow(clippy::print_stdout)]

use std::collections::BTreeMap;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lightbots_draw::picture::PictureSettings;
use lightbots_draw::{DrawError, FileKind, Note, animation, list, picture, sniff, svg, unsupported};

/// Number of the slowest files that are listed.
const SLOWEST: usize = 5;

fn main() {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let mut times: Vec<(f64, PathBuf)> = Vec::new();
    for path in std::env::args().skip(1).flat_map(|folder| files(Path::new(&folder))) {
        let Ok(bytes) = std::fs::read(&path) else { continue };
        let start = Instant::now();
        let outcome = catch_unwind(|| notes(&bytes));
        times.push((start.elapsed().as_secs_f64(), path.clone()));
        let kind = sniff(&bytes).map_or("unknown".to_owned(), |kind| format!("{kind:?}").to_lowercase());
        let codes = match outcome {
            Ok(Ok(notes)) => std::iter::once("drawn").chain(notes.iter().map(|note| note.code)).collect(),
            Ok(Err(error)) => vec!["refused", error.code],
            Err(_) => {
                println!("panic: {}", path.display());
                vec!["panic"]
            }
        };
        for code in codes {
            *counts.entry(format!("{kind} {code}")).or_default() += 1;
        }
    }
    counts.iter().for_each(|(code, count)| println!("{count:8} {code}"));
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    times.iter().take(SLOWEST).for_each(|(time, path)| println!("{time:8.2} s {}", path.display()));
}

/// Notes about parts of a file that its drawing lacks. The error says why there is no drawing.
fn notes(bytes: &[u8]) -> Result<Vec<Note>, DrawError> {
    let settings = PictureSettings::default();
    match sniff(bytes) {
        Some(FileKind::Svg) => svg::draw(bytes).map(|made| made.notes),
        Some(FileKind::Png | FileKind::Jpeg) => picture::draw(bytes, &settings).map(|made| made.notes),
        Some(FileKind::Webp) => match animation::read(bytes, &settings) {
            Err(error) if error.code == "animation-single" => {
                picture::draw(bytes, &settings).map(|made| made.notes)
            }
            other => other.map(|animation| animation.notes),
        },
        Some(FileKind::Gif) => animation::read(bytes, &settings).map(|animation| animation.notes),
        Some(FileKind::Csv) => list::read(bytes).map(|_| Vec::new()),
        None => Err(unsupported(bytes)),
    }
}

/// All files below a folder, or the file itself.
fn files(path: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(path) else { return vec![path.to_owned()] };
    let mut inside: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    inside.sort();
    inside.iter().filter(|path| !path.is_symlink()).flat_map(|path| files(path)).collect()
}
