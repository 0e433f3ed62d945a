//! Frames and pixels of JSON formats, with errors that name frame and pixel.

use lightbots_show::{Issue, Issues, MAX_FRAMES, MAX_PIXELS, Pixel, excerpt};

use super::{Json, Scalar, text};
use crate::error::{PixelName, ReadError};

/// Reads a whole file with `content`. Returns the result of `content`, and the notes that `content` made. Fails if more
/// text follows.
pub(crate) fn document<T>(
    bytes: &[u8],
    content: impl FnOnce(&mut Json<'_>, &mut Notes) -> Result<T, ReadError>,
) -> Result<(T, Notes), ReadError> {
    let again = "; this file is damaged: save or copy it again";
    let text = text(bytes).map_err(|error| ReadError { what: error.what + again, ..error })?;
    let mut json = Json::new(text);
    let mut notes = Notes::default();
    let read = content(&mut json, &mut notes)?;
    if json.is_at_end() { Ok((read, notes)) } else { Err(json.unexpected("the end of the file")) }
}

/// What a reader notes about a file: issues, unknown fields, and counts of values that are bounded per file.
#[derive(Default)]
pub(crate) struct Notes {
    pub issues: Issues,
    /// Number of settings' values that were read. A bound on all settings of a show applies to it.
    pub settings: usize,
    /// Number of frames' sources that were read. A bound on all sources of a show applies to it.
    pub sources: usize,
    /// Unknown fields that were reported: the kind of object with the field, such as "pixel", and the field's name.
    unknown: Vec<(&'static str, String)>,
    /// Whether more than `UNKNOWN_MAX` different unknown fields were found.
    has_more_unknown: bool,
    /// The file's version of the format, if the reader does not know it because it is newer.
    newer_version: Option<u32>,
}

impl Notes {
    /// Largest number of unknown fields that are reported, each once. One more issue stands for all others. Without a
    /// bound, a hostile file could fill the list of issues and the memory.
    const UNKNOWN_MAX: usize = 20;
    /// Largest number of unknown fields that [`Self::unread`] names: what fits on a line.
    const NAMED_MAX: usize = 4;

    /// Skips the value of the unknown field `key`. `level` is the kind of object that has the field, such as "pixel".
    /// Reports each field once per level, up to [`Self::UNKNOWN_MAX`].
    pub fn unknown(&mut self, json: &mut Json<'_>, level: &'static str, key: &str) -> Result<(), ReadError> {
        let known = self.unknown.iter().any(|(at, name)| *at == level && name == key);
        if !known && self.unknown.len() < Self::UNKNOWN_MAX {
            let what = format!(
                "line {}: the field \"{}\" of the {level} is not known; it is neither played nor converted",
                json.line(),
                excerpt(key)
            );
            self.issues.push(Issue::warning("unknown-field", what));
            self.unknown.push((level, key.into()));
        } else if !known && !self.has_more_unknown {
            self.has_more_unknown = true;
            let what = format!("line {}: further fields are not known; they are lost likewise", json.line());
            self.issues.push(Issue::warning("unknown-field", what));
        }
        json.skip()
    }

    /// Reports that the file has a newer version of the format.
    pub fn newer(&mut self, version: u32, newest: u32) {
        let what = format!(
            "the show has format version {version}, and this program knows up to {newest}: parts may be missing; \
             update it"
        );
        self.issues.push(Issue::warning("newer-version", what));
        self.newer_version = Some(version);
    }

    /// Why the file holds more than was read: words that follow "because". `None`: the file has no unknown fields and
    /// no newer version.
    pub fn unread(&self) -> Option<String> {
        let version = self.newer_version.map(|version| format!("it has format version {version}"));
        let name = |(level, name): &(&str, String)| format!("\"{}\" of the {level}", excerpt(name));
        let mut names: Vec<String> = self.unknown.iter().take(Self::NAMED_MAX).map(name).collect();
        if self.unknown.len() > Self::NAMED_MAX {
            names.push("more".into());
        }
        let fields = (!names.is_empty()).then(|| format!("it has unknown fields ({})", names.join(", ")));
        let reasons: Vec<String> = version.into_iter().chain(fields).collect();
        (!reasons.is_empty()).then(|| reasons.join(" and "))
    }
}

/// Reads the list of frames, at most [`MAX_FRAMES`]. `frame` reads each of them, and gets its index, counted from 0.
/// Errors name the frame.
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

/// Reads the list of pixels of a frame, at most [`MAX_PIXELS`], each with `pixel`, and sorts it by id. Errors name the
/// pixel by the value of the field `id_key`. If that is no whole number, they name it by its position in the list.
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

/// Returns the error that a required field is missing.
pub(crate) fn missing(json: &Json<'_>, what: &str) -> ReadError {
    json.fail("missing-field", format!("{what} is missing; add it"))
}
