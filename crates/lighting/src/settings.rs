//! Turns a layer of a document into a light layer. docs/light.md has the settings of each kind.

use crate::layer_settings::{LayerSettings, colour};
use crate::masks;
use lightbots_base::Vec2;
use lightbots_light::{
    BlendMode, Coordinate, Ease, LayerFault, Layers, LightEffect, LightLayer, Linear, Look, OpacityCurve,
    Palette, PaletteStop, Wrap,
};
use lightbots_show::{Layer, Setting, excerpt, setting};

/// Names of the effects: the allowed values of the field `kind` of a layer.
pub const LAYER_KINDS: [&str; 19] = [
    "solid",
    "gradient",
    "fade",
    "pulse",
    "strobe",
    "twinkle",
    "sparkle",
    "rainbow",
    "wave",
    "chase",
    "ripple",
    "plasma",
    "noise",
    "fire",
    "picture",
    "sequence",
    "next-frame",
    "by-robot",
    "by-speed",
];

const BLENDS: [(&str, BlendMode); 12] = [
    ("normal", BlendMode::Normal),
    ("add", BlendMode::Add),
    ("subtract", BlendMode::Subtract),
    ("multiply", BlendMode::Multiply),
    ("screen", BlendMode::Screen),
    ("darken", BlendMode::Darken),
    ("lighten", BlendMode::Lighten),
    ("difference", BlendMode::Difference),
    ("average", BlendMode::Average),
    ("overlay", BlendMode::Overlay),
    ("hard-light", BlendMode::HardLight),
    ("soft-light", BlendMode::SoftLight),
];
const EASES: [(&str, Ease); 5] = [
    ("linear", Ease::Linear),
    ("smooth", Ease::Smooth),
    ("sine", Ease::Sine),
    ("in", Ease::In),
    ("out", Ease::Out),
];
const WRAPS: [(&str, Wrap); 3] = [("once", Wrap::Once), ("loop", Wrap::Loop), ("mirror", Wrap::Mirror)];
/// Allowed values of the setting `along`, which says what an effect runs along.
const ALONG: [(&str, Along); 5] = [
    ("line", Along::Line),
    ("distance", Along::Distance),
    ("angle", Along::Angle),
    ("order", Along::Order),
    ("curve", Along::Curve),
];

#[derive(Clone, Copy, Default)]
enum Along {
    #[default]
    Line,
    Distance,
    Angle,
    Order,
    Curve,
}

/// Reads a layer of a show document; `number` is its index in the show, counted from 0. Returns the light layer, and a
/// fault for each setting without meaning. `picture` returns the index of the picture whose file has the given hash.
///
/// # Errors
/// The faults of the layer, if it cannot be shown.
pub(crate) fn light_layer(
    layer: &Layer,
    number: usize,
    picture: &mut dyn FnMut(&str) -> Option<usize>,
) -> Result<(LightLayer, Vec<LayerFault>), Vec<LayerFault>> {
    let mut fields = LayerSettings::new(&layer.settings, number);
    let look = look(&mut fields);
    let Some(effect) = effect(&layer.kind, &mut fields, picture) else {
        if fields.faults.is_empty() {
            let remedy = format!("choose one of {}", LAYER_KINDS.join(", "));
            fields.fault("kind", format!("\"{}\"", excerpt(&layer.kind)), remedy);
        }
        return Err(fields.faults);
    };
    let light = LightLayer {
        blend: fields.word("blend", &BLENDS),
        opacity: opacity(&mut fields),
        masks: masks::read(&mut fields),
        runs_freely: fields.truth("runs_freely"),
        ..LightLayer::new(effect, look)
    };
    if !fields.faults.is_empty() {
        return Err(fields.faults);
    }
    let own_number = |fault: LayerFault| LayerFault { layer: Some(number), ..fault };
    let valid = Layers::new(vec![light.clone()]);
    valid.map_err(|faults| faults.into_iter().map(own_number).collect::<Vec<_>>())?;
    Ok((light, fields.end()))
}

fn look(fields: &mut LayerSettings<'_>) -> Look {
    let default = Look::default();
    Look {
        place: fields.place("place", default.place),
        angle: fields.number("angle", default.angle),
        size_m: fields.number("size_m", default.size_m),
        speed_hz: fields.number("speed_hz", default.speed_hz),
        width: fields.number("width", default.width),
        palette: palette(fields),
        ease: fields.word("ease", &EASES),
        wrap: fields.word("wrap", &WRAPS),
        seed: fields.whole("seed", default.seed),
    }
}

