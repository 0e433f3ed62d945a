//! Turns SVG files into drawings: filled areas with their colours, and strokes as lines. Hidden parts are cut away as
//! far as possible.

mod canvas;
mod census;
mod cost;
mod css;
mod flatten;
mod lights;
mod paint;
mod region;
mod scan;
mod typeface;
mod walk;

pub use typeface::faces as font_faces;

use lightbots_base::Vec2;
use usvg::roxmltree::{Document, ParsingOptions};
use usvg::{ImageHrefResolver, Options, Tree};

use crate::drawing::{Area, Drawing, DrawingPart, FillRule, Stroke};
use crate::error::{DrawError, Made, Note};
use crate::svg::canvas::Canvas;
use crate::svg::flatten::{FlatLine, Spot};
use crate::svg::walk::Walk;

/// Largest number of elements, texts and comments in a file. This number takes 150 MB, measured on 2026-11-23.
const NODES_MAX: u32 = 200_000;
/// Largest width and height of a page, in units of the page.
const PAGE_MAX: f32 = 1e6;

/// Draws an SVG file. The result has notes about what cannot be drawn. Other files that the SVG refers to are not read.
///
/// # Errors
/// Files that are compressed, damaged, too large or too complex, and files without visible areas or lines.
pub fn draw(bytes: &[u8]) -> Result<Made, DrawError> {
    if bytes.starts_with(&[0x1f, 0x8b]) {
        let message = "The SVG file is compressed (svgz). Unpack it, or save it as plain SVG.";
        return Err(DrawError::new("svg-compressed", message));
    }
    let text = scan::text(bytes)?;
    let options = ParsingOptions { allow_dtd: true, nodes_limit: NODES_MAX, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(unparsed)?;
    cost::check(&document)?;
    let mut notes = census::notes(&document);
    let tree = Tree::from_xmltree(&document, &closed_options()).map_err(|error| {
        let message = format!("The SVG file cannot be read: {error}. Save it again as plain SVG.");
        DrawError::new("svg-tree", message)
    })?;
    notes.extend(typeface::missing(tree.root()));
    let mut walk = painted(&tree)?;
    notes.extend(beyond(walk.beyond));
    notes.extend(left_out(&walk.canvas));
    notes.extend(lights::light(&mut walk.canvas));
    let drawing = drawing(&walk.canvas, f64::from(tree.size().height()));
    if drawing.bounds().is_none() {
        let reasons: Vec<String> = notes.iter().map(|note| note.message.clone()).collect();
        let message = format!("The SVG file has no visible areas or lines. {}", reasons.join(" "));
        return Err(DrawError::new("svg-empty", message.trim_end()));
    }
    Ok(Made { drawing, notes })
}

fn unparsed(error: usvg::roxmltree::Error) -> DrawError {
    if matches!(error, usvg::roxmltree::Error::NodesLimitReached) {
        return scan::too_large(format!("it has more than {NODES_MAX} elements and texts"));
    }
    let message =
        format!("The SVG file is damaged or cut off: {error}. Save it again in the program that made it.");
    DrawError::new("svg-xml", message)
}

/// Options with which usvg reads no other file, address or picture.
fn closed_options() -> Options<'static> {
    Options {
        resources_dir: None,
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        font_family: typeface::FAMILY.to_owned(),
        fontdb: typeface::faces(),
        ..Options::default()
    }
}

fn painted(tree: &Tree) -> Result<Walk, DrawError> {
    let (width, height) = (tree.size().width(), tree.size().height());
    if width.is_nan() || height.is_nan() || width.max(height) > PAGE_MAX {
        let message =
            format!("The SVG page is {width} × {height} large. Make it at most {PAGE_MAX} × {PAGE_MAX}.");
        return Err(DrawError::new("svg-page", message));
    }
    let page = ([0.0, 0.0], [f64::from(width), f64::from(height)]);
    let around = tree.root().abs_stroke_bounding_box();
    let side = |from: f32, to: f32, limit: f32| f64::from(to.min(limit) - from.max(0.0));
    let size = side(around.left(), around.right(), width).max(side(around.top(), around.bottom(), height));
    let size = if size > 0.0 { size } else { f64::from(width.max(height)) };
    Walk::paint(tree.root(), page, size)
}

fn beyond(count: usize) -> Option<Note> {
    let what = census::counted(count, "A part with coordinates", "parts with coordinates")?;
    let message = format!("{what} beyond {PAGE_MAX} left out. Move such parts onto the page.");
    Some(Note::new("svg-coordinates", message))
}

fn left_out(canvas: &Canvas) -> Vec<Note> {
    let hidden = census::counted(canvas.hidden, "A part is", "parts are").map(|what| {
        let message =
            format!("{what} left out, because later parts cover them or they lie outside of the page.");
        Note::new("svg-hidden", message)
    });
    let faint = census::counted(canvas.faint, "A part is", "parts are").map(|what| {
        let message = format!("{what} left out, because they are nearly transparent.");
        Note::new("svg-faint", message)
    });
    let overlap = canvas.is_overworked().then(|| {
        let message = "The drawing has more overlapping parts than can be cut. Covered parts keep their robots; \
                       simplify the drawing if that disturbs.";
        Note::new("svg-overlap", message)
    });
    hidden.into_iter().chain(faint).chain(overlap).collect()
}

/// Makes a drawing of a canvas, with y upwards.
fn drawing(canvas: &Canvas, height: f64) -> Drawing {
    let place = |spot: &Spot| Vec2::new(spot[0], height - spot[1]);
    let flip = |at: Vec2| Vec2::new(at.x, height - at.y);
    let line = |points: &[Spot]| points.iter().map(place).collect::<Vec<Vec2>>();
    let areas = canvas.surfaces.iter().map(|surface| Area {
        rings: surface.region.rings().iter().map(|ring| line(ring)).collect(),
        rule: FillRule::NonZero,
        ink: surface.ink.mapped(flip),
        weight: 1.0,
    });
    let strokes = canvas.lines.iter().map(|found| {
        let FlatLine { points, closed } = &found.line;
        Stroke { points: line(points), closed: *closed, ink: found.ink.mapped(flip), weight: 1.0 }
    });
    let part = DrawingPart {
        name: "drawing".to_owned(),
        areas: areas.collect(),
        strokes: strokes.collect(),
        ..DrawingPart::default()
    };
    let empty = part.areas.is_empty() && part.strokes.is_empty();
    Drawing { parts: if empty { Vec::new() } else { vec![part] } }
}

#[cfg(test)]
mod tests;
