//! Validation of the parts that version 2 of the file format added. All issues are warnings: a show with them can be
//! played.

use std::collections::BTreeSet;

use super::findings::Findings;
use super::limits::MAX_PIXELS;
use super::words::number;
use crate::frame_loop::examined;
use crate::{BeatGrid, CuePlace, Issue, LayerSpan, Show, excerpt, frame_label};

/// Latest moment on the timeline, seconds: one day, which is also the longest air time.
const MOST_S: f64 = 86_400.0;
/// Allowed tempo, beats per minute: from one beat every six seconds to ten a second.
const BPM: std::ops::RangeInclusive<f64> = 10.0..=600.0;

pub(super) fn check(show: &Show, findings: &mut Findings) {
    not_played(show, findings);
    let ids = frame_ids(show, findings);
    for (kind, name, id) in named_frames(show) {
        if !ids.contains(id) {
            let what = format!(
                "{kind} \"{}\" names the frame \"{}\", which is not there",
                excerpt(name),
                excerpt(id)
            );
            warn(findings, "unknown-frame", what);
        }
    }
    for issue in examined(show).1 {
        findings.add(issue);
    }
    times(show, findings);
    beats(show, findings);
    sources(show, findings);
    if show.spares as usize > MAX_PIXELS {
        warn(findings, "too-many-spares", format!("{} spare robots; at most {MAX_PIXELS}", show.spares));
    }
}

fn warn(findings: &mut Findings, code: &str, message: String) {
    findings.add(Issue::warning(code, message));
}

/// Warns about parts of the show that this version of the program keeps but does not play.
fn not_played(show: &Show, findings: &mut Findings) {
    let timed = show.cues.iter().filter(|cue| matches!(cue.at, CuePlace::Seconds(_))).count();
    let whole = show.trajectories.iter().filter(|trajectory| trajectory.frame.is_none()).count();
    for (count, one, many) in [
        (timed, "cue at a moment", "cues at moments"),
        (whole, "trajectory for the whole show", "trajectories for the whole show"),
    ] {
        if count > 0 {
            let what = if count == 1 { one } else { many };
            let message = format!("{count} {what}: kept in the show, but this version does not play it yet");
            warn(findings, "not-played-yet", message);
        }
    }
}

/// Returns the ids of all frames. Warns about each frame that has the id of an earlier frame, because layers and cues
/// could not tell the two apart.
fn frame_ids<'a>(show: &'a Show, findings: &mut Findings) -> BTreeSet<&'a str> {
    let mut ids = BTreeSet::new();
    for (index, frame) in show.frames.iter().enumerate() {
        if let Some(id) = frame.id.as_deref().filter(|id| !ids.insert(*id)) {
            let label = frame_label(index, &frame.name);
            let what = format!("{label}: an earlier frame has the id \"{}\" too; change it", excerpt(id));
            findings.add(Issue::warning("duplicate-frame-id", what).in_frame(index));
        }
    }
    ids
}

/// All references to frames: what refers, such as "the layer", its name (empty for a trajectory), and the id of the
/// frame.
fn named_frames(show: &Show) -> impl Iterator<Item = (&'static str, &str, &str)> {
    let layers = show.layers.iter().flat_map(|layer| match &layer.span {
        LayerSpan::Frames { first, last, .. } => {
            vec![("the layer", layer.name.as_str(), first.as_str()), ("the layer", &layer.name, last)]
        }
        _ => Vec::new(),
    });
    let cues = show.cues.iter().filter_map(|cue| match &cue.at {
        CuePlace::Frame(id) => Some(("the cue", cue.name.as_str(), id.as_str())),
        CuePlace::Seconds(_) => None,
    });
    let paths =
        show.trajectories.iter().filter_map(|path| Some(("a trajectory", "", path.frame.as_deref()?)));
    layers.chain(cues).chain(paths)
}

