//! Validation of the floor, its no-go areas and the robots' limits.

use lightbots_base::Limits;

use super::findings::Findings;
use super::limits::MAX_OBSTACLES;
use super::words::number;
use crate::{Obstacle, Stage};

/// Shortest side of a floor, metres: the width of more than three robots. A smaller floor has no room for a transition.
const LEAST_SIDE_M: f64 = 0.2;
/// Longest side of a floor, metres: room for `MAX_PIXELS` robots 1.4 m apart. Bounds the planner's grids, which grow with
/// the area of the floor.
const MOST_SIDE_M: f64 = 200.0;

/// Largest magnitude of a no-go area's coordinates, and largest radius, metres: five times the longest floor. Bounds
/// distances, so that they stay finite.
const REACH_MAX_M: f64 = 1e3;

/// Adds the issues of the stage. Returns whether the stage has none; only then can pixels be compared with it.
pub(super) fn check(stage: &Stage, findings: &mut Findings) -> bool {
    let before = findings.issues.len();
    for (name, side_m) in [("width", stage.width_m), ("depth", stage.depth_m)] {
        if !(LEAST_SIDE_M..=MOST_SIDE_M).contains(&side_m) {
            let what = format!(
                "the stage's {name} is {} m; it must be {LEAST_SIDE_M} to {MOST_SIDE_M} m",
                number(side_m)
            );
            findings.show("bad-stage", what);
        }
    }
    limits(&stage.limits, findings);
    if stage.obstacles.len() > MAX_OBSTACLES {
        let count = stage.obstacles.len();
        findings.show(
            "too-many-obstacles",
            format!("{count} no-go areas; a stage has at most {MAX_OBSTACLES}: join some"),
        );
    }
    for (nth, obstacle) in stage.obstacles.iter().take(MAX_OBSTACLES).enumerate() {
        if let Some(problem) = problem_of(obstacle) {
            findings.show("bad-obstacle", format!("area {}: {problem}", nth + 1));
        }
    }
    findings.issues.len() == before
}

fn limits(limits: &Limits, findings: &mut Findings) {
    let ranges = [
        ("radius_m", limits.radius_m, 0.005, 1.0),
        ("speed_mps", limits.speed_mps, 0.01, 10.0),
        ("accel_mps2", limits.accel_mps2, 0.01, 100.0),
        ("turn_radps", limits.turn_radps, 0.1, 100.0),
        ("wheel_radps", limits.wheel_radps, 0.1, 10_000.0),
        ("wheel_radius_m", limits.wheel_radius_m, 0.0005, 1.0),
        ("track_m", limits.track_m, 0.002, 2.0),
    ];
    let mut is_sound = true;
    for (name, value, least, most) in ranges {
        if !(least..=most).contains(&value) {
            let what = format!("the robot's {name} is {}; it must be {least} to {most}", number(value));
            findings.show("bad-limits", what);
            is_sound = false;
        }
    }
    let wheel_mps = limits.wheel_radps * limits.wheel_radius_m;
    if is_sound && limits.speed_mps > wheel_mps {
        let what = format!(
            "the robot's speed_mps is {}, but its wheels make at most {wheel_mps:.3} m/s; lower it",
            limits.speed_mps
        );
        findings.show("bad-limits", what);
    }
}

fn problem_of(obstacle: &Obstacle) -> Option<&'static str> {
    match *obstacle {
        Obstacle::Disc { at, radius_m } => {
            let is_sound = at.x.abs() <= REACH_MAX_M
                && at.y.abs() <= REACH_MAX_M
                && radius_m > 0.0
                && radius_m <= REACH_MAX_M;
            (!is_sound).then_some("its place and radius make no disc; the radius must be more than 0 m")
        }
        Obstacle::Rect { min, max } => {
            let is_sound = min.x < max.x
                && min.y < max.y
                && [min.x, min.y, max.x, max.y].iter().all(|m| m.abs() <= REACH_MAX_M);
            (!is_sound).then_some("its corners make no rectangle; min must be less than max in x and in y")
        }
    }
}
