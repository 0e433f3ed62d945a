//! From a file of our format to a show.

use lightbots_base::{Limits, Rgb, Vec2};
use lightbots_show::{
    Easing, Frame, Identity, Layer, MAX_OBSTACLES, MAX_PIXELS, Obstacle, Pixel, Show, SourcePart, Stage,
    excerpt,
};

use super::fields::{label, one_of, place};
use super::{assets, motion, sources, timeline, trajectories};
use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::frames::{Notes, document, frames, missing, pixels};
use crate::json::{Json, Scalar};

/// Newest version of the format that this reader knows. The field `lightbots` of a file has its version. In files of a
/// newer version, the known fields are read.
const NEWEST: u32 = 2;

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let ((show, has_stage), notes) = document(bytes, show)?;
    Ok(Loaded { show, plan: None, has_stage, unread: notes.unread(), issues: notes.issues })
}

/// Reads one layer, written as in `layers` of a show. Unknown fields are skipped.
///
/// # Errors
/// If the bytes are not a layer: what is wrong, and where.
pub fn read_layer(bytes: &[u8]) -> Result<Layer, ReadError> {
    document(bytes, timeline::layer).map(|(layer, _)| layer)
}

/// Reads the show. Returns it, and whether the file has a stage. An error in a file of a newer version also names that
/// version, because the file may be valid in it. A file that is cut off gets no such addition.
fn show(json: &mut Json<'_>, notes: &mut Notes) -> Result<(Show, bool), ReadError> {
    let start = json.clone();
    let read = known_parts(json, notes);
    read.map_err(|error| match start.ahead("lightbots") {
        Some(Scalar::Number(version)) if version > f64::from(NEWEST) && error.code != "cut-off" => {
            let what =
                format!("{}; or update this program, the show has format version {version}", error.what);
            ReadError { what, ..error }
        }
        _ => error,
    })
}

fn known_parts(json: &mut Json<'_>, notes: &mut Notes) -> Result<(Show, bool), ReadError> {
    let mut show = Show::default();
    let (mut has_version, mut has_stage, mut has_frames) = (false, false, false);
    json.object(|json, key| {
        match key {
            "lightbots" => has_version = version(json, notes)?,
            "name" => show.name = json.text("name")?.into_owned(),
            "stage" => {
                show.stage = stage(json, notes)?;
                has_stage = true;
            }
            "identity" => show.identity = identity(json)?,
            "starts" => show.starts = Some(starts(json)?),
            "music" => show.music = Some(json.text("music")?.into_owned()),
            "spares" => show.spares = json.whole(key)?,
            "assets" => show.assets = assets::read(json, notes)?,
            "beats" => show.beats = Some(timeline::beats(json, notes)?),
            "sections" => show.sections = timeline::sections(json, notes)?,
            "markers" => show.markers = timeline::markers(json, notes)?,
            "cues" => show.cues = timeline::cues(json, notes)?,
            "layers" => show.layers = timeline::layers(json, notes)?,
            "trajectories" => show.trajectories = trajectories::read(json, notes)?,
            "frames" => {
                show.frames = frames(json, |json, _| frame(json, notes))?;
                has_frames = true;
            }
            _ => notes.unknown(json, "show", key)?,
        }
        Ok(())
    })?;
    if !has_version {
        let what = "this is JSON, but not a show: the field \"lightbots\" is missing; open another file";
        return Err(ReadError::whole("not-a-show", what));
    }
    if !has_frames {
        return Err(missing(json, "the list \"frames\""));
    }
    Ok((show, has_stage))
}

/// Reads the version, and returns `true`. A newer version than [`NEWEST`] is noted as a warning and is no error. Version
/// 0 is an error.
fn version(json: &mut Json<'_>, notes: &mut Notes) -> Result<bool, ReadError> {
    json.peek()?;
    let before = json.clone();
    match json.whole("lightbots")? {
        0 => Err(before.fail("unknown-version", "there is no format version 0; open another file")),
        version if version > NEWEST => {
            notes.newer(version, NEWEST);
            Ok(true)
        }
        _ => Ok(true),
    }
}

fn stage(json: &mut Json<'_>, notes: &mut Notes) -> Result<Stage, ReadError> {
    let mut stage = Stage::default();
    json.object(|json, key| {
        match key {
            "width_m" => stage.width_m = json.number(key)?,
            "depth_m" => stage.depth_m = json.number(key)?,
            "obstacles" => stage.obstacles = obstacles(json, notes)?,
            "robot" => stage.limits = limits(json, notes)?,
            _ => notes.unknown(json, "stage", key)?,
        }
        Ok(())
    })?;
    Ok(stage)
}

fn limits(json: &mut Json<'_>, notes: &mut Notes) -> Result<Limits, ReadError> {
    let mut limits = Limits::default();
    json.object(|json, key| {
        let limit = match key {
            "radius_m" => &mut limits.radius_m,
            "speed_mps" => &mut limits.speed_mps,
            "accel_mps2" => &mut limits.accel_mps2,
            "turn_radps" => &mut limits.turn_radps,
            "wheel_radps" => &mut limits.wheel_radps,
            "wheel_radius_m" => &mut limits.wheel_radius_m,
            "track_m" => &mut limits.track_m,
            _ => return notes.unknown(json, "robot", key),
        };
        *limit = json.number(key)?;
        Ok(())
    })?;
    Ok(limits)
}

