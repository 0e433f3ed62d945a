//! Fits all frames of a show to another number of robots.

use lightbots_draw::animation::{self, Animation};
use lightbots_draw::picture::PictureSettings;
use lightbots_draw::{DrawError, Note, PictureFloor, PlacedLight, Quality, refit};
use lightbots_show::{AssetHash, Frame, FrameSource, Pixel, Show, frame_label};

use crate::floor::picture_floor;
use crate::frame::make_frame_from;
use crate::material::{Material, asset_of, material, moment};
use crate::recipe::{Content, Recipe};

/// Smallest distance between two lights in frames that are not made anew from a source, metres; less if the frame's lights
/// are closer already. With a smaller value, planning takes longer (measured).
const SPACING_M: f64 = 0.0764;

/// Fits every frame of a show to `robots` robots. Frames that already have `robots` pixels are kept. Frames with
/// exactly one source are made anew from it. Other frames, and frames whose source cannot be drawn, keep their lights
/// as far as possible. Starts for another number of robots are dropped. Returns notes about sources that cannot be
/// drawn, and about changes that people may not expect.
///
/// # Errors
/// If a frame has no room for `robots` robots, or has neither pixels nor a source that can be drawn. The message names
/// the frame. The show is then unchanged.
pub fn fit_show(show: &mut Show, robots: usize) -> Result<Vec<Note>, DrawError> {
    let floor = picture_floor(&show.stage);
    let mut notes = Vec::new();
    let mut fitted_frames = Vec::new();
    let mut film = Film::None;
    for index in 0..show.frames.len() {
        let frame = &show.frames[index];
        if frame.pixels.len() == robots {
            continue;
        }
        let label = frame_label(index, &frame.name);
        let named = |error: DrawError| DrawError::new(error.code, format!("{label}: {}", error.message));
        let kept = || fitted(frame, &floor, robots).map_err(named);
        let fitted = match made_anew(show, frame, &floor, robots, &mut film) {
            Some(Ok((frame, more))) => {
                notes.extend(
                    more.into_iter().map(|note| Note::new(note.code, format!("{label}: {}", note.message))),
                );
                frame
            }
            Some(Err(error)) if error.code == "too-many-robots" || frame.pixels.is_empty() => {
                return Err(named(error));
            }
            Some(Err(error)) => {
                let what = format!(
                    "{label}: its source cannot be drawn ({}), so it keeps its lights as far as possible",
                    error.message
                );
                notes.push(Note::new("source-not-drawn", what));
                kept()?
            }
            None => kept()?,
        };
        fitted_frames.push((index, fitted));
    }
    for (index, fitted) in fitted_frames {
        show.frames[index] = fitted;
    }
    if let Some(starts) = show.starts.take_if(|starts| starts.len() != robots) {
        let what = format!(
            "the show said where {} robots start; {robots} robots start in rows at the back edge",
            starts.len()
        );
        notes.push(Note::new("starts-dropped", what));
    }
    Ok(notes)
}

/// The animation that was read last, with the hash of its file and its settings; `None`: none yet. Successive frames often
/// come from one animation, which is then read only once.
type Film = Option<((AssetHash, PictureSettings), Animation)>;

/// Makes the frame anew from its source, and returns it with notes. `None` if the frame does not have exactly one
/// source.
fn made_anew(
    show: &Show,
    frame: &Frame,
    floor: &PictureFloor,
    robots: usize,
    film: &mut Film,
) -> Option<Result<(Frame, Vec<Note>), DrawError>> {
    let [source] = frame.sources.as_slice() else { return None };
    let made = material_of(show, source, film)
        .and_then(|material| make_frame_from(frame, material, floor, robots, Quality::Full, &[]));
    Some(made.map(|made| (made.frame, made.notes)))
}

fn material_of(show: &Show, source: &FrameSource, film: &mut Film) -> Result<Material, DrawError> {
    let recipe = Recipe::read(source)?;
    let asset = asset_of(source, &show.assets);
    let (Content::Animation { picture, moment_s }, Some(bytes), Some(hash)) =
        (&recipe.content, asset, source.asset)
    else {
        return material(&recipe, asset);
    };
    if film.as_ref().is_none_or(|(key, _)| *key != (hash, *picture)) {
        *film = Some(((hash, *picture), animation::read(bytes, picture)?));
    }
    film.as_ref().map_or_else(|| material(&recipe, asset), |(_, animation)| moment(animation, *moment_s))
}

