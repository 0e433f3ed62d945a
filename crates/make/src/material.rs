//! Draws sources, independent of the number of robots: as a drawing, or as lights at exact places.

use lightbots_base::{Rgb, Vec2};
use lightbots_draw::animation::{self, Animation};
use lightbots_draw::text::{self, Colors, Font, Page, TextSettings};
use lightbots_draw::{
    DrawError, LightList, Made, ShapeKind, ShapeSettings, bounds, draw_shape, list, picture, svg,
};
use lightbots_show::{Assets, FrameSource};

use crate::recipe::{Content, Recipe, Scroll, TextRecipe};

/// Colour of words if the settings have no colour: the orange of a warm lamp.
const USUAL_COLOR: Rgb = Rgb::new(255, 165, 0);

/// A drawn source, independent of the number of robots.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// A drawing, on which any number of robots is placed.
    Drawing {
        /// The drawing, and notes about what is missing from it.
        made: Made,
        /// The rectangle that counts as the whole picture: its lower and its upper corner, in the drawing's units. `None`:
        /// the smallest rectangle around the drawing.
        view: Option<(Vec2, Vec2)>,
    },
    /// Lights at exact places, in metres.
    Lights(LightList),
}

/// Draws a source. `asset` has the bytes of the source's file; for words, it is the font. Grids, hexagonal grids and
/// random shapes give an empty drawing, because the places of their lights depend on the number of robots.
///
/// # Errors
/// If the source cannot be drawn, or needs a file and `asset` is `None`.
pub fn material(recipe: &Recipe, asset: Option<&[u8]>) -> Result<Material, DrawError> {
    let file = || asset.ok_or_else(missing);
    let made = match &recipe.content {
        Content::Text(words) => draw_text(words, asset)?,
        // The places of the lights depend on the number of robots.
        Content::Shape(shape) if is_exact(shape) => Made::default(),
        Content::Shape(shape) => Made { drawing: draw_shape(shape)?, notes: Vec::new() },
        Content::Svg => svg::draw(file()?)?,
        Content::Picture(settings) => picture::draw(file()?, settings)?,
        Content::List => return Ok(Material::Lights(list::read(file()?)?)),
        Content::Animation { picture, moment_s } => {
            return moment(&animation::read(file()?, picture)?, *moment_s);
        }
    };
    let view = match &recipe.content {
        Content::Text(words) => words.view(),
        Content::Shape(shape) => box_of_points(shape),
        _ => None,
    };
    Ok(Material::Drawing { made, view })
}

/// Returns the smallest rectangle around the points of a line that was drawn by hand. `None` for other shapes, and for
/// fewer than two points. It serves as the whole picture: the points thus stay where people dragged them, although a
/// curve swings beyond them.
fn box_of_points(shape: &ShapeSettings) -> Option<(Vec2, Vec2)> {
    let drawn = [ShapeKind::Line, ShapeKind::Polyline, ShapeKind::Curve, ShapeKind::Freehand];
    let is_drawn = drawn.contains(&shape.kind) && shape.points.len() > 1;
    is_drawn.then(|| bounds(&shape.points)).flatten()
}

/// Returns the picture that an animation shows at `moment_s`, seconds from the start of the animation. Before the first
/// picture it is the first one, after the end the last one.
pub(crate) fn moment(animation: &Animation, moment_s: f64) -> Result<Material, DrawError> {
    let after = animation.frames.partition_point(|frame| frame.at_s <= moment_s + 1e-6);
    let frame = animation.frames.get(after.saturating_sub(1));
    let frame = frame.ok_or_else(|| DrawError::new("animation-empty", "the animation has no pictures"))?;
    let made = Made { drawing: frame.drawing.clone(), notes: Vec::new() };
    Ok(Material::Drawing { made, view: view_of(animation) })
}

/// Returns the lower and the upper corner of the smallest rectangle around all pictures of an animation, in the drawings'
/// units. `None` if all pictures are empty.
pub(crate) fn view_of(animation: &Animation) -> Option<(Vec2, Vec2)> {
    let corners: Vec<Vec2> = animation
        .frames
        .iter()
        .filter_map(|frame| frame.drawing.bounds())
        .flat_map(|(low, high)| [low, high])
        .collect();
    bounds(&corners)
}

fn missing() -> DrawError {
    DrawError::new("asset-missing", "the file that this frame is made from is not in the show; add it again")
}

