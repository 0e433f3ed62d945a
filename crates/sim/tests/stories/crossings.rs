//! Shows as the original saves them: pixel 7 is the same robot in every frame, and straight lines would collide.

use lightbots_base::random::congruential;
use lightbots_base::{Rgb, Vec2};
use lightbots_exchange::{ORIGINAL, read};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show};
use lightbots_sim::{Conditions, RehearsalOptions, rehearse};

/// A show of two frames that was written and read in the original's format, with paths between them that cross.
fn show(name: &str, from: &[Vec2], to: &[Vec2]) -> Show {
    let frame = |name: &str, places: &[Vec2]| Frame {
        name: name.into(),
        air_time_s: 0.3,
        transition_s: None,
        easing: Easing::Swift,
        pixels: (0..)
            .zip(places)
            .map(|(id, &at)| Pixel { id, at, color: Rgb::new(255, 165, 0), ..Pixel::default() })
            .collect(),
        ..Frame::default()
    };
    let there = Show { frames: vec![frame("From", from), frame("To", to)], ..Show::default() };
    let bytes = ORIGINAL.write(&there, None).bytes;
    assert_eq!(bytes[0], b'[', "a list of frames");
    let loaded = read(&bytes, None).unwrap();
    Show { name: name.into(), identity: Identity::Fixed, ..loaded.show }
}

fn crossing_pairs(show: &Show) -> usize {
    let ways: Vec<(Vec2, Vec2)> = show.frames[0]
        .pixels
        .iter()
        .map(|pixel| pixel.at)
        .zip(show.frames[1].pixels.iter().map(|pixel| pixel.at))
        .collect();
    let meet = |(a, b): (Vec2, Vec2), (c, d): (Vec2, Vec2)| {
        (0..=100).any(|step| {
            let share = f64::from(step) / 100.0;
            a.lerp(b, share).distance(c.lerp(d, share)) < 0.054
        })
    };
    (0..ways.len()).map(|i| (0..i).filter(|&j| meet(ways[i], ways[j])).count()).sum()
}

fn shows() -> Vec<Show> {
    let line = |count: i32, step_m: f64| -> Vec<Vec2> {
        (0..count).map(|i| Vec2::new((f64::from(i) - f64::from(count - 1) / 2.0) * step_m, 0.2)).collect()
    };
    let reversed = |mut places: Vec<Vec2>| {
        places.reverse();
        places
    };
    let ring: Vec<Vec2> =
        (0..20).map(|i| Vec2::unit(f64::from(i) / 20.0 * std::f64::consts::TAU) * 0.7).collect();
    let mirrored: Vec<Vec2> = ring.iter().map(|&at| -at).collect();
    let column = |x: f64| (0..8).map(move |i| Vec2::new(x, f64::from(i) * 0.1 - 0.35));
    let columns: Vec<Vec2> = column(-0.6).chain(column(0.6)).collect();
    let passed: Vec<Vec2> = column(0.6).chain(column(-0.6)).collect();
    let grid: Vec<Vec2> =
        (0..36).map(|i| Vec2::new(f64::from(i % 6), f64::from(i / 6)) * 0.16 - Vec2::new(0.4, 0.4)).collect();
    // 7 and 36 have no common divisor, so each place is used once.
    let shuffled: Vec<Vec2> = (0..36).map(|i| grid[(i * 7 + 5) % 36]).collect();
    let scattered = |seed: u64| {
        let mut state = seed;
        let mut random = || (congruential(&mut state) >> 33) as f64 / (1u64 << 31) as f64 * 2.8 - 1.4;
        let mut places: Vec<Vec2> = Vec::new();
        while places.len() < 30 {
            let at = Vec2::new(random(), random());
            if places.iter().all(|other| other.distance(at) >= 0.1) {
                places.push(at);
            }
        }
        places
    };
    vec![
        show("two change places", &line(2, 0.8), &reversed(line(2, 0.8))),
        show("a line turns round", &line(9, 0.12), &reversed(line(9, 0.12))),
        show("a ring through its centre", &ring, &mirrored),
        show("columns pass through each other", &columns, &passed),
        show("a shuffled grid", &grid, &shuffled),
        show("thirty at random", &scattered(3), &scattered(4)),
    ]
}

#[test]
fn shows_whose_straight_lines_collide_are_driven_without_contact() {
    for show in shows() {
        let name = &show.name;
        assert!(crossing_pairs(&show) > 0, "{name} must collide on straight lines");
        for seed in 1..=3 {
            plays_without_contact(&show, seed, Conditions::default());
        }
    }
}

#[test]
fn robots_that_speak_only_target_and_color_come_through_as_well() {
    for show in shows() {
        let robots = show.frames[0].pixels.len();
        for (seed, originals) in [(1, robots), (2, robots.div_ceil(2))] {
            plays_without_contact(&show, seed, Conditions { originals, ..Conditions::default() });
        }
    }
}

fn plays_without_contact(show: &Show, seed: u64, conditions: Conditions) {
    let (name, originals) = (&show.name, conditions.originals);
    let report = rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    assert!(report.ok, "{name}, {originals} originals, seed {seed}: {:?}", report.issues);
    assert_eq!((report.contacts, report.frames_played), (0, 2), "{name}, seed {seed}");
    assert!(report.closest_m.unwrap_or(1.0) >= 0.054, "{name}, seed {seed}");
}
