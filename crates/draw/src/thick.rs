//! Widens lines to bands, if there are more robots than fit in a single row along the lines.

use core::f64::consts::PI;

use lightbots_base::Vec2;

use crate::drawing::{Area, DrawingPart, FillRule, Stroke};
use crate::geometry::{hexagonal_area, hexagonal_count};

/// Number of segments of the half circle at each end of a band.
const ROUND: usize = 6;

/// Places of a filling may be as close as this, in ideal spacings. Bands are made wide enough that robots keep the
/// wanted distance nevertheless.
const NEAREST: f64 = 0.85;

/// Share of the places along lines that can be used. Where lines meet, places of one line are too close to places of
/// the other.
const USABLE: f64 = 0.8;

/// What lines, or the bands that replace them, must hold.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BandLoad {
    /// Number of robots.
    pub robots: usize,
    /// Least distance between robots, in units of the drawing.
    pub spacing: f64,
    /// Total length of the lines.
    pub length: f64,
    /// Total size of the areas, which hold robots as well.
    pub area: f64,
}

impl BandLoad {
    /// Returns the width of bands that hold all robots, in units of the drawing. `None` if the lines hold all robots as
    /// they are, or if there are no lines.
    pub fn width(&self) -> Option<f64> {
        let ideal = self.spacing / NEAREST;
        let on_lines = USABLE * self.length / self.spacing;
        if self.length <= 0.0 || self.robots as f64 <= on_lines + hexagonal_count(self.area, ideal) {
            return None;
        }
        Some((hexagonal_area(self.robots, ideal) - self.area) / self.length)
    }
}

/// Returns a part whose strokes are replaced by bands of this width.
pub(crate) fn thickened(part: &DrawingPart, width: f64) -> DrawingPart {
    let areas = part.strokes.iter().map(|stroke| band(stroke, width)).collect();
    DrawingPart { areas, strokes: Vec::new(), spine: part.strokes.clone(), ..part.clone() }
}

fn band(stroke: &Stroke, width: f64) -> Area {
    let ends = stroke.points.first().filter(|_| stroke.closed);
    let points: Vec<Vec2> = stroke.points.iter().chain(ends).copied().collect();
    let rings = points.windows(2).map(|pair| around(pair[0], pair[1], width / 2.0)).collect();
    Area { rings, rule: FillRule::NonZero, ink: stroke.ink.clone(), weight: stroke.weight }
}

/// Returns the outline of all points within `reach` of a straight segment, counter-clockwise.
fn around(from: Vec2, to: Vec2, reach: f64) -> Vec<Vec2> {
    let along = (to - from).angle();
    let cap = |center: Vec2, first: f64| {
        (0..=ROUND).map(move |step| center + Vec2::unit(first + PI * step as f64 / ROUND as f64) * reach)
    };
    cap(to, along - PI / 2.0).chain(cap(from, along + PI / 2.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coverage::samples;
    use lightbots_base::Rgb;

    fn load(robots: usize) -> BandLoad {
        BandLoad { robots, spacing: 0.1, length: 2.0, area: 0.0 }
    }

    #[test]
    fn lines_with_room_stay_lines() {
        assert_eq!(load(16).width(), None);
        assert!(load(30).width().is_some_and(|width| width > 0.1));
        let more = load(60).width().unwrap_or_default() / load(30).width().unwrap_or(1.0);
        assert!((more - 2.0).abs() < 1e-9);
        assert_eq!(BandLoad { length: 0.0, ..load(30) }.width(), None);
    }

    #[test]
    fn a_band_covers_its_line_and_no_more() {
        let points = vec![Vec2::ZERO, Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0)];
        let stroke = Stroke { points, closed: false, ink: Rgb::BLACK.into(), weight: 1.0 };
        let part = DrawingPart { strokes: vec![stroke], ..DrawingPart::default() };
        let mass: f64 = samples(&thickened(&part, 0.2), 0.01).iter().map(|sample| sample.mass).sum();
        // Two bands of 1 × 0.2 without their overlap, a quarter of a disc at the corner, half a disc at each end.
        let exact = 0.4 - 0.01 + PI * 0.01 / 4.0 + PI * 0.01;
        assert!((mass - exact).abs() < 0.01, "{mass} {exact}");
    }
}
