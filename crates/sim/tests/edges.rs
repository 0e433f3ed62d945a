//! The floor's edge: pixels may lie right at it, and who touches it is told of.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show, Stage};
use lightbots_sim::{EDGE_SLACK_M, RehearsalOptions, RehearsalReport, rehearse};

/// Two rows of robots, `off_m` off two edges of a small floor, that move on along them.
fn rows(off_m: f64) -> Show {
    let stage = Stage { width_m: 0.8, depth_m: 0.8, ..Stage::default() };
    let far_m = 0.4 - stage.limits.radius_m - off_m;
    let frame = |aside_m: f64| Frame {
        name: "rows".into(),
        air_time_s: 0.3,
        transition_s: None,
        easing: Easing::Swift,
        identity: None,
        pixels: (0..8)
            .map(|id| {
                let along_m = 0.1 * f64::from(id / 2) - 0.3 + aside_m;
                let at = if id % 2 == 0 { Vec2::new(along_m, far_m) } else { Vec2::new(along_m, -far_m) };
                Pixel { id, at, color: Rgb::new(255, 160, 0), robot: None }
            })
            .collect(),
    };
    Show {
        stage,
        identity: Identity::Fixed,
        frames: vec![frame(0.0), frame(0.25), frame(0.0)],
        ..Show::default()
    }
}

fn play(off_m: f64) -> RehearsalReport {
    rehearse(&rows(off_m), &RehearsalOptions::default(), &mut |_| {})
}

#[test]
fn who_drives_right_along_the_edge_touches_it_and_is_named_but_nothing_failed() {
    let report = play(0.0);
    assert!(report.ok && report.contacts == 0, "{:?}", report.issues);
    assert!(report.wall_contacts > 4, "{}", report.wall_contacts);
    assert!((0.0005..EDGE_SLACK_M).contains(&report.wall_pressed_m), "{}", report.wall_pressed_m);
    let told: Vec<_> = report.issues.iter().filter(|issue| issue.code == "edge-touched").collect();
    assert_eq!(told.len() as u64, report.wall_contacts.min(20));
    let message = &told[0].message;
    assert!(message.starts_with("Robot ") && message.contains("touched the floor's edge at ("), "{message}");
    assert!(told.iter().any(|issue| issue.frame == Some(1)));
}

#[test]
fn who_has_a_few_millimetres_does_not_touch_it() {
    let report = play(0.003);
    assert!(report.ok, "{:?}", report.issues);
    assert_eq!((report.wall_contacts, report.wall_pressed_m, report.contacts), (0, 0.0, 0));
}
