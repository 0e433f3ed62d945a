//! Turns animations into frames between which robots have time to move.

use lightbots_base::{Limits, Vec2};
use lightbots_draw::animation::{self, Animation, key_moments};
use lightbots_draw::{DrawError, Made, Note, PictureFloor, PlaceSettings, Quality, place};
use lightbots_show::Frame;

use crate::material::{Material, view_of};
use crate::recipe::{Content, Recipe, style_of};

/// Largest distance between successive key frames, in pictures of the animation. A larger value gives more choice and
/// takes longer.
const REACH: usize = 60;

/// Time that a drive takes in addition to its length divided by the top speed, seconds: for a quarter turn and a ramp.
const MOVE_S: f64 = 0.62;

/// The frames made of an animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// The frames in order of time; at least one.
    pub frames: Vec<FilmFrame>,
    /// Factor by which the animation is slowed down to give robots time to drive; 1: it is not slowed down.
    pub slowdown: f64,
    /// Notes about what is missing from the film, or differs from the animation.
    pub notes: Vec<Note>,
}

/// A frame of a film. Its pixels are not made yet.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmFrame {
    /// The frame with its name, its air time and its source. The source has the moment of the animation, but no file.
    pub frame: Frame,
    /// The picture of the animation at that moment.
    pub material: Material,
}

/// Chooses frames from the pictures of an animation, far enough apart in time for robots to drive from one to the next.
/// If even that is not enough time, the animation is slowed down. `name` is the name of the series and the beginning of
/// the frames' names. `recipe` has the animation as its content; its moment is not used. `bytes` are those of the
/// animation's file.
///
/// # Errors
/// If the recipe is not one of an animation, the file cannot be read, or a picture has no room for `robots` robots.
pub fn film(
    name: &str,
    bytes: &[u8],
    recipe: &Recipe,
    floor: &PictureFloor,
    robots: usize,
) -> Result<Film, DrawError> {
    let Content::Animation { picture, .. } = recipe.content else {
        return Err(DrawError::new("animation-single", "only an animation becomes a film"));
    };
    let mut recipe = recipe.clone();
    recipe.placing.style = style_of(recipe.placing.style, &recipe.content);
    let animation = animation::read(bytes, &picture)?;
    let view = view_of(&animation);
    let places = places(&animation, &recipe.place_settings(robots), view, floor)?;
    let cost_s = |from: usize, to: usize| {
        let moves = places[from].iter().zip(&places[to]).map(|(a, b)| a.distance(*b));
        moves.fold(0.0, f64::max) / Limits::default().speed_mps + MOVE_S
    };
    let keys = key_moments(&animation.times_s(), REACH, |a, b| animation.change(a, b), cost_s)
        .ok_or_else(|| DrawError::new("animation-empty", "the animation has no pictures"))?;
    let mut frames = Vec::new();
    for (nth, moment) in keys.moments.iter().enumerate() {
        let next = keys.moments.get(nth + 1);
        let drive_s = next.map_or(0.0, |next| cost_s(*moment, *next));
        let lasts_s = (end_s(&animation, next) - animation.frames[*moment].at_s) * keys.slowdown;
        let content = Content::Animation { picture, moment_s: animation.frames[*moment].at_s };
        let mut source = Recipe { content, ..recipe.clone() }.source();
        source.series = Some(name.to_owned());
        let made = Made { drawing: animation.frames[*moment].drawing.clone(), notes: Vec::new() };
        frames.push(FilmFrame {
            frame: Frame {
                name: format!("{name} {}", nth + 1),
                // A frame stays until the next key frame is due, minus the time of the drive there.
                air_time_s: ((lasts_s - drive_s).max(0.0) * 100.0).round() / 100.0,
                sources: vec![source],
                ..Frame::default()
            },
            material: Material::Drawing { made, view },
        });
    }
    let notes = notes(animation.notes, keys.slowdown);
    Ok(Film { frames, slowdown: keys.slowdown, notes })
}

