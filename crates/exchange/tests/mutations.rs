//! Seeded mutations of good files: each is read, or refused with one line, and never panics.

mod extras;
mod mutator;
mod numbers;
mod played;
mod zipped;

use extras::with_every_part;
use lightbots_base::{Rgb, Vec2};
use lightbots_exchange::{CSV, FORMATS, FSEQ, LIGHTBOTS, SKYC, VVIZ, put_onto, read};
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage, front_rows, validate};
use mutator::mutant;
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
            match read(&bytes, Some("a.json")) {
                Ok(loaded) => {
                    were_read += 1;
                    let lines = validate(&loaded.show);
                    assert!(lines.iter().chain(&loaded.issues).all(|issue| !issue.message.contains('\n')));
                    front_rows(&loaded.show.stage, 5);
                    let again =
                        read(&format.write(&loaded.show, None).bytes, None).expect("what we write we read");
                    assert_eq!(again.show.frames.len(), loaded.show.frames.len());
                }
                Err(error) => {
                    refused += 1;
                    let line = error.to_string();
                    assert!(!line.contains('\n') && line.len() < 400, "{line}");
                }
            }
        }
    }
    assert!(were_read > 500 && refused > 500, "{were_read} read, {refused} refused");
}

/// Reads a mutant; whether it is a show, which a file of ours then holds.
fn is_read(bytes: &[u8]) -> bool {
    match read(bytes, Some("a.skyc")) {
        Ok(loaded) => {
            let lines = validate(&loaded.show);
            assert!(lines.iter().chain(&loaded.issues).all(|issue| !issue.message.contains('\n')));
            let again =
                read(&LIGHTBOTS.write(&loaded.show, None).bytes, None).expect("what we write we read");
            assert_eq!(again.show.frames.len(), loaded.show.frames.len());
            true
        }
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains('\n') && line.len() < 400, "{line}");
            false
        }
    }
}

#[test]
fn no_mutation_breaks_reading_files_of_other_programs() {
    let show = played::lit_show();
    let plan = played::planned(&show);
    let mut numbers = Numbers(3);
    let (mut were_read, mut refused) = (0, 0);
    let mut count = |is_read: bool| if is_read { were_read += 1 } else { refused += 1 };
    for format in [&SKYC, &CSV] {
        let whole = format.write(&show, Some(&plan)).bytes;
        let files = zipped::texts(&whole);
        for round in 0..300 {
            // A changed archive is nearly always one with a wrong checksum.
            if round % 4 == 0 {
                count(is_read(&mutant(&whole, 2, &mut numbers)));
            }
            let changed = numbers.below(files.len());
            let contents: Vec<Vec<u8>> = files.iter().map(|(_, text)| text.clone().into_bytes()).collect();
            let files = files.iter().zip(&contents).enumerate().map(|(index, ((name, _), content))| {
                let content =
                    if index == changed { mutant(content, 1, &mut numbers) } else { content.clone() };
                (name.as_str(), content)
            });
            let files: Vec<(&str, Vec<u8>)> = files.collect();
            let files: Vec<(&str, &[u8])> =
                files.iter().map(|(name, content)| (*name, &content[..])).collect();
            count(is_read(&zipped::archive(&files)));
        }
    }
    let vviz = VVIZ.write(&show, Some(&plan)).bytes;
    for _ in 0..300 {
        count(is_read(&mutant(&vviz, 1, &mut numbers)));
    }
    let fseq = FSEQ.write(&show, Some(&plan)).bytes;
    for _ in 0..1_000 {
        let bytes = mutant(&fseq, 3, &mut numbers);
        let put = put_onto(&mut show.clone(), &bytes);
        count(put.is_ok());
        assert!(put.is_ok() || !put.unwrap_err().to_string().contains('\n'));
    }
    assert!(were_read > 100 && refused > 300, "{were_read} read, {refused} refused");
}
