//! Formats of other programs: how a show changes when it is written and read again. docs/exchange.md has the figures,
//! which `--nocapture` prints.
#![allow(clippy::print_stdout)]

mod played;
mod zipped;

use std::sync::Arc;

use lightbots_base::Vec2;
use lightbots_exchange::{CSV, FORMATS, FSEQ, Format, SKYC, VVIZ, asset_of, put_onto, read, replanned};
use lightbots_plan::ShowPlan;
use lightbots_show::{Issue, Show, validate};
use played::{Apart, apart, lit_show, moments, order, planned, prescribed, seen, small_show};

/// Writes a show and reads it again. Returns the result and its differences from the show.
fn there_and_back(format: &Format, show: &Show, codes_max: u8) -> (Show, Apart) {
    let plan = planned(show);
    let written = format.write(show, Some(&plan));
    assert!(!written.issues.iter().any(Issue::is_error), "{:?}", written.issues);
    let mut back = read(&written.bytes, None).unwrap().show;
    let moments_s = moments(&plan);
    let before = seen(show, &plan, &moments_s);
    let after = prescribed(&mut back, &moments_s);
    let apart = apart(&before, &after, &order(&before[0], &after[0]), codes_max);
    println!("{format:?} with {} layers: {apart:?}, {} bytes", show.layers.len(), written.bytes.len());
    (back, apart)
}

/// Asserts that errors are within these bounds: millimetres, colour codes and milliseconds.
#[track_caller]
fn within(apart: Apart, place_mm: f64, codes: u8, time_ms: usize) {
    assert!(apart.place_mm <= place_mm, "{apart:?}");
    assert!(apart.codes <= codes && apart.time_ms <= time_ms, "{apart:?}");
}

#[test]
fn pictures_and_paths_come_back() {
    let show = small_show();
    for (format, place_mm) in [(&SKYC, 1e-6), (&CSV, 1.5), (&VVIZ, 0.6)] {
        let (back, apart) = there_and_back(format, &show, 7);
        within(apart, place_mm, 7, 25);
        assert_eq!((back.frames.len(), back.layers.len()), (3, 0), "{format:?}");
        for (own, other) in show.frames.iter().zip(&back.frames) {
            assert!((own.air_time_s - other.air_time_s).abs() < 0.11, "{format:?}: {}", other.air_time_s);
            assert_eq!(own.pixels.len(), other.pixels.len());
        }
        assert!(validate(&back).iter().all(|issue| !issue.is_error()), "{format:?}");
    }
}

#[test]
fn fades_and_steps_of_layers_come_back_as_a_sequence() {
    for (format, place_mm) in [(&SKYC, 1e-6), (&CSV, 1.5), (&VVIZ, 0.6)] {
        // A channel that falls to code 4 for less than one sample stays at 22.
        let (back, apart) = there_and_back(format, &lit_show(), 24);
        within(apart, place_mm, 24, 40);
        assert_eq!((back.layers.len(), back.layers[0].kind.as_str()), (1, "sequence"), "{format:?}");
    }
}

#[test]
fn a_show_from_skybrush_is_proven_and_lasts_as_long() {
    let show = small_show();
    let plan = planned(&show);
    let back = read(&SKYC.write(&show, Some(&plan)).bytes, None).unwrap();
    assert_eq!(back.issues, []);
    let again = planned(&back.show);
    assert!(again.issues.is_empty(), "{:?}", again.issues);
    assert!((again.duration_s - plan.duration_s).abs() < 0.1, "{} {}", again.duration_s, plan.duration_s);
    assert_eq!(back.show.name, show.name);
}

#[test]
fn music_in_an_archive_comes_back_with_the_first_frame() {
    let content: Arc<[u8]> = b"OggS, and what follows".as_slice().into();
    for mut show in [small_show(), lit_show()] {
        let (hash, asset) = asset_of("march.ogg", "audio/ogg", content.clone());
        show.assets.insert(hash, asset.clone());
        let plan = planned(&show);
        let written = SKYC.write(&show, Some(&plan));
        let lost: Vec<&str> = written.issues.iter().map(|issue| issue.message.as_str()).collect();
        assert!(
            lost.iter().all(|lost| !lost.contains("music") && !lost.contains("files that belong")),
            "{lost:?}"
        );
        let back = read(&written.bytes, None).unwrap();
        assert!(back.issues.iter().all(|issue| issue.code != "music-moved"), "{:?}", back.issues);
        assert_eq!(back.show.music.as_deref(), Some("march.ogg"));
        assert_eq!(back.show.assets.get(&hash), Some(&asset));
        assert_eq!(back.show.frames.len(), 3, "no frame is before that with the music");
        // Without the file of the music the show keeps no music.
        show.assets.clear();
        let silent = SKYC.write(&show, Some(&plan));
        assert!(silent.issues.iter().any(|issue| issue.message.contains("add it to the show")));
        assert_eq!(read(&silent.bytes, None).unwrap().show.music, None);
    }
}

