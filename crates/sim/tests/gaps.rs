//! Gaps between things on the floor hardly wider than a robot: what is planned through them from stop to stop is driven
//! without touching anything.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage};
use lightbots_sim::{RehearsalOptions, RehearsalReport, rehearse};

fn frame(places: &[Vec2]) -> Frame {
    let pixels =
        (0..).zip(places).map(|(id, &at)| Pixel { id, at, color: Rgb::new(255, 160, 0), robot: None });
    Frame {
        name: "gap".into(),
        air_time_s: 0.2,
        transition_s: None,
        easing: Easing::Swift,
        identity: None,
        pixels: pixels.collect(),
    }
}

fn rect(min: (f64, f64), max: (f64, f64)) -> Obstacle {
    Obstacle::Rect { min: Vec2::new(min.0, min.1), max: Vec2::new(max.0, max.1) }
}

fn play(show: &Show, seed: u64) -> RehearsalReport {
    let report = rehearse(show, &RehearsalOptions { seed, ..RehearsalOptions::default() }, &mut |_| {});
    assert!(report.ok, "seed {seed}: {:?}", report.issues);
    assert_eq!((report.contacts, report.wall_contacts, report.dropouts), (0, 0, 0), "seed {seed}");
    report
}

/// Who left a stop before it had turned was 7 mm off its line, and grazed the corners of the gap.
#[test]
fn eight_robots_pass_a_gap_half_a_millimetre_wider_than_it_must_be() {
    let half_m = 0.0605 / 2.0;
    let walls = vec![rect((-1.5, 0.85), (-half_m, 0.95)), rect((half_m, 0.85), (1.5, 0.95))];
    let stage = Stage { obstacles: walls, ..Stage::default() };
    let ring = |id: u32| Vec2::unit(f64::from(id) / 8.0 * std::f64::consts::TAU) * 0.5;
    let show = Show { stage, frames: vec![frame(&(0..8).map(ring).collect::<Vec<_>>())], ..Show::default() };
    let report = play(&show, 1);
    assert!(report.tracking_error_m.p99 < 0.003, "{:?}", report.tracking_error_m);
}

/// Both touched there: one the corner of the bay, the other the floor's edge along which it was planned.
#[test]
fn two_change_places_by_a_bay_without_touching_its_corners_or_the_edge() {
    let (width, wide, deep, at) = (0.0754, 0.0701, 0.1027, -0.1568);
    let half = Vec2::new(0.6, width / 2.0 + deep);
    let (top, y) = (width - half.y, width / 2.0 - half.y);
    let bay =
        vec![rect((-0.6, top), (at - wide / 2.0, half.y)), rect((at + wide / 2.0, top), (half.x, half.y))];
    let stage = Stage { width_m: 2.0 * half.x, depth_m: 2.0 * half.y, obstacles: bay, ..Stage::default() };
    let (a, b) = (Vec2::new(-0.4, y), Vec2::new(0.4, y));
    let show = Show {
        stage,
        identity: Identity::Fixed,
        starts: Some(vec![a, b]),
        frames: vec![frame(&[a, b]), frame(&[b, a])],
        ..Show::default()
    };
    for seed in 1..=6 {
        play(&show, seed);
    }
}