fn draw_text(words: &TextRecipe, asset: Option<&[u8]>) -> Result<Made, DrawError> {
    let font = font(words, asset)?;
    let Some(scroll) = words.scroll else { return text::draw(&words.settings(&font)) };
    let pages = text::scrolling(&words.settings(&font), scroll.window, scroll.steps)?;
    let page = pages.into_iter().nth(scroll.step);
    page.map(|page| page.made).ok_or_else(|| {
        DrawError::new("text-settings", format!("the scrolling text has no step {}", scroll.step + 1))
    })
}

/// How a text becomes frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextPages {
    /// One frame.
    Whole,
    /// A frame for each word.
    Words,
    /// A frame for each step of the text as it scrolls past behind a window.
    Scroll {
        /// Width of the window, in heights of a capital letter.
        window: f64,
        /// Number of steps in which the text scrolls past. Steps in which the window is empty get no frame.
        steps: usize,
    },
}

/// Returns the recipe and the material of each frame that a text becomes. `asset` has the bytes of the font; `None`:
/// the font is the built-in one that `words` names.
///
/// # Errors
/// If the font cannot be read or is unknown, or the text cannot be drawn.
pub fn text_pages(
    words: &TextRecipe,
    asset: Option<&[u8]>,
    pages: TextPages,
) -> Result<Vec<(TextRecipe, Material)>, DrawError> {
    let font = font(words, asset)?;
    let settings = words.settings(&font);
    let recipes: Vec<(TextRecipe, Made)> = match pages {
        TextPages::Whole => vec![(words.clone(), text::draw(&settings)?)],
        TextPages::Words => {
            let word = |page: Page| (TextRecipe { text: page.title, ..words.clone() }, page.made);
            text::per_word(&settings)?.into_iter().map(word).collect()
        }
        TextPages::Scroll { window, steps } => {
            let scrolled =
                |step| TextRecipe { scroll: Some(Scroll { window, steps, step }), ..words.clone() };
            let pages = text::scrolling(&settings, window, steps)?;
            pages.into_iter().enumerate().map(|(step, page)| (scrolled(step), page.made)).collect()
        }
    };
    let of = |(recipe, made): (TextRecipe, Made)| {
        let view = recipe.view();
        (recipe, Material::Drawing { made, view })
    };
    Ok(recipes.into_iter().map(of).collect())
}

fn font(words: &TextRecipe, asset: Option<&[u8]>) -> Result<Font, DrawError> {
    if let Some(bytes) = asset {
        return Font::read(bytes);
    }
    Font::built_in(&words.font).ok_or_else(|| {
        let known: Vec<&str> = text::FONTS.iter().filter(|font| font.offered).map(|font| font.name).collect();
        let name: String = words.font.chars().take(40).collect();
        DrawError::new("unknown-font", format!("there is no font \"{name}\"; use {}", known.join(", ")))
    })
}

impl TextRecipe {
    /// The lower and the upper corner of the window behind which the text scrolls, in heights of a capital letter. `None` if
    /// the text does not scroll.
    fn view(&self) -> Option<(Vec2, Vec2)> {
        self.scroll.map(|scroll| (Vec2::ZERO, Vec2::new(scroll.window, 1.0)))
    }

    fn settings<'a>(&'a self, font: &'a Font) -> TextSettings<'a> {
        let colors = match self.colors.as_slice() {
            [] => Colors::One(USUAL_COLOR),
            [one] => Colors::One(*one),
            several => Colors::Each(several.to_vec()),
        };
        TextSettings {
            align: self.align,
            wrap: self.wrap,
            letter_gap: self.letter_gap,
            colors,
            ..TextSettings::new(&self.text, font)
        }
    }
}

/// Returns the bytes of a source's file. `None` if the source has no file, or `assets` lack its bytes.
pub(crate) fn asset_of<'a>(source: &FrameSource, assets: &'a Assets) -> Option<&'a [u8]> {
    assets.get(source.asset.as_ref()?)?.content.as_deref()
}

/// Returns `robots` lights of a grid, a hexagonal grid or a random shape, about one unit apart. `None` for other sources.
pub(crate) fn exact(recipe: &Recipe, robots: usize) -> Option<LightList> {
    let Content::Shape(shape) = &recipe.content else { return None };
    let places = lightbots_draw::exact_places(shape, robots, u64::from(recipe.seed))?;
    Some(LightList { places: places.into_iter().map(|at| (at, shape.color)).collect() })
}

fn is_exact(shape: &ShapeSettings) -> bool {
    matches!(shape.kind, ShapeKind::Grid | ShapeKind::Hexagons | ShapeKind::Random)
}