/// Returns the frame with `robots` pixels: some are added or removed, the others are moved a little. Pixels that are
/// pinned to a robot are removed last. New pixels get the smallest free ids.
fn fitted(frame: &Frame, floor: &PictureFloor, robots: usize) -> Result<Frame, DrawError> {
    let lights: Vec<PlacedLight> =
        frame.pixels.iter().map(|pixel| PlacedLight { at: pixel.at, color: pixel.color, part: 0 }).collect();
    let pinned: Vec<bool> = frame.pixels.iter().map(|pixel| pixel.robot.is_some()).collect();
    let closest = lightbots_draw::closest_distance(&lights.iter().map(|light| light.at).collect::<Vec<_>>());
    let refitted = refit(&lights, &pinned, robots, SPACING_M.min(closest), floor)?;
    let taken: std::collections::BTreeSet<u32> =
        refitted.iter().filter_map(|light| light.from).map(|index| frame.pixels[index].id).collect();
    let mut free = (0..).filter(|id| !taken.contains(id));
    let mut pixels: Vec<Pixel> = refitted
        .iter()
        .map(|light| match light.from {
            Some(index) => Pixel { at: light.light.at, ..frame.pixels[index].clone() },
            None => Pixel {
                id: free.next().unwrap_or(u32::MAX),
                at: light.light.at,
                color: light.light.color,
                ..Pixel::default()
            },
        })
        .collect();
    pixels.sort_by_key(|pixel| pixel.id);
    Ok(Frame { pixels, ..frame.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::make_frame;
    use crate::recipe::TextRecipe;
    use lightbots_base::{Rgb, Vec2};
    use lightbots_show::{Severity, validate};

    fn show() -> Show {
        let source = Recipe::new(Content::Text(TextRecipe::new("HI"))).source();
        let empty = Frame { name: "Word".into(), air_time_s: 2.0, sources: vec![source], ..Frame::default() };
        let stage = lightbots_show::Stage::default();
        let word = make_frame(&empty, None, &picture_floor(&stage), 24, Quality::Full, &[]).unwrap().frame;
        let dot = |id: u32| Pixel {
            id,
            at: Vec2::new(f64::from(id % 6), f64::from(id / 6)) * 0.2,
            color: Rgb::new(200, 100, 0),
            robot: (id == 5).then(|| "9".to_owned()),
            ..Pixel::default()
        };
        let drawn = Frame {
            name: "By hand".into(),
            air_time_s: 2.0,
            pixels: (0..24).map(dot).collect(),
            ..Frame::default()
        };
        Show { stage, frames: vec![word, drawn], ..Show::default() }
    }

    #[test]
    fn every_frame_has_the_robots_that_there_are_and_is_valid() {
        for robots in [10, 24, 60] {
            let mut fitted = show();
            fit_show(&mut fitted, robots).unwrap();
            assert!(fitted.frames.iter().all(|frame| frame.pixels.len() == robots), "{robots}");
            assert!(validate(&fitted).iter().all(|issue| issue.severity != Severity::Error), "{robots}");
            let pinned = fitted.frames[1].pixels.iter().filter(|pixel| pixel.robot.is_some());
            assert_eq!(pinned.count(), 1);
        }
    }

    #[test]
    fn a_source_that_cannot_be_drawn_is_noted() {
        let mut show = show();
        show.frames[0].sources = vec![Recipe::new(Content::Svg).source()];
        let notes = fit_show(&mut show, 30).unwrap();
        assert_eq!(show.frames[0].pixels.len(), 30);
        assert_eq!(notes.iter().map(|note| note.code).collect::<Vec<_>>(), ["source-not-drawn"]);
        assert!(notes[0].message.contains("Word"), "{}", notes[0].message);
        // Without pixels there is nothing to keep, and the reason is the source's.
        let why = notes[0].message.split(['(', ')']).nth(1).unwrap().to_owned();
        show.frames[0].pixels.clear();
        let error = fit_show(&mut show, 30).unwrap_err();
        assert!(error.message.contains(&why), "{}", error.message);
    }

    #[test]
    fn too_many_robots_name_the_frame() {
        let error = fit_show(&mut show(), 9_000).unwrap_err();
        assert_eq!(error.code, "too-many-robots");
        assert!(error.message.contains("Word"), "{}", error.message);
    }

    #[test]
    fn a_show_that_cannot_be_fitted_stays_as_it_is() {
        let mut whole = show();
        whole.frames.push(Frame::default());
        let mut changed = whole.clone();
        fit_show(&mut changed, 60).unwrap_err();
        assert_eq!(changed, whole);
    }
}
