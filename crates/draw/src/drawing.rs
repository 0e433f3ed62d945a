//! What robots are to show: lines and areas with colours, before anybody knows how many robots there are.

use lightbots_base::{Rgb, Vec2};

use crate::geometry::bounds;
use crate::ink::Ink;

pub use crate::geometry::FillRule;

/// A drawing in units of its own, x to the right and y up. Its size and place on the floor are chosen later.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Parts that get robots of their own: the letters of a word, or the whole of a picture.
    pub parts: Vec<DrawingPart>,
}

/// A part of a drawing. Robots of one part are spread evenly over all of its lines and areas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingPart {
    /// Name for people and for pins; unique in its drawing.
    pub name: String,
    /// The letter that the part is, for the measure of readability.
    pub letter: Option<char>,
    /// Areas to be outlined or filled.
    pub areas: Vec<Area>,
    /// Lines to be followed.
    pub strokes: Vec<Stroke>,
    /// Lines that stand for the areas where robots are few, such as the single strokes of a letter. Empty: there are none.
    pub spine: Vec<Stroke>,
    /// Colours and weights of a picture. Areas and strokes take their colours from it where it is given; without areas and
    /// strokes robots are spread by its weights.
    pub raster: Option<Raster>,
}

/// A filled area.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Closed lines, without repetition of their first point.
    pub rings: Vec<Vec<Vec2>>,
    /// What is inside where rings overlap.
    pub rule: FillRule,
    /// Colours of its lights.
    pub ink: Ink,
    /// How densely it is filled, relative to the others; positive.
    pub weight: f64,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Points along it, at least two, straight in between.
    pub points: Vec<Vec2>,
    /// Whether its last point is joined to its first.
    pub closed: bool,
    /// Colours of its lights.
    pub ink: Ink,
    /// How densely it is occupied, relative to the others; positive.
    pub weight: f64,
}

/// A picture as a grid of cells, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Corner with the smaller x and y.
    pub min: Vec2,
    /// Corner with the larger x and y.
    pub max: Vec2,
    /// Cells in a row.
    pub columns: usize,
    /// Colours, `columns` for each row.
    pub colors: Vec<Rgb>,
    /// How densely robots stand in each cell: 0 is empty, 1 is densest.
    pub weights: Vec<f32>,
}

impl Raster {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.colors.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Index of the cell at a place; the nearest cell outside of the picture; `None` for an empty picture.
    pub fn cell(&self, at: Vec2) -> Option<usize> {
        let rows = self.rows();
        if rows == 0 {
            return None;
        }
        let share = |value: f64, from: f64, to: f64| ((value - from) / (to - from)).clamp(0.0, 1.0);
        let column = (share(at.x, self.min.x, self.max.x) * self.columns as f64) as usize;
        let row = (share(at.y, self.max.y, self.min.y) * rows as f64) as usize;
        Some(row.min(rows - 1) * self.columns + column.min(self.columns - 1))
    }
}

impl DrawingPart {
    /// All points of its lines and areas, and the corners of its picture.
    pub fn points(&self) -> impl Iterator<Item = &Vec2> {
        let areas = self.areas.iter().flat_map(|area| area.rings.iter().flatten());
        let strokes = self.strokes.iter().chain(&self.spine).flat_map(|stroke| &stroke.points);
        let corners = self.raster.iter().flat_map(|raster| [&raster.min, &raster.max]);
        areas.chain(strokes).chain(corners)
    }
}

impl Drawing {
    /// All points of all parts.
    pub fn points(&self) -> impl Iterator<Item = &Vec2> {
        self.parts.iter().flat_map(DrawingPart::points)
    }

    /// The smallest rectangle around everything: its corners with the smaller and the larger x and y. `None`: empty.
    pub fn bounds(&self) -> Option<(Vec2, Vec2)> {
        bounds(self.points())
    }
}
