//! Areas of a page, and their differences, intersections and unions.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::clip::FloatClip;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::string::clip::ClipRule;

use lightbots_base::random::split_mix;

use crate::drawing::FillRule as Rule;
use crate::svg::flatten::{FlatLine, Spot, distance};

/// An area that is not empty. Its outer rings run in one direction, the rings of its holes in the other.
#[derive(Clone, Debug)]
pub struct Region {
    rings: Vec<Vec<Spot>>,
    low: Spot,
    high: Spot,
}

/// Areas are cut only if the estimated number of crossings between their lines is at most this. Each crossing takes
/// memory and time.
const CROSSINGS_MAX: f64 = 1e5;
/// Fewer lines than this have fewer than [`CROSSINGS_MAX`] pairs, and therefore cannot have too many crossings.
const LINES_FEW: usize = 440;
/// Least and largest number of random pairs of lines from which the number of crossings is estimated.
const SAMPLES: [f64; 2] = [100.0, 200_000.0];
/// Number of crossings expected among the random pairs if there are [`CROSSINGS_MAX`] in all. It sets how many pairs
/// are drawn.
const HITS: f64 = 20.0;

impl Region {
    /// Returns the area inside rings, without parts thinner than `thinnest`, in units of the page. `None` if nothing is
    /// left, or if the lines of the rings cross too often.
    pub fn new(rings: &Vec<Vec<Spot>>, rule: Rule, thinnest: f64) -> Option<Self> {
        let rule = match rule {
            Rule::NonZero => FillRule::NonZero,
            Rule::EvenOdd => FillRule::EvenOdd,
        };
        if is_tangled(rings, &[]) {
            return None;
        }
        Self::from_shapes(rings.simplify_shape(rule), thinnest)
    }

    /// Makes a rectangle from its corners with the smaller and the larger coordinates.
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

    /// The rings of the area. Points with a winding number other than 0 are inside ([`Rule::NonZero`]).
    pub fn rings(&self) -> &[Vec<Spot>] {
        &self.rings
    }

    /// Corners of the box around the area, with the smaller and the larger coordinates.
    pub fn bounds(&self) -> (Spot, Spot) {
        (self.low, self.high)
    }

