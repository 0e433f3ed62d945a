//! Finds the colour of a drawing at a place.

use lightbots_base::shape::point_to_segment;
use lightbots_base::{Rgb, Vec2};

use crate::drawing::{Area, DrawingPart, Stroke};
use crate::geometry::{contains, edges};

/// Finds the colours of one part of a drawing.
pub(crate) struct Paint<'a> {
    part: &'a DrawingPart,
    /// The colour of the whole part; `None` if the part has several colours, a gradient or a picture, or has neither
    /// areas nor strokes.
    single: Option<Rgb>,
}

impl<'a> Paint<'a> {
    /// Colours of a part.
    pub fn new(part: &'a DrawingPart) -> Self {
        let mut inks =
            part.areas.iter().map(|area| &area.ink).chain(part.strokes.iter().map(|stroke| &stroke.ink));
        let first = inks.next().filter(|first| first.gradient.is_none());
        let single = first.filter(|first| part.raster.is_none() && inks.all(|ink| ink == *first));
        let single = single.map(|ink| ink.color);
        Self { part, single }
    }

    /// Returns the colour at a place. A picture comes first, then the last area that covers the place. Outside all
    /// areas it is the colour of the nearest area or line. An empty part is white.
    pub fn at(&self, at: Vec2) -> Rgb {
        if let Some(color) = self.single {
            return color;
        }
        let picture = self.part.raster.as_ref();
        if let Some(color) = picture.and_then(|raster| raster.colors.get(raster.cell(at)?)) {
            return *color;
        }
        let cover = self.part.areas.iter().rev().find(|area| contains(&area.rings, area.rule, at));
        let areas = self.part.areas.iter().map(|area| (&area.ink, to_area(area, at)));
        let strokes = self.part.strokes.iter().chain(&self.part.spine).map(|s| (&s.ink, to_stroke(s, at)));
        let nearest = areas.chain(strokes).min_by(|a, b| a.1.total_cmp(&b.1));
        let ink = cover.map(|area| &area.ink).or(nearest.map(|(ink, _)| ink));
        ink.map_or(Rgb::new(255, 255, 255), |ink| ink.at(at))
    }
}

fn to_area(area: &Area, at: Vec2) -> f64 {
    edges(&area.rings).map(|(a, b)| point_to_segment(at, a, b)).fold(f64::INFINITY, f64::min)
}

fn to_stroke(stroke: &Stroke, at: Vec2) -> f64 {
    stroke.points.windows(2).map(|pair| point_to_segment(at, pair[0], pair[1])).fold(f64::INFINITY, f64::min)
}
