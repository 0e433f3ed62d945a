//! Frames and pixels of JSON formats, with errors that name frame and pixel.

use lightbots_show::{Issue, Issues, MAX_FRAMES, MAX_PIXELS, Pixel, excerpt};

use super::{Json, Scalar, text};
use crate::error::{PixelName, ReadError};

/// Reads a whole file with `content`, and gives the issues that were found on the way.
pub(crate) fn document<T>(
    bytes: &[u8],
    content: impl FnOnce(&mut Json<'_>, &mut Notes) -> Result<T, ReadError>,
) -> Result<(T, Issues), ReadError> {
    let again = "; this file is damaged: save or copy it again";
    let text = text(bytes).map_err(|error| ReadError { what: error.what + again, ..error })?;
    let mut json = Json::new(text);
    let mut notes = Notes::default();
    let read = content(&mut json, &mut notes)?;
    if json.is_at_end() { Ok((read, notes.issues)) } else { Err(json.unexpected("the end of the file")) }
}

/// Issues that reading finds.
#[derive(Default)]
pub(crate) struct Notes {
    pub issues: Issues,
    /// Unknown fields that were reported: level, such as "pixel", and name.
    unknown: Vec<(&'static str, String)>,
}

impl Notes {
    /// Most unknown fields that are reported, each once. Bounds list and memory for hostile files; further unknown
    /// fields are skipped without an issue.
    const UNKNOWN_MAX: usize = 20;

    /// Skips the value of an unknown field, and reports each name once for each level.
    pub fn unknown(&mut self, json: &mut Json<'_>, level: &'static str, key: &str) -> Result<(), ReadError> {
        let known = self.unknown.iter().any(|(at, name)| *at == level && name == key);
        if !known && self.unknown.len() < Self::UNKNOWN_MAX {
            let what = format!(
                "line {}: the field \"{}\" of the {level} is not known; it is ignored and lost when the show is saved",
                json.line(),
                excerpt(key)
            );
            self.issues.push(Issue::warning("unknown-field", what));
            self.unknown.push((level, key.into()));
        }
        json.skip()
    }
}

/// Reads the list of frames. Errors name the frame.
pub(crate) fn frames<T>(
    json: &mut Json<'_>,
    mut frame: impl FnMut(&mut Json<'_>, usize) -> Result<T, ReadError>,
) -> Result<Vec<T>, ReadError> {
    let mut frames = Vec::new();
    json.list(|json, index| {
        if index >= MAX_FRAMES {
            let what = format!("more than {MAX_FRAMES} frames; split the show into several");
            return Err(json.fail("too-many-frames", what));
        }
        let start = json.clone();
        frames.push(frame(json, index).map_err(|error| {
            let name = match start.ahead("name") {
                Some(Scalar::Text(name)) => name.into_owned(),
                _ => String::new(),
            };
            ReadError { frame: Some((index, name)), ..error }
        })?);
        Ok(())
    })?;
    Ok(frames)
}

/// Reads the list of pixels of a frame and sorts it by id. Errors name the pixel by the field `id_key`.
pub(crate) fn pixels(
    json: &mut Json<'_>,
    id_key: &str,
    mut pixel: impl FnMut(&mut Json<'_>) -> Result<Pixel, ReadError>,
) -> Result<Vec<Pixel>, ReadError> {
    let mut pixels = Vec::new();
    json.list(|json, index| {
        if index >= MAX_PIXELS {
            let what = format!("more than {MAX_PIXELS} pixels; take some away");
            return Err(json.fail("too-many-pixels", what));
        }
        let start = json.clone();
        pixels.push(pixel(json).map_err(|error| {
            let name = match start.ahead(id_key) {
                Some(Scalar::Number(id)) if id >= 0.0 && id.fract() == 0.0 => PixelName::Id(id as u32),
                _ => PixelName::Nth(index),
            };
            ReadError { pixel: Some(name), ..error }
        })?);
        Ok(())
    })?;
    pixels.sort_by_key(|pixel| pixel.id);
    Ok(pixels)
}

/// The error that a required field is missing.
pub(crate) fn missing(json: &Json<'_>, what: &str) -> ReadError {
    json.fail("missing-field", format!("{what} is missing; add it"))
}
