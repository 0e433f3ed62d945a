//! Validation of one frame: times, ids, pins and places of pixels.

use std::collections::BTreeMap;

use lightbots_base::{RobotId, Vec2};

use super::findings::Findings;
use super::limits::{MAX_PIXELS, PROVABLE_GAP_M, ROUNDING_M};
use super::words::{millimetres, number, place};
use crate::{Frame, Show, Stage, close_pairs, excerpt};

/// Longest air time or transition, seconds: one day. A longer time is a mistake. The sum of `MAX_FRAMES` such times in
/// microseconds stays below 2^53, so that a double holds it exactly.
const MOST_S: f64 = 86_400.0;
/// The search for pairs of close pixels in a frame ends once it has found this number of pairs. Bounds the time if many
/// pixels are at one place.
const MOST_PAIRS: usize = 1_000;

pub(super) fn check(show: &Show, index: usize, is_stage_sound: bool, findings: &mut Findings) {
    let frame = &show.frames[index];
    times(show, index, findings);
    if frame.pixels.is_empty() {
        findings.frame(show, index, "empty-frame", "it has no pixels; add some or delete the frame");
        return;
    }
    if frame.pixels.len() > MAX_PIXELS {
        let what = format!("{} pixels; a frame has at most {MAX_PIXELS}: take some away", frame.pixels.len());
        findings.frame(show, index, "too-many-pixels", &what);
        return;
    }
    findings.pixels(show, index, "duplicate-id", duplicate_ids(frame));
    findings.pixels(show, index, "bad-robot", bad_pins(frame));
    findings.pixels(show, index, "not-a-number", places_without_number(frame));
    if is_stage_sound {
        findings.pixels(show, index, "pixel-off-floor", off_floor(frame, &show.stage));
        findings.pixels(show, index, "pixel-on-obstacle", on_obstacle(frame, &show.stage));
        close(show, index, findings);
    }
}

fn times(show: &Show, index: usize, findings: &mut Findings) {
    let frame = &show.frames[index];
    if !(0.0..=MOST_S).contains(&frame.air_time_s) {
        let what = format!("the air time is {} s; it must be 0 to {MOST_S} s", number(frame.air_time_s));
        findings.frame(show, index, "bad-air-time", &what);
    }
    let wanted_s = frame.transition_s.unwrap_or(1.0);
    if !(wanted_s > 0.0 && wanted_s <= MOST_S) {
        let what = format!(
            "the transition takes {} s; it must be more than 0 and at most {MOST_S} s",
            number(wanted_s)
        );
        findings.frame(show, index, "bad-transition-time", &what);
    }
}

fn duplicate_ids(frame: &Frame) -> Vec<(Vec<u32>, String)> {
    let mut ids: Vec<u32> = frame.pixels.iter().map(|pixel| pixel.id).collect();
    ids.sort_unstable();
    let runs = ids.chunk_by(|a, b| a == b).filter(|run| run.len() > 1);
    runs.map(|run| {
        let id = run[0];
        (vec![id], format!("pixel {id}: {} pixels have this id; give each its own", run.len()))
    })
    .collect()
}

/// Finds pixels that name an invalid robot, and robots that two pixels of the frame name. Returns ids of pixels and a
/// message for each.
fn bad_pins(frame: &Frame) -> Vec<(Vec<u32>, String)> {
    let mut found = Vec::new();
    let mut pinned = BTreeMap::new();
    for pixel in &frame.pixels {
        let Some(robot) = &pixel.robot else { continue };
        if RobotId::new(robot).is_none() {
            let what = format!(
                "pixel {}: \"{}\" is no robot's name; choose a robot again",
                pixel.id,
                excerpt(robot)
            );
            found.push((vec![pixel.id], what));
        } else if let Some(first) = pinned.insert(robot.as_str(), pixel.id) {
            let what =
                format!("pixels {first} and {}: both are for robot {robot}; free one of them", pixel.id);
            found.push((vec![first, pixel.id], what));
        }
    }
    found
}

fn places_without_number(frame: &Frame) -> Vec<(Vec<u32>, String)> {
    let broken = frame.pixels.iter().filter(|pixel| !pixel.at.is_finite());
    broken
        .map(|pixel| {
            let what = format!(
                "pixel {}: its place ({}, {}) is no place; put it on the floor",
                pixel.id, pixel.at.x, pixel.at.y
            );
            (vec![pixel.id], what)
        })
        .collect()
}

fn off_floor(frame: &Frame, stage: &Stage) -> Vec<(Vec<u32>, String)> {
    let radius_m = stage.limits.radius_m;
    let (most_x, most_y) = (stage.width_m / 2.0 - radius_m, stage.depth_m / 2.0 - radius_m);
    let is_off = |at: Vec2| at.x.abs() > most_x + ROUNDING_M || at.y.abs() > most_y + ROUNDING_M;
    let off = frame.pixels.iter().filter(|pixel| pixel.at.is_finite() && is_off(pixel.at));
    off.map(|pixel| {
        let what = format!(
            "pixel {}: ({}) is off the {} m x {} m floor; keep x within ±{most_x:.3} m and y within ±{most_y:.3} m",
            pixel.id,
            place(pixel.at),
            stage.width_m,
            stage.depth_m
        );
        (vec![pixel.id], what)
    })
    .collect()
}

fn on_obstacle(frame: &Frame, stage: &Stage) -> Vec<(Vec<u32>, String)> {
    let reach_m = stage.limits.radius_m + PROVABLE_GAP_M;
    let mut found = Vec::new();
    for pixel in frame.pixels.iter().filter(|pixel| pixel.at.is_finite()) {
        let hit = stage.obstacles.iter().position(|obstacle| obstacle.gap_m(pixel.at) < reach_m - ROUNDING_M);
        if let Some(nth) = hit {
            let what = format!(
                "pixel {}: ({}) is closer than {} to area {}; move it away",
                pixel.id,
                place(pixel.at),
                millimetres(reach_m),
                nth + 1
            );
            found.push((vec![pixel.id], what));
        }
    }
    found
}

fn close(show: &Show, index: usize, findings: &mut Findings) {
    let frame = &show.frames[index];
    let contact_m = show.stage.limits.contact_m();
    let reach_m = contact_m + PROVABLE_GAP_M;
    let places: Vec<Vec2> = frame.pixels.iter().map(|pixel| pixel.at).collect();
    let (mut overlapping, mut close) = (Vec::new(), Vec::new());
    for pair in close_pairs(&places, reach_m - ROUNDING_M, MOST_PAIRS) {
        let (a, b) = (frame.pixels[pair.first].id, frame.pixels[pair.second].id);
        let gap = millimetres(pair.gap_m);
        if pair.gap_m < 0.001 {
            overlapping
                .push((vec![a, b], format!("pixels {a} and {b}: they are on one place; move one away")));
        } else if pair.gap_m < contact_m {
            let what = format!(
                "pixels {a} and {b}: they are {gap} apart, but robots touch at {}; move one away",
                millimetres(contact_m)
            );
            overlapping.push((vec![a, b], what));
        } else {
            let what = format!(
                "pixels {a} and {b}: they are {gap} apart, too close to prove that robots do not touch; leave {}",
                millimetres(reach_m)
            );
            close.push((vec![a, b], what));
        }
    }
    findings.pixels(show, index, "pixels-overlap", overlapping);
    findings.pixels(show, index, "pixels-too-close", close);
}
