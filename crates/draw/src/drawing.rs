//! Drawings: lines and areas with colours that robots are to show, independent of the number of robots.

use lightbots_base::{Rgb, Vec2};

use crate::geometry::bounds;
use crate::ink::Ink;

pub use crate::geometry::FillRule;

/// A drawing in units of its own, x to the right and y up. Its size and place on the floor are chosen later.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The parts, each with robots of its own if there are enough. Examples: the letters of a word, or the whole of a
    /// picture.
    pub parts: Vec<DrawingPart>,
}

/// A part of a drawing. The robots of one part are spread over its lines and areas, more densely where the weight is
/// larger.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingPart {
    /// Name of the part, unique in its drawing.
    pub name: String,
    /// The letter that the part shows, if it shows a letter: readability is then measured as that of a letter.
    pub letter: Option<char>,
    /// Areas to outline or to fill.
    pub areas: Vec<Area>,
    /// Lines along which robots stand.
    pub strokes: Vec<Stroke>,
    /// Lines that can replace the areas when there are few robots, such as the single strokes of a letter. Empty if
    /// there are none.
    pub spine: Vec<Stroke>,
    /// Colours and weights of a picture. If present, areas and strokes take their colours from the picture. In a part
    /// without areas and strokes, its weights set how densely robots stand.
    pub raster: Option<Raster>,
}

/// A filled area.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Closed lines; the first point is not repeated at the end.
    pub rings: Vec<Vec<Vec2>>,
    /// Which points count as inside where rings overlap.
    pub rule: FillRule,
    /// Colours of its lights.
    pub ink: Ink,
    /// How densely robots fill the area, relative to other areas; positive.
    pub weight: f64,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Points along the line, at least two, joined by straight segments.
    pub points: Vec<Vec2>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
    /// Colours of its lights.
    pub ink: Ink,
    /// How densely robots stand along the line, relative to other lines; positive.
    pub weight: f64,
}

/// A picture as a grid of cells, row by row from the picture's top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Corners of the rectangle that the picture covers, in this order of the picture's own corners: bottom left, bottom
    /// right, top right, top left. The rectangle may be turned.
    pub corners: [Vec2; 4],
    /// Number of cells in a row.
    pub columns: usize,
    /// Colours of the cells, `columns` of them for each row.
    pub colors: Vec<Rgb>,
    /// How densely robots stand in each cell, in the order of `colors`: 0 is empty, 1 is densest.
    pub weights: Vec<f32>,
}

impl Raster {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.colors.len().checked_div(self.columns).unwrap_or(0)
    }

    /// The picture's top left corner, and the two sides from there: along the top, and along the left edge.
    pub fn axes(&self) -> [Vec2; 3] {
        let [bottom_left, _, top_right, top_left] = self.corners;
        [top_left, top_right - top_left, bottom_left - top_left]
    }

    /// Returns the index of the cell at a place, or of the nearest cell if the place is outside the picture. `None` for
    /// an empty picture.
    pub fn cell(&self, at: Vec2) -> Option<usize> {
        let rows = self.rows();
        if rows == 0 {
            return None;
        }
        let [top_left, across, down] = self.axes();
        let share = |side: Vec2| ((at - top_left).dot(side) / side.dot(side)).clamp(0.0, 1.0);
        let column = (share(across) * self.columns as f64) as usize;
        let row = (share(down) * rows as f64) as usize;
        Some(row.min(rows - 1) * self.columns + column.min(self.columns - 1))
    }
}

impl DrawingPart {
    /// All points of the part's lines and areas, and the corners of its picture.
    pub fn points(&self) -> impl Iterator<Item = &Vec2> {
        let areas = self.areas.iter().flat_map(|area| area.rings.iter().flatten());
        let strokes = self.strokes.iter().chain(&self.spine).flat_map(|stroke| &stroke.points);
        let corners = self.raster.iter().flat_map(|raster| &raster.corners);
        areas.chain(strokes).chain(corners)
    }
}

impl Drawing {
    /// All points of all parts.
    pub fn points(&self) -> impl Iterator<Item = &Vec2> {
        self.parts.iter().flat_map(DrawingPart::points)
    }

    /// Returns the smallest rectangle with sides along the axes around all parts: its corners with the smaller and the
    /// larger x and y. `None` if the drawing has no points.
    pub fn bounds(&self) -> Option<(Vec2, Vec2)> {
        bounds(self.points())
    }
}
