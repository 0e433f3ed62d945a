//! Measures the area of a letter: which points are inside, how thick its strokes are, and where their middle is.

use lightbots_base::Vec2;

use crate::drawing::FillRule;
use crate::geometry::{bounds, contains, edges};

/// Corners of a rectangle: the one with the smaller, then the one with the larger x and y.
pub(super) type Extent = (Vec2, Vec2);

/// A separate part of a letter is a dot if its width and height are below this, in cap heights.
const BLOB_MAX: f64 = 0.4;

/// Area of a letter, given by rings that may overlap. Points with a winding number other than 0 are inside.
pub(super) struct LetterArea<'a> {
    rings: &'a [Vec<Vec2>],
    /// Mean width of the letter's strokes, in cap heights.
    pub(super) stem: f64,
    /// Smallest rectangle around the letter.
    pub(super) extent: Extent,
}

impl<'a> LetterArea<'a> {
    /// Returns the area inside rings. `None` if they enclose no area.
    pub(super) fn new(rings: &'a [Vec<Vec2>]) -> Option<Self> {
        let extent = bounds(rings.iter().flatten())?;
        let mut region = Self { rings, stem: 0.0, extent };
        let area = region.edges().map(|(a, b)| a.cross(b)).sum::<f64>().abs() / 2.0;
        let length: f64 = region.edges().map(|(a, b)| a.distance(b)).sum();
        // A long stroke of width w and length l has the area w·l and the outline 2·l.
        region.stem = 2.0 * area / length;
        (region.stem > 0.0).then_some(region)
    }

    /// Returns the boxes around separate small parts (dots), the lowest first, and the box around all other parts. A
    /// hole belongs to the part around it.
    pub(super) fn blobs(&self) -> (Vec<Extent>, Option<Extent>) {
        let boxes: Vec<Extent> = self.rings.iter().filter_map(|ring| bounds(ring.iter())).collect();
        let within = |a: &Extent, b: &Extent| {
            a != b && a.0.x >= b.0.x && a.0.y >= b.0.y && a.1.x <= b.1.x && a.1.y <= b.1.y
        };
        let outer = boxes.iter().filter(|inner| !boxes.iter().any(|outer| within(inner, outer)));
        let small = |extent: &Extent| (extent.1 - extent.0).x.max((extent.1 - extent.0).y) < BLOB_MAX;
        let (mut blobs, rest): (Vec<Extent>, Vec<Extent>) = outer.copied().partition(small);
        blobs.sort_by(|a, b| a.0.y.total_cmp(&b.0.y));
        (blobs, bounds(rest.iter().flat_map(|(low, high)| [low, high])))
    }

    /// Number of its points.
    pub(super) fn points(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// Its edges.
    pub(super) fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        edges(self.rings)
    }

    /// Whether a point is inside.
    pub(super) fn contains(&self, point: Vec2) -> bool {
        contains(self.rings, FillRule::NonZero, point)
    }

    /// Distance of a point from the outline.
    pub(super) fn distance(&self, point: Vec2) -> f64 {
        self.edges().map(|(a, b)| distance(point, a, b)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the signed distance from a point, along `direction`, to the middle of the nearest stroke. `None` if
    /// there is no middle within one stroke width.
    pub(super) fn middle(&self, point: Vec2, direction: Vec2) -> Option<f64> {
        let mut hits: Vec<f64> = self.edges().filter_map(|(a, b)| hit(point, direction, a, b)).collect();
        hits.sort_by(f64::total_cmp);
        let strokes = hits.windows(2).filter_map(|pair| match pair {
            [low, high] if high - low <= STROKE_MAX * self.stem => Some((low + high) / 2.0),
            _ => None,
        });
        let near =
            strokes.filter(|middle| middle.abs() <= self.stem && self.contains(point + direction * *middle));
        near.min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }
}

/// Longest cut across a stroke, in stroke widths. A longer cut runs along a stroke or through a joint, so that its
/// middle is not the middle of a stroke.
const STROKE_MAX: f64 = 1.7;

fn hit(point: Vec2, direction: Vec2, a: Vec2, b: Vec2) -> Option<f64> {
    let (from, to) = (direction.cross(a - point), direction.cross(b - point));
    if (from < 0.0) == (to < 0.0) {
        return None;
    }
    Some(direction.dot(a.lerp(b, from / (from - to)) - point))
}

/// Distance of a point from the straight segment between `a` and `b`.
pub(super) fn distance(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let share = ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance(if share.is_finite() { a.lerp(b, share) } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar() -> Vec<Vec<Vec2>> {
        vec![[(0.0, 0.0), (0.2, 0.0), (0.2, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec()]
    }

    #[test]
    fn a_bar_knows_its_width_and_middle() {
        let rings = bar();
        let region = LetterArea::new(&rings).unwrap();
        assert!((region.stem - 0.2 / 1.2).abs() < 1e-12);
        assert!(region.contains(Vec2::new(0.1, 0.5)) && !region.contains(Vec2::new(0.3, 0.5)));
        let to_middle = region.middle(Vec2::new(0.05, 0.5), Vec2::new(1.0, 0.0)).unwrap();
        assert!((to_middle - 0.05).abs() < 1e-12);
        assert_eq!(region.middle(Vec2::new(0.1, 0.5), Vec2::new(0.0, 1.0)), None);
    }
}
