//! Computes which share of each cell of a grid an area covers. The cells become weighted samples for the relaxation.

use lightbots_base::Vec2;

use crate::drawing::{Area, DrawingPart, FillRule, Raster};
use crate::geometry::bounds;

/// Number of scan lines in a cell, on which the covered share of the cell is measured. Along each line the share is
/// exact.
const LINES: usize = 4;

/// What is drawn in a cell of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    /// Centroid of what is drawn in the cell.
    pub at: Vec2,
    /// Area of what is drawn in the cell, times the square of the drawing's weight there.
    pub mass: f64,
}

/// What is drawn in a cell: the covered share times the square of the weight. `x` and `y`: its first moments about the
/// cell's lower left corner, in cells.
#[derive(Clone, Copy, Default)]
struct Cell {
    share: f64,
    x: f64,
    y: f64,
}

struct Grid {
    min: Vec2,
    pitch: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
}

/// Returns samples of a part's areas, or of its picture if it has neither areas nor strokes, one for each drawn cell of
/// side `pitch`. Where areas overlap, the later area counts.
pub(crate) fn samples(part: &DrawingPart, pitch: f64) -> Vec<Sample> {
    if part.areas.is_empty() {
        // Strokes with a picture are the outline of the thing in it, which is not to be filled.
        let picture = part.raster.as_ref().filter(|_| part.strokes.is_empty());
        return picture.map_or_else(Vec::new, |raster| of_raster(raster, pitch));
    }
    let points = part.areas.iter().flat_map(|area| area.rings.iter().flatten());
    let Some((min, max)) = bounds(points) else { return Vec::new() };
    let mut grid = Grid::new(min, max, pitch);
    for area in &part.areas {
        grid.cover(area);
    }
    grid.samples()
}

/// Returns samples of a picture. The density of relaxed points grows with the square root of the mass (Gersho 1979).
/// Therefore the mass is the square of the weight, and the density grows with the weight.
fn of_raster(raster: &Raster, pitch: f64) -> Vec<Sample> {
    let [top_left, across, down] = raster.axes();
    let columns = (across.length() / pitch).ceil().max(1.0) as usize;
    let rows = (down.length() / pitch).ceil().max(1.0) as usize;
    let mut samples = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let at = top_left
                + across * ((column as f64 + 0.5) / columns as f64)
                + down * ((row as f64 + 0.5) / rows as f64);
            let weight =
                raster.cell(at).and_then(|cell| raster.weights.get(cell)).map_or(0.0, |w| f64::from(*w));
            if weight > 0.0 {
                samples.push(Sample { at, mass: weight * weight * pitch * pitch });
            }
        }
    }
    samples
}

impl Grid {
    fn new(min: Vec2, max: Vec2, pitch: f64) -> Self {
        let columns = ((max.x - min.x) / pitch) as usize + 1;
        let rows = ((max.y - min.y) / pitch) as usize + 1;
        Self { min, pitch, columns, rows, cells: vec![Cell::default(); columns * rows] }
    }

    /// Draws an area into the grid, over the areas drawn before.
    fn cover(&mut self, area: &Area) {
        let mut shares = vec![Cell::default(); self.cells.len()];
        for (line, crossings) in self.crossings(area).iter().enumerate() {
            for (from, to) in inside(crossings, area.rule) {
                self.add(&mut shares, line, from, to);
            }
        }
        let mass = area.weight * area.weight;
        for (cell, new) in self.cells.iter_mut().zip(shares) {
            let rest = 1.0 - new.share.min(1.0);
            cell.share = cell.share * rest + new.share * mass;
            cell.x = cell.x * rest + new.x * mass;
            cell.y = cell.y * rest + new.y * mass;
        }
    }

    /// Returns for each scan line its crossings with the area's rings. The first value of a crossing is its distance
    /// from the left side of the grid, in cells. The second is 1 if the ring goes up there, −1 if it goes down.
    fn crossings(&self, area: &Area) -> Vec<Vec<(f64, i32)>> {
        let mut lines = vec![Vec::new(); self.rows * LINES];
        let scaled = |point: Vec2| {
            let at = point - self.min;
            Vec2::new(at.x / self.pitch, at.y / self.pitch * LINES as f64 - 0.5)
        };
        for ring in &area.rings {
            for (index, point) in ring.iter().enumerate() {
                let (a, b) = (scaled(*point), scaled(ring[(index + 1) % ring.len()]));
                let (low, high, way) = if a.y < b.y { (a, b, 1) } else { (b, a, -1) };
                let first = low.y.ceil().max(0.0) as usize;
                for (line, crossings) in lines.iter_mut().enumerate().skip(first) {
                    if line as f64 >= high.y {
                        break;
                    }
                    let share = (line as f64 - low.y) / (high.y - low.y);
                    crossings.push((low.x + (high.x - low.x) * share, way));
                }
            }
        }
        lines
    }

