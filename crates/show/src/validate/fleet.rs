//! Validation of all frames together: numbers and ids of pixels, starting places and music.

use std::collections::BTreeMap;

use lightbots_base::Vec2;

use super::findings::Findings;
use super::limits::{MAX_FRAMES, MAX_PIXELS, PROVABLE_GAP_M, ROUNDING_M};
use super::words::{millimetres, place};
use crate::{Frame, Identity, Issue, Show, back_rows, close_pairs, robots_asked_for};

/// The search for pairs of close starting places ends once it has found this number of pairs. Bounds the list if many
/// starts are at one place.
const CLOSE_STARTS_MAX: usize = 100;

pub(super) fn check(show: &Show, is_stage_sound: bool, findings: &mut Findings) {
    if show.frames.is_empty() {
        findings.show("no-frames", "the show has no frames; add one");
        return;
    }
    if show.frames.len() > MAX_FRAMES {
        let count = show.frames.len();
        findings
            .show("too-many-frames", format!("{count} frames; a show has at most {MAX_FRAMES}: split it"));
    }
    let usual = usual_count(&show.frames);
    counts(show, usual, findings);
    same_ids(show, usual, findings);
    if is_stage_sound && usual <= MAX_PIXELS {
        starts(show, usual, usual.max(robots_asked_for(show)), findings);
    }
    if show.music.as_deref().is_some_and(|name| name.contains(['/', '\\', '\0'])) {
        let what = "the music is a path; name a file that lies beside the show";
        findings.add(Issue::warning("bad-music", what));
    }
}

/// The most frequent number of pixels of a frame. If several numbers are equally frequent, it is the one that comes
/// first in the show. 0 without frames.
fn usual_count(frames: &[Frame]) -> usize {
    let mut times: BTreeMap<usize, usize> = BTreeMap::new();
    for frame in frames {
        *times.entry(frame.pixels.len()).or_default() += 1;
    }
    let most = times.values().copied().max().unwrap_or(0);
    let usual = frames.iter().map(|frame| frame.pixels.len()).find(|count| times[count] == most);
    usual.unwrap_or(0)
}

fn counts(show: &Show, usual: usize, findings: &mut Findings) {
    for (index, frame) in show.frames.iter().enumerate() {
        let count = frame.pixels.len();
        if count != usual && count > 0 {
            let remedy = if count < usual { "add" } else { "take away" };
            let what = format!(
                "{count} pixels, but other frames have {usual}; {remedy} {}, every robot needs a place in every frame",
                count.abs_diff(usual)
            );
            findings.frame(show, index, "pixel-count", &what);
        }
    }
}

/// Checks that the frames with a fixed identity have the same ids of pixels as the first frame with `usual` pixels.
/// Frames with another number of pixels are skipped: they have an issue already.
fn same_ids(show: &Show, usual: usize, findings: &mut Findings) {
    let ids = |frame: &Frame| frame.pixels.iter().map(|pixel| pixel.id).collect::<Vec<_>>();
    let Some(model) = show.frames.iter().position(|frame| frame.pixels.len() == usual) else { return };
    let wanted = ids(&show.frames[model]);
    for (index, frame) in show.frames.iter().enumerate() {
        let is_fixed = frame.identity.unwrap_or(show.identity) == Identity::Fixed;
        if !is_fixed || frame.pixels.len() != usual {
            continue;
        }
        if let Some(odd) = ids(frame).into_iter().find(|id| wanted.binary_search(id).is_err()) {
            let what = format!(
                "pixel {odd} is not in frame {}; where identity is fixed every frame has the same ids",
                model + 1
            );
            findings.frame(show, index, "pixel-ids", &what);
        }
    }
}

/// Checks the starting places, or the rows at the back edge if the show has none. `usual` is the most frequent number
/// of pixels of a frame. `needed` is the number of robots that must have a place, including robots that pixels name.
fn starts(show: &Show, usual: usize, needed: usize, findings: &mut Findings) {
    let stage = &show.stage;
    let radius_m = stage.limits.radius_m;
    let is_off = |at: &Vec2| {
        let (most_x, most_y) = (stage.width_m / 2.0 - radius_m, stage.depth_m / 2.0 - radius_m);
        !(at.x.abs() <= most_x + ROUNDING_M && at.y.abs() <= most_y + ROUNDING_M)
    };
    let Some(starts) = &show.starts else {
        if back_rows(stage, needed).iter().any(is_off) {
            let what =
                format!("{needed} robots cannot wait on this floor; make it larger or take pixels away");
            findings.show("floor-too-small", what);
        }
        return;
    };
    if starts.len() < usual {
        let what = format!("{} starts for {usual} pixels; add {}", starts.len(), usual - starts.len());
        findings.show("too-few-starts", what);
    } else if starts.len() < needed {
        let missing = needed - starts.len();
        let what =
            format!("{} starts, but pixels ask for {needed} robots by name; add {missing}", starts.len());
        findings.show("too-few-starts", what);
    }
    if starts.len() > MAX_PIXELS {
        let what = format!("{} starts; no fleet has more than {MAX_PIXELS} robots", starts.len());
        findings.show("too-many-starts", what);
        return;
    }
    let reach_m = radius_m + PROVABLE_GAP_M - ROUNDING_M;
    for (nth, at) in starts.iter().enumerate() {
        if is_off(at) {
            findings.show(
                "start-off-floor",
                format!("start {}: ({}) is off the floor; move it in", nth + 1, place(*at)),
            );
        } else if stage.obstacles.iter().any(|obstacle| obstacle.gap_m(*at) < reach_m) {
            findings.show(
                "start-on-obstacle",
                format!("start {}: ({}) is on a no-go area; move it", nth + 1, place(*at)),
            );
        }
    }
    for pair in close_pairs(starts, stage.limits.contact_m() + PROVABLE_GAP_M - ROUNDING_M, CLOSE_STARTS_MAX)
    {
        let (a, b) = (pair.first + 1, pair.second + 1);
        let what = format!("starts {a} and {b}: they are {} apart; move one away", millimetres(pair.gap_m));
        findings.show("starts-too-close", what);
    }
}
