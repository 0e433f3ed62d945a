//! Areas of a page, and what is left of them under others.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::clip::FloatClip;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::string::clip::ClipRule;

use crate::drawing::FillRule as Rule;
use crate::svg::flatten::{FlatLine, Spot, distance};

/// An area that is not empty: outer rings run one way, holes the other.
#[derive(Clone, Debug)]
pub struct Region {
    rings: Vec<Vec<Spot>>,
    low: Spot,
    high: Spot,
}

impl Region {
    /// The area inside of rings. `None`: it is thinner than `thinnest`, in units of the page.
    pub fn new(rings: &Vec<Vec<Spot>>, rule: Rule, thinnest: f64) -> Option<Self> {
        let rule = match rule {
            Rule::NonZero => FillRule::NonZero,
            Rule::EvenOdd => FillRule::EvenOdd,
        };
        Self::from_shapes(rings.simplify_shape(rule), thinnest)
    }

    /// A rectangle between its corners with the smaller and the larger coordinates.
    pub fn rectangle(low: Spot, high: Spot) -> Self {
        Self { rings: vec![vec![low, [high[0], low[1]], high, [low[0], high[1]]]], low, high }
    }

    fn from_shapes(shapes: Vec<Vec<Vec<Spot>>>, thinnest: f64) -> Option<Self> {
        let thick = |shape: &Vec<Vec<Spot>>| {
            let edge: f64 = shape.iter().map(|ring| perimeter(ring)).sum();
            shape.iter().map(|ring| signed_area(ring)).sum::<f64>().abs() > edge * 0.5 * thinnest
        };
        let rings: Vec<Vec<Spot>> = shapes.into_iter().filter(thick).flatten().collect();
        let (low, high) = bounds(rings.iter().flatten())?;
        Some(Self { rings, low, high })
    }

    /// Its rings, to be filled by [`Rule::NonZero`].
    pub fn rings(&self) -> &[Vec<Spot>] {
        &self.rings
    }

    /// Its corners with the smaller and the larger coordinates.
    pub fn bounds(&self) -> (Spot, Spot) {
        (self.low, self.high)
    }

    /// Square units of the page.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| signed_area(ring)).sum::<f64>().abs()
    }

    /// Number of points of its rings.
    pub fn points(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// Whether the rectangles around two areas overlap.
    pub fn is_near(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    /// Whether it is a rectangle along the axes with all of a box inside.
    pub fn frames(&self, low: Spot, high: Spot) -> bool {
        let on_edge =
            |spot: &Spot| (0..2).all(|axis| spot[axis] == self.low[axis] || spot[axis] == self.high[axis]);
        let rectangle =
            self.rings.len() == 1 && self.rings[0].len() == 4 && self.rings[0].iter().all(on_edge);
        rectangle && (0..2).all(|axis| self.low[axis] <= low[axis] && high[axis] <= self.high[axis])
    }

    /// What is in this area and not in the other.
    pub fn minus(&self, other: &Self, thinnest: f64) -> Option<Self> {
        self.overlaid(other, OverlayRule::Difference, thinnest)
    }

    /// What is in both areas.
    pub fn common(&self, other: &Self, thinnest: f64) -> Option<Self> {
        self.overlaid(other, OverlayRule::Intersect, thinnest)
    }

    /// What is in one of the areas.
    pub fn joined(&self, other: &Self, thinnest: f64) -> Option<Self> {
        self.overlaid(other, OverlayRule::Union, thinnest)
    }

    /// What is in any of several areas.
    pub fn all(regions: &[Self], thinnest: f64) -> Option<Self> {
        if let [only] = regions {
            return Some(only.clone());
        }
        let rings: Vec<Vec<Spot>> = regions.iter().flat_map(|region| region.rings.iter().cloned()).collect();
        Self::new(&rings, Rule::NonZero, thinnest)
    }

    fn overlaid(&self, other: &Self, rule: OverlayRule, thinnest: f64) -> Option<Self> {
        Self::from_shapes(self.rings.overlay(&other.rings, rule, FillRule::NonZero), thinnest)
    }

    /// The parts of a line that are inside or outside of the area, at least as long as `shortest`.
    pub fn parts(&self, line: &FlatLine, inside: bool, shortest: f64) -> Vec<FlatLine> {
        let mut path = line.points.clone();
        if line.closed {
            path.extend(line.points.first());
        }
        let whole = length(&path);
        let rule = ClipRule { invert: !inside, boundary_included: inside };
        let parts = vec![path].clip_by(&self.rings, FillRule::NonZero, rule);
        let parts: Vec<Vec<Spot>> = parts.into_iter().filter(|part| part.len() >= 2).collect();
        let kept: f64 = parts.iter().map(|part| length(part)).sum();
        if kept > whole * 0.999 {
            return vec![line.clone()];
        }
        let long = parts.into_iter().filter(|part| length(part) >= shortest);
        long.map(|points| FlatLine { points, closed: false }).collect()
    }
}

/// The corners of the box around points.
pub fn bounds<'a>(points: impl IntoIterator<Item = &'a Spot>) -> Option<(Spot, Spot)> {
    points.into_iter().map(|spot| (*spot, *spot)).reduce(|(low, high), (spot, _)| {
        ([low[0].min(spot[0]), low[1].min(spot[1])], [high[0].max(spot[0]), high[1].max(spot[1])])
    })
}

