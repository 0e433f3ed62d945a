//! A robot is cut off or loses its place for some seconds. No robots touch, the robot takes part again afterwards, and
//! the show is played to its end.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show, Stage};
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Number of robots of the show, and of pixels in each frame.
const ROBOTS: u32 = 8;
/// Number of frames of the show.
const FRAMES: usize = 5;

/// A show whose row of robots moves to and fro by half a metre, with two seconds of air time.
fn show() -> Show {
    let frame = |number: usize| Frame {
        name: format!("{number}"),
        air_time_s: 2.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels: (0..ROBOTS)
            .map(|id| {
                let x = 0.15 * (f64::from(id) - 3.5);
                let at = Vec2::new(x, if number.is_multiple_of(2) { 0.5 } else { 0.0 });
                Pixel { id, at, color: Rgb::new(0, 80, id as u8), ..Pixel::default() }
            })
            .collect(),
        ..Frame::default()
    };
    Show {
        name: "to and fro".into(),
        stage: Stage { width_m: 2.4, depth_m: 2.4, ..Stage::default() },
        identity: Identity::Any,
        starts: None,
        music: None,
        frames: (0..FRAMES).map(frame).collect(),
        ..Show::default()
    }
}

/// A show of robots one behind the other, 18 mm between rims, which move to and fro by a metre.
fn column() -> Show {
    let mut show = show();
    show.identity = Identity::Fixed;
    for (number, frame) in show.frames.iter_mut().enumerate() {
        for (pixel, id) in frame.pixels.iter_mut().zip(0..) {
            let x = 0.072 * f64::from(id) - 0.75;
            pixel.at = Vec2::new(if number.is_multiple_of(2) { x } else { x + 1.0 }, 0.0);
        }
    }
    show
}

/// Plays the show with one robot in trouble. All robots must play the last frame.
fn play(faults: &str, seed: u64) -> RehearsalReport {
    play_show(&show(), faults, seed)
}

fn play_show(show: &Show, faults: &str, seed: u64) -> RehearsalReport {
    let faults_read = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let conditions = faults_read.added_to(Conditions::default());
    let report = rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    assert_eq!(
        (report.contacts, report.frames_played),
        (0, FRAMES),
        "{faults}, seed {seed}: {:#?}",
        report.issues
    );
    report
}

fn has(report: &RehearsalReport, code: &str) -> bool {
    report.issues.iter().any(|issue| issue.code == code)
}

#[test]
fn cut_off_or_lost_on_the_way_it_drops_out_and_comes_back() {
    for (fault, begun) in [("cut=3@1.5s+4s", "robot-cut"), ("blind=3@1.5s+6s", "robot-blind")] {
        for seed in 1..=5 {
            let report = play(fault, seed);
            assert!(has(&report, begun) && has(&report, "robot-back"), "{:#?}", report.issues);
            assert!(has(&report, "rejoined"), "{fault}, seed {seed}: {:#?}", report.issues);
            let last = report.per_frame.last().expect("frames stood");
            assert!(last.position_error_m.max < 0.02, "{fault}, seed {seed}: {last:?}");
        }
    }
}

#[test]
fn a_robot_that_is_cut_off_and_drives_on_runs_into_no_other() {
    // The robots ahead once held after a second of silence, while the one behind them drove on until it noticed the
    // lost link.
    let leaves_s = play_show(&column(), "", 1).per_frame[0].at_s + 2.0;
    for seed in 1..=5 {
        for after_s in [0.4, 0.8, 1.2] {
            let report = play_show(&column(), &format!("cut=0@{:.2}s+5s", leaves_s + after_s), seed);
            assert_eq!(report.dropouts, 1, "seed {seed}: {:#?}", report.issues);
        }
    }
}

#[test]
fn cut_off_or_lost_beyond_the_air_time_it_is_waited_for_by_name_and_comes_back() {
    let at_s = play("", 1).per_frame[1].at_s + 0.3;
    let cut = play(&format!("cut=3@{at_s:.2}s+4s"), 1);
    // The robot may have died: no robot departs before it has acknowledged START.
    assert!(has(&cut, "waiting") && cut.dropouts == 0, "{:#?}", cut.issues);
    // After 4 s the others depart without it, and it rejoins later.
    let long = play(&format!("cut=3@{at_s:.2}s+7s"), 1);
    assert!(has(&long, "dropout") && has(&long, "rejoined"), "{:#?}", long.issues);
    let blind = play(&format!("blind=3@{at_s:.2}s+7s"), 1);
    assert!(has(&blind, "dropout") && has(&blind, "rejoined"), "{:#?}", blind.issues);
}

#[test]
fn an_outage_that_ends_within_the_air_time_changes_nothing() {
    let whole = play("", 1);
    let at_s = whole.per_frame[1].at_s + 0.3;
    for fault in ["cut", "blind"] {
        let report = play(&format!("{fault}=3@{at_s:.2}s+1.2s"), 1);
        assert!(has(&report, "robot-back") && report.dropouts == 0, "{fault}: {:#?}", report.issues);
        assert!((report.duration_s - whole.duration_s).abs() < 0.1, "{fault}: {}", report.duration_s);
    }
}
