//! Layers, sections, markers, cues and beats.

use lightbots_show::{
    BeatGrid, Beats, Cue, CuePlace, FramePhase, Layer, LayerSpan, MAX_BEATS, MAX_LAYERS, MAX_MARKS, Marker,
    Section,
};

use super::fields::{bounded, label, one_of};
use super::settings;
use crate::error::ReadError;
use crate::json::Json;
use crate::json::frames::{Notes, missing};
use crate::json::text::{exact, quoted};

/// Words for the parts of a frame's time.
const PHASES: [(&str, FramePhase); 3] =
    [("whole", FramePhase::Whole), ("transition", FramePhase::Transition), ("picture", FramePhase::Picture)];

pub(super) fn layers(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<Layer>, ReadError> {
    bounded(json, "layers", MAX_LAYERS, |json| layer(json, notes))
}

pub(super) fn layer(json: &mut Json<'_>, notes: &mut Notes) -> Result<Layer, ReadError> {
    let (mut name, mut kind, mut settings) = (String::new(), None, Vec::new());
    let (mut frames, mut phase, mut from_s, mut to_s) = (None, None, None, None);
    json.object(|json, key| {
        match key {
            "name" => name = label(json, key)?,
            "kind" => kind = Some(label(json, key)?),
            "frames" => frames = Some(bounded(json, "frames", 2, |json| label(json, "a frame's id"))?),
            "phase" => phase = Some(one_of(json, key, &PHASES)?),
            "from_s" => from_s = Some(json.number(key)?),
            "to_s" => to_s = Some(json.number(key)?),
            "settings" => settings = settings::read(json, notes)?,
            _ => notes.unknown(json, "layer", key)?,
        }
        Ok(())
    })?;
    let kind = kind.ok_or_else(|| missing(json, "the kind of the layer"))?;
    let phase_or_whole = phase.unwrap_or_default();
    let span = match (frames.as_deref(), from_s, to_s, phase) {
        (None, None, None, None) => LayerSpan::Show,
        (Some([first, last]), None, None, _) => {
            LayerSpan::Frames { first: first.clone(), last: last.clone(), phase: phase_or_whole }
        }
        (None, Some(from_s), Some(to_s), None) => LayerSpan::Seconds { from_s, to_s },
        _ => {
            let what = "a layer has \"frames\": [first, last], or \"from_s\" and \"to_s\", or none of them";
            return Err(json.fail("bad-span", what));
        }
    };
    Ok(Layer { name, kind, span, settings })
}

pub(super) fn sections(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<Section>, ReadError> {
    bounded(json, "sections", MAX_MARKS, |json| {
        let (mut name, mut from_s, mut to_s) = (String::new(), None, None);
        json.object(|json, key| {
            match key {
                "name" => name = label(json, key)?,
                "from_s" => from_s = Some(json.number(key)?),
                "to_s" => to_s = Some(json.number(key)?),
                _ => notes.unknown(json, "section", key)?,
            }
            Ok(())
        })?;
        let (Some(from_s), Some(to_s)) = (from_s, to_s) else {
            return Err(missing(json, "from_s or to_s of the section"));
        };
        Ok(Section { name, from_s, to_s })
    })
}

pub(super) fn markers(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<Marker>, ReadError> {
    bounded(json, "markers", MAX_MARKS, |json| {
        let (mut name, mut at_s) = (String::new(), None);
        json.object(|json, key| {
            match key {
                "name" => name = label(json, key)?,
                "at_s" => at_s = Some(json.number(key)?),
                _ => notes.unknown(json, "marker", key)?,
            }
            Ok(())
        })?;
        Ok(Marker { name, at_s: at_s.ok_or_else(|| missing(json, "at_s of the marker"))? })
    })
}

pub(super) fn cues(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<Cue>, ReadError> {
    bounded(json, "cues", MAX_MARKS, |json| {
        let (mut name, mut frame, mut at_s, mut loop_from) = (String::new(), None, None, None);
        json.object(|json, key| {
            match key {
                "name" => name = label(json, key)?,
                "frame" => frame = Some(label(json, key)?),
                "at_s" => at_s = Some(json.number(key)?),
                "loop_from" => loop_from = Some(label(json, key)?),
                _ => notes.unknown(json, "cue", key)?,
            }
            Ok(())
        })?;
        let at = match (frame, at_s) {
            (Some(frame), None) => CuePlace::Frame(frame),
            (None, Some(at_s)) => CuePlace::Seconds(at_s),
            _ => return Err(json.fail("bad-cue", "a cue has either \"frame\" or \"at_s\"")),
        };
        Ok(Cue { name, at, loop_from })
    })
}

pub(super) fn beats(json: &mut Json<'_>, notes: &mut Notes) -> Result<Beats, ReadError> {
    let (mut bpm, mut offset_s, mut times, mut per_bar) = (None, None, None, 4);
    json.object(|json, key| {
        match key {
            "bpm" => bpm = Some(json.number(key)?),
            "offset_s" => offset_s = Some(json.number(key)?),
            "times_s" => times = Some(bounded(json, "beats", MAX_BEATS, |json| json.number("a beat"))?),
            "per_bar" => per_bar = json.whole(key)?,
            _ => notes.unknown(json, "beats", key)?,
        }
        Ok(())
    })?;
    let grid = match (bpm, offset_s, times) {
        (Some(bpm), offset_s, None) => BeatGrid::Steady { bpm, offset_s: offset_s.unwrap_or(0.0) },
        (None, None, Some(times)) => BeatGrid::Times(times),
        _ => {
            let what = "beats have either \"bpm\" and \"offset_s\" or \"times_s\"";
            return Err(json.fail("bad-beats", what));
        }
    };
    Ok(Beats { grid, per_bar })
}

pub(super) fn layer_text(layer: &Layer) -> String {
    let mut fields = vec![named(&layer.name), format!("\"kind\": {}", quoted(&layer.kind))];
    match &layer.span {
        LayerSpan::Show => {}
        LayerSpan::Frames { first, last, phase } => {
            fields.push(format!("\"frames\": [{}, {}]", quoted(first), quoted(last)));
            if let Some((word, _)) = PHASES.iter().skip(1).find(|(_, value)| value == phase) {
                fields.push(format!("\"phase\": \"{word}\""));
            }
        }
        LayerSpan::Seconds { from_s, to_s } => fields.push(stretch(*from_s, *to_s)),
    }
    if !layer.settings.is_empty() {
        fields.push(format!("\"settings\": {}", settings::text(&layer.settings)));
    }
    object(fields)
}

pub(super) fn section_text(section: &Section) -> String {
    object(vec![named(&section.name), stretch(section.from_s, section.to_s)])
}

pub(super) fn marker_text(marker: &Marker) -> String {
    object(vec![named(&marker.name), format!("\"at_s\": {}", exact(marker.at_s))])
}

pub(super) fn cue_text(cue: &Cue) -> String {
    let at = match &cue.at {
        CuePlace::Frame(id) => format!("\"frame\": {}", quoted(id)),
        CuePlace::Seconds(at_s) => format!("\"at_s\": {}", exact(*at_s)),
    };
    let loop_from = cue.loop_from.as_ref().map(|from| format!("\"loop_from\": {}", quoted(from)));
    object([named(&cue.name), at].into_iter().chain(loop_from).collect())
}

pub(super) fn beats_text(beats: &Beats) -> String {
    let grid = match &beats.grid {
        BeatGrid::Steady { bpm, offset_s } => {
            format!("\"bpm\": {}, \"offset_s\": {}", exact(*bpm), exact(*offset_s))
        }
        BeatGrid::Times(times) => {
            let times: Vec<String> = times.iter().map(|time| exact(*time)).collect();
            format!("\"times_s\": [{}]", times.join(", "))
        }
    };
    object(vec![grid, format!("\"per_bar\": {}", beats.per_bar)])
}

/// The field `name` as JSON; an empty text for an empty name.
fn named(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("\"name\": {}", quoted(name)) }
}

fn stretch(from_s: f64, to_s: f64) -> String {
    format!("\"from_s\": {}, \"to_s\": {}", exact(from_s), exact(to_s))
}

/// A JSON object on one line. Empty texts in `fields` are left out.
fn object(fields: Vec<String>) -> String {
    let fields: Vec<String> = fields.into_iter().filter(|field| !field.is_empty()).collect();
    format!("{{ {} }}", fields.join(", "))
}
