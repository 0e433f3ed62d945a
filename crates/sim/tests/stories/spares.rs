//! Spare robots wait at their starts, and one of them takes over the pixel of a robot that fails.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Identity, Pixel, Show, Stage};
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Number of pixels in each frame.
const PIXELS: u32 = 12;

/// A show with spare robots: a row, a ring and a row again.
fn show(spares: u32, identity: Identity) -> Show {
    let place = |number: usize, id: u32| {
        let share = f64::from(id) / f64::from(PIXELS);
        match number {
            1 => Vec2::unit(share * std::f64::consts::TAU) * 0.45,
            _ => Vec2::new((share - 0.5) * 1.2, if number == 0 { 0.9 } else { -0.6 }),
        }
    };
    let pixel = |number: usize, id: u32| Pixel {
        id,
        at: place(number, id),
        color: Rgb::new(255, 80, 0),
        ..Pixel::default()
    };
    let frame = |number: usize| Frame {
        id: Some(number.to_string()),
        air_time_s: 2.0,
        pixels: (0..PIXELS).map(|id| pixel(number, id)).collect(),
        ..Frame::default()
    };
    let frames = (0..3).map(frame).collect();
    Show { stage: Stage::default(), frames, spares, identity, ..Show::default() }
}

fn play(show: &Show, faults: &str, seed: u64) -> RehearsalReport {
    let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
    rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {})
}

/// Number of pixels of the last frame that a robot shows.
fn shown_last(report: &RehearsalReport) -> usize {
    report.per_frame.last().map_or(0, |frame| frame.pixels_shown)
}

/// A time at which robots stand in the frame if nothing fails, seconds.
fn stands_s(show: &Show, seed: u64, frame: usize) -> f64 {
    play(show, "loss=0%", seed).per_frame[frame].at_s + 1.0
}

#[test]
fn spare_robots_take_over_the_pixels_of_robots_that_die() {
    for identity in [Identity::Any, Identity::Fixed] {
        let show = show(2, identity);
        for seed in 1..=3 {
            let [first, second] = [0, 1].map(|frame| stands_s(&show, seed, frame));
            for faults in [
                format!("kill=3@{first:.1}s"),
                format!("kill=3@{first:.1}s,kill=7@{second:.1}s,loss=5%"),
                format!("kill=5@{second:.1}s"),
            ] {
                let report = play(&show, &faults, seed);
                let what = format!("{identity:?}, {faults}, seed {seed}: {:?}", report.issues);
                assert_eq!((report.robots, report.contacts), (14, 0), "{what}");
                assert_eq!(shown_last(&report), PIXELS as usize, "{what}");
            }
        }
    }
}

#[test]
fn without_spare_robots_their_pixels_stay_dark() {
    let report = play(&show(0, Identity::Any), "kill=3@2s", 1);
    assert_eq!((report.robots, report.contacts), (12, 0));
    assert_eq!(shown_last(&report), PIXELS as usize - 1);
}
