//! What frames were made from.

use lightbots_show::{FloorBox, FrameSource, MAX_PIXELS, MAX_SOURCES, MAX_SOURCES_OF_SHOW, SourceKind};

use super::fields::{bounded, label, one_of, place};
use super::{assets, settings};
use crate::error::ReadError;
use crate::json::Json;
use crate::json::frames::{Notes, missing};
use crate::json::text::{exact, lines, place_text, quoted};

/// Reads the sources of a frame.
pub(super) fn read(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<FrameSource>, ReadError> {
    let sources = bounded(json, "sources of a frame", MAX_SOURCES, |json| source(json, notes))?;
    notes.sources += sources.len();
    if notes.sources > MAX_SOURCES_OF_SHOW {
        let what = format!("the show has more than {MAX_SOURCES_OF_SHOW} sources; split it");
        return Err(json.fail("too-many-items", what));
    }
    Ok(sources)
}

fn source(json: &mut Json<'_>, notes: &mut Notes) -> Result<FrameSource, ReadError> {
    let mut kind = None;
    let mut source = FrameSource::new(SourceKind::Text);
    json.object(|json, key| {
        match key {
            "kind" => kind = Some(one_of(json, key, &SourceKind::ALL.map(|kind| (kind.name(), kind)))?),
            "asset" => source.asset = Some(assets::hash(json, key)?),
            "seed" => source.seed = json.whole(key)?,
            "box" => source.floor_box = Some(floor_box(json, notes)?),
            "moved" => source.moved = moved(json)?,
            "series" => source.series = Some(label(json, key)?),
            "moment_s" => source.moment_s = Some(json.number(key)?),
            "settings" => source.settings = settings::read(json, notes)?,
            _ => notes.unknown(json, "source", key)?,
        }
        Ok(())
    })?;
    source.kind = kind.ok_or_else(|| missing(json, "the kind of the source"))?;
    Ok(source)
}

fn floor_box(json: &mut Json<'_>, notes: &mut Notes) -> Result<FloorBox, ReadError> {
    let (mut min, mut max) = (None, None);
    json.object(|json, key| {
        match key {
            "min" => min = Some(place(json, key)?),
            "max" => max = Some(place(json, key)?),
            _ => notes.unknown(json, "box", key)?,
        }
        Ok(())
    })?;
    match (min, max) {
        (Some(min), Some(max)) => Ok(FloorBox { min, max }),
        _ => Err(missing(json, "min or max of the box")),
    }
}

fn moved(json: &mut Json<'_>) -> Result<Vec<u32>, ReadError> {
    let mut ids = bounded(json, "moved pixels", MAX_PIXELS, |json| json.whole("moved"))?;
    ids.sort_unstable();
    ids.dedup();
    Ok(ids)
}

/// Writes the list of sources, one per line.
pub(super) fn text(sources: &[FrameSource]) -> String {
    lines(sources.iter().map(source_text), "      ")
}

fn source_text(source: &FrameSource) -> String {
    let mut fields = vec![format!("\"kind\": \"{}\"", source.kind.name())];
    if let Some(hash) = source.asset {
        fields.push(format!("\"asset\": \"{hash}\""));
    }
    if source.seed != 0 {
        fields.push(format!("\"seed\": {}", source.seed));
    }
    if let Some(FloorBox { min, max }) = source.floor_box {
        fields.push(format!("\"box\": {{ \"min\": {}, \"max\": {} }}", place_text(min), place_text(max)));
    }
    if !source.moved.is_empty() {
        let ids: Vec<String> = source.moved.iter().map(u32::to_string).collect();
        fields.push(format!("\"moved\": [{}]", ids.join(", ")));
    }
    if let Some(series) = &source.series {
        fields.push(format!("\"series\": {}", quoted(series)));
    }
    if let Some(moment_s) = source.moment_s {
        fields.push(format!("\"moment_s\": {}", exact(moment_s)));
    }
    if !source.settings.is_empty() {
        fields.push(format!("\"settings\": {}", settings::text(&source.settings)));
    }
    format!("{{ {} }}", fields.join(", "))
}
