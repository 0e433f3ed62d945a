//! Chooses colours and weights of the lights that show a picture.

use lightbots_base::{Rgb, Vec2};

use crate::drawing::Raster;
use crate::picture::bitmap::{BitMask, Bitmap, neighbours};

/// Least value of a light's brightest channel, 0 to 255. A darker light is hardly visible beside other lights.
const BRIGHT_MIN: u8 = 90;
/// A pixel is black if all its channels are below this, 0 to 255. A thing that is mostly black is shown in white.
const BLACK: u8 = 40;
/// Number of rounds in which colours from inside the thing spread outwards, by one pixel in each round. They replace
/// the colours at the border, where pixels mix with the background.
const CARRIES: usize = 6;
/// The brightness below which 2 % of all pixels lie is taken as black, that below which 98 % lie as white.
const ENDS: [f64; 2] = [0.02, 0.98];
/// Least difference of brightness between black and white, 0 to 1. Pictures with less contrast are not stretched to
/// full contrast.
const CONTRAST_MIN: f64 = 0.1;
/// Density of robots is the stored brightness to this power, chosen by eye. It lies between the exponent of measured
/// light, 2.2, and that of perceived light, 1.
const DENSITY: f64 = 1.5;
/// Weights (densities of robots) below this become 0: no robots stand where the picture is nearly black.
const WEIGHT_MIN: f64 = 0.05;

/// Returns the colours of the thing that `mask` marks, spread across its border and bright enough for lights. A thing
/// that is mostly black gets white lights. Weights are 1 inside the mask and 0 outside.
pub fn painted(bitmap: &Bitmap, mask: &BitMask) -> Raster {
    let mut colors: Vec<Rgb> = bitmap.colors().collect();
    let core = eroded(mask);
    let core = if core.count() > 0 { &core } else { mask };
    if is_black(&colors, mask) {
        colors.fill(Rgb::new(255, 255, 255));
    } else {
        carry(&mut colors, core);
        colors.iter_mut().for_each(|color| *color = lifted(*color));
    }
    let weights = mask.inside.iter().map(|inside| if *inside { 1.0 } else { 0.0 }).collect();
    raster(bitmap, colors, weights)
}

/// Returns colours and weights that show the tones of a picture. Robots stand densely where the picture is light, or
/// where it is dark if `inverted`. They stand less densely where it is transparent.
pub fn tones(bitmap: &Bitmap, inverted: bool) -> Raster {
    let value = |[r, g, b, _]: &[u8; 4]| {
        (0.2126 * f64::from(*r) + 0.7152 * f64::from(*g) + 0.0722 * f64::from(*b)) / 255.0
    };
    let values: Vec<f64> = bitmap.pixels.iter().map(value).collect();
    let [low, high] = ends(&values);
    let low = low.min(high - CONTRAST_MIN).max(0.0);
    let span = (high - low).max(CONTRAST_MIN);
    let weight = |(value, pixel): (&f64, &[u8; 4])| {
        let light = ((value - low) / span).clamp(0.0, 1.0);
        let light = if inverted { 1.0 - light } else { light };
        let weight = libm::pow(light, DENSITY) * f64::from(pixel[3]) / 255.0;
        if weight < WEIGHT_MIN { 0.0 } else { weight as f32 }
    };
    let weights = values.iter().zip(&bitmap.pixels).map(weight).collect();
    let colors = bitmap.colors().map(|color| if inverted { opposite(color) } else { lifted(color) });
    raster(bitmap, colors.collect(), weights)
}

fn raster(bitmap: &Bitmap, colors: Vec<Rgb>, weights: Vec<f32>) -> Raster {
    let (width, height) = (bitmap.columns as f64, bitmap.rows as f64);
    let corners = [Vec2::ZERO, Vec2::new(width, 0.0), Vec2::new(width, height), Vec2::new(0.0, height)];
    Raster { corners, columns: bitmap.columns, colors, weights }
}

/// Returns the two values below which the shares in [`ENDS`] of all values lie.
fn ends(values: &[f64]) -> [f64; 2] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    ENDS.map(|share| sorted.get((share * sorted.len() as f64) as usize).copied().unwrap_or(0.0))
}

/// Whether most pixels inside the mask are black.
fn is_black(colors: &[Rgb], mask: &BitMask) -> bool {
    let black = |color: &Rgb| color.r.max(color.g).max(color.b) < BLACK;
    let inside = colors.iter().zip(&mask.inside).filter(|(_, inside)| **inside);
    inside.filter(|(color, _)| black(color)).count() * 2 > mask.count()
}