/// Returns when a key frame ends, seconds from the start of the animation. `next` is the index of the next key frame's
/// picture, at which it ends; `None`: the key frame ends with the animation.
fn end_s(animation: &Animation, next: Option<&usize>) -> f64 {
    let end_s = animation.frames.last().map_or(0.0, |frame| frame.at_s + frame.lasts_s);
    next.map_or(end_s, |next| animation.frames[*next].at_s)
}

fn notes(mut notes: Vec<Note>, slowdown: f64) -> Vec<Note> {
    if slowdown > 1.0 {
        let what =
            format!("the animation plays {slowdown:.1} times slower, so that robots have time to move");
        notes.push(Note::new("animation-slower", what));
    }
    notes
}

/// Returns `[picture][robot]`: the place of each robot in each picture of the animation, stage metres. The search for
/// the places of a picture begins with those of the previous picture.
fn places(
    animation: &Animation,
    usual: &PlaceSettings,
    view: Option<(Vec2, Vec2)>,
    floor: &PictureFloor,
) -> Result<Vec<Vec<Vec2>>, DrawError> {
    let mut all: Vec<Vec<Vec2>> = Vec::new();
    for frame in &animation.frames {
        let start = all.last().cloned().unwrap_or_default();
        let settings = PlaceSettings { view, start, quality: Quality::Quick, ..usual.clone() };
        let placed = place(&frame.drawing, floor, &settings)?;
        all.push(placed.lights.iter().map(|light| light.at).collect());
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use gif::{Encoder, Frame as Still};
    use lightbots_draw::picture::PictureSettings;

    use super::*;
    use lightbots_draw::Style;

    /// A GIF of a white square that moves to the right on black. Each of its four pictures lasts `delay` hundredths of
    /// a second.
    fn gif(delay: u16) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, 40, 40, &[0, 0, 0, 255, 255, 255]).unwrap();
        for left in [0, 10, 20, 30] {
            let lit = |n: u16| (left..left + 10).contains(&(n % 40)) && (10..30).contains(&(n / 40));
            let buffer: Vec<u8> = (0..1600).map(|n| u8::from(lit(n))).collect();
            let still = Still { width: 40, height: 40, delay, buffer: buffer.into(), ..Still::default() };
            encoder.write_frame(&still).unwrap();
        }
        drop(encoder);
        bytes
    }

    fn made(bytes: &[u8]) -> Result<Film, DrawError> {
        let content = Content::Animation { picture: PictureSettings::default(), moment_s: 0.0 };
        film("walk", bytes, &Recipe::new(content), &PictureFloor::new(3.0, 3.0, 0.05), 12)
    }

    #[test]
    fn an_animation_becomes_frames_with_moments_and_time_to_move() {
        let slow = made(&gif(300)).unwrap();
        assert!(slow.frames.len() > 1 && slow.slowdown == 1.0, "{slow:?}");
        let moments: Vec<f64> =
            slow.frames.iter().map(|one| one.frame.sources[0].moment_s.unwrap()).collect();
        assert!(moments[0] == 0.0 && moments.windows(2).all(|pair| pair[0] < pair[1]), "{moments:?}");
        assert_eq!(slow.frames[1].frame.name, "walk 2");
        let source = &slow.frames[1].frame.sources[0];
        assert_eq!(source.series.as_deref(), Some("walk"));
        assert_eq!(Recipe::read(source).unwrap().placing.style, Style::Filled);
        assert!(slow.frames.iter().any(|one| one.frame.air_time_s > 0.0));
    }

    #[test]
    fn an_animation_that_is_too_fast_is_slowed_down_and_says_so() {
        let fast = made(&gif(5)).unwrap();
        assert!(fast.slowdown > 1.0);
        assert_eq!(fast.notes.last().unwrap().code, "animation-slower");
    }

    #[test]
    fn what_is_no_animation_is_refused() {
        assert!(made(b"<svg/>").is_err());
        let recipe = Recipe::new(Content::Svg);
        let floor = PictureFloor::new(3.0, 3.0, 0.05);
        assert_eq!(film("a", &gif(5), &recipe, &floor, 12).unwrap_err().code, "animation-single");
    }
}
