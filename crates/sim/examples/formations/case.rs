//! The cases of the sweep: every shape, number of robots, spacing and distance from the starting rows.

use std::fmt;

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Pixel, Show, Stage, back_rows};

use super::shapes::{Shape, bounds};

/// Numbers of robots.
pub const COUNTS: [usize; 4] = [30, 100, 200, 400];
/// The least spacing, metres. Each of the `SPACINGS` spacings is half a millimetre wider than the one before.
const SPACING_MIN_M: f64 = 0.06;
/// Number of spacings: from [`SPACING_MIN_M`] to 0.12 m.
const SPACINGS: usize = 121;
/// Difference between two successive spacings, metres.
const SPACING_STEP_M: f64 = 0.0005;
/// How many cases there are.
pub const CASES: usize = Shape::ALL.len() * COUNTS.len() * SPACINGS * 2;
/// Least width and depth of the floor, metres. Larger formations get a larger floor.
const FLOOR_MIN_M: f64 = 8.0;
/// Least free space between a formation and the floor's edges, metres.
const MARGIN_M: f64 = 0.5;
/// Distance from the last starting row to the nearest robot of a near formation, metres.
const NEAR_M: f64 = 0.3;

/// The place of a formation on the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Right in front of the starting rows.
    Near,
    /// In the middle of the floor.
    Far,
}

/// One formation, to which robots drive from the rows of [`back_rows`].
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Its number, less than [`CASES`].
    pub index: usize,
    pub shape: Shape,
    pub count: usize,
    pub spacing_m: f64,
    pub place: Place,
}

impl Case {
    /// The case with this number, which is less than [`CASES`]. As numbers grow, the place changes first, then the
    /// spacing, the number of robots and the shape.
    pub fn new(index: usize) -> Self {
        let (rest, place) = (index / 2, if index.is_multiple_of(2) { Place::Near } else { Place::Far });
        let (rest, spacing) = (rest / SPACINGS, rest % SPACINGS);
        let (shape, count) = (rest / COUNTS.len(), rest % COUNTS.len());
        // Rounded to tenths of millimetres, so that spacings are round decimal numbers.
        let tenths_mm = (SPACING_MIN_M * 1e4).round() + spacing as f64 * (SPACING_STEP_M * 1e4).round();
        let spacing_m = tenths_mm / 1e4;
        Self { index, shape: Shape::ALL[shape], count: COUNTS[count], spacing_m, place }
    }

    /// The show: one frame, and no starts, so that robots start from the usual rows.
    pub fn show(&self) -> Show {
        let places = self.shape.places(self.count, self.spacing_m);
        let (low, high) = bounds(&places);
        let size = high - low;
        // Depth of the starting rows in front of a near formation.
        let rows_m = 1.0;
        let width_m = (size.x + 2.0 * MARGIN_M).ceil().max(FLOOR_MIN_M);
        let depth_m = (size.y + NEAR_M + rows_m + MARGIN_M).ceil().max(FLOOR_MIN_M);
        let stage = Stage { width_m, depth_m, ..Stage::default() };
        let middle = match self.place {
            Place::Far => Vec2::ZERO,
            Place::Near => {
                let last_row = bounds(&back_rows(&stage, self.count)).0.y;
                Vec2::new(0.0, last_row - NEAR_M - size.y / 2.0)
            }
        };
        let pixels = (0..).zip(places).map(|(id, place)| Pixel {
            id,
            at: middle + place,
            color: Rgb::new(255, 160, 0),
            ..Pixel::default()
        });
        let frame = Frame {
            name: self.to_string(),
            air_time_s: 0.3,
            transition_s: None,
            easing: Easing::Swift,
            pixels: pixels.collect(),
            ..Frame::default()
        };
        Show { name: self.to_string(), stage, frames: vec![frame], ..Show::default() }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { index, count, spacing_m, .. } = self;
        let place = if self.place == Place::Near { "near" } else { "far" };
        write!(f, "{index}: {} of {count}, {spacing_m:.4} m, {place}", self.shape.name())
    }
}
