//! Frames repeat until GO. No robots touch on any way back, even if messages are lost.

use crate::five_frames::{self, play};
use lightbots_base::Span;
use lightbots_show::{Cue, CuePlace, Layer, LayerSpan, Setting, Show};
use lightbots_sim::{Conditions, Mishap, RehearsalReport};

/// A show of five frames for `count` robots. Those from `first` to `last`, counted from 0, repeat until GO.
fn show((first, last): (usize, usize), count: u32) -> Show {
    let at = CuePlace::Frame(last.to_string());
    let cue = Cue { name: "Encore".into(), at, loop_from: Some(first.to_string()) };
    Show { cues: vec![cue], ..five_frames::show(count, 0.5) }
}

fn rounds(loop_rounds: u32) -> Conditions {
    Conditions { loop_rounds, ..Conditions::default() }
}

/// Asserts that no robots touched or dropped out, and that exactly these frames were played.
fn assert_played(report: &RehearsalReport, frames: &[usize], what: &str) {
    let (seed, issues) = (report.seed, &report.issues);
    let what = format!("{what}, seed {seed}: {issues:?}");
    assert_eq!((report.contacts, report.dropouts), (0, 0), "{what}");
    assert_eq!(report.per_frame.iter().map(|frame| frame.frame).collect::<Vec<_>>(), frames, "{what}");
    let is_bad = |code: &str| ["plan-failed", "no-end", "run-failed"].contains(&code);
    assert!(!issues.iter().any(|issue| is_bad(&issue.code)), "{what}");
}

#[test]
fn a_rehearsal_plays_a_loop_once_and_goes_on() {
    let report = play(&show((1, 3), 12), "", 1, Conditions::default());
    assert_played(&report, &[0, 1, 2, 3, 4], "once");
    let plain = play(&Show { cues: Vec::new(), ..show((1, 3), 12) }, "", 1, Conditions::default());
    assert!(report.ok && (report.duration_s - plain.duration_s).abs() < 1.0, "{} s", report.duration_s);
}

#[test]
fn frames_repeat_without_contacts() {
    for seed in 1..=4 {
        for faults in ["", "loss=5%", "loss=5%,double=5%,reorder=5%,jitter"] {
            let report = play(&show((1, 3), 12), faults, seed, rounds(4));
            assert_played(&report, &[0, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4], faults);
            assert!(report.position_error_m.max < 0.02, "{faults}, seed {seed}");
            let report = play(&show((2, 4), 12), faults, seed, rounds(2));
            assert_played(&report, &[0, 1, 2, 3, 4, 2, 3, 4], faults);
        }
    }
    let report = play(&show((2, 2), 12), "loss=5%", 1, rounds(3));
    assert_played(&report, &[0, 1, 2, 2, 2, 3, 4], "one frame");
}

#[test]
fn loops_outlive_controllers_links_and_robots() {
    for seed in 1..=3 {
        for faults in ["crash=9+3,loss=5%", "freeze=9+5,loss=5%", "gone=14+4,loss=5%"] {
            let report = play(&show((1, 2), 12), faults, seed, rounds(4));
            assert_played(&report, &[0, 1, 2, 1, 2, 1, 2, 1, 2, 3, 4], faults);
        }
        let report = play(&show((1, 2), 12), "kill=3@10,loss=5%", seed, rounds(4));
        assert_eq!((report.contacts, report.dropouts), (0, 1), "seed {seed}: {:?}", report.issues);
        assert_eq!(report.frames_played, 11, "seed {seed}: {:?}", report.issues);
    }
}

#[test]
fn the_operator_pauses_and_jumps_in_a_loop() {
    for (seed, at_ms) in (1_000..20_000).step_by(1_900).enumerate() {
        let at = Span::from_millis(at_ms);
        let mishaps = vec![
            (at, Mishap::Pause),
            (at + Span::from_millis(700), Mishap::GoTo(seed % 4)),
            (at + Span::from_millis(4_000), Mishap::Pause),
            (at + Span::from_millis(5_000), Mishap::Resume),
        ];
        let conditions = Conditions { mishaps, ..rounds(3) };
        let report = play(&show((1, 3), 12), "loss=5%", seed as u64, conditions);
        let frames: Vec<usize> = report.per_frame.iter().map(|frame| frame.frame).collect();
        assert_eq!((report.contacts, report.dropouts), (0, 0), "at {at_ms} ms: {:?}", report.issues);
        assert!(frames.ends_with(&[3, 4]), "at {at_ms} ms: {frames:?}, {:?}", report.issues);
    }
}

#[test]
fn light_is_that_of_the_frame_in_every_round() {
    let settings = vec![("speed_hz".into(), Setting::Number(0.2))];
    let layer = Layer { name: String::new(), kind: "rainbow".into(), span: LayerSpan::Show, settings };
    let lit = Show { layers: vec![layer], ..show((1, 3), 12) };
    for (faults, seed, one_in) in [("", 1, 2_000), ("loss=5%", 2, 500)] {
        let report = play(&lit, faults, seed, rounds(3));
        assert_played(&report, &[0, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4], faults);
        let lights = report.lights;
        assert!(lights.compared > 1_000, "seed {seed}: {lights:?}");
        assert!(lights.wrong * one_in <= lights.compared, "seed {seed}: {lights:?}");
    }
}
