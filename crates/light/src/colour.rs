//! Linear light: colours as proportions of light power, in which mixing, blurring and fading look right.

use lightbots_base::{Rgb, srgb_decoded};
use std::sync::LazyLock;

/// `[code]`: linear light, 0 to 1, of an sRGB code. A table, because computing a power takes fifty times as long, and
/// light tracks need millions of values.
static LIGHTS: LazyLock<[f64; 256]> =
    LazyLock::new(|| std::array::from_fn(|code| srgb_decoded(code as f64 / 255.0)));
/// `[code]`: linear light of the sRGB value half-way between a code and the next code, for rounding.
static HALVES: LazyLock<[f64; 255]> =
    LazyLock::new(|| std::array::from_fn(|code| srgb_decoded((code as f64 + 0.5) / 255.0)));

/// A colour in linear light. In each channel, 0 is off and 1 is full light; sums of colours may exceed 1 until they are
/// clamped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linear {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Linear {
    /// No light.
    pub const BLACK: Self = Self::new(0.0, 0.0, 0.0);

    /// A colour from its three channels.
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self { r, g, b }
    }

    /// The linear light that an sRGB colour stands for.
    pub fn from_rgb(coded: Rgb) -> Self {
        let [r, g, b] = [coded.r, coded.g, coded.b].map(|code| LIGHTS[usize::from(code)]);
        Self::new(r, g, b)
    }

    /// The sRGB colour with the nearest codes. Channels are clamped to 0..=1 first; NaN counts as 0.
    pub fn to_rgb(self) -> Rgb {
        let nearest = |light: f64| HALVES.partition_point(|&half| half <= light) as u8;
        let [r, g, b] = [self.r, self.g, self.b].map(nearest);
        Rgb::new(r, g, b)
    }

    /// Red, green and blue as sRGB codes, 0.0 to 255.0, not rounded. Channels are clamped to 0..=1 first.
    pub fn coded(self) -> [f64; 3] {
        [self.r, self.g, self.b].map(|light| 255.0 * encoded(within_one(light)))
    }

    /// Relative luminance, 0 to 1 (WCAG 2.2, "relative luminance"; the weights are those of ITU-R BT.709).
    pub fn luminance(self) -> f64 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }

    /// Returns the colour whose channels are `change` of this colour's channels.
    pub fn map(self, change: impl Fn(f64) -> f64) -> Self {
        Self::new(change(self.r), change(self.g), change(self.b))
    }

    /// Returns the colour whose channels are `join` of this colour's and `other`'s channels.
    pub fn zip(self, other: Self, join: impl Fn(f64, f64) -> f64) -> Self {
        Self::new(join(self.r, other.r), join(self.g, other.g), join(self.b, other.b))
    }

    /// The mixture of this colour and `other`, in which `other` has `share`, 0 to 1.
    pub fn lerp(self, other: Self, share: f64) -> Self {
        self.zip(other, |from, to| from + (to - from) * share)
    }

    /// The colour with each channel clamped to 0..=1; NaN gives 0.
    pub fn clamped(self) -> Self {
        self.map(within_one)
    }
}

/// Clamps to 0..=1; NaN gives 0.
pub(crate) fn within_one(value: f64) -> f64 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

/// The sRGB value, 0 to 1, that encodes `light`, linear light of 0 to 1 (IEC 61966-2-1).
fn encoded(light: f64) -> f64 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 }
}

/// Lightness L* of CIE 1976, 0 to 100, of the grey whose three sRGB codes are `code`.
pub fn lightness(code: u8) -> f64 {
    let light = srgb_decoded(f64::from(code) / 255.0);
    // CIE 15: (6/29)³ and (29/3)³ as exact fractions.
    if light <= 216.0 / 24_389.0 { light * 24_389.0 / 27.0 } else { 116.0 * libm::cbrt(light) - 16.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_comes_back() {
        for code in 0..=255 {
            let colour = Rgb::new(code, 255 - code, code / 2);
            assert_eq!(Linear::from_rgb(colour).to_rgb(), colour);
        }
    }

    #[test]
    fn the_table_rounds_as_the_formula_does() {
        for step in 0..=100_000 {
            let light = f64::from(step) / 100_000.0;
            let [code, ..] = Linear::new(light, 0.0, 0.0).coded();
            assert_eq!(Linear::new(light, 0.0, 0.0).to_rgb().r, (code + 0.5) as u8, "{light}");
        }
    }

    #[test]
    fn absurd_light_is_clamped() {
        assert_eq!(Linear::new(f64::NAN, 7.0, -1.0).to_rgb(), Rgb::new(0, 255, 0));
    }

    #[test]
    fn lightness_meets_the_known_values() {
        assert_eq!(lightness(0), 0.0);
        assert!((lightness(255) - 100.0).abs() < 1e-9);
        // sRGB 119 is known as the middle grey of L* 50.
        assert!((lightness(119) - 50.0).abs() < 0.1);
    }
}