/// Makes a colour bright enough for a light. Dark colours keep their hue; nearly black colours become grey.
pub fn lifted(color: Rgb) -> Rgb {
    let brightest = color.r.max(color.g).max(color.b);
    if brightest >= BRIGHT_MIN {
        return color;
    }
    if brightest < BLACK / 2 {
        return Rgb::new(BRIGHT_MIN, BRIGHT_MIN, BRIGHT_MIN);
    }
    let lift = |channel: u8| (u32::from(channel) * u32::from(BRIGHT_MIN) / u32::from(brightest)) as u8;
    Rgb::new(lift(color.r), lift(color.g), lift(color.b))
}

/// Returns the colour of a light at a dark place of an inverted picture: the hue of the place at full brightness. For
/// greys and black it is white.
fn opposite(color: Rgb) -> Rgb {
    let (brightest, darkest) = (color.r.max(color.g).max(color.b), color.r.min(color.g).min(color.b));
    if brightest < BLACK || brightest - darkest < BLACK {
        return Rgb::new(255, 255, 255);
    }
    let lift = |channel: u8| (u32::from(channel) * 255 / u32::from(brightest)) as u8;
    Rgb::new(lift(color.r), lift(color.g), lift(color.b))
}

/// Returns the pixels of a mask whose four neighbours are all inside as well.
fn eroded(mask: &BitMask) -> BitMask {
    let surrounded = |index: usize| {
        mask.inside[index]
            && neighbours(index, mask.columns, mask.inside.len()).all(|neighbour| mask.inside[neighbour])
    };
    BitMask { columns: mask.columns, inside: (0..mask.inside.len()).map(surrounded).collect() }
}

/// Spreads the colours inside a mask outwards, by one pixel in each round.
fn carry(colors: &mut [Rgb], mask: &BitMask) {
    let mut known = mask.inside.clone();
    for _ in 0..CARRIES {
        let from = |index: usize| {
            let mut near = neighbours(index, mask.columns, known.len());
            near.find(|neighbour| known[*neighbour]).map(|neighbour| (index, neighbour))
        };
        let fresh: Vec<(usize, usize)> =
            (0..known.len()).filter(|index| !known[*index]).filter_map(from).collect();
        for (index, neighbour) in fresh {
            colors[index] = colors[neighbour];
            known[index] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_places_are_dense_unless_inverted() {
        let pixels = (0..=255u8).map(|grey| [grey, grey, grey, 255]).collect();
        let bitmap = Bitmap { columns: 16, rows: 16, pixels };
        let light = tones(&bitmap, false);
        let dark = tones(&bitmap, true);
        assert_eq!(
            (light.weights[0], light.weights[255], dark.weights[0], dark.weights[255]),
            (0.0, 1.0, 1.0, 0.0)
        );
        assert!(light.weights.is_sorted());
        assert_eq!(dark.colors[0], Rgb::new(255, 255, 255));
        let clear = Bitmap { columns: 1, rows: 1, pixels: vec![[255, 255, 255, 0]] };
        assert_eq!(tones(&clear, false).weights, [0.0]);
    }

    #[test]
    fn dark_colours_keep_their_hue() {
        assert_eq!(lifted(Rgb::new(30, 0, 0)), Rgb::new(90, 0, 0));
        assert_eq!(lifted(Rgb::BLACK), Rgb::new(90, 90, 90));
        assert_eq!(lifted(Rgb::new(0, 200, 9)), Rgb::new(0, 200, 9));
    }

    #[test]
    fn the_border_has_the_colours_of_the_thing() {
        let red = [255, 0, 0, 255];
        let pixels: Vec<[u8; 4]> = (0..81)
            .map(|n| if (3..6).contains(&(n % 9)) && (3..6).contains(&(n / 9)) { red } else { [255; 4] })
            .collect();
        let inside: Vec<bool> = pixels.iter().map(|pixel| *pixel == red).collect();
        let bitmap = Bitmap { columns: 9, rows: 9, pixels };
        let raster = painted(&bitmap, &BitMask { columns: 9, inside });
        assert_eq!(raster.colors[2 * 9 + 4], Rgb::new(255, 0, 0));
        assert_eq!(raster.weights.iter().sum::<f32>(), 9.0);
    }
}