#[test]
fn without_its_paths_a_show_is_planned_anew_in_the_same_time() {
    let show = small_show();
    let plan = planned(&show);
    let mut back = read(&CSV.write(&show, Some(&plan)).bytes, None).unwrap();
    assert!(back.issues.iter().any(|issue| issue.code == "sudden-speeds"), "{:?}", back.issues);
    replanned(&mut back.show);
    assert!(back.show.trajectories.is_empty());
    let again = planned(&back.show);
    assert!((again.duration_s - plan.duration_s).abs() < 2.0, "{} {}", again.duration_s, plan.duration_s);
}

#[test]
fn colours_of_a_sequence_are_put_onto_a_show() {
    let (plain, lit) = (small_show(), lit_show());
    let plan = planned(&plain);
    let written = FSEQ.write(&lit, Some(&plan));
    let first_s = plan.transitions[0].duration.as_secs();
    let mut back = plain.clone();
    back.music = None;
    assert_eq!(put_onto(&mut back, &written.bytes).unwrap(), []);
    assert_eq!(back.music.as_deref(), Some("march.ogg"));
    let moments_s: Vec<f64> = moments(&plan).into_iter().filter(|at_s| *at_s >= first_s).collect();
    let (before, mut after) = (seen(&lit, &plan, &moments_s), back.clone());
    // Places come from the show, which has no trajectories.
    after.starts = Some(lightbots_show::starting_places(&plain));
    lightbots_lighting::attach_pictures(&mut after, |_, asset| {
        lightbots_exchange::sequence_picture(asset.content.as_ref().unwrap()).map(Arc::new)
    });
    let after = seen(&after, &plan, &moments_s);
    let all: Vec<usize> = (0..4).collect();
    let apart = apart(&before, &after, &all, 7);
    println!("fseq: {apart:?}, {} bytes", written.bytes.len());
    within(apart, 0.0, 7, 45);
    let refusal = read(&written.bytes, Some("a.fseq")).unwrap_err();
    assert!(refusal.to_string().contains("--onto SHOW"), "{refusal}");
    let mut wide = plain;
    let first = wide.frames[0].pixels[0].clone();
    wide.frames[0].pixels.push(lightbots_show::Pixel { id: 9, at: Vec2::ZERO, ..first });
    assert_eq!(put_onto(&mut wide, &written.bytes).unwrap()[0].code, "too-few-colours");
    assert!(put_onto(&mut wide, b"PK").unwrap_err().to_string().contains("no FSEQ file"));
}

#[test]
fn a_file_with_paths_needs_a_sound_plan() {
    let show = small_show();
    for format in FORMATS.into_iter().filter(|format| format.needs_plan) {
        for plan in [None, Some(&ShowPlan::default())] {
            let written = format.write(&show, plan);
            let error = written.issues.iter().find(|issue| issue.is_error()).expect("an error");
            assert_eq!((written.bytes.len(), error.code.as_str()), (0, "no-plan"), "{format:?}");
        }
        let written = format.write(&lit_show(), Some(&planned(&lit_show())));
        let codes: Vec<&str> = written.issues.iter().map(|issue| issue.code.as_str()).collect();
        assert!(codes.contains(&"lost-in-format") && codes.contains(&"sampled"), "{format:?}: {codes:?}");
        assert_eq!(format.write(&lit_show(), Some(&planned(&lit_show()))), written, "the same bytes");
    }
}

#[test]
fn names_of_robots_come_back_and_numbers_are_none() {
    let mut show = small_show();
    show.frames.iter_mut().for_each(|frame| frame.pixels[2].robot = Some("abfe6805".into()));
    let plan = planned(&show);
    for format in [&SKYC, &CSV] {
        let back = read(&format.write(&show, Some(&plan)).bytes, None).unwrap();
        let named: Vec<&str> =
            back.show.frames[0].pixels.iter().filter_map(|pixel| pixel.robot.as_deref()).collect();
        assert_eq!(named, ["abfe6805"], "{format:?}");
        assert!(back.issues.iter().any(|issue| issue.code == "named-robots"));
    }
    let tables = zipped::texts(&CSV.write(&show, Some(&plan)).bytes);
    assert!(tables.iter().any(|(name, _)| name == "abfe6805.csv"));
    let (_, table) = tables.iter().find(|(name, _)| name.starts_with("Robot ")).unwrap();
    assert!(table.starts_with("Time [msec],x [m],y [m],z [m],Red,Green,Blue\n0,"), "{}", &table[..90]);
}
