//! A robot stops dead at a random moment. No robot touches it, and the show goes on without it.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show, Stage};
use lightbots_sim::{BrakeCounts, Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Number of robots, and of pixels in each frame.
const ROBOTS: u32 = 16;

/// A show of a line with 100 mm spacing, a block with 85 mm and a diagonal with 93 mm. Robots follow each other
/// closely.
fn dense_show() -> Show {
    let side = |index: u32| (f64::from(index % 4), f64::from(index / 4));
    let centred = |steps: f64, of: f64| steps - 0.5 * (of - 1.0);
    let line = |index: u32| Vec2::new(0.5, 0.1 * centred(f64::from(index), f64::from(ROBOTS)));
    let block = |index: u32| {
        let (column, row) = side(index);
        Vec2::new(-0.4 + 0.085 * column, 0.085 * centred(row, 4.0))
    };
    let diagonal = |index: u32| {
        let along = 0.077 * centred(f64::from(index), f64::from(ROBOTS));
        Vec2::new(along, along + 0.1) * 0.85
    };
    let frame = |name: &str, place: &dyn Fn(u32) -> Vec2| Frame {
        name: name.into(),
        air_time_s: 0.2,
        transition_s: None,
        easing: Easing::Swift,
        pixels: (0..ROBOTS)
            .map(|id| Pixel { id, at: place(id), color: Rgb::new(0, 80, id as u8), ..Pixel::default() })
            .collect(),
        ..Frame::default()
    };
    Show {
        name: "dense".into(),
        stage: Stage { width_m: 2.4, depth_m: 2.4, ..Stage::default() },
        identity: Identity::Any,
        starts: None,
        music: None,
        frames: vec![frame("line", &line), frame("block", &block), frame("diagonal", &diagonal)],
        ..Show::default()
    }
}

fn play(faults: &str, seed: u64) -> RehearsalReport {
    let faults = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let conditions = faults.added_to(Conditions::default());
    rehearse(&dense_show(), &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {})
}

/// Number of runs, of thirty, in which robots touched after this fault. Asserts that the show goes on in all of them.
fn touched(fault: &str) -> usize {
    let touches = |seed| {
        let report = play(fault, seed);
        assert_eq!(report.frames_played, 3, "{fault}, seed {seed}: {:#?}", report.issues);
        assert!((1..=2).contains(&report.dropouts), "{fault}, seed {seed}: {:#?}", report.issues);
        report.contacts > 0
    };
    (1..=30).filter(|&seed| touches(seed)).count()
}

#[test]
fn no_robot_touches_one_that_died_and_the_show_goes_on() {
    let touched = touched("kill=random") + touched("mute=random");
    assert_eq!(touched, 0, "of 60 runs");
}

#[test]
fn no_robot_touches_one_that_got_stuck_and_the_show_goes_on() {
    let touched = touched("stuck=random");
    assert_eq!(touched, 0, "of 30 runs");
}

#[test]
fn a_robot_that_is_waited_for_and_excluded_is_named() {
    let report = play("kill=5@4s", 2);
    let struck = report.issues.iter().find(|issue| issue.code == "robot-killed").unwrap();
    let name = struck.message.split(['(', ')']).nth(1).unwrap();
    let about =
        |code: &str| report.issues.iter().any(|issue| issue.code == code && issue.message.contains(name));
    assert!(about("dropout"), "{name}: {:#?}", report.issues);
    assert!(report.issues.iter().any(|issue| issue.code == "pixels-dark"), "{:#?}", report.issues);
}

#[test]
fn no_robot_brakes_where_nothing_is_wrong() {
    for seed in 1..=10 {
        let report = play("", seed);
        assert!(report.ok && report.issues.is_empty(), "seed {seed}: {:#?}", report.issues);
        assert_eq!(report.brakes, BrakeCounts::default(), "seed {seed}");
    }
}

/// A show of pairs that drive 1.6 m together. They come within 64 mm of each other half way, then one follows straight
/// behind the other. Of pair n, robot 2n is ahead of robot 2n + 1.
fn pairs_in_line() -> Show {
    let place = |x: f64, aside: f64, id: u32| {
        let back = f64::from(id % 2);
        Vec2::new(x - 0.064 * back, 0.3 * f64::from(id / 2) - 0.9 + aside * back)
    };
    let mut show = dense_show();
    show.starts = Some((0..12).map(|id| place(-0.8, 0.05, id)).collect());
    show.frames.truncate(1);
    show.frames[0].pixels.truncate(12);
    show.frames[0].pixels.iter_mut().for_each(|pixel| pixel.at = place(0.8, -0.05, pixel.id));
    show
}

/// Without a plan that keeps them apart, on straight lines 10 mm behind, nine in ten touched.
#[test]
fn a_robot_close_behind_stops_in_time_when_the_one_ahead_dies() {
    for fault in ["kill=0@3.2s", "stuck=4@3.4s", "kill=6@3.6s", "stuck=2@3.3s"] {
        for seed in 1..=4 {
            let conditions = Faults::parse(fault).unwrap().added_to(Conditions::default());
            let options = RehearsalOptions { seed, conditions, robots: None };
            let report = rehearse(&pairs_in_line(), &options, &mut |_| {});
            let issues = &report.issues;
            assert_eq!((report.contacts, report.dropouts), (0, 1), "{fault}, seed {seed}: {issues:?}");
            // The robot behind the dead one brakes for a real obstacle.
            let BrakeCounts { all, unfounded } = report.brakes;
            assert!(all > 0 && unfounded == 0, "{fault}, seed {seed}: {all} brakes, {unfounded} false");
        }
    }
}
