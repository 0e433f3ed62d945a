//! Colours of a light.

use core::fmt;

/// Colour of a light: 8 bits per channel, sRGB, not premultiplied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rgb {
    /// Red, 0 to 255.
    pub r: u8,
    /// Green, 0 to 255.
    pub g: u8,
    /// Blue, 0 to 255.
    pub b: u8,
}

impl Rgb {
    /// Colour of a light that is off.
    pub const BLACK: Self = Self::new(0, 0, 0);

    /// A colour from its three channels.
    pub const fn new(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b }
    }

    /// The colour whose number is R·65536 + G·256 + B; `None` for numbers above 16777215.
    pub const fn from_number(n: u32) -> Option<Self> {
        if n > 0xff_ffff {
            return None;
        }
        Some(Self::new((n >> 16) as u8, (n >> 8) as u8, n as u8))
    }

    /// R·65536 + G·256 + B.
    pub const fn number(self) -> u32 {
        (self.r as u32) << 16 | (self.g as u32) << 8 | self.b as u32
    }

    /// The colour in a text of `#` and six hexadecimal digits, such as `#ffa500`; `None` for any other text.
    pub fn from_hex(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6 && !digits.starts_with('+'))?;
        Self::from_number(u32::from_str_radix(digits, 16).ok()?)
    }

    /// The colour `share` of the way to `other`, per channel in sRGB codes. `share` is clamped to 0..=1; NaN counts as
    /// 0.
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        let mix = |from: u8, to: u8| (from as f64 + (to as f64 - from as f64) * share + 0.5) as u8;
        Self::new(mix(self.r, other.r), mix(self.g, other.g), mix(self.b, other.b))
    }
}

/// Decodes an sRGB channel (IEC 61966-2-1): from the coded value, 0 to 1, to linear light, 0 to 1.
pub fn srgb_decoded(share: f64) -> f64 {
    if share <= 0.04045 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) }
}

/// Writes the colour in hexadecimal, for example `#ffa500`.
impl fmt::Display for Rgb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:06x}", self.number())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::*;

    #[test]
    fn texts_and_colours_agree() {
        assert_eq!(Rgb::from_hex("#ffa500"), Some(Rgb::new(255, 165, 0)));
        assert_eq!(Rgb::new(0, 10, 255).to_string(), "#000aff");
        for bad in ["", "#", "ffa500", "#ffa50", "#ffa5000", "#+fa500", "#gfa500", "#é1234"] {
            assert_eq!(Rgb::from_hex(bad), None, "{bad}");
        }
    }

    #[test]
    fn numbers_and_channels_agree() {
        assert_eq!(Rgb::from_number(16_753_920), Some(Rgb::new(255, 165, 0)));
        assert_eq!(Rgb::new(255, 165, 0).number(), 16_753_920);
        assert_eq!(Rgb::from_number(16_777_216), None);
    }

    #[test]
    fn mixing_meets_both_ends() {
        let (black, white) = (Rgb::BLACK, Rgb::new(255, 255, 255));
        assert_eq!(black.mixed(white, 0.0), black);
        assert_eq!(black.mixed(white, 7.0), white);
        assert_eq!(black.mixed(white, 0.5), Rgb::new(128, 128, 128));
        assert_eq!(black.mixed(white, f64::NAN), black);
    }
}
