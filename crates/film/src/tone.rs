//! From linear light to the bytes of a picture.

use std::sync::OnceLock;

use lightbots_base::Rgb;
use lightbots_light::Linear;

/// Entries of the table: the steps are finer than a byte's where light is darkest.
const STEPS: usize = 1 << 14;

/// sRGB code of linear light from 0 to 1, by steps.
pub(crate) fn codes() -> &'static [u8] {
    static CODES: OnceLock<Vec<u8>> = OnceLock::new();
    let code = |step: usize| Linear::new(step as f64 / STEPS as f64, 0.0, 0.0).to_rgb().r;
    CODES.get_or_init(|| (0..=STEPS).map(code).collect())
}

/// The linear light of a colour.
pub(crate) fn light(colour: Rgb) -> [f32; 3] {
    let Linear { r, g, b } = Linear::from_rgb(colour);
    [r, g, b].map(|channel| channel as f32)
}

/// Light from which on colours become paler, as film and eyes do it: above that of one robot with all that it adds to
/// itself.
const PALER_FROM: f32 = 1.5;
/// How pale the brightest become.
const PALEST: f32 = 0.3;

/// The bytes of one pixel. Light beyond what a screen shows keeps its hue and becomes paler, so that neither clipping
/// changes colours where lights overlap nor a robot's own colour is changed.
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
        // Below code 6 a step of the table is coarser than a code, which is far darker than any lamp.
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