/// Reads the palette: colours at equal distances, or stops, each with position, colour and perhaps opacity.
fn palette(fields: &mut LayerSettings<'_>) -> Palette {
    let remedy = "give colours: [\"#ff0000\", …], or stops: [{\"at\": 0, \"color\": \"#ff0000\"}, …]";
    let is_plain = |items: &[Setting]| items.iter().all(|item| matches!(item, Setting::Text(_)));
    match fields.get("palette") {
        None => Palette::default(),
        Some(Setting::List(items)) if is_plain(items) => {
            let colours = fields.list("palette", remedy, colour).unwrap_or_default();
            Palette::even(&colours)
        }
        Some(_) => Palette { stops: fields.list("palette", remedy, stop).unwrap_or_default() },
    }
}

fn stop(item: &Setting) -> Option<PaletteStop> {
    let Setting::Object(own) = item else { return None };
    let share = |name: &str, default: Option<f64>| match setting(own, name) {
        None => default,
        Some(Setting::Number(number)) => Some(*number),
        Some(_) => None,
    };
    Some(PaletteStop {
        at: share("at", None)?,
        colour: Linear::from_rgb(setting(own, "color").and_then(colour)?),
        opacity: share("opacity", Some(1.0))?,
    })
}

/// Reads the opacity: one number, or points `[seconds, opacity]`.
fn opacity(fields: &mut LayerSettings<'_>) -> OpacityCurve {
    match fields.get("opacity") {
        None => OpacityCurve::default(),
        Some(Setting::Number(opacity)) => OpacityCurve::constant(*opacity),
        Some(_) => {
            let pair = |item: &Setting| crate::layer_settings::point(item).map(|Vec2 { x, y }| (x, y));
            let remedy = "give a number from 0 to 1, or points: [[seconds, opacity], …]";
            OpacityCurve { points: fields.list("opacity", remedy, pair).unwrap_or_default() }
        }
    }
}

/// Reads the effect. Returns `None` if `kind` is unknown, and `None` with a fault if the picture of the effect is missing.
fn effect(
    kind: &str,
    fields: &mut LayerSettings<'_>,
    picture: &mut dyn FnMut(&str) -> Option<usize>,
) -> Option<LightEffect> {
    Some(match kind {
        "solid" => LightEffect::Solid,
        "gradient" => LightEffect::Gradient(along(fields)),
        "fade" => LightEffect::Fade,
        "pulse" => LightEffect::Pulse,
        "strobe" => LightEffect::Strobe,
        "twinkle" => LightEffect::Twinkle { density: fields.number("density", 0.5) },
        "sparkle" => LightEffect::Sparkle { density: fields.number("density", 0.1) },
        "rainbow" => {
            LightEffect::Rainbow { along: along(fields), saturation: fields.number("saturation", 1.0) }
        }
        "wave" => LightEffect::Wave(along(fields)),
        "chase" => LightEffect::Chase(along(fields)),
        "ripple" => LightEffect::Ripple,
        "plasma" => LightEffect::Plasma,
        "noise" => {
            LightEffect::Noise { octaves: u32::try_from(fields.whole("octaves", 3)).unwrap_or(u32::MAX) }
        }
        "fire" => LightEffect::Fire,
        "picture" => return picture_number(fields, picture).map(LightEffect::Picture),
        "sequence" => {
            let (step_s, start_s) = (fields.number("step_s", 0.04), fields.number("start_s", 0.0));
            let picture = picture_number(fields, picture)?;
            LightEffect::Sequence { picture, step_s, start_s }
        }
        "next-frame" => LightEffect::NextFrame,
        "by-robot" => LightEffect::ByRobot,
        // An Elisa-3 drives 0.27 m/s at most.
        "by-speed" => LightEffect::BySpeed { top_mps: fields.number("top_mps", 0.27) },
        _ => return None,
    })
}

/// Returns the index of the picture that the setting `picture` names by its hash. Returns `None` and adds a fault if there
/// is no such picture.
fn picture_number(
    fields: &mut LayerSettings<'_>,
    picture: &mut dyn FnMut(&str) -> Option<usize>,
) -> Option<usize> {
    let hash = match fields.get("picture") {
        Some(Setting::Text(hash)) => hash.as_str(),
        _ => "",
    };
    let number = picture(hash);
    if number.is_none() {
        let remedy = "add the picture to the show, and give the hash of its file";
        fields.fault("picture", format!("\"{}\"", excerpt(hash)), remedy);
    }
    number
}

fn along(fields: &mut LayerSettings<'_>) -> Coordinate {
    match fields.word("along", &ALONG) {
        Along::Line => Coordinate::Line,
        Along::Distance => Coordinate::Distance,
        Along::Angle => Coordinate::Angle,
        Along::Order => Coordinate::Order,
        Along::Curve => Coordinate::Curve(fields.points("curve")),
    }
}
