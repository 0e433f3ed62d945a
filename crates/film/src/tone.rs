//! Converts linear light to the bytes of a picture.

use std::sync::OnceLock;

use lightbots_base::Rgb;
use lightbots_light::Linear;

/// Number of steps of the table from linear light to sRGB codes. There are enough for each code, even of the darkest light,
/// to cover several steps.
const STEPS: usize = 1 << 14;

/// Returns the table of sRGB codes for linear light from 0 to 1, in [`STEPS`] steps.
pub(crate) fn codes() -> &'static [u8] {
    static CODES: OnceLock<Vec<u8>> = OnceLock::new();
    let code = |step: usize| Linear::new(step as f64 / STEPS as f64, 0.0, 0.0).to_rgb().r;
    CODES.get_or_init(|| (0..=STEPS).map(code).collect())
}

/// Converts an sRGB colour to linear light, 0 to 1 in each channel.
pub(crate) fn light(colour: Rgb) -> [f32; 3] {
    let Linear { r, g, b } = Linear::from_rgb(colour);
    [r, g, b].map(|channel| channel as f32)
}

/// Linear light of a channel above which colours become paler, as on film and in eyes. A single robot with its bloom and
/// the light around it stays below this, so that its colour does not change.
const PALER_FROM: f32 = 1.5;
/// Upper bound on the share of white in the colour of a light. The brighter a light, the closer its share is to this.
const PALEST: f32 = 0.3;

/// Converts the linear light of one pixel to sRGB codes. Light brighter than a screen can show keeps its hue and becomes
/// paler, because clipping would change the hue where lights overlap. `codes` is the table from [`codes()`].
pub(crate) fn bytes(codes: &[u8], [r, g, b]: [f32; 3]) -> [u8; 3] {
    let most = r.max(g).max(b);
    let [r, g, b] = if most > 1.0 {
        let white = PALEST * (1.0 - PALER_FROM / most).max(0.0);
        [r, g, b].map(|channel| (channel / most) * (1.0 - white) + white)
    } else {
        [r, g, b]
    };
    [r, g, b].map(|channel| codes[(channel * STEPS as f32) as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_code_comes_back() {
        // Codes below 6 are left out, because no lamp is nearly that dark.
        for code in 6..=255 {
            assert_eq!(bytes(codes(), light(Rgb::new(code, code, code))), [code; 3]);
        }
    }

    #[test]
    fn too_much_light_becomes_paler_and_keeps_its_hue() {
        let [r, g, b] = bytes(codes(), [3.0, 1.5, 0.0]);
        assert!(r == 255 && g < r && b < g && b > 0, "{r} {g} {b}");
        assert_eq!(bytes(codes(), [1.0, 0.0, 0.0]), [255, 0, 0]);
    }
}
