//! The motion to a frame.

use lightbots_base::Vec2;
use lightbots_show::{MAX_MOTION_PLACES, MAX_PICTURES_BETWEEN, MAX_PIXELS, PictureMotion};

use super::fields::{bounded, one_of, place};
use crate::error::ReadError;
use crate::json::Json;
use crate::json::frames::{Notes, missing};
use crate::json::text::{exact, place_text, quoted};

/// The fields that the motions of all kinds have in files; `None` for a field that is not in the file.
#[derive(Default)]
struct Fields {
    kind: Option<usize>,
    along: Option<Vec<Vec2>>,
    through: Option<Vec<Vec<Vec2>>>,
    center: Option<Vec2>,
    turn: Option<f64>,
    size: Option<f64>,
    times: Option<u32>,
    radius_m: Option<f64>,
    length_m: Option<f64>,
    direction: Option<f64>,
    delay_s: Option<f64>,
}

/// Reads a motion. An unknown kind is an error: without its motion, the drive would be a different one.
pub(super) fn read(json: &mut Json<'_>, notes: &mut Notes) -> Result<PictureMotion, ReadError> {
    let mut fields = Fields::default();
    let kinds: Vec<(&str, usize)> = PictureMotion::NAMES.into_iter().zip(0..).collect();
    json.object(|json, key| {
        match key {
            "kind" => fields.kind = Some(one_of(json, "the kind of motion", &kinds)?),
            "along" => fields.along = Some(places(json, "places of a motion", MAX_MOTION_PLACES)?),
            "through" => {
                let picture =
                    |json: &mut Json<'_>| places(json, "places of a picture in between", MAX_PIXELS);
                fields.through = Some(bounded(json, "pictures in between", MAX_PICTURES_BETWEEN, picture)?);
            }
            "center" => fields.center = Some(place(json, key)?),
            "turn" => fields.turn = Some(json.number(key)?),
            "size" => fields.size = Some(json.number(key)?),
            "times" => fields.times = Some(json.whole(key)?),
            "radius_m" => fields.radius_m = Some(json.number(key)?),
            "length_m" => fields.length_m = Some(json.number(key)?),
            "direction" => fields.direction = Some(json.number(key)?),
            "delay_s" => fields.delay_s = Some(json.number(key)?),
            _ => notes.unknown(json, "motion", key)?,
        }
        Ok(())
    })?;
    motion(json, fields)
}

fn places(json: &mut Json<'_>, name: &str, most: usize) -> Result<Vec<Vec2>, ReadError> {
    bounded(json, name, most, |json| place(json, "place"))
}

fn motion(json: &Json<'_>, fields: Fields) -> Result<PictureMotion, ReadError> {
    let needs = |name: &str| missing(json, &format!("\"{name}\" of the motion"));
    let kind = fields.kind.ok_or_else(|| needs("kind"))?;
    let center = fields.center.unwrap_or(Vec2::ZERO);
    let times = fields.times.unwrap_or(1);
    let direction = fields.direction.unwrap_or(0.0);
    Ok(match PictureMotion::NAMES[kind] {
        "travel" => PictureMotion::Travel { along: fields.along.ok_or_else(|| needs("along"))? },
        "turn" => {
            let turn = fields.turn.ok_or_else(|| needs("turn"))?;
            PictureMotion::Turn { center, turn, size: fields.size.unwrap_or(1.0) }
        }
        "breathe" => {
            PictureMotion::Breathe { center, size: fields.size.ok_or_else(|| needs("size"))?, times }
        }
        "follow" => PictureMotion::Follow { along: fields.along.ok_or_else(|| needs("along"))? },
        "wave" => {
            let radius_m = fields.radius_m.ok_or_else(|| needs("radius_m"))?;
            let length_m = fields.length_m.ok_or_else(|| needs("length_m"))?;
            PictureMotion::Wave { radius_m, direction, length_m, times }
        }
        "stagger" => {
            PictureMotion::Stagger { direction, delay_s: fields.delay_s.ok_or_else(|| needs("delay_s"))? }
        }
        _ => PictureMotion::Morph { through: fields.through.ok_or_else(|| needs("through"))? },
    })
}

pub(super) fn text(motion: &PictureMotion) -> String {
    let mut fields = vec![format!("\"kind\": {}", quoted(motion.name()))];
    let mut add = |name: &str, value: String| fields.push(format!("\"{name}\": {value}"));
    match motion {
        PictureMotion::Travel { along } | PictureMotion::Follow { along } => add("along", places_text(along)),
        PictureMotion::Turn { center, turn, size } => {
            add("center", place_text(*center));
            add("turn", exact(*turn));
            add("size", exact(*size));
        }
        PictureMotion::Breathe { center, size, times } => {
            add("center", place_text(*center));
            add("size", exact(*size));
            add("times", times.to_string());
        }
        PictureMotion::Wave { radius_m, direction, length_m, times } => {
            add("radius_m", exact(*radius_m));
            add("direction", exact(*direction));
            add("length_m", exact(*length_m));
            add("times", times.to_string());
        }
        PictureMotion::Stagger { direction, delay_s } => {
            add("direction", exact(*direction));
            add("delay_s", exact(*delay_s));
        }
        PictureMotion::Morph { through } => {
            let pictures: Vec<String> = through.iter().map(|places| places_text(places)).collect();
            add("through", format!("[{}]", pictures.join(", ")));
        }
    }
    format!("{{ {} }}", fields.join(", "))
}

fn places_text(places: &[Vec2]) -> String {
    let places: Vec<String> = places.iter().map(|&at| place_text(at)).collect();
    format!("[{}]", places.join(", "))
}
