//! The settings that effects share.

use crate::ease::{Ease, Wrap};
use crate::palette::Palette;
use lightbots_base::Vec2;

/// Settings that all kinds of effects have. docs/light.md says how each effect uses them.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Where the effect starts, stage metres.
    pub place: Vec2,
    /// Direction of the effect on the floor, radians counter-clockwise from the x axis of the stage.
    pub angle: f64,
    /// Span of the effect on the floor, metres.
    pub size_m: f64,
    /// Speed of the effect, cycles per second; with a negative speed, the effect runs backwards.
    pub speed_hz: f64,
    /// A share, above 0 and at most 1: for example of a cycle that shines, or of the span that a tail takes.
    pub width: f64,
    /// Colours of the effect.
    pub palette: Palette,
    /// Curve that maps the effect's value, 0 to 1, to a position of the palette.
    pub ease: Ease,
    /// How a phase outside of 0..=1 is brought into that range.
    pub wrap: Wrap,
    /// Seed of everything random in the effect.
    pub seed: u64,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            place: Vec2::ZERO,
            angle: 0.0,
            size_m: 1.0,
            speed_hz: 0.5,
            width: 0.5,
            palette: Palette::default(),
            ease: Ease::Linear,
            wrap: Wrap::Once,
            seed: 0,
        }
    }
}
