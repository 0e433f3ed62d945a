//! From a show to a file of our format: one field per line, one pixel per line. Most fields with default values are
//! left out. A show without parts of version 2 is written as version 1, so that older programs read it. The stage is
//! always there, because places of pixels mean nothing without their floor.

use std::fmt::Write;

use lightbots_base::{Limits, Vec2};
use lightbots_plan::ShowPlan;
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage};

use super::{assets, motion, sources, timeline, trajectories};
use crate::format::Written;
use crate::json::text::{exact, lines, number, quoted};
use crate::part::is_version_2;

pub(crate) fn encode(show: &Show, _: Option<&ShowPlan>) -> Written {
    Written { bytes: text(show).into_bytes(), issues: Vec::new() }
}

fn text(show: &Show) -> String {
    let version = if is_version_2(show) { 2 } else { 1 };
    let mut fields = vec![format!("\"lightbots\": {version}")];
    if !show.name.is_empty() {
        fields.push(format!("\"name\": {}", quoted(&show.name)));
    }
    fields.push(format!("\"stage\": {}", stage(&show.stage)));
    if show.identity != Identity::default() {
        fields.push(format!("\"identity\": {}", identity(show.identity)));
    }
    if let Some(starts) = &show.starts {
        fields.push(format!("\"starts\": {}", lines(starts.iter().map(place), "  ")));
    }
    if let Some(music) = &show.music {
        fields.push(format!("\"music\": {}", quoted(music)));
    }
    fields.extend(extras(show));
    fields.push(format!("\"frames\": {}", lines(show.frames.iter().map(frame), "  ")));
    format!("{{\n  {}\n}}\n", fields.join(",\n  "))
}

/// The fields at the top of a show file that version 2 of the format added, without those with default values.
fn extras(show: &Show) -> Vec<String> {
    let mut fields = Vec::new();
    if show.spares > 0 {
        fields.push(format!("\"spares\": {}", show.spares));
    }
    if !show.assets.is_empty() {
        fields.push(format!("\"assets\": {}", assets::text(&show.assets)));
    }
    if let Some(beats) = &show.beats {
        fields.push(format!("\"beats\": {}", timeline::beats_text(beats)));
    }
    fields.extend(list("sections", &show.sections, timeline::section_text));
    fields.extend(list("markers", &show.markers, timeline::marker_text));
    fields.extend(list("cues", &show.cues, timeline::cue_text));
    fields.extend(list("layers", &show.layers, timeline::layer_text));
    fields.extend(list("trajectories", &show.trajectories, trajectories::text));
    fields
}

/// The JSON field `name` with a list, one item per line; `None` for an empty list.
fn list<T>(name: &str, items: &[T], text: impl Fn(&T) -> String) -> Option<String> {
    (!items.is_empty()).then(|| format!("\"{name}\": {}", lines(items.iter().map(text), "  ")))
}

fn stage(stage: &Stage) -> String {
    let mut fields = vec![
        format!("\"width_m\": {}", number(stage.width_m)),
        format!("\"depth_m\": {}", number(stage.depth_m)),
    ];
    if !stage.obstacles.is_empty() {
        fields.push(format!("\"obstacles\": {}", lines(stage.obstacles.iter().map(obstacle), "    ")));
    }
    if stage.limits != Limits::default() {
        fields.push(format!("\"robot\": {{ {} }}", limits(&stage.limits)));
    }
    format!("{{\n    {}\n  }}", fields.join(",\n    "))
}

fn obstacle(obstacle: &Obstacle) -> String {
    match obstacle {
        Obstacle::Disc { at, radius_m } => {
            format!("{{ \"at\": {}, \"radius_m\": {} }}", place(at), number(*radius_m))
        }
        Obstacle::Rect { min, max } => format!("{{ \"min\": {}, \"max\": {} }}", place(min), place(max)),
    }
}

/// The limits of robots that differ from the default and are finite, with all digits. Rounding to four decimals would
/// change a wheel radius of 0.00451 m.
fn limits(limits: &Limits) -> String {
    let usual = Limits::default();
    let all = [
        ("radius_m", limits.radius_m, usual.radius_m),
        ("speed_mps", limits.speed_mps, usual.speed_mps),
        ("accel_mps2", limits.accel_mps2, usual.accel_mps2),
        ("turn_radps", limits.turn_radps, usual.turn_radps),
        ("wheel_radps", limits.wheel_radps, usual.wheel_radps),
        ("wheel_radius_m", limits.wheel_radius_m, usual.wheel_radius_m),
        ("track_m", limits.track_m, usual.track_m),
    ];
    let changed = all.into_iter().filter(|(_, value, usual)| value != usual && value.is_finite());
    changed.map(|(name, value, _)| format!("\"{name}\": {value}")).collect::<Vec<_>>().join(", ")
}

fn frame(frame: &Frame) -> String {
    let mut fields = Vec::new();
    if !frame.name.is_empty() {
        fields.push(format!("\"name\": {}", quoted(&frame.name)));
    }
    if let Some(id) = &frame.id {
        fields.push(format!("\"id\": {}", quoted(id)));
    }
    fields.push(format!("\"air_time_s\": {}", number(frame.air_time_s)));
    if let Some(at_s) = frame.at_s {
        fields.push(format!("\"at_s\": {}", exact(at_s)));
    }
    if let Some(seconds) = frame.transition_s {
        fields.push(format!("\"transition_s\": {}", number(seconds)));
    }
    if frame.easing == Easing::Gentle {
        fields.push("\"easing\": \"gentle\"".into());
    }
    if let Some(motion) = &frame.motion {
        fields.push(format!("\"motion\": {}", motion::text(motion)));
    }
    if let Some(bound) = frame.identity {
        fields.push(format!("\"identity\": {}", identity(bound)));
    }
    if !frame.sources.is_empty() {
        fields.push(format!("\"sources\": {}", sources::text(&frame.sources)));
    }
    fields.push(format!("\"pixels\": {}", lines(frame.pixels.iter().map(pixel), "      ")));
    format!("{{\n      {}\n    }}", fields.join(",\n      "))
}

fn pixel(pixel: &Pixel) -> String {
    let mut line =
        format!("{{ \"id\": {}, \"place\": {}, \"color\": \"{}\"", pixel.id, place(&pixel.at), pixel.color);
    if let Some(robot) = &pixel.robot {
        // Writing to a text cannot fail.
        let _ = write!(line, ", \"robot\": {}", quoted(robot));
    }
    if let Some(part) = &pixel.part {
        // The index of the first source is left out if the part has a name.
        if part.source != 0 || part.name.is_empty() {
            let _ = write!(line, ", \"source\": {}", part.source);
        }
        if !part.name.is_empty() {
            let _ = write!(line, ", \"part\": {}", quoted(&part.name));
        }
    }
    if let Some(group) = &pixel.group {
        let _ = write!(line, ", \"group\": {}", quoted(group));
    }
    line + " }"
}

fn place(at: &Vec2) -> String {
    format!("[{}, {}]", number(at.x), number(at.y))
}

fn identity(identity: Identity) -> &'static str {
    match identity {
        Identity::Any => "\"any\"",
        Identity::Fixed => "\"fixed\"",
    }
}
