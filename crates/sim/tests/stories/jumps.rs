//! The operator sends robots to frames other than the next one. No robots touch, even if messages are lost.

use crate::five_frames::{FRAMES, play, show};
use lightbots_base::Span;
use lightbots_show::{Layer, LayerSpan, Setting, Show};
use lightbots_sim::{Conditions, Mishap, RehearsalReport};

/// A walk that goes from each frame to every frame, itself included, once.
fn each_to_each() -> Vec<usize> {
    let mut left: Vec<Vec<usize>> = vec![(0..FRAMES).collect(); FRAMES];
    let (mut path, mut walk) = (vec![0], Vec::new());
    while let Some(&at) = path.last() {
        match left[at].pop() {
            Some(next) => path.push(next),
            None => walk.extend(path.pop()),
        }
    }
    walk.reverse();
    walk.split_off(1)
}

/// Asserts that no robots touched or dropped out, and that the show ended after `frames` frames.
fn assert_fine(report: &RehearsalReport, frames: usize, what: &str) {
    let (seed, issues) = (report.seed, &report.issues);
    assert_eq!((report.contacts, report.dropouts), (0, 0), "{what}, seed {seed}: {issues:?}");
    assert_eq!(report.frames_played, frames, "{what}, seed {seed}: {issues:?}");
    let is_bad = |code: &str| ["plan-failed", "no-end", "run-failed"].contains(&code);
    assert!(!issues.iter().any(|issue| is_bad(&issue.code)), "{what}, seed {seed}: {issues:?}");
}

#[test]
fn robots_go_from_each_frame_to_each_other() {
    let visits = each_to_each();
    assert_eq!(visits.len(), FRAMES * FRAMES);
    for (faults, seed) in
        [("", 1), ("loss=5%", 1), ("loss=5%", 2), ("loss=5%,double=5%,reorder=5%,jitter", 3)]
    {
        let conditions = Conditions { visits: visits.clone(), ..Conditions::default() };
        let report = play(&show(12, 1.0), faults, seed, conditions);
        // The frames played: the first one, those of the walk, which ends at the first frame, and the four after it.
        assert_fine(&report, 1 + FRAMES * FRAMES + 4, faults);
        assert!(report.position_error_m.max < 0.02, "{faults}, seed {seed}: {:?}", report.position_error_m);
    }
}

#[test]
fn robots_that_are_held_on_their_way_go_to_each_frame() {
    let mut stopped_on_the_way = 0;
    for (number, at_ms) in (300..9_000).step_by(725).enumerate() {
        let to = number % FRAMES;
        let at = Span::from_millis(at_ms);
        // After 0.1 s robots still slow down, after 0.9 s they stand.
        let after = Span::from_millis(if number % 2 == 0 { 100 } else { 900 });
        let mishaps = vec![(at, Mishap::Pause), (at + after, Mishap::GoTo(to))];
        let conditions = Conditions { mishaps, ..Conditions::default() };
        let report = play(&show(12, 0.3), "loss=5%", at_ms as u64, conditions);
        assert_eq!((report.contacts, report.dropouts), (0, 0), "at {at_ms} ms: {:?}", report.issues);
        assert!(report.frames_played >= FRAMES - to, "at {at_ms} ms: {:?}", report.issues);
        let is_bad = |code: &str| ["plan-failed", "no-end", "run-failed"].contains(&code);
        assert!(!report.issues.iter().any(|issue| is_bad(&issue.code)), "at {at_ms} ms: {:?}", report.issues);
        stopped_on_the_way += usize::from(report.frames_played < FRAMES + 1);
    }
    assert!(stopped_on_the_way > 0);
}

#[test]
fn a_skipped_frame_is_left_out() {
    let mishaps = vec![
        (Span::from_millis(300), Mishap::Pause),
        (Span::from_millis(1_500), Mishap::Skip),
        (Span::from_millis(3_000), Mishap::Resume),
    ];
    for seed in 1..=2 {
        let conditions = Conditions { mishaps: mishaps.clone(), ..Conditions::default() };
        assert_fine(&play(&show(12, 0.3), "loss=5%", seed, conditions), FRAMES - 1, "skip");
    }
}

#[test]
fn light_goes_on_with_the_frame() {
    let settings = vec![("speed_hz".to_owned(), Setting::Number(0.2))];
    let layer = Layer { name: String::new(), kind: "rainbow".into(), span: LayerSpan::Show, settings };
    let lit = Show { layers: vec![layer], ..show(12, 3.0) };
    for (faults, seed, one_in) in [("", 1, 2_000), ("loss=5%", 2, 500)] {
        let conditions = Conditions { visits: vec![3, 1, 1, 4, 0, 2], ..Conditions::default() };
        let report = play(&lit, faults, seed, conditions);
        assert_fine(&report, 1 + 6 + 2, faults);
        let lights = report.lights;
        assert!(lights.compared > 1_000, "seed {seed}: {lights:?}");
        assert!(lights.wrong * one_in <= lights.compared, "seed {seed}: {lights:?}");
    }
}
