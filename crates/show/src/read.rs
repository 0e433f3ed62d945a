//! From a file's bytes to a show.

mod lightbots;
mod original;

use crate::error::{PixelName, ReadError, shown};
use crate::json::{Json, Scalar};
use crate::{Issue, Issues, Pixel, Show};

/// The longest file that is read, in bytes.
pub const MAX_BYTES: usize = 64 << 20;

/// The formats a show can be kept in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Ours: an object with `lightbots`, usually in a file ending in `.lightbots.json`.
    LightBots,
    /// The original's: a list of frames.
    Original,
}

/// A show that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The show.
    pub show: Show,
    /// What format it was in.
    pub format: Format,
    /// Whether the file says what stage it plays on; where not, the floor is 3 m by 3 m and may be overridden.
    pub has_stage: bool,
    /// What reading it showed, such as fields that are not known and would be lost by writing. Not what
    /// [`validate`](crate::validate) finds.
    pub issues: Issues,
}

/// Reads a show in either format; its content tells which. `ending` is that of the file's name and only makes
/// messages clearer.
///
/// # Errors
/// Where the bytes cannot be a show. What can be held in memory but must not be played is left to
/// [`validate`](crate::validate).
pub fn read(bytes: &[u8], ending: Option<&str>) -> Result<Loaded, ReadError> {
    if bytes.len() > MAX_BYTES {
        let size = bytes.len() as f64 / 1e6;
        let what =
            format!("the file has {size:.1} MB; a show has at most 67.1 MB (64 MiB): split it into several");
        return Err(ReadError::whole("too-big", what));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| not_utf8(bytes, error.valid_up_to(), ending))?;
    let mut json = Json::new(text);
    if json.is_at_end() {
        return Err(ReadError::whole("empty-file", "the file is empty; a show has at least one frame"));
    }
    let mut notes = Notes::default();
    let loaded = match json.peek()? {
        b'{' => lightbots::show(&mut json, &mut notes)?,
        b'[' => original::show(&mut json, &mut notes)?,
        _ => return Err(not_a_show(&json, ending)),
    };
    if !json.is_at_end() {
        return Err(json.unexpected("the end of the file"));
    }
    Ok(Loaded { issues: notes.issues, ..loaded })
}

fn not_utf8(bytes: &[u8], valid: usize, ending: Option<&str>) -> ReadError {
    let before = std::str::from_utf8(&bytes[..valid]).unwrap_or("");
    ReadError::at("not-utf-8", before, valid, format!("this is no UTF-8 text{}", expected(ending)))
}

fn not_a_show(json: &Json<'_>, ending: Option<&str>) -> ReadError {
    json.fail("not-json", format!("this is not JSON{}", expected(ending)))
}

fn expected(ending: Option<&str>) -> String {
    let ending = ending.map(|ending| ending.trim_start_matches('.')).unwrap_or("json");
    if ending.eq_ignore_ascii_case("json") || ending.to_ascii_lowercase().ends_with(".json") {
        return "; a show file is".into();
    }
    format!("; a .{} file is not read, open a .lightbots.json or an original .json show", shown(ending))
}

/// What reading shows, with a bound on it.
#[derive(Default)]
pub(crate) struct Notes {
    issues: Issues,
    unknown: Vec<(&'static str, String)>,
}

impl Notes {
    /// Different unknown fields that are reported.
    const MAX_UNKNOWN: usize = 20;

    /// Takes the value of a field that is not known, and says so once for each name.
    fn unknown(&mut self, json: &mut Json<'_>, level: &'static str, key: &str) -> Result<(), ReadError> {
        let known = self.unknown.iter().any(|(at, name)| *at == level && name == key);
        if !known && self.unknown.len() < Self::MAX_UNKNOWN {
            let place = json.fail("", "").place.map_or(0, |(line, _)| line);
            let what = format!(
                "line {place}: the field \"{}\" of the {level} is not known; it is ignored and lost when the show is saved",
                shown(key)
            );
            self.issues.push(Issue::warning("unknown-field", what));
            self.unknown.push((level, key.into()));
        }
        json.skip()
    }
}

/// Reads the frames' list, naming the frame in errors.
fn frames<T>(
    json: &mut Json<'_>,
    mut frame: impl FnMut(&mut Json<'_>, usize) -> Result<T, ReadError>,
) -> Result<Vec<T>, ReadError> {
    let mut frames = Vec::new();
    json.list(|json, index| {
        if index >= crate::MAX_FRAMES {
            let what = format!("more than {} frames; split the show into several", crate::MAX_FRAMES);
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

/// Reads a frame's pixels, sorted by id, naming the pixel in errors.
fn pixels(
    json: &mut Json<'_>,
    id_key: &str,
    mut pixel: impl FnMut(&mut Json<'_>) -> Result<Pixel, ReadError>,
) -> Result<Vec<Pixel>, ReadError> {
    let mut pixels = Vec::new();
    json.list(|json, index| {
        if index >= crate::MAX_PIXELS {
            let what = format!("more than {} pixels; a frame has no room for them", crate::MAX_PIXELS);
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

/// What is said of a pixel or frame that lacks something it cannot do without.
fn missing(json: &Json<'_>, what: &str) -> ReadError {
    json.fail("missing-field", format!("{what} is missing; add it"))
}
