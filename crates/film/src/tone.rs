//! From linear light to the bytes of a picture.

use std::sync::OnceLock;

/// Entries of the table: the steps are finer than a byte's where light is darkest.
const STEPS: usize = 1 << 14;

/// sRGB code of linear light from 0 to 1, by steps.
pub(crate) fn codes() -> &'static [u8] {
    static CODES: OnceLock<Vec<u8>> = OnceLock::new();
    CODES.get_or_init(|| (0..=STEPS).map(|step| code(step as f64 / STEPS as f64)).collect())
}

fn code(light: f64) -> u8 {
    let value =
        if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
    libm::round(255.0 * value) as u8
}

/// Linear light of an sRGB code.
pub(crate) fn light(code: u8) -> f32 {
    let value = f64::from(code) / 255.0;
    let light = if value <= 0.040_45 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) };
    light as f32
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
            assert_eq!(bytes(codes(), [light(code); 3]), [code; 3]);
        }
    }

    #[test]
    fn too_much_light_becomes_paler_and_keeps_its_hue() {
        let [r, g, b] = bytes(codes(), [3.0, 1.5, 0.0]);
        assert!(r == 255 && g < r && b < g && b > 0, "{r} {g} {b}");
        assert_eq!(bytes(codes(), [1.0, 0.0, 0.0]), [255, 0, 0]);
    }
}
