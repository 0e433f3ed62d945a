//! Seeded mutations of good files. Each is read, or refused with one line, and never panics.

mod checks;
mod extras;
mod mutator;
mod numbers;
mod played;
mod sequences;
mod zipped;

use std::path::PathBuf;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use checks::{is_sequence_for, is_show};
use extras::with_every_part;
use lightbots_base::{Rgb, Vec2};
use lightbots_exchange::{ARCHIVE, CSV, FORMATS, FSEQ, Format, LIGHTBOTS, SKYC, VVIZ, asset_of, put_onto};
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage};
use mutator::{corpus_files, mutant};
use numbers::Numbers;

fn seed_show() -> Show {
    let pixel = |id: u32| Pixel {
        id,
        at: Vec2::new(f64::from(id) * 0.1, 0.5),
        color: Rgb::new(255, 165, 0),
        robot: (id == 1).then(|| "r\u{e4}1".to_owned()),
        ..Pixel::default()
    };
    let frame = Frame {
        name: "First \"ä\"\n".into(),
        air_time_s: 1.5,
        transition_s: Some(4.0),
        easing: Easing::Gentle,
        identity: Some(Identity::Fixed),
        pixels: (0..3).map(pixel).collect(),
        ..Frame::default()
    };
    with_every_part(Show {
        stage: Stage {
            obstacles: vec![Obstacle::Disc { at: Vec2::new(-1.0, 0.0), radius_m: 0.2 }],
            ..Stage::default()
        },
        starts: Some(vec![Vec2::new(0.1, 0.2); 2]),
        frames: vec![frame; 2],
        ..Show::default()
    })
}

#[test]
fn no_mutation_breaks_reading_or_validating() {
    let mut numbers = Numbers(2);
    let (mut were_read, mut refused) = (0, 0);
    for format in FORMATS.into_iter().filter(|format| !format.needs_plan) {
        let good = format.write(&seed_show(), None).bytes;
        for _ in 0..4_000 {
            let bytes = mutant(&good, 3, &mut numbers);
            *(if is_show(&bytes, "a.json", format) { &mut were_read } else { &mut refused }) += 1;
        }
    }
    assert!(were_read > 500 && refused > 500, "{were_read} read, {refused} refused");
}

/// Whether a mutant is a show. If it is, it is also written in our format and read again.
fn is_read(bytes: &[u8]) -> bool {
    is_show(bytes, "a.skyc", &LIGHTBOTS)
}

/// Numbers of mutants that were read and refused.
#[derive(Default)]
struct Counted {
    were_read: usize,
    refused: usize,
}

impl Counted {
    fn add(&mut self, is_read: bool) {
        *(if is_read { &mut self.were_read } else { &mut self.refused }) += 1;
    }

    #[track_caller]
    fn has_both(&self) {
        let Self { were_read, refused } = self;
        assert!(*were_read > 20 && *refused > 20, "{were_read} read, {refused} refused");
    }
}

/// Reads mutants in which one file of an archive is changed, with right checksums.
fn mutated_inside(files: &[(String, Vec<u8>)], rounds: usize, numbers: &mut Numbers) -> Counted {
    let mut counted = Counted::default();
    for _ in 0..rounds {
        let changed = numbers.below(files.len());
        let mutated = mutant(&files[changed].1, 1, numbers);
        let content = |index: usize| if index == changed { &mutated } else { &files[index].1 };
        let all: Vec<(&str, &[u8])> =
            files.iter().enumerate().map(|(index, (name, _))| (name.as_str(), &content(index)[..])).collect();
        counted.add(is_read(&zipped::archive(&all)));
    }
    counted
}

/// A file in this format, of the lit show with its music and its plan.
fn file_of(format: &Format) -> Vec<u8> {
    let mut show = played::lit_show();
    let content = b"OggS, and what follows";
    show.assets.extend([asset_of("march.ogg", "audio/ogg", content.as_slice().into())]);
    let plan = format.needs_plan.then(|| played::planned(&show));
    format.write(&show, plan.as_ref()).bytes
}