fn obstacles(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<Obstacle>, ReadError> {
    let mut obstacles = Vec::new();
    json.list(|json, index| {
        if index >= MAX_OBSTACLES {
            return Err(
                json.fail("too-many-obstacles", format!("more than {MAX_OBSTACLES} no-go areas; join some"))
            );
        }
        obstacles.push(obstacle(json, notes)?);
        Ok(())
    })?;
    Ok(obstacles)
}

fn obstacle(json: &mut Json<'_>, notes: &mut Notes) -> Result<Obstacle, ReadError> {
    let (mut at, mut radius_m, mut min, mut max) = (None, None, None, None);
    json.object(|json, key| {
        match key {
            "at" => at = Some(place(json, key)?),
            "radius_m" => radius_m = Some(json.number(key)?),
            "min" => min = Some(place(json, key)?),
            "max" => max = Some(place(json, key)?),
            _ => notes.unknown(json, "no-go area", key)?,
        }
        Ok(())
    })?;
    match (at, radius_m, min, max) {
        (Some(at), Some(radius_m), None, None) => Ok(Obstacle::Disc { at, radius_m }),
        (None, None, Some(min), Some(max)) => Ok(Obstacle::Rect { min, max }),
        _ => Err(json
            .fail("bad-obstacle", "a no-go area has either \"at\" and \"radius_m\" or \"min\" and \"max\"")),
    }
}

fn starts(json: &mut Json<'_>) -> Result<Vec<Vec2>, ReadError> {
    let mut starts = Vec::new();
    json.list(|json, index| {
        if index >= MAX_PIXELS {
            return Err(
                json.fail("too-many-starts", format!("more than {MAX_PIXELS} starts; take some away"))
            );
        }
        starts.push(place(json, "start")?);
        Ok(())
    })?;
    Ok(starts)
}

fn frame(json: &mut Json<'_>, notes: &mut Notes) -> Result<Frame, ReadError> {
    let mut frame = Frame {
        name: String::new(),
        air_time_s: 0.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels: Vec::new(),
        ..Frame::default()
    };
    let mut has_pixels = false;
    json.object(|json, key| {
        match key {
            "name" => frame.name = json.text(key)?.into_owned(),
            "air_time_s" => frame.air_time_s = json.number(key)?,
            "transition_s" => frame.transition_s = Some(json.number(key)?),
            "easing" => {
                frame.easing = one_of(json, key, &[("swift", Easing::Swift), ("gentle", Easing::Gentle)])?
            }
            "identity" => frame.identity = Some(identity(json)?),
            "id" => frame.id = Some(label(json, key)?),
            "at_s" => frame.at_s = Some(json.number(key)?),
            "motion" => frame.motion = Some(motion::read(json, notes)?),
            "sources" => frame.sources = sources::read(json, notes)?,
            "pixels" => {
                frame.pixels = pixels(json, "id", |json| pixel(json, notes))?;
                has_pixels = true;
            }
            _ => notes.unknown(json, "frame", key)?,
        }
        Ok(())
    })?;
    if has_pixels { Ok(frame) } else { Err(missing(json, "the list \"pixels\"")) }
}

fn pixel(json: &mut Json<'_>, notes: &mut Notes) -> Result<Pixel, ReadError> {
    let (mut id, mut at, mut color, mut robot) = (None, None, None, None);
    let (mut source, mut part, mut group) = (None, None, None);
    json.object(|json, key| {
        match key {
            "id" => id = Some(json.whole(key)?),
            "place" => at = Some(place(json, key)?),
            "color" => color = Some(rgb(json)?),
            "robot" => robot = Some(json.text(key)?.into_owned()),
            "source" => source = Some(json.whole(key)?),
            "part" => part = Some(label(json, key)?),
            "group" => group = Some(label(json, key)?),
            _ => notes.unknown(json, "pixel", key)?,
        }
        Ok(())
    })?;
    Ok(Pixel {
        id: id.ok_or_else(|| missing(json, "the id"))?,
        at: at.ok_or_else(|| missing(json, "the place"))?,
        color: color.ok_or_else(|| missing(json, "the color"))?,
        robot,
        part: source_part(source, part),
        group,
    })
}

/// The part of a source to which a pixel belongs. `None` if the pixel names neither a source nor a part. If it names a
/// part only, the source is the frame's first.
fn source_part(source: Option<u32>, name: Option<String>) -> Option<SourcePart> {
    let is_from_source = source.is_some() || name.is_some();
    is_from_source.then(|| SourcePart { source: source.unwrap_or(0), name: name.unwrap_or_default() })
}

fn rgb(json: &mut Json<'_>) -> Result<Rgb, ReadError> {
    json.peek()?;
    let before = json.clone();
    let text = json.text("color")?;
    Rgb::from_hex(&text).ok_or_else(|| {
        let what = format!("\"{}\" is not a colour; write it like \"#ffa500\"", excerpt(&text));
        before.fail("bad-color", what)
    })
}

fn identity(json: &mut Json<'_>) -> Result<Identity, ReadError> {
    one_of(json, "identity", &[("any", Identity::Any), ("fixed", Identity::Fixed)])
}