/// Warns about moments that are not on the timeline and about stretches that end before or at their start. Also warns
/// about trajectories whose times do not increase.
fn times(show: &Show, findings: &mut Findings) {
    let layers = show.layers.iter().filter_map(|layer| match layer.span {
        LayerSpan::Seconds { from_s, to_s } => Some(("layer", layer.name.as_str(), from_s, to_s)),
        _ => None,
    });
    let sections =
        show.sections.iter().map(|section| ("section", section.name.as_str(), section.from_s, section.to_s));
    for (kind, name, from_s, to_s) in layers.chain(sections) {
        if !(is_moment(from_s) && is_moment(to_s) && from_s < to_s) {
            let (from, to) = (number(from_s), number(to_s));
            let what = format!("the {kind} \"{}\" lasts from {from} to {to} s; {REMEDY}", excerpt(name));
            warn(findings, "bad-time", what);
        }
    }
    let cues = show.cues.iter().filter_map(|cue| match cue.at {
        CuePlace::Seconds(at_s) => Some(("cue", cue.name.as_str(), at_s)),
        CuePlace::Frame(_) => None,
    });
    let markers = show.markers.iter().map(|marker| ("marker", marker.name.as_str(), marker.at_s));
    let frames = show.frames.iter().filter_map(|frame| Some(("frame", frame.name.as_str(), frame.at_s?)));
    for (kind, name, at_s) in cues.chain(markers).chain(frames) {
        if !is_moment(at_s) {
            let what = format!("the {kind} \"{}\" is at {} s; {REMEDY}", excerpt(name), number(at_s));
            warn(findings, "bad-time", what);
        }
    }
    for path in &show.trajectories {
        let ends = || path.pieces.iter().map(|piece| piece.end_s);
        let is_increasing =
            std::iter::once(0.0).chain(ends()).zip(ends()).all(|(from_s, to_s)| from_s < to_s);
        if !(is_increasing && is_moment(path.at_s) && ends().all(is_moment)) {
            let what =
                format!("the times of the trajectory of pixel {} do not increase; {REMEDY}", path.pixel);
            warn(findings, "bad-time", what);
        }
    }
}

/// What to do about a moment that is not on the timeline, for messages.
const REMEDY: &str = "times go up from 0 s and stay below a day";

fn is_moment(at_s: f64) -> bool {
    (0.0..=MOST_S).contains(&at_s)
}

fn beats(show: &Show, findings: &mut Findings) {
    let Some(beats) = &show.beats else { return };
    let is_sound = match &beats.grid {
        BeatGrid::Steady { bpm, offset_s } => BPM.contains(bpm) && offset_s.abs() <= MOST_S,
        BeatGrid::Times(times) => {
            times.windows(2).all(|pair| pair[0] < pair[1]) && times.iter().all(|time| time.abs() <= MOST_S)
        }
    };
    if !is_sound || beats.per_bar == 0 {
        let (least, most) = (BPM.start(), BPM.end());
        let what = format!(
            "the beats are none: {least} to {most} a minute, or times that increase; find them again"
        );
        warn(findings, "bad-beats", what);
    }
}

/// Warns about sources whose file is missing and boxes without an area. Also warns about one pixel of each frame that
/// refers to a missing source.
fn sources(show: &Show, findings: &mut Findings) {
    for (index, frame) in show.frames.iter().enumerate() {
        let label = frame_label(index, &frame.name);
        let mut parts = frame.pixels.iter().filter_map(|pixel| Some((pixel.id, pixel.part.as_ref()?.source)));
        if let Some((id, source)) = parts.find(|(_, source)| *source as usize >= frame.sources.len()) {
            let what = format!(
                "{label}, pixel {id}: it belongs to source {}, and the frame has {}; make the frame again",
                u64::from(source) + 1,
                frame.sources.len()
            );
            findings.add(Issue::warning("unknown-source", what).in_frame(index).with_pixels([id]));
        }
        for source in &frame.sources {
            if source.asset.is_some_and(|hash| !show.assets.contains_key(&hash)) {
                let what =
                    format!("{label}: the file of a source is not among the show's assets; add it again");
                findings.add(Issue::warning("missing-asset", what).in_frame(index));
            }
            let is_box = |area: &crate::FloorBox| area.min.x < area.max.x && area.min.y < area.max.y;
            if source.floor_box.as_ref().is_some_and(|area| !is_box(area)) {
                let what = format!("{label}: the box of a source has no area; min must be less than max");
                findings.add(Issue::warning("bad-box", what).in_frame(index));
            }
        }
    }
}
