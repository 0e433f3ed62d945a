//! Masks of a layer's settings.

use crate::layer_settings::{LayerSettings, shown};
use lightbots_base::Vec2;
use lightbots_light::{LightMask, MaskShape};
use lightbots_show::{NamedSettings, Setting};

/// Allowed values of the setting `shape`, for people.
const SHAPES: &str = "pixels, rectangle, circle or polygon";

/// Reads the setting `masks`: a list of objects, each with a `shape`. Each wrong setting of a mask is a fault of the layer.
pub(crate) fn read(fields: &mut LayerSettings<'_>) -> Vec<LightMask> {
    let objects = fields.list("masks", "give a list of masks: [{\"shape\": \"circle\", …}, …]", object);
    let mut masks = Vec::new();
    for own in objects.unwrap_or_default() {
        let mut part = fields.part(&own);
        let mask = mask(&mut part);
        let faults = part.end();
        fields.faults.extend(faults);
        masks.extend(mask);
    }
    masks
}

fn object(item: &Setting) -> Option<NamedSettings> {
    match item {
        Setting::Object(own) => Some(own.clone()),
        _ => None,
    }
}

fn mask(part: &mut LayerSettings<'_>) -> Option<LightMask> {
    let shape = shape(part)?;
    Some(LightMask { shape, feather_m: part.number("feather_m", 0.0), inverted: part.truth("inverted") })
}

fn shape(part: &mut LayerSettings<'_>) -> Option<MaskShape> {
    let word = part.get("shape");
    match word {
        Some(Setting::Text(word)) if word == "pixels" => {
            let mut ids = part.list("pixels", "give the ids of pixels: [1, 2, …]", id)?;
            ids.sort_unstable();
            ids.dedup();
            Some(MaskShape::Selection(ids))
        }
        Some(Setting::Text(word)) if word == "rectangle" => Some(MaskShape::Rectangle {
            centre: part.place("center", Vec2::ZERO),
            half: part.place("size_m", Vec2::new(1.0, 1.0)) / 2.0,
            angle: part.number("angle", 0.0),
        }),
        Some(Setting::Text(word)) if word == "circle" => Some(MaskShape::Circle {
            centre: part.place("center", Vec2::ZERO),
            radius_m: part.number("radius_m", 0.5),
        }),
        Some(Setting::Text(word)) if word == "polygon" => Some(MaskShape::Polygon(part.points("points"))),
        other => {
            let value = other.map_or("nothing".into(), shown);
            part.fault("shape", value, format!("choose {SHAPES}"));
            None
        }
    }
}

fn id(item: &Setting) -> Option<u32> {
    match item {
        Setting::Number(number) if (0.0..=f64::from(u32::MAX)).contains(number) && number.fract() == 0.0 => {
            Some(*number as u32)
        }
        _ => None,
    }
}
