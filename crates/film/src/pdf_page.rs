//! Writes A4 pages with text and simple figures.

use krilla::Document;
use krilla::color::rgb;
use krilla::geom::{PathBuilder, Point, Rect};
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla::paint::{Fill, Stroke};
use krilla::text::{Font, TextDirection};
use lightbots_draw::text::{FONTS, FontInfo};

/// Width and height of A4, points.
pub(crate) const PAGE: (f32, f32) = (595.28, 841.89);
/// Margin, points.
pub(crate) const MARGIN: f32 = 42.0;
/// A Bézier curve draws a quarter of a circle if its control points are this far from its end points, in radii.
const QUARTER: f32 = 0.552_284_8;
/// Name of the built-in font.
const FONT: &str = "lato";

/// A grey: 0 is black, 255 is white.
pub(crate) type Grey = u8;

/// An element of a page. Coordinates and sizes are in points; x and y count from the top left corner, y downwards.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Mark {
    Text {
        x: f32,
        y: f32,
        size: f32,
        grey: Grey,
        words: String,
    },
    /// A disc, if `is_filled`, or else the outline of a circle.
    Disc {
        x: f32,
        y: f32,
        radius: f32,
        grey: Grey,
        is_filled: bool,
    },
    /// The outline of a rectangle.
    Frame {
        x: f32,
        y: f32,
        width: f32,
        height: f32,
        grey: Grey,
    },
    Line {
        from: (f32, f32),
        to: (f32, f32),
        grey: Grey,
    },
}

/// Returns a PDF file with these pages. The file has no dates, so that equal pages give equal bytes. The result is empty if
/// the font cannot be read or the file cannot be made.
pub(crate) fn document(title: &str, pages: &[Vec<Mark>]) -> Vec<u8> {
    let file = FONTS.iter().find(|font| font.name == FONT).and_then(FontInfo::outline_file);
    let Some(font) = file.and_then(|file| Font::new(file.to_vec().into(), 0)) else { return Vec::new() };
    let mut document = Document::new();
    document.set_metadata(Metadata::new().title(title.to_owned()).creator("LightBots".into()));
    for (number, marks) in pages.iter().enumerate() {
        let Some(settings) = PageSettings::from_wh(PAGE.0, PAGE.1) else { continue };
        let mut page = document.start_page_with(settings);
        let mut surface = page.surface();
        let foot = Mark::Text {
            x: MARGIN,
            y: PAGE.1 - 20.0,
            size: 8.0,
            grey: 110,
            words: format!("{title}, page {} of {}", number + 1, pages.len()),
        };
        for mark in marks.iter().chain([&foot]) {
            draw(&mut surface, mark, &font);
        }
        surface.finish();
        page.finish();
    }
    document.finish().unwrap_or_default()
}

fn draw(surface: &mut krilla::surface::Surface<'_>, mark: &Mark, font: &Font) {
    let colour = |grey: Grey| rgb::Color::new(grey, grey, grey);
    let fill = |grey: Grey| Some(Fill { paint: colour(grey).into(), ..Fill::default() });
    let stroke = |grey: Grey| Some(Stroke { paint: colour(grey).into(), width: 0.7, ..Stroke::default() });
    let mut path = PathBuilder::new();
    let is_filled = match mark {
        Mark::Text { x, y, size, grey, words } => {
            surface.set_stroke(None);
            surface.set_fill(fill(*grey));
            surface.draw_text(Point::from_xy(*x, *y), font.clone(), *size, words, false, TextDirection::Auto);
            return;
        }
        Mark::Disc { x, y, radius, is_filled, .. } => {
            circle(&mut path, (*x, *y), *radius);
            *is_filled
        }
        Mark::Frame { x, y, width, height, .. } => {
            if let Some(rect) = Rect::from_xywh(*x, *y, *width, *height) {
                path.push_rect(rect);
            }
            false
        }
        Mark::Line { from, to, .. } => {
            path.move_to(from.0, from.1);
            path.line_to(to.0, to.1);
            false
        }
    };
    let (Mark::Text { grey, .. }
    | Mark::Disc { grey, .. }
    | Mark::Frame { grey, .. }
    | Mark::Line { grey, .. }) = mark;
    surface.set_fill(fill(*grey).filter(|_| is_filled));
    surface.set_stroke(stroke(*grey).filter(|_| !is_filled));
    if let Some(path) = path.finish() {
        surface.draw_path(&path);
    }
}

fn circle(path: &mut PathBuilder, (x, y): (f32, f32), r: f32) {
    let c = r * QUARTER;
    path.move_to(x + r, y);
    path.cubic_to(x + r, y + c, x + c, y + r, x, y + r);
    path.cubic_to(x - c, y + r, x - r, y + c, x - r, y);
    path.cubic_to(x - r, y - c, x - c, y - r, x, y - r);
    path.cubic_to(x + c, y - r, x + r, y - c, x + r, y);
    path.close();
}
