//! Makes the pixels of a frame from its source, and makes them again later. Moved pixels and pins stay.

use lightbots_base::{Rgb, Vec2};
use lightbots_draw::{
    DrawError, Drawing, LightList, Made, Note, PictureFloor, PlaceSettings, PlacedLight, Quality,
    Readability, bounds, closest_distance, place, refit,
};
use lightbots_show::{Frame, FrameSource, Pixel, SourcePart};

use crate::material::{Material, exact, material};
use crate::recipe::Recipe;

/// Factor by which exact arrangements are enlarged beyond the wanted spacing. Files round places, which could otherwise
/// make distances too small.
const SLACK: f64 = 1.001;

/// Smallest distance between two lights at which a list of lights is taken as it is, metres. A list with lights closer
/// together is scaled up.
const LEAST_M: f64 = 0.06;

/// A frame made from its source.
#[derive(Clone, Debug, PartialEq)]
pub struct MadeFrame {
    /// The frame.
    pub frame: Frame,
    /// Longer side of the picture, metres.
    pub size_m: f64,
    /// Distance between the two closest lights, metres. For lists, grids and random places, moved pixels are not
    /// considered. Without meaning for fewer than two lights.
    pub closest_m: f64,
    /// How well the lights show the source. `None` if the source is itself an arrangement of lights, such as a grid.
    pub readability: Option<Readability>,
    /// Notes about what is missing from the picture, or differs from the settings.
    pub notes: Vec<Note>,
}

/// Makes the pixels of the frame `before` anew from its only source, for `robots` robots. Everything else of the frame
/// is kept, and so are pixels that were moved by hand, up to `robots` of them. A robot that is pinned to another pixel
/// is pinned to the nearest new pixel, of the same part if possible.
///
/// `asset` has the bytes of the source's file. `start` has places from which the search for places begins, stage
/// metres, such as those of the previous picture. It is used only for parts filled with lights, if no pixel was moved
/// by hand and its number of places fits.
///
/// # Errors
/// If the frame does not have exactly one source, the source cannot be read or drawn, or not all robots find room.
pub fn make_frame(
    before: &Frame,
    asset: Option<&[u8]>,
    floor: &PictureFloor,
    robots: usize,
    quality: Quality,
    start: &[Vec2],
) -> Result<MadeFrame, DrawError> {
    let material = material(&Recipe::read(only_source(before)?)?, asset)?;
    make_frame_from(before, material, floor, robots, quality, start)
}

/// Like [`make_frame`], but takes the drawn source instead of the bytes of its file.
///
/// # Errors
/// As for [`make_frame`].
pub fn make_frame_from(
    before: &Frame,
    material: Material,
    floor: &PictureFloor,
    robots: usize,
    quality: Quality,
    start: &[Vec2],
) -> Result<MadeFrame, DrawError> {
    let source = only_source(before)?;
    let recipe = Recipe::read(source)?;
    let moved: Vec<&Pixel> = before
        .pixels
        .iter()
        .filter(|pixel| source.moved.binary_search(&pixel.id).is_ok())
        .take(robots)
        .collect();
    let kept = moved.iter().map(|pixel| PlacedLight { at: pixel.at, color: pixel.color, part: 0 }).collect();
    let made = match (exact(&recipe, robots), material) {
        (Some(lights), _) => arranged(&lights, &recipe, floor, false)?.with(kept),
        (None, Material::Lights(lights)) => listed(&lights, &recipe, floor, robots)?.with(kept),
        (None, Material::Drawing { made, view }) => {
            let start = if kept.is_empty() { start.to_vec() } else { Vec::new() };
            let wanted = PlaceSettings { view, kept, start, quality, ..recipe.place_settings(robots) };
            drawn(made, floor, &wanted)?
        }
    };
    let mut frame = before.clone();
    frame.pixels = pixels(before, &moved, &made.lights, &made.names);
    Ok(MadeFrame {
        frame,
        size_m: made.size_m,
        closest_m: made.closest_m,
        readability: made.readability,
        notes: made.notes,
    })
}

fn only_source(frame: &Frame) -> Result<&FrameSource, DrawError> {
    let [source] = frame.sources.as_slice() else {
        let what = "a frame can be made anew from one source; this one has none or several";
        return Err(DrawError::new("source-count", what));
    };
    Ok(source)
}

