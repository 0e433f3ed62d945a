//! Poor sensors and slippery floors: noise, delay and missing fixes once broke these shows, and must not.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show};
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Faults: poor sensors on a slippery floor, and old fixes.
const HEAVY: &str = "slip=10%,gps=5mm,heading=2deg,fix-delay=100ms";
/// The faults of `HEAVY`, and fixes that are missing for a second now and then.
const WORST: &str = "slip=10%,gps=5mm,heading=2deg,fix-delay=100ms,fix-dropout=1s";
/// A show of a hundred robots. If fixes drop out, at any time some of them are unsure of their places.
const FIREWORKS: &[u8] = include_bytes!("../../../../shows/fireworks.lightbots.json");

/// A show of pairs that start and end `apart_m` apart. They turn about each other on the way, down to three quarters of
/// that distance.
fn turning_pairs(apart_m: f64) -> Show {
    let pixels = |y: f64, towards: f64| {
        let apart = Vec2::unit(towards.to_radians()) * (apart_m / 2.0);
        let pair = move |pair: i32| {
            let middle = Vec2::new(0.24 * f64::from(pair) - 1.2, y);
            [middle + apart, middle - apart]
        };
        let at = (0..11).flat_map(pair);
        at.zip(0..)
            .map(|(at, id)| Pixel { id, at, color: Rgb::new(90, 200, 255), ..Pixel::default() })
            .collect()
    };
    let frame = |name: &str, y: f64, towards: f64| Frame {
        name: name.into(),
        air_time_s: 0.2,
        transition_s: None,
        easing: Easing::Swift,
        pixels: pixels(y, towards),
        ..Frame::default()
    };
    let frames = vec![
        frame("near", -1.2, 0.0),
        frame("far", 1.0, 84.0),
        frame("near", -1.2, 0.0),
        frame("far", 1.0, 84.0),
    ];
    Show { name: "turning pairs".into(), identity: Identity::Fixed, frames, ..Show::default() }
}

fn play(show: &Show, faults: &str, seed: u64) -> RehearsalReport {
    let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
    let report = rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    let bad: Vec<&str> =
        report.issues.iter().filter(|issue| issue.is_error()).map(|issue| issue.message.as_str()).collect();
    assert!(report.ok && bad.is_empty(), "seed {seed}: {bad:?}");
    assert_eq!((report.contacts, report.dropouts), (0, 0), "seed {seed}");
    assert!(report.position_error_m.max < 0.02, "seed {seed}: {:?}", report.position_error_m);
    report
}

#[test]
fn neighbours_whose_sensors_are_poor_give_way_to_each_other() {
    // Two robots side by side once had errors of 4 mm each and touched, although both saw the other approach.
    for seed in 1..=4 {
        play(&turning_pairs(0.084), HEAVY, seed);
    }
}

#[test]
fn a_robot_without_fixes_for_a_second_waits_for_them_and_goes_on() {
    // Robots whose places were uncertain by centimetres once drove on, and touched others with seed 7. With seeds 6, 9
    // and 35 they kept the slip estimate from before all robots stood, and took their places for certain.
    for seed in [5, 6, 7, 8, 9, 35] {
        play(&turning_pairs(0.1), WORST, seed);
    }
}

#[test]
fn one_hold_after_another_is_kept_when_it_is_needed() {
    // Holds were once sent up to 2 s ahead, each for a time after the resume of the one before. Robots forgot the first
    // of them and were set back a quarter of a metre on their routes.
    let show = lightbots_exchange::read(FIREWORKS, None).unwrap().show;
    let report = play(&show, "fix-dropout=1s", 3);
    assert!(report.tracking_error_m.max < 0.03, "{:?}", report.tracking_error_m);
}
