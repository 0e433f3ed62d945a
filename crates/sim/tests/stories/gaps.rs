//! Gaps between obstacles hardly wider than a robot, and the floor's edge. Robots drive there as planned without
//! touching anything. A robot that touches the edge anyway is reported.

#[path = "../../examples/noise/places.rs"]
mod places;

use lightbots_show::Show;
use lightbots_sim::{EDGE_SLACK_M, RehearsalOptions, RehearsalReport, rehearse};

fn play(show: &Show, seed: u64) -> RehearsalReport {
    rehearse(show, &RehearsalOptions { seed, ..RehearsalOptions::default() }, &mut |_| {})
}

#[track_caller]
fn assert_untouched(report: &RehearsalReport) {
    let RehearsalReport { seed, issues, .. } = report;
    assert!(report.ok, "seed {seed}: {issues:?}");
    assert_eq!((report.contacts, report.wall_contacts, report.dropouts), (0, 0, 0), "seed {seed}");
    assert_eq!(report.wall_pressed_m, 0.0);
}

/// A robot that left a waypoint before it had turned was once 7 mm off its line, and grazed the corners of the gap.
#[test]
fn eight_robots_pass_a_gap_half_a_millimetre_wider_than_it_must_be() {
    let report = play(&places::gap(0.0605), 1);
    assert_untouched(&report);
    assert!(report.tracking_error_m.p99 < 0.003, "{:?}", report.tracking_error_m);
}

/// Robots that wait in front of a gap must leave room for those that pass.
#[test]
fn twenty_queue_at_a_gap_without_touching_each_other() {
    for (wide_m, seed) in [(0.063, 23), (0.08, 12)] {
        assert_untouched(&play(&places::queue(20, 0.6, wide_m), seed));
    }
}

/// Both robots once touched something: one the corner of the bay, the other the floor's edge along which it was
/// planned.
#[test]
fn two_change_places_by_a_bay_without_touching_its_corners_or_the_edge() {
    for seed in 1..=6 {
        assert_untouched(&play(&places::bay(), seed));
    }
}

#[test]
fn a_robot_right_along_the_edge_touches_it_and_is_named_but_nothing_failed() {
    let report = play(&places::along_edge(0.0), 1);
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
fn a_robot_with_a_few_millimetres_does_not_touch_it() {
    assert_untouched(&play(&places::along_edge(0.003), 1));
}
