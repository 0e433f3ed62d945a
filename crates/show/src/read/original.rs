//! The original's format: a list of frames. Only what carries meaning is read; the rest was its editor's state.

use lightbots_base::{Rgb, Vec2};

use super::{Format, Loaded, Notes, frames, missing, pixels};
use crate::error::ReadError;
use crate::json::Json;
use crate::{Easing, Frame, Issue, Pixel, Show};

/// Canvas pixels of the original's editor along each side of its floor.
const CANVAS_PX: f64 = 720.0;
/// Metres along each side of its floor.
const FLOOR_M: f64 = 3.0;

pub(super) fn show(json: &mut Json<'_>, notes: &mut Notes) -> Result<Loaded, ReadError> {
    let frames = frames(json, |json, index| frame(json, index, notes))?;
    Ok(Loaded {
        show: Show { frames, ..Show::default() },
        format: Format::Original,
        has_stage: false,
        issues: Vec::new(),
    })
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
        let what = format!("{} has no airTime; it is taken as 0 s", crate::error::frame_label(index, &name));
        notes.issues.push(Issue::warning("missing-field", what).in_frame(index));
    }
    Ok(Frame {
        name,
        air_time_s: air_time_s.unwrap_or(0.0),
        transition_s: None,
        easing: Easing::Swift,
        identity: None,
        pixels: found.ok_or_else(|| missing(json, "the list \"pixels\""))?,
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
        robot: None,
    })
}

/// Metres from canvas pixels.
fn stage_from_canvas(px: Vec2) -> Vec2 {
    let metres = FLOOR_M / CANVAS_PX;
    Vec2::new((px.x - CANVAS_PX / 2.0) * metres, (CANVAS_PX / 2.0 - px.y) * metres)
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

/// A channel stated as 0 to 1.
fn channel_byte(json: &mut Json<'_>, name: &str) -> Result<u8, ReadError> {
    json.peek()?;
    let before = json.clone();
    let share = json.number(name)?;
    if !(-1e-6..=1.000_001).contains(&share) {
        let what = format!("colour component {name} is {share}; it must be from 0 to 1");
        return Err(before.fail("bad-color", what));
    }
    Ok((share * 255.0).round() as u8)
}
