//! The cases of the sweep: every shape, number of robots, spacing and distance from the starting rows.

use std::fmt;

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Pixel, Show, Stage, front_rows};

use super::shapes::{Shape, bounds};

/// Numbers of robots.
pub const COUNTS: [usize; 4] = [30, 100, 200, 400];
/// The least spacing, and how many spacings there are, half a millimetre apart.
const SPACING_MIN_M: f64 = 0.06;
const SPACINGS: usize = 121;
const SPACING_STEP_M: f64 = 0.0005;
/// How many cases there are.
pub const CASES: usize = Shape::ALL.len() * COUNTS.len() * SPACINGS * 2;
/// The least width and depth of the floor, metres; larger formations get a larger floor.
const FLOOR_MIN_M: f64 = 8.0;
/// Free space between a formation and the floor's edges at least, metres.
const MARGIN_M: f64 = 0.5;
/// From the last starting row to the nearest robot of a formation near it, metres.
const NEAR_M: f64 = 0.3;

/// Where a formation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Right in front of the starting rows.
    Near,
    /// In the middle of the floor.
    Far,
}

/// One formation that robots drive to from the usual rows at the front edge.
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
    /// The case of a number less than [`CASES`]. The place changes first, then the spacing, the number of robots and the
    /// shape.
    pub fn new(index: usize) -> Self {
        let (rest, place) = (index / 2, if index.is_multiple_of(2) { Place::Near } else { Place::Far });
        let (rest, spacing) = (rest / SPACINGS, rest % SPACINGS);
        let (shape, count) = (rest / COUNTS.len(), rest % COUNTS.len());
        // Through whole tenths of millimetres, so that spacings are the numbers that people write.
        let tenths_mm = (SPACING_MIN_M * 1e4).round() + spacing as f64 * (SPACING_STEP_M * 1e4).round();
        let spacing_m = tenths_mm / 1e4;
        Self { index, shape: Shape::ALL[shape], count: COUNTS[count], spacing_m, place }
    }

    /// The show: one frame, and no starts, so that robots start from the usual rows.
    pub fn show(&self) -> Show {
        let places = self.shape.places(self.count, self.spacing_m);
        let (low, high) = bounds(&places);
        let size = high - low;
        // Room for the rows in front of a formation near them.
        let rows_m = 1.0;
        let width_m = (size.x + 2.0 * MARGIN_M).ceil().max(FLOOR_MIN_M);
        let depth_m = (size.y + NEAR_M + rows_m + MARGIN_M).ceil().max(FLOOR_MIN_M);
        let stage = Stage { width_m, depth_m, ..Stage::default() };
        let middle = match self.place {
            Place::Far => Vec2::ZERO,
            Place::Near => {
                let last_row = bounds(&front_rows(&stage, self.count)).0.y;
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