#[test]
fn no_mutation_breaks_reading_archives() {
    let mut numbers = Numbers(3);
    for format in [&SKYC, &CSV, &ARCHIVE] {
        let whole = file_of(format);
        mutated_inside(&zipped::contents(&whole), 300, &mut numbers).has_both();
        for _ in 0..75 {
            // A changed archive almost always has a wrong checksum.
            is_read(&mutant(&whole, 2, &mut numbers));
        }
    }
}

#[test]
fn no_mutation_breaks_reading_parts_and_music_in_files_of_their_own() {
    let files = [
        (
            "show.json",
            "{\"version\":1,\"media\":{\"audio\":{\"data\":{\"$ref\":\"./a.mp3#\"},\"filename\":\"a\",\"startTime\":1}},\
             \"swarm\":{\"drones\":[{\"settings\":{\"name\":\"r1\",\"trajectory\":{\"$ref\":\"./p.json#\"},\
             \"lights\":{\"$ref\":\"./l.json#\"}}}]}}",
        ),
        ("p.json", "{\"version\":1,\"points\":[[0,[0,0,0],[]],[5,[1,0,0],[[0.5,1,0]]]],\"takeoffTime\":3}"),
        ("l.json", "{\"version\":1,\"data\":\"B6MQAA==\"}"),
        ("a.mp3", "sound"),
    ];
    let files = files.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    mutated_inside(&files, 1_000, &mut Numbers(4)).has_both();
}

#[test]
fn no_mutation_breaks_reading_light_programs() {
    let mut numbers = Numbers(5);
    // The program's commands: set, sleep, a loop with a fade, wait until, pyrotechnics, end.
    let program =
        [4, 255, 9, 0, 100, 2, 50, 12, 3, 8, 0, 0, 255, 25, 6, 25, 13, 3, 0x90, 3, 0x14, 2, 7, 30, 0];
    let mut counted = Counted::default();
    for _ in 0..1_000 {
        let data = STANDARD.encode(mutant(&program, 2, &mut numbers));
        let document = format!(
            "{{\"version\":1,\"swarm\":{{\"drones\":[{{\"settings\":{{\"trajectory\":{{\"version\":1,\"points\":\
             [[0,[0,0,0]],[9,[1,0,0]]]}},\"lights\":{{\"version\":1,\"data\":\"{data}\"}}}}}}]}}}}"
        );
        counted.add(is_read(&zipped::archive(&[("show.json", document.as_bytes())])));
    }
    counted.has_both();
}

#[test]
fn no_mutation_breaks_reading_vviz() {
    let (vviz, mut numbers, mut counted) = (file_of(&VVIZ), Numbers(6), Counted::default());
    for _ in 0..300 {
        counted.add(is_read(&mutant(&vviz, 1, &mut numbers)));
    }
    counted.has_both();
}

#[test]
fn no_mutation_breaks_reading_sequences() {
    let (show, mut numbers) = (played::lit_show(), Numbers(7));
    let plain = file_of(&FSEQ);
    for compression in [sequences::PLAIN, sequences::ZSTD, sequences::ZLIB] {
        for ranges in [&[][..], &[(0, 4), (5, 8)]] {
            let file = sequences::packed(&plain, compression, ranges);
            put_onto(&mut show.clone(), &file).expect("the file itself is read");
            // The header before the frames is a small part of the file.
            let (head, frames) = file.split_at(sequences::data_at(&file));
            let mut counted = Counted::default();
            for round in 0..400 {
                let bytes = if round % 4 == 0 {
                    mutant(&file, 3, &mut numbers)
                } else {
                    [mutant(head, 1, &mut numbers), frames.to_vec()].concat()
                };
                counted.add(is_sequence_for(show.clone(), &bytes));
            }
            counted.has_both();
        }
    }
}

/// The corpora hold the files with which fuzzers begin (`cargo xtask fuzz`), and files that once broke a reader.
#[test]
fn files_of_the_corpora_are_read_or_refused() {
    let corpus =
        |kind: &str| corpus_files(&PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(kind));
    let mut counted = Counted::default();
    for bytes in corpus("show") {
        counted.add(is_read(&bytes));
    }
    assert!(counted.were_read >= 5, "the seeds are read");
    let show = played::lit_show();
    let sequences = corpus("sequence");
    assert!(!sequences.is_empty());
    for bytes in sequences {
        is_sequence_for(show.clone(), &bytes);
    }
}
