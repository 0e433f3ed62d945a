//! Colours of areas and lines: a single colour or a gradient.

use lightbots_base::{Rgb, Vec2};

/// What an area or a line is painted with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ink {
    /// The single colour. If there is a gradient, this is the mean of its colours.
    pub color: Rgb,
    /// How the colour changes over the drawing; `None` for a single colour.
    pub gradient: Option<Gradient>,
}

impl From<Rgb> for Ink {
    fn from(color: Rgb) -> Self {
        Self { color, gradient: None }
    }
}

impl Ink {
    /// The colour at a place of the drawing.
    pub fn at(&self, place: Vec2) -> Rgb {
        self.gradient.as_ref().map_or(self.color, |gradient| gradient.at(place))
    }

    /// Returns the ink of a drawing whose points were moved by the affine map `map`.
    pub fn mapped(&self, map: impl Fn(Vec2) -> Vec2) -> Self {
        let gradient = self
            .gradient
            .as_ref()
            .map(|gradient| Gradient { frame: gradient.frame.map(map), ..gradient.clone() });
        Self { gradient, ..*self }
    }
}

/// Colours along a line or around a focus, after SVG 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// Positions in the drawing of the points (0, 0), (1, 0) and (0, 1) of the gradient's own coordinate system.
    pub frame: [Vec2; 3],
    /// Shape of the gradient in its own coordinate system.
    pub shape: GradientShape,
    /// How the colours go on before offset 0 and after offset 1.
    pub spread: GradientSpread,
    /// Colour stops: offsets from 0 to 1 in ascending order, each with a colour; at least one.
    pub stops: Vec<(f64, Rgb)>,
}

/// The shape of a gradient. Places are in the gradient's own coordinate system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GradientShape {
    /// Along a line from offset 0 to offset 1.
    Linear {
        /// Where offset 0 is.
        from: Vec2,
        /// Where offset 1 is.
        to: Vec2,
    },
    /// From a focus, which has offset 0, to a circle, which has offset 1.
    Radial {
        /// Middle of the circle of offset 1.
        center: Vec2,
        /// Its radius.
        radius: f64,
        /// The focus, where offset 0 is.
        focus: Vec2,
    },
}

/// How a gradient continues beyond its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GradientSpread {
    /// The colour of the nearer end.
    Pad,
    /// The gradient backwards, then forwards, and so on.
    Reflect,
    /// The gradient again from its start.
    Repeat,
}

impl Gradient {
    /// The colour at a place of the drawing.
    pub fn at(&self, place: Vec2) -> Rgb {
        let offset = self.own(place).map_or(0.0, |own| self.shape.offset(own));
        let offset = match self.spread {
            GradientSpread::Pad => offset.clamp(0.0, 1.0),
            GradientSpread::Repeat => offset - libm::floor(offset),
            GradientSpread::Reflect => {
                let within = offset - 2.0 * libm::floor(offset / 2.0);
                within.min(2.0 - within)
            }
        };
        self.color(if offset.is_nan() { 0.0 } else { offset })
    }

    /// Converts a place of the drawing to the gradient's own coordinates. `None` if the three points of its frame are
    /// on one line.
    fn own(&self, place: Vec2) -> Option<Vec2> {
        let [origin, x, y] = self.frame;
        let (x, y, at) = (x - origin, y - origin, place - origin);
        let extent = x.cross(y);
        (extent != 0.0).then(|| Vec2::new(at.cross(y) / extent, x.cross(at) / extent))
    }

    fn color(&self, offset: f64) -> Rgb {
        let after = self.stops.partition_point(|(stop, _)| *stop <= offset);
        let Some(&(from, color)) = after.checked_sub(1).and_then(|before| self.stops.get(before)) else {
            return self.stops.first().map_or(Rgb::BLACK, |(_, color)| *color);
        };
        match self.stops.get(after) {
            Some(&(to, next)) => color.mixed(next, (offset - from) / (to - from)),
            None => color,
        }
    }
}

