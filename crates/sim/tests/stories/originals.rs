//! Robots that understand only TARGET and COLOR play whole shows. They drive simultaneously where no two can meet, and
//! one after the other elsewhere.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Pixel, Show};
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Number of robots of the show, and of pixels in each frame.
const ROBOTS: u32 = 30;

/// A show as dense as the original's, whose closest pixels are 84 mm apart. Its frames are a row, two lines, a block at
/// the other side of the floor, and a ring.
fn show() -> Show {
    let row = |i: u32| Vec2::new(-1.3 + 0.0917 * f64::from(i), 1.29);
    let lines = |i: u32| Vec2::new(-1.3 + 0.15 * f64::from(i / 2), 1.2 - 0.09 * f64::from(i % 2));
    let block = |i: u32| Vec2::new(0.4 + 0.085 * f64::from(i % 6), -0.9 + 0.085 * f64::from(i / 6));
    let ring = |i: u32| Vec2::unit(f64::from(i) * std::f64::consts::TAU / f64::from(ROBOTS)) * 0.42;
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
    let frames =
        vec![frame("row", &row), frame("lines", &lines), frame("block", &block), frame("ring", &ring)];
    Show { name: "dense".into(), frames, ..Show::default() }
}

fn play(faults: &str, seed: u64) -> RehearsalReport {
    let stated = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let conditions = stated.added_to(Conditions::default());
    let report = rehearse(&show(), &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    assert_eq!((report.contacts, report.frames_played), (0, 4), "{faults} {seed}: {:#?}", report.issues);
    report
}

#[test]
fn they_take_little_longer_than_ours_and_stand_where_they_should() {
    let ours_s = play("original=0", 1).duration_s;
    for seed in 1..=3 {
        let report = play("original=30", seed);
        assert!(report.ok, "seed {seed}: {:#?}", report.issues);
        let took_s = report.duration_s;
        assert!(took_s < 2.0 * ours_s, "seed {seed}: {took_s} s, ours {ours_s} s");
        assert!(report.position_error_m.median < 0.006, "seed {seed}: {:?}", report.position_error_m);
        assert!(report.position_error_m.max < 0.03, "seed {seed}: {:?}", report.position_error_m);
    }
}

#[test]
fn the_spread_of_arrivals_counts_from_the_first_robot_that_stays() {
    let report = play("original=30", 1);
    for frame in &report.per_frame {
        let (spread_s, drive_s) = (frame.arrival_spread_s, frame.drive_s);
        assert!(spread_s > 0.1 && spread_s < drive_s, "{}: {spread_s} s of {drive_s} s", frame.name);
    }
}

#[test]
fn lost_messages_cost_time_and_no_contact() {
    for seed in 1..=3 {
        assert!(play("original=30,loss=5%", seed).ok);
        assert!(play("original=12,loss=5%", seed).ok);
    }
}

#[test]
fn with_ours_among_them_all_robots_arrive() {
    for seed in 1..=2 {
        let report = play("original=15", seed);
        assert!(report.ok, "seed {seed}: {:#?}", report.issues);
    }
}

#[test]
fn one_that_breaks_down_is_waited_for_named_and_driven_around() {
    for seed in 1..=3 {
        for fault in ["kill=random", "mute=random", "stuck=random"] {
            let report = play(&format!("original=30,{fault}"), seed);
            assert_eq!(report.dropouts, 1, "{fault}, seed {seed}: {:#?}", report.issues);
            let struck = report.issues.iter().find(|issue| issue.code.starts_with("robot-")).unwrap();
            let name = struck.message.split(['(', ')']).nth(1).unwrap();
            let dropout = report.issues.iter().find(|issue| issue.code == "dropout").unwrap();
            assert!(dropout.message.contains(name), "{fault}, seed {seed}: {:#?}", report.issues);
        }
    }
}
