//! Settings for placing lights on a drawing.

use lightbots_base::{Rgb, Vec2};

use crate::error::DrawError;
use crate::ground::Quality;
use crate::layout::Style;

/// Largest number of robots in a drawing.
pub const MAX_ROBOTS: usize = 10_000;

/// Settings of a picture of lights.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceSettings {
    /// Number of lights.
    pub robots: usize,
    /// Wanted least distance between two lights, metres.
    pub spacing_m: f64,
    /// Least value, metres, to which `spacing_m` may be reduced if the lights do not fit otherwise.
    pub least_m: f64,
    /// How areas are shown.
    pub style: Style,
    /// Wanted larger side of the picture, metres. It becomes larger if the lights need more room, and smaller if the
    /// floor is too small. `None`: chosen for the floor and the number of robots.
    pub size_m: Option<f64>,
    /// Centre of the picture, stage metres.
    pub center: Vec2,
    /// Angle by which the picture is turned, radians counter-clockwise.
    pub turn: f64,
    /// The rectangle of the drawing that is scaled to the picture's size. It is given by its corners with the smaller
    /// and the larger x and y, in the drawing's units. `None`: the rectangle around the whole drawing. If a series of
    /// pictures has one view, all have one scale.
    pub view: Option<(Vec2, Vec2)>,
    /// Lights that stay where they are. They are included in `robots` and come first in the result.
    pub kept: Vec<PlacedLight>,
    /// Places with which the relaxation begins, stage metres, such as those of the previous picture. Used only for
    /// filling a part, and only if their number is the part's number of places. Otherwise the relaxation begins with
    /// new places.
    pub start: Vec<Vec2>,
    /// How much work goes into the places.
    pub quality: Quality,
    /// Seed of all random choices.
    pub seed: u64,
}

impl Default for PlaceSettings {
    fn default() -> Self {
        Self {
            robots: 30,
            spacing_m: 0.08,
            least_m: 0.062,
            style: Style::Auto,
            size_m: None,
            center: Vec2::ZERO,
            turn: 0.0,
            view: None,
            kept: Vec::new(),
            start: Vec::new(),
            quality: Quality::Full,
            seed: 1,
        }
    }
}

/// A light on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLight {
    /// Place, stage metres.
    pub at: Vec2,
    /// Colour.
    pub color: Rgb,
    /// Index of the drawing's part that the light shows.
    pub part: usize,
}

impl PlaceSettings {
    /// Checks that the numbers are in range.
    ///
    /// # Errors
    /// The first number that is out of range.
    pub(crate) fn check(&self) -> Result<(), DrawError> {
        let fail = |what: String| Err(DrawError::new("bad-setting", what));
        if self.robots == 0 || self.robots > MAX_ROBOTS {
            return fail(format!("{} robots; a picture takes 1 to {MAX_ROBOTS}", self.robots));
        }
        if !(0.02..=5.0).contains(&self.spacing_m) {
            return fail(format!("a spacing of {} m; use 0.02 to 5 m", self.spacing_m));
        }
        if !(0.01..=5.0).contains(&self.least_m) {
            return fail(format!("a least spacing of {} m; use 0.01 to 5 m", self.least_m));
        }
        if self.size_m.is_some_and(|size| !(0.01..=1_000.0).contains(&size)) {
            return fail("the size of the picture must be from 0.01 to 1000 m".into());
        }
        if !self.center.is_finite() || !self.turn.is_finite() {
            return fail("place and turn of the picture must be numbers".into());
        }
        if self.kept.len() > self.robots {
            let moved = self.kept.len();
            return fail(format!("{moved} lights were moved by hand, but there are {} robots", self.robots));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_that_are_no_lengths_are_refused() {
        assert_eq!(PlaceSettings::default().check(), Ok(()));
        for least_m in [f64::NAN, -1.0, 9.0] {
            assert_eq!(
                PlaceSettings { least_m, ..PlaceSettings::default() }.check().unwrap_err().code,
                "bad-setting"
            );
        }
    }
}