/// Length of an open line.
pub fn length(points: &[Spot]) -> f64 {
    points.iter().zip(points.iter().skip(1)).map(|(a, b)| distance(*a, *b)).sum()
}

fn perimeter(ring: &[Spot]) -> f64 {
    length(ring) + ring.first().zip(ring.last()).map_or(0.0, |(a, b)| distance(*a, *b))
}

fn signed_area(ring: &[Spot]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Region {
        Region::rectangle([x, y], [x + side, y + side])
    }

    #[test]
    fn areas_are_cut_by_others() {
        let big = square(0.0, 0.0, 10.0);
        let hole = square(2.0, 2.0, 4.0);
        let area = |region: Option<Region>| region.map(|region| (region.area() * 1e3).round() / 1e3);
        assert_eq!(area(big.minus(&hole, 0.01)), Some(84.0));
        assert_eq!(area(big.common(&square(8.0, 8.0, 10.0), 0.01)), Some(4.0));
        assert_eq!(area(big.joined(&square(10.0, 0.0, 10.0), 0.01)), Some(200.0));
        assert_eq!(area(hole.minus(&big, 0.01)), None);
        let sliver = Region::rectangle([0.0, 0.0], [10.0, 9.995]);
        assert_eq!(area(big.minus(&sliver, 0.01)), None);
    }

    #[test]
    fn lines_are_cut_by_areas() {
        let line = FlatLine { points: vec![[-5.0, 5.0], [15.0, 5.0]], closed: false };
        let region = square(0.0, 0.0, 10.0);
        let ends = |inside: bool| {
            let mut parts: Vec<(i64, i64)> = region
                .parts(&line, inside, 0.1)
                .iter()
                .map(|part| (part.points[0][0].round() as i64, part.points[1][0].round() as i64))
                .collect();
            parts.sort_unstable();
            parts
        };
        assert_eq!(ends(true), [(0, 10)]);
        assert_eq!(ends(false), [(-5, 0), (10, 15)]);
        let ring = FlatLine { points: vec![[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]], closed: true };
        assert_eq!(region.parts(&ring, true, 0.1), std::slice::from_ref(&ring));
        assert!(region.parts(&ring, false, 0.1).is_empty());
    }

    #[test]
    fn the_rule_decides_about_holes() {
        let rings = vec![square(0.0, 0.0, 10.0).rings[0].clone(), square(2.0, 2.0, 4.0).rings[0].clone()];
        let area = |rule: Rule| Region::new(&rings, rule, 0.01).map(|region| region.area().round());
        assert_eq!(area(Rule::NonZero), Some(100.0));
        assert_eq!(area(Rule::EvenOdd), Some(84.0));
    }
}
