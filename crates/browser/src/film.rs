//! Makes the frames of animations.

use lightbots_api::{FilmAnswer, FilmPicture, MakeRemark};
use lightbots_base::Vec2;
use lightbots_make::{FilmFrame, Recipe, film, make_frame_from};

use crate::answer;
use crate::make::{FrameWish, full, readability, remark};

/// Makes the frames of an animation. `request` is a `MakeRequest` as JSON, and the source of its frame is the animation.
/// `bytes` are those of the animation's file.
pub fn film_answer(request: &str, bytes: &[u8]) -> FilmAnswer {
    made(request, bytes).unwrap_or_else(|error| FilmAnswer { error: Some(error), ..FilmAnswer::default() })
}

fn made(request: &str, bytes: &[u8]) -> Result<FilmAnswer, MakeRemark> {
    let wish = FrameWish::read(request)?;
    let source =
        wish.frame.sources.first().ok_or_else(|| remark("source-count", "the frame has no source"))?;
    let recipe = Recipe::read(source).map_err(answer::drawing)?;
    let film = film(&wish.frame.name, bytes, &recipe, &wish.floor, wish.robots).map_err(answer::drawing)?;
    let mut frames: Vec<FilmPicture> = Vec::new();
    let mut places: Vec<Vec2> = Vec::new();
    for FilmFrame { frame, material } in film.frames {
        let made = make_frame_from(&frame, material, &wish.floor, wish.robots, wish.quality, &places)
            .map_err(answer::drawing)?;
        places = made.frame.pixels.iter().map(|pixel| pixel.at).collect();
        frames.push(FilmPicture {
            moment_s: frame.sources.first().and_then(|source| source.moment_s).unwrap_or(0.0),
            air_time_s: frame.air_time_s,
            made: full(&made, readability(&made), None),
        });
    }
    Ok(FilmAnswer { frames, slowdown: film.slowdown, notes: answer::notes(&film.notes), error: None })
}