/// Lights that were made from a source, and the names of the source's parts.
struct Lights {
    lights: Vec<PlacedLight>,
    names: Vec<String>,
    size_m: f64,
    closest_m: f64,
    readability: Option<Readability>,
    notes: Vec<Note>,
}

impl Lights {
    /// For each of the `kept` lights, removes the nearest light that was made. Then puts the kept lights before the others.
    fn with(mut self, kept: Vec<PlacedLight>) -> Self {
        for light in &kept {
            let distance = |index: &usize| self.lights[*index].at.distance(light.at);
            let nearest = (0..self.lights.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(index) = nearest {
                self.lights.remove(index);
            }
        }
        self.lights.splice(0..0, kept);
        self
    }
}

fn drawn(made: Made, floor: &PictureFloor, wanted: &PlaceSettings) -> Result<Lights, DrawError> {
    let placed = place(&made.drawing, floor, wanted)?;
    let mut notes = made.notes;
    notes.extend(placed.notes);
    Ok(Lights {
        lights: placed.lights,
        names: names(&made.drawing),
        size_m: placed.size_m,
        closest_m: placed.closest_m,
        readability: Some(placed.readability),
        notes,
    })
}

fn names(drawing: &Drawing) -> Vec<String> {
    drawing.parts.iter().map(|part| part.name.clone()).collect()
}

/// Places a list of lights on the floor. If it does not have `robots` lights, lights are added or removed, and a note
/// says so.
fn listed(
    list: &LightList,
    recipe: &Recipe,
    floor: &PictureFloor,
    robots: usize,
) -> Result<Lights, DrawError> {
    if list.places.len() == robots {
        return arranged(list, recipe, floor, true);
    }
    let as_they_are = arranged(list, recipe, floor, true)?;
    let spacing_m = recipe.placing.spacing().1;
    let refitted = refit(&as_they_are.lights, &[], robots, spacing_m, floor)?;
    let lights: Vec<PlacedLight> = refitted.iter().map(|light| light.light).collect();
    let what = format!("the list has {} lights; {robots} robots show it", list.places.len());
    let closest_m = closest_distance(&lights.iter().map(|light| light.at).collect::<Vec<_>>());
    Ok(Lights { lights, closest_m, notes: vec![Note::new("list-fitted", what)], ..as_they_are })
}

/// Places an exact arrangement of lights on the floor. With `in_metres`, its places are stage metres. They are kept if
/// the settings state no size, place or turn, and all lights are on the floor and at least [`LEAST_M`] apart.
/// Otherwise, the arrangement is turned, moved and scaled. It gets the size in the settings, or a larger one if lights
/// would be closer than the wanted spacing. Without a size in the settings, the closest lights get the wanted spacing.
///
/// # Errors
/// If two lights are at one place, or the arrangement does not fit on the floor.
fn arranged(
    list: &LightList,
    recipe: &Recipe,
    floor: &PictureFloor,
    in_metres: bool,
) -> Result<Lights, DrawError> {
    let placing = &recipe.placing;
    let places: Vec<Vec2> = list.places.iter().map(|(at, _)| *at).collect();
    let (low, high) = bounds(&places).unwrap_or_default();
    let side = (high.x - low.x).max(high.y - low.y);
    let unit = closest_distance(&places).min(1e6);
    if unit <= 0.0 {
        return Err(DrawError::new(
            "same-place",
            "two lights of the list are at one place; move one of them",
        ));
    }
    let is_free = placing.size_m.is_none() && placing.center == Vec2::ZERO && placing.turn == 0.0;
    let stays = in_metres && is_free && unit >= LEAST_M && places.iter().all(|at| floor.allows(*at));
    let least = placing.spacing().0 / unit * SLACK;
    let scale = placing.size_m.filter(|_| side > 0.0).map_or(least, |size| (size / side).max(least));
    let (sin, cos) = (libm::sin(placing.turn), libm::cos(placing.turn));
    let map = |at: Vec2| {
        let point = (at - low.lerp(high, 0.5)) * scale;
        placing.center + Vec2::new(point.x * cos - point.y * sin, point.x * sin + point.y * cos)
    };
    let light = |(at, color): &(Vec2, Rgb)| PlacedLight {
        at: if stays { *at } else { map(*at) },
        color: *color,
        part: 0,
    };
    let lights: Vec<PlacedLight> = list.places.iter().map(light).collect();
    if !lights.iter().all(|light| floor.allows(light.at)) {
        let what = format!(
            "this arrangement of {} robots is {:.2} m wide and does not fit on the floor; use fewer robots, another place, \
             or a drawing, which flows around no-go areas",
            places.len(),
            side * scale
        );
        return Err(DrawError::new("too-many-robots", what));
    }
    let scale = if stays { 1.0 } else { scale };
    Ok(Lights {
        lights,
        names: vec![String::new()],
        size_m: side * scale,
        closest_m: unit * scale,
        readability: None,
        notes: Vec::new(),
    })
}

/// Makes the pixels for `lights`. The first lights belong to the pixels `moved`, which are kept unchanged. The others
/// get the smallest free ids in order. `names` are the names of the source's parts. Robots that are pinned in `before`
/// are pinned again.
fn pixels(before: &Frame, moved: &[&Pixel], lights: &[PlacedLight], names: &[String]) -> Vec<Pixel> {
    let taken: Vec<u32> = moved.iter().map(|pixel| pixel.id).collect();
    let mut free = (0..).filter(|id| !taken.contains(id));
    let mut pixels: Vec<Pixel> = Vec::with_capacity(lights.len());
    for (index, light) in lights.iter().enumerate() {
        if let Some(pixel) = moved.get(index) {
            pixels.push((*pixel).clone());
            continue;
        }
        let name = names.get(light.part).cloned().unwrap_or_default();
        let part = Some(SourcePart { source: 0, name });
        let id = free.next().unwrap_or(u32::MAX);
        pixels.push(Pixel { id, at: light.at, color: light.color, robot: None, part, group: None });
    }
    pin(before, &taken, &mut pixels);
    pixels.sort_by_key(|pixel| pixel.id);
    pixels
}

/// Pins each robot that is pinned in `before` to the nearest new pixel without a robot, of the same part if there is
/// one. `kept` has the ids of moved pixels, which come first in `pixels` and keep their robots. A robot gets no pixel
/// if all others have one.
fn pin(before: &Frame, kept: &[u32], pixels: &mut [Pixel]) {
    for old in before.pixels.iter().filter(|pixel| pixel.robot.is_some() && !kept.contains(&pixel.id)) {
        let same = |pixel: &Pixel| pixel.part == old.part;
        let free = pixels.iter_mut().skip(kept.len()).filter(|pixel| pixel.robot.is_none());
        let nearest = free.min_by(|a, b| {
            let distance = |pixel: &Pixel| pixel.at.distance(old.at);
            same(b).cmp(&same(a)).then(distance(a).total_cmp(&distance(b)))
        });
        if let Some(pixel) = nearest {
            pixel.robot.clone_from(&old.robot);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Content, Placing, TextRecipe};

    fn floor() -> PictureFloor {
        PictureFloor::new(4.0, 4.0, 0.05)
    }

    fn hi(robots: usize) -> Frame {
        let source = Recipe::new(Content::Text(TextRecipe::new("HI"))).source();
        let empty = Frame { name: "HI".into(), sources: vec![source], ..Frame::default() };
        make_frame(&empty, None, &floor(), robots, Quality::Full, &[]).unwrap().frame
    }

    #[test]
    fn a_word_becomes_pixels_with_the_names_of_their_letters() {
        let frame = hi(20);
        assert_eq!(frame.pixels.len(), 20);
        assert_eq!(frame.name, "HI");
        let letters: std::collections::BTreeSet<&str> = frame
            .pixels
            .iter()
            .filter_map(|pixel| pixel.part.as_ref())
            .map(|part| part.name.as_str())
            .collect();
        assert_eq!(letters.len(), 2, "{letters:?}");
        assert!(frame.pixels.windows(2).all(|pair| pair[0].id < pair[1].id));
    }

    #[test]
    fn a_moved_pixel_stays_when_the_number_of_robots_changes() {
        let mut frame = hi(20);
        frame.pixels[4].at = Vec2::new(1.7, 1.7);
        frame.sources[0].moved = vec![frame.pixels[4].id];
        for robots in [12, 20, 33] {
            let made = make_frame(&frame, None, &floor(), robots, Quality::Full, &[]).unwrap().frame;
            assert_eq!(made.pixels.len(), robots);
            assert!(made.pixels.contains(&frame.pixels[4]));
        }
    }

    #[test]
    fn a_pin_follows_to_the_nearest_pixel_of_its_letter() {
        let mut frame = hi(20);
        let of_i = |frame: &Frame, name: &str| {
            let part =
                frame.pixels.iter().find(|pixel| pixel.robot.as_deref() == Some(name)).unwrap().part.clone();
            part.unwrap().name
        };
        let right = (0..20).max_by(|a, b| frame.pixels[*a].at.x.total_cmp(&frame.pixels[*b].at.x)).unwrap();
        frame.pixels[right].robot = Some("7".into());
        let letter = of_i(&frame, "7");
        let made = make_frame(&frame, None, &floor(), 31, Quality::Full, &[]).unwrap().frame;
        assert_eq!(of_i(&made, "7"), letter);
    }

    #[test]
    fn a_grid_is_exact() {
        let settings = lightbots_draw::ShapeSettings::new(lightbots_draw::ShapeKind::Grid);
        let source = Recipe::new(Content::Shape(settings)).source();
        let empty = Frame { sources: vec![source], ..Frame::default() };
        let made = make_frame(&empty, None, &floor(), 100, Quality::Full, &[]).unwrap();
        assert!((made.closest_m - 0.08).abs() < 1e-3);
        assert_eq!(made.readability, None);
        assert_eq!(
            make_frame(&empty, None, &floor(), 9_000, Quality::Full, &[]).unwrap_err().code,
            "too-many-robots"
        );
    }

    #[test]
    fn a_drawn_curve_goes_through_its_points_at_their_places() {
        let settings = lightbots_draw::ShapeSettings {
            points: vec![
                Vec2::new(-0.9, 0.2),
                Vec2::new(0.1, 0.7),
                Vec2::new(0.3, -0.4),
                Vec2::new(1.1, 0.6),
            ],
            ..lightbots_draw::ShapeSettings::new(lightbots_draw::ShapeKind::Curve)
        };
        let ends = [settings.points[0], settings.points[3]];
        let recipe = Recipe::new(Content::Shape(settings));
        let placing = Placing { size_m: Some(2.0), center: Vec2::new(0.1, 0.15), ..recipe.placing };
        let source = Recipe { placing, ..recipe }.source();
        let empty = Frame { sources: vec![source], ..Frame::default() };
        let made = make_frame(&empty, None, &floor(), 30, Quality::Full, &[]).unwrap();
        for end in ends {
            let pixels = made.frame.pixels.iter();
            let nearest = pixels.map(|pixel| pixel.at.distance(end)).fold(f64::MAX, f64::min);
            assert!(nearest < 0.01, "{end:?}: {nearest}");
        }
    }

    #[test]
    fn a_dash_of_one_stroke_is_a_word() {
        let words = TextRecipe { font: "hershey-sans".into(), ..TextRecipe::new("-") };
        let frame = Frame { sources: vec![Recipe::new(Content::Text(words)).source()], ..Frame::default() };
        let made = make_frame(&frame, None, &floor(), 9, Quality::Full, &[]).unwrap();
        assert_eq!(made.frame.pixels.len(), 9);
        assert!(made.readability.unwrap().correlation > 0.85);
    }

    #[test]
    fn a_moved_pixel_of_a_grid_leaves_only_its_own_place() {
        let settings = lightbots_draw::ShapeSettings::new(lightbots_draw::ShapeKind::Grid);
        let source = Recipe::new(Content::Shape(settings)).source();
        let empty = Frame { sources: vec![source], ..Frame::default() };
        let mut frame = make_frame(&empty, None, &floor(), 16, Quality::Full, &[]).unwrap().frame;
        let places = |frame: &Frame| -> Vec<Vec2> { frame.pixels.iter().map(|pixel| pixel.at).collect() };
        let before = places(&frame);
        frame.pixels[9].at = before[9] + Vec2::new(0.01, 0.01);
        frame.sources[0].moved = vec![9];
        let after = places(&make_frame(&frame, None, &floor(), 16, Quality::Full, &[]).unwrap().frame);
        let stayed = before.iter().filter(|at| after.contains(at)).count();
        assert_eq!((after.len(), stayed), (16, 15));
        assert!(after.contains(&frame.pixels[9].at) && !after.contains(&before[9]));
    }
}