    /// Adds a piece of a scan line, from `from` to `to` (in cells from the left), to the cells that it passes.
    fn add(&self, shares: &mut [Cell], line: usize, from: f64, to: f64) {
        let row = line / LINES;
        let y = ((line % LINES) as f64 + 0.5) / LINES as f64;
        let (from, to) = (from.max(0.0), to.min(self.columns as f64));
        let mut column = from as usize;
        while column < self.columns && (column as f64) < to {
            let (left, right) = (from.max(column as f64), to.min(column as f64 + 1.0));
            let share = (right - left) / LINES as f64;
            let cell = &mut shares[row * self.columns + column];
            cell.share += share;
            cell.x += share * ((left + right) / 2.0 - column as f64);
            cell.y += share * y;
            column += 1;
        }
    }

    fn samples(&self) -> Vec<Sample> {
        let drawn = self.cells.iter().enumerate().filter(|(_, cell)| cell.share > 1e-6);
        drawn
            .map(|(index, cell)| {
                let corner = Vec2::new((index % self.columns) as f64, (index / self.columns) as f64);
                let at = corner + Vec2::new(cell.x / cell.share, cell.y / cell.share);
                Sample { at: self.min + at * self.pitch, mass: cell.share * self.pitch * self.pitch }
            })
            .collect()
    }
}

/// Returns the pieces of a scan line that are inside the area: where each begins and ends, in cells from the left.
fn inside(crossings: &[(f64, i32)], rule: FillRule) -> Vec<(f64, f64)> {
    let mut sorted = crossings.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pieces = Vec::new();
    let mut winding = 0;
    for pair in sorted.windows(2) {
        winding += pair[0].1;
        let is_inside = match rule {
            FillRule::NonZero => winding != 0,
            FillRule::EvenOdd => winding % 2 != 0,
        };
        if is_inside && pair[1].0 > pair[0].0 {
            pieces.push((pair[0].0, pair[1].0));
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    fn square(at: f64, side: f64) -> Vec<Vec2> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(x, y)| Vec2::new(at + x * side, at + y * side))
            .to_vec()
    }

    fn total(rings: Vec<Vec<Vec2>>, rule: FillRule) -> f64 {
        let area = Area { rings, rule, ink: Rgb::BLACK.into(), weight: 1.0 };
        samples(&DrawingPart { areas: vec![area], ..DrawingPart::default() }, 0.07)
            .iter()
            .map(|s| s.mass)
            .sum()
    }

    #[test]
    fn the_mass_of_a_square_is_its_area() {
        assert!((total(vec![square(0.013, 1.0)], FillRule::NonZero) - 1.0).abs() < 0.02);
    }

    #[test]
    fn a_hole_is_empty_by_the_even_odd_rule_only() {
        let rings = || vec![square(0.0, 1.0), square(0.25, 0.5)];
        assert!((total(rings(), FillRule::NonZero) - 1.0).abs() < 0.02);
        assert!((total(rings(), FillRule::EvenOdd) - 0.75).abs() < 0.02);
    }

    #[test]
    fn an_area_over_another_counts_once() {
        let area = |at| Area {
            rings: vec![square(at, 1.0)],
            rule: FillRule::NonZero,
            ink: Rgb::BLACK.into(),
            weight: 1.0,
        };
        let part = DrawingPart { areas: vec![area(0.0), area(0.5)], ..DrawingPart::default() };
        let mass: f64 = samples(&part, 0.05).iter().map(|sample| sample.mass).sum();
        assert!((mass - 1.75).abs() < 0.03, "{mass}");
    }

    #[test]
    fn a_sample_at_the_edge_is_the_centroid_of_the_part_inside() {
        let area = Area {
            rings: vec![square(0.0, 1.5)],
            rule: FillRule::NonZero,
            ink: Rgb::BLACK.into(),
            weight: 1.0,
        };
        let samples = samples(&DrawingPart { areas: vec![area], ..DrawingPart::default() }, 1.0);
        let corner = samples.last().unwrap();
        assert!((corner.at.x - 1.25).abs() < 1e-9 && (corner.mass - 0.25).abs() < 1e-9, "{corner:?}");
    }
}
