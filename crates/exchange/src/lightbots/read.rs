//! From a file of our format to a show.

use lightbots_base::{Limits, Rgb, Vec2};
use lightbots_show::{
    Easing, Frame, Identity, MAX_OBSTACLES, MAX_PIXELS, Obstacle, Pixel, Show, Stage, excerpt,
};

use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::Json;
use crate::json::frames::{Notes, document, frames, missing, pixels};

/// Version of the format, in the field `lightbots`. A file of another version is refused, because this reader would
/// miss what it means.
pub(super) const VERSION: u32 = 1;

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let ((show, has_stage), issues) = document(bytes, show)?;
    Ok(Loaded { show, plan: None, has_stage, issues })
}

/// The show, and whether the file has a stage.
fn show(json: &mut Json<'_>, notes: &mut Notes) -> Result<(Show, bool), ReadError> {
    let mut show = Show::default();
    let (mut has_version, mut has_stage, mut has_frames) = (false, false, false);
    json.object(|json, key| {
        match key {
            "lightbots" => has_version = version(json)?,
            "name" => show.name = json.text("name")?.into_owned(),
            "stage" => {
                show.stage = stage(json, notes)?;
                has_stage = true;
            }
            "identity" => show.identity = identity(json)?,
            "starts" => show.starts = Some(starts(json)?),
            "music" => show.music = Some(json.text("music")?.into_owned()),
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

fn version(json: &mut Json<'_>) -> Result<bool, ReadError> {
    json.peek()?;
    let before = json.clone();
    let version = json.whole("lightbots")?;
    if version == VERSION {
        return Ok(true);
    }
    let what = format!("the show has format version {version}, but this program reads {VERSION}; update it");
    Err(before.fail("unknown-version", what))
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
        identity: None,
        pixels: Vec::new(),
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
    json.object(|json, key| {
        match key {
            "id" => id = Some(json.whole(key)?),
            "place" => at = Some(place(json, key)?),
            "color" => color = Some(rgb(json)?),
            "robot" => robot = Some(json.text(key)?.into_owned()),
            _ => notes.unknown(json, "pixel", key)?,
        }
        Ok(())
    })?;
    Ok(Pixel {
        id: id.ok_or_else(|| missing(json, "the id"))?,
        at: at.ok_or_else(|| missing(json, "the place"))?,
        color: color.ok_or_else(|| missing(json, "the color"))?,
        robot,
    })
}

/// `[x, y]` in stage metres.
fn place(json: &mut Json<'_>, name: &str) -> Result<Vec2, ReadError> {
    let mut at = [None; 2];
    json.list(|json, index| {
        let axis = if index == 0 { "x" } else { "y" };
        let number = json.number(&format!("{axis} of the {name}"))?;
        if let Some(slot) = at.get_mut(index) {
            *slot = Some(number);
            return Ok(());
        }
        Err(json
            .fail("bad-place", format!("the {name} has more than two numbers; give it x and y in metres")))
    })?;
    match at {
        [Some(x), Some(y)] => Ok(Vec2::new(x, y)),
        _ => {
            Err(json.fail("bad-place", format!("the {name} has too few numbers; give it x and y in metres")))
        }
    }
}

fn rgb(json: &mut Json<'_>) -> Result<Rgb, ReadError> {
    json.peek()?;
    let before = json.clone();
    let text = json.text("color")?;
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6 && !digits.starts_with('+'));
    let number = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    number.and_then(Rgb::from_number).ok_or_else(|| {
        let what = format!("\"{}\" is not a colour; write it like \"#ffa500\"", excerpt(&text));
        before.fail("bad-color", what)
    })
}

fn identity(json: &mut Json<'_>) -> Result<Identity, ReadError> {
    one_of(json, "identity", &[("any", Identity::Any), ("fixed", Identity::Fixed)])
}

/// The value of one of the words that a field may have.
fn one_of<T: Copy>(json: &mut Json<'_>, name: &str, words: &[(&str, T)]) -> Result<T, ReadError> {
    json.peek()?;
    let before = json.clone();
    let text = json.text(name)?;
    words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value).ok_or_else(|| {
        let known: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let what = format!("{name} is \"{}\"; it can be {}", excerpt(&text), known.join(" or "));
        before.fail("unknown-word", what)
    })
}
