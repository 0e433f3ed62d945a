//! The colour of a drawing at a place.

use lightbots_base::shape::point_to_segment;
use lightbots_base::{Rgb, Vec2};

use crate::drawing::{Area, DrawingPart, FillRule, Stroke};

/// Colours of a group.
pub(crate) struct Paint<'a> {
    group: &'a DrawingPart,
    /// The colour, where the group has only one.
    single: Option<Rgb>,
}

impl<'a> Paint<'a> {
    /// Colours of a group.
    pub fn new(group: &'a DrawingPart) -> Self {
        let mut colors = group.areas.iter().map(|a| a.color).chain(group.strokes.iter().map(|s| s.color));
        let first = colors.next();
        let single = first.filter(|first| group.raster.is_none() && colors.all(|color| color == *first));
        Self { group, single }
    }

    /// The colour at a place: of the picture, of the last area that covers it, else of what is nearest.
    pub fn at(&self, at: Vec2) -> Rgb {
        if let Some(color) = self.single {
            return color;
        }
        let picture = self.group.raster.as_ref();
        if let Some(color) = picture.and_then(|raster| raster.colors.get(raster.cell(at)?)) {
            return *color;
        }
        let cover = self.group.areas.iter().rev().find(|area| contains(area, at));
        let areas = self.group.areas.iter().map(|area| (area.color, to_area(area, at)));
        let strokes = self.group.strokes.iter().chain(&self.group.spine).map(|s| (s.color, to_stroke(s, at)));
        let nearest = areas.chain(strokes).min_by(|a, b| a.1.total_cmp(&b.1));
        cover.map(|area| area.color).or(nearest.map(|(color, _)| color)).unwrap_or(Rgb::new(255, 255, 255))
    }
}

/// Whether an area contains a point.
pub(crate) fn contains(area: &Area, at: Vec2) -> bool {
    let mut winding = 0;
    for ring in &area.rings {
        for (index, a) in ring.iter().enumerate() {
            let b = ring[(index + 1) % ring.len()];
            if (a.y <= at.y) != (b.y <= at.y) {
                let x = a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y);
                if x > at.x {
                    winding += if a.y < b.y { 1 } else { -1 };
                }
            }
        }
    }
    match area.rule {
        FillRule::NonZero => winding != 0,
        FillRule::EvenOdd => winding % 2 != 0,
    }
}

fn to_area(area: &Area, at: Vec2) -> f64 {
    let edges = area.rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    edges.map(|(a, b)| point_to_segment(at, *a, *b)).fold(f64::INFINITY, f64::min)
}

fn to_stroke(stroke: &Stroke, at: Vec2) -> f64 {
    stroke.points.windows(2).map(|pair| point_to_segment(at, pair[0], pair[1])).fold(f64::INFINITY, f64::min)
}
