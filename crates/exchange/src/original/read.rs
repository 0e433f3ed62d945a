//! From a file of the original to a show. Fields that hold the state of the original's editor are skipped.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Issue, Pixel, Show, frame_label};

use super::canvas::stage_from_canvas;
use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::Json;
use crate::json::frames::{Notes, document, frames, missing, pixels};

/// How far a colour component of a file may lie outside 0 to 1. Covers the rounding of 32-bit numbers (6e-8 near 1).
/// Without this slack, files of other programs with the component 1.0000001 would be refused.
const COLOR_SLACK: f64 = 1e-6;

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let (frames, notes) =
        document(bytes, |json, notes| frames(json, |json, index| frame(json, index, notes)))?;
    let show = Show { frames, ..Show::default() };
    Ok(Loaded { show, plan: None, has_stage: false, unread: notes.unread(), issues: notes.issues })
}

fn frame(json: &mut Json<'_>, index: usize, notes: &mut Notes) -> Result<Frame, ReadError> {
    let mut name = String::new();
    let mut air_time_s = None;
    let mut found = None;
    json.object(|json, key| {
        match key {
            "name" => name = json.text("name")?.into_owned(),
            "airTime" => air_time_s = Some(json.number("airTime")?),
            "pixels" => found = Some(pixels(json, "pixelId", |json| pixel(json, notes))?),
            "selected" | "selectedPixels" => json.skip()?,
            _ => notes.unknown(json, "frame", key)?,
        }
        Ok(())
    })?;
    if air_time_s.is_none() {
        let what = format!("{} has no airTime; it is taken as 0 s", frame_label(index, &name));
        notes.issues.push(Issue::warning("missing-field", what).in_frame(index));
    }
    Ok(Frame {
        name,
        air_time_s: air_time_s.unwrap_or(0.0),
        transition_s: None,
        easing: Easing::Swift,
        pixels: found.ok_or_else(|| missing(json, "the list \"pixels\""))?,
        ..Frame::default()
    })
}

fn pixel(json: &mut Json<'_>, notes: &mut Notes) -> Result<Pixel, ReadError> {
    let (mut id, mut at, mut canvas) = (None, None, None);
    let (mut color, mut preview) = (None, None);
    json.object(|json, key| {
        match key {
            "pixelId" => id = Some(json.whole("pixelId")?),
            "physicalLocation" => at = Some(location(json, "physicalLocation")?),
            "pixelLocation" => canvas = Some(location(json, "pixelLocation")?),
            "color" => color = Some(rgb(json)?),
            "previewColor" => preview = Some(rgb(json)?),
            "pixelPreviewLocation" | "pixelTimelineLocation" => json.skip()?,
            _ => notes.unknown(json, "pixel", key)?,
        }
        Ok(())
    })?;
    Ok(Pixel {
        id: id.ok_or_else(|| missing(json, "pixelId"))?,
        at: at.or(canvas.map(stage_from_canvas)).ok_or_else(|| missing(json, "physicalLocation"))?,
        color: color.or(preview).ok_or_else(|| missing(json, "color"))?,
        ..Pixel::default()
    })
}

fn location(json: &mut Json<'_>, name: &str) -> Result<Vec2, ReadError> {
    let (mut x, mut y) = (None, None);
    json.object(|json, key| {
        match key {
            "X" => x = Some(json.number("X")?),
            "Y" => y = Some(json.number("Y")?),
            _ => json.skip()?,
        }
        Ok(())
    })?;
    match (x, y) {
        (Some(x), Some(y)) => Ok(Vec2::new(x, y)),
        _ => Err(missing(json, &format!("X or Y of {name}"))),
    }
}

fn rgb(json: &mut Json<'_>) -> Result<Rgb, ReadError> {
    let mut channels = [None; 3];
    json.object(|json, key| {
        let channel = match key {
            "R" => 0,
            "G" => 1,
            "B" => 2,
            _ => return json.skip(),
        };
        channels[channel] = Some(channel_byte(json, key)?);
        Ok(())
    })?;
    match channels {
        [Some(r), Some(g), Some(b)] => Ok(Rgb::new(r, g, b)),
        _ => Err(missing(json, "R, G or B of the colour")),
    }
}

/// Reads a colour component, which is 0 to 1 in files, as a number from 0 to 255.
fn channel_byte(json: &mut Json<'_>, name: &str) -> Result<u8, ReadError> {
    json.peek()?;
    let before = json.clone();
    let share = json.number(name)?;
    if !(-COLOR_SLACK..=1.0 + COLOR_SLACK).contains(&share) {
        let what = format!("colour component {name} is {share}; it must be from 0 to 1");
        return Err(before.fail("bad-color", what));
    }
    Ok((share * 255.0).round() as u8)
}