    /// Size of the area, square units of the page.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| signed_area(ring)).sum::<f64>().abs()
    }

    /// Number of points of all rings.
    pub fn points(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// Whether the boxes around two areas overlap.
    pub fn is_near(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    /// Whether the area is a rectangle with sides along the axes that contains the whole box from `low` to `high`.
    pub fn frames(&self, low: Spot, high: Spot) -> bool {
        let on_edge =
            |spot: &Spot| (0..2).all(|axis| spot[axis] == self.low[axis] || spot[axis] == self.high[axis]);
        let rectangle =
            self.rings.len() == 1 && self.rings[0].len() == 4 && self.rings[0].iter().all(on_edge);
        rectangle && (0..2).all(|axis| self.low[axis] <= low[axis] && high[axis] <= self.high[axis])
    }

    /// Returns the part of this area that is not in the other. `None` if nothing is left that is at least `thinnest`
    /// thick. If the lines of both cross too often, returns this area unchanged.
    pub fn minus(&self, other: &Self, thinnest: f64) -> Option<Self> {
        self.overlaid(other, OverlayRule::Difference, thinnest)
    }

    /// Returns the part that is in both areas. `None` if nothing is at least `thinnest` thick. If the lines of both
    /// cross too often, returns this area unchanged.
    pub fn common(&self, other: &Self, thinnest: f64) -> Option<Self> {
        self.overlaid(other, OverlayRule::Intersect, thinnest)
    }

    /// Returns the union of both areas. `None` if nothing is at least `thinnest` thick. If the lines of both cross too
    /// often, returns this area unchanged.
    pub fn joined(&self, other: &Self, thinnest: f64) -> Option<Self> {
        self.overlaid(other, OverlayRule::Union, thinnest)
    }

    /// Returns the union of several areas. `None` if they are empty, or if their lines cross too often.
    pub fn all(regions: &[Self], thinnest: f64) -> Option<Self> {
        if let [only] = regions {
            return Some(only.clone());
        }
        let rings: Vec<Vec<Spot>> = regions.iter().flat_map(|region| region.rings.iter().cloned()).collect();
        Self::new(&rings, Rule::NonZero, thinnest)
    }

    /// Combines both areas by a rule. If their lines cross too often, returns this area unchanged.
    fn overlaid(&self, other: &Self, rule: OverlayRule, thinnest: f64) -> Option<Self> {
        if is_tangled(&self.rings, &other.rings) {
            return Some(self.clone());
        }
        Self::from_shapes(self.rings.overlay(&other.rings, rule, FillRule::NonZero), thinnest)
    }

    /// Returns the parts of a line inside the area (or, if `inside` is false, outside) that are at least `shortest`
    /// long. A line of which nearly all would be returned, or that crosses too often, is returned unchanged.
    pub fn parts(&self, line: &FlatLine, inside: bool, shortest: f64) -> Vec<FlatLine> {
        let mut path = line.points.clone();
        if line.closed {
            path.extend(line.points.first());
        }
        let path = vec![path];
        if is_tangled(&path, &self.rings) {
            return vec![line.clone()];
        }
        let whole = path.iter().map(|path| length(path)).sum::<f64>();
        let rule = ClipRule { invert: !inside, boundary_included: inside };
        let parts = path.clip_by(&self.rings, FillRule::NonZero, rule);
        let parts: Vec<Vec<Spot>> = parts.into_iter().filter(|part| part.len() >= 2).collect();
        let kept: f64 = parts.iter().map(|part| length(part)).sum();
        if kept > whole * 0.999 {
            return vec![line.clone()];
        }
        let long = parts.into_iter().filter(|part| length(part) >= shortest);
        long.map(|points| FlatLine { points, closed: false }).collect()
    }
}

/// Whether the lines of the rings cross each other too often, estimated from random pairs of lines.
fn is_tangled(first: &[Vec<Spot>], second: &[Vec<Spot>]) -> bool {
    let count = first.iter().chain(second).map(Vec::len).sum::<usize>();
    if count < LINES_FEW {
        return false;
    }
    let ends = |ring: &Vec<Spot>| {
        let next = ring.iter().cycle().skip(1).copied();
        ring.iter().copied().zip(next).collect::<Vec<(Spot, Spot)>>()
    };
    let lines: Vec<(Spot, Spot)> = first.iter().chain(second).flat_map(ends).collect();
    let pairs = count as f64 * count as f64 / 2.0;
    let samples = (pairs / CROSSINGS_MAX * HITS).clamp(SAMPLES[0], SAMPLES[1]);
    let mut state = count as u64;
    let mut any = || lines[(split_mix(&mut state) % count as u64) as usize];
    let crossing = (0..samples as usize).filter(|_| cross(any(), any())).count();
    crossing as f64 / samples * pairs > CROSSINGS_MAX
}

/// Whether two line segments cross between their ends.
fn cross(a: (Spot, Spot), b: (Spot, Spot)) -> bool {
    let side = |line: (Spot, Spot), point: Spot| {
        let (from, to) = line;
        (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0])
    };
    side(a, b.0) * side(a, b.1) < 0.0 && side(b, a.0) * side(b, a.1) < 0.0
}

/// Corners of the box around points. `None` if there are no points.
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
    fn tangles_are_not_cut() {
        let scribble = |points: usize| {
            let mut state = 25;
            let mut unit = || split_mix(&mut state) as f64 / u64::MAX as f64;
            vec![(0..points).map(|_| [unit(), unit()]).collect::<Vec<Spot>>()]
        };
        assert!(Region::new(&scribble(600), Rule::NonZero, 1e-4).is_some());
        assert!(Region::new(&scribble(100_000), Rule::NonZero, 1e-4).is_none());
        let comb = |swapped: bool| {
            let tooth = |n: usize| {
                let (low, high) = (n as f64, n as f64 + 0.5);
                let point = |x: f64, y: f64| if swapped { [y, x] } else { [x, y] };
                vec![point(low, 0.0), point(high, 0.0), point(high, 20_000.0), point(low, 20_000.0)]
            };
            let rings: Vec<Vec<Spot>> = (0..20_000).map(tooth).collect();
            Region::new(&rings, Rule::EvenOdd, 1e-4).expect("its teeth do not cross")
        };
        let (first, second) = (comb(false), comb(true));
        assert_eq!(first.minus(&second, 1e-4).map(|rest| rest.points()), Some(first.points()));
    }

    #[test]
    fn the_rule_decides_about_holes() {
        let rings = vec![square(0.0, 0.0, 10.0).rings[0].clone(), square(2.0, 2.0, 4.0).rings[0].clone()];
        let area = |rule: Rule| Region::new(&rings, rule, 0.01).map(|region| region.area().round());
        assert_eq!(area(Rule::NonZero), Some(100.0));
        assert_eq!(area(Rule::EvenOdd), Some(84.0));
    }
}
