//! Animations become the frames that robots have time for.

use std::path::Path;

use lightbots_base::{Limits, Vec2};
use lightbots_draw::animation::{self, Animation, key_moments};
use lightbots_draw::picture::PictureSettings;
use lightbots_draw::{DrawError, Made, Note, PlaceSettings, Quality, place};
use lightbots_make::{Content, Material, picture_floor, view_of};
use lightbots_show::Frame;

use super::wanted::{Wanted, asset, recipe, stage};
use crate::cli::MakeArguments;

/// Pictures that one move may leave out, at most.
const REACH: usize = 60;

/// Time that every move takes besides its way, seconds: a quarter turn and a ramp.
const MOVE_S: f64 = 0.62;

/// Whether a WebP file is an animation: its header says so in bit 1 of the flags.
pub fn moves(bytes: &[u8]) -> bool {
    bytes.get(12..16) == Some(b"VP8X") && bytes.get(20).is_some_and(|flags| flags & 2 != 0)
}

/// The frames of an animation: moments between which robots have time to move.
pub fn frames(
    path: &Path,
    bytes: &[u8],
    picture: &PictureSettings,
    arguments: &MakeArguments,
) -> Result<Vec<Wanted>, DrawError> {
    let animation = animation::read(bytes, picture)?;
    let view = view_of(&animation);
    let places = places(&animation, view, arguments)?;
    let speed_mps = Limits::default().speed_mps;
    let cost_s = |from: usize, to: usize| {
        let moves = places[from].iter().zip(&places[to]).map(|(a, b)| a.distance(*b));
        moves.fold(0.0, f64::max) / speed_mps + MOVE_S
    };
    let times_s = animation.times_s();
    let moments = key_moments(&times_s, REACH, |a, b| animation.change(a, b), cost_s)
        .ok_or_else(|| DrawError::new("animation-empty", "the animation has no pictures"))?;
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let media_type = if bytes.starts_with(b"GIF8") { "image/gif" } else { "image/webp" };
    let asset = asset(path, bytes, media_type);
    let ends_s = animation.frames.last().map_or(0.0, |frame| frame.at_s + frame.lasts_s);
    let mut wanted = Vec::new();
    for (nth, moment) in moments.moments.iter().enumerate() {
        let frame = &animation.frames[*moment];
        let next = moments.moments.get(nth + 1);
        let content = Content::Animation { picture: *picture, moment_s: frame.at_s };
        let mut source = recipe(content, arguments).source();
        source.series = Some(name.clone());
        let until_s = next.map_or(ends_s, |next| animation.frames[*next].at_s);
        let drive_s = next.map_or(0.0, |next| cost_s(*moment, *next));
        // A moment stays for what the move to the next one leaves of its time.
        let air_time_s = ((until_s - frame.at_s) * moments.slowdown - drive_s).max(0.0);
        wanted.push(Wanted {
            frame: Frame {
                name: format!("{name} {}", nth + 1),
                air_time_s: (air_time_s * 100.0).round() / 100.0,
                sources: vec![source],
                ..Frame::default()
            },
            material: Material::Drawing {
                made: Made { drawing: frame.drawing.clone(), notes: Vec::new() },
                view,
            },
            asset: Some(asset.clone()),
            start: nth > 0,
        });
    }
    let notes = notes(&animation, moments.slowdown);
    if let Some(Wanted { material: Material::Drawing { made, .. }, .. }) = wanted.first_mut() {
        made.notes = notes;
    }
    Ok(wanted)
}

fn notes(animation: &Animation, slowdown: f64) -> Vec<Note> {
    let mut notes = animation.notes.clone();
    if slowdown > 1.0 {
        let what =
            format!("the animation plays {slowdown:.1} times slower, so that robots have time to move");
        notes.push(Note::new("animation-slower", what));
    }
    notes
}

/// Places of the robots in each picture, each made from the one before it: the same number is the same robot.
fn places(
    animation: &Animation,
    view: Option<(Vec2, Vec2)>,
    arguments: &MakeArguments,
) -> Result<Vec<Vec<Vec2>>, DrawError> {
    let floor = picture_floor(&stage(arguments));
    let content = Content::Animation { picture: PictureSettings::default(), moment_s: 0.0 };
    let usual = recipe(content, arguments).place_settings(arguments.robots as usize);
    let mut all: Vec<Vec<Vec2>> = Vec::new();
    for frame in &animation.frames {
        let start = all.last().cloned().unwrap_or_default();
        let settings = PlaceSettings { view, start, quality: Quality::Quick, ..usual.clone() };
        let placed = place(&frame.drawing, &floor, &settings)?;
        all.push(placed.lights.iter().map(|light| light.at).collect());
    }
    Ok(all)
}
