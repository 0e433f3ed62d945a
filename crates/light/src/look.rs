//! The settings that effects share.

use crate::ease::{Ease, Wrap};
use crate::palette::Palette;
use lightbots_base::Vec2;

/// Place, span, direction, speed, palette, easing and seed of an effect. docs/light.md says how each effect uses them.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Where the effect starts, stage metres.
    pub place: Vec2,
    /// Its direction, radians counter-clockwise from +x.
    pub angle: f64,
    /// Its span on the floor, metres.
    pub size_m: f64,
    /// Its speed, cycles per second; a negative speed runs backwards.
    pub speed_hz: f64,
    /// The share of a cycle that shines, above 0 and at most 1.
    pub width: f64,
    /// Its colours.
    pub palette: Palette,
    /// How its value is bent before the palette is looked up.
    pub ease: Ease,
    /// How a phase outside of 0..=1 is brought into that range.
    pub wrap: Wrap,
    /// Seed of everything random.
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