impl GradientShape {
    fn offset(self, at: Vec2) -> f64 {
        match self {
            Self::Linear { from, to } => {
                let along = to - from;
                (at - from).dot(along) / along.length_squared()
            }
            Self::Radial { center, radius, focus } => {
                // Solves |at - focus - offset (center - focus)| = offset radius: the circle of this offset passes
                // through `at`.
                let (shift, off) = (center - focus, at - focus);
                let a = shift.length_squared() - radius * radius;
                let b = off.dot(shift);
                (b - (b * b - a * off.length_squared()).max(0.0).sqrt()) / a
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = Rgb::new(255, 0, 0);
    const BLUE: Rgb = Rgb::new(0, 0, 255);
    const FRAME: [Vec2; 3] = [Vec2::ZERO, Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];

    fn gradient(shape: GradientShape, spread: GradientSpread) -> Gradient {
        Gradient { frame: FRAME, shape, spread, stops: vec![(0.0, RED), (1.0, BLUE)] }
    }

    fn linear(spread: GradientSpread) -> Gradient {
        gradient(GradientShape::Linear { from: Vec2::ZERO, to: Vec2::new(2.0, 0.0) }, spread)
    }

    #[test]
    fn colours_change_along_a_line_and_go_on_as_the_spread_says() {
        let at = |spread, x| linear(spread).at(Vec2::new(x, 7.0));
        assert_eq!(at(GradientSpread::Pad, 1.0), Rgb::new(128, 0, 128));
        assert_eq!([at(GradientSpread::Pad, -3.0), at(GradientSpread::Pad, 9.0)], [RED, BLUE]);
        assert_eq!(at(GradientSpread::Repeat, 2.5), at(GradientSpread::Pad, 0.5));
        assert_eq!(at(GradientSpread::Reflect, 2.5), at(GradientSpread::Pad, 1.5));
        assert_eq!(at(GradientSpread::Reflect, -0.5), at(GradientSpread::Pad, 0.5));
    }

    #[test]
    fn colours_change_from_the_focus_to_the_circle() {
        let (center, focus) = (Vec2::new(1.0, 0.0), Vec2::new(0.5, 0.0));
        let gradient = gradient(GradientShape::Radial { center, radius: 1.0, focus }, GradientSpread::Pad);
        assert_eq!(gradient.at(focus), RED);
        for edge in [Vec2::new(2.0, 0.0), Vec2::new(0.0, 0.0), Vec2::new(1.0, 1.0)] {
            assert_eq!(gradient.at(edge), BLUE);
        }
        // Half of the way to the circle, in any direction.
        assert_eq!(gradient.at(Vec2::new(1.25, 0.0)), Rgb::new(128, 0, 128));
    }

    #[test]
    fn a_gradient_moves_with_its_drawing() {
        let ink = Ink { color: RED, gradient: Some(linear(GradientSpread::Pad)) };
        let turned = ink.mapped(|at| Vec2::new(3.0 - at.y * 2.0, at.x * 2.0));
        assert_eq!(turned.at(Vec2::new(-4.0, 2.0)), ink.at(Vec2::new(1.0, 3.5)));
    }

    #[test]
    fn gradients_without_extent_have_a_colour() {
        let point = GradientShape::Linear { from: Vec2::ZERO, to: Vec2::ZERO };
        assert_eq!(gradient(point, GradientSpread::Pad).at(Vec2::new(1.0, 1.0)), RED);
        let flat = Gradient { frame: [Vec2::ZERO; 3], ..linear(GradientSpread::Reflect) };
        assert_eq!(flat.at(Vec2::new(1.0, 1.0)), RED);
        assert_eq!(Gradient { stops: Vec::new(), ..linear(GradientSpread::Pad) }.at(Vec2::ZERO), Rgb::BLACK);
    }
}
