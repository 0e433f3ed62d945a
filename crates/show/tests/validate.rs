//! Shows that must not be played. Each fault gives one line with place, cause and remedy.

mod rows;

use lightbots_base::Vec2;
use lightbots_show::{Pixel, Show, Stage, validate};
use rows::{row, show};

/// Codes and messages of all issues of a show, one per line.
fn messages(show: &Show) -> String {
    let lines: Vec<String> =
        validate(show).iter().map(|issue| format!("{}: {}", issue.code, issue.message)).collect();
    lines.join("\n")
}

#[test]
fn frames_of_different_sizes() {
    let found = messages(&show(vec![row(29), row(28), row(29)]));
    assert_eq!(
        found,
        "pixel-count: frame 2 \"Row\": 28 pixels, but other frames have 29; \
         add 1, every robot needs a place in every frame"
    );
    assert_eq!(messages(&show(vec![])), "no-frames: the show has no frames; add one");
    assert!(messages(&show(vec![row(2), vec![]])).contains("empty-frame: frame 2 \"Row\": it has no pixels"));
}

#[test]
fn pixels_too_close_together() {
    let mut broken = show(vec![row(5)]);
    broken.frames[0].pixels[1].at = Vec2::new(-1.4, 0.0);
    broken.frames[0].pixels[3].at = Vec2::new(-1.0 - 0.05, 0.0);
    broken.frames[0].pixels[4].at = Vec2::new(-1.0, 0.0);
    broken.frames[0].pixels[2].at = Vec2::new(-1.0 - 0.05, 0.0555);
    assert_eq!(
        messages(&broken),
        "pixels-overlap: frame 1 \"Row\", pixels 0 and 1: they are on one place; move one away\n\
         pixels-overlap: frame 1 \"Row\", pixels 3 and 4: they are 50.0 mm apart, \
         but robots touch at 54.0 mm; move one away\n\
         pixels-too-close: frame 1 \"Row\", pixels 2 and 3: they are 55.5 mm apart, \
         too close to prove that robots do not touch; leave 57.0 mm"
    );
}

#[test]
fn pixels_off_the_floor_and_ids_given_twice() {
    let mut broken = show(vec![row(3)]);
    broken.frames[0].pixels[0].at = Vec2::new(1.48, 0.0);
    broken.frames[0].pixels[2].id = 1;
    assert_eq!(
        messages(&broken),
        "duplicate-id: frame 1 \"Row\", pixel 1: 2 pixels have this id; give each its own\n\
         pixel-off-floor: frame 1 \"Row\", pixel 0: (1.480, 0.000) is off the 3 m x 3 m floor; \
         keep x within ±1.473 m and y within ±1.473 m"
    );
}

#[test]
fn times_and_stages_that_make_no_sense() {
    for air_time_s in [-1.0, f64::NAN, f64::INFINITY, 1e9] {
        let mut broken = show(vec![row(3)]);
        broken.frames[0].air_time_s = air_time_s;
        let found = messages(&broken);
        assert!(found.starts_with("bad-air-time: frame 1 \"Row\": the air time is"), "{found}");
    }
    for side_m in [0.0, -3.0, f64::NAN, 1e9] {
        let broken = Show { stage: Stage { depth_m: side_m, ..Stage::default() }, ..show(vec![row(3)]) };
        assert!(messages(&broken).starts_with("bad-stage: the stage's depth is"));
    }
    let mut broken = show(vec![row(3)]);
    broken.stage.limits.speed_mps = 0.7;
    assert!(messages(&broken).contains("its wheels make at most 0.598 m/s"));
    broken.stage.limits.radius_m = -1.0;
    assert!(messages(&broken).contains("bad-limits: the robot's radius_m is -1"));
}

#[test]
fn the_list_of_issues_is_bounded() {
    let heap = vec![Pixel { at: Vec2::ZERO, ..row(1).remove(0) }; 10_000];
    let issues = validate(&show(vec![heap; 100]));
    assert!((100..=1_001).contains(&issues.len()), "{}", issues.len());
    let more = issues.iter().find(|issue| issue.message.contains("more like this")).unwrap();
    assert!(!more.pixels.is_empty(), "{more:?}");
}
