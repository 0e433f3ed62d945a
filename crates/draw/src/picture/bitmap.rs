//! Small pictures in memory.

use lightbots_base::{Rgb, srgb_decoded};

/// A picture, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    /// Pixels in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Red, green, blue and opacity of each pixel, 0 to 255.
    pub pixels: Vec<[u8; 4]>,
}

/// A flag for each pixel, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct BitMask {
    /// Pixels in a row.
    pub columns: usize,
    /// For each pixel, whether it belongs to the thing that is shown.
    pub inside: Vec<bool>,
}

/// A colour in Oklab (Ottosson 2020): lightness 0 to 1, then the axes green to red and blue to yellow. Equal distances
/// between colours look about equally large.
pub type Oklab = [f32; 3];

impl Bitmap {
    /// Colours of the pixels, without opacity.
    pub fn colors(&self) -> impl Iterator<Item = Rgb> + '_ {
        self.pixels.iter().map(|[r, g, b, _]| Rgb::new(*r, *g, *b))
    }

    /// Indices of the pixels along the edge of the picture.
    pub fn edge(&self) -> impl Iterator<Item = usize> + '_ {
        let (columns, rows) = (self.columns, self.rows);
        (0..columns * rows).filter(move |index| {
            let (x, y) = (index % columns, index / columns);
            x == 0 || y == 0 || x + 1 == columns || y + 1 == rows
        })
    }
}

impl BitMask {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.inside.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Number of pixels inside.
    pub fn count(&self) -> usize {
        self.inside.iter().filter(|inside| **inside).count()
    }
}

/// Returns the indices of the neighbours of pixel `index`: above, left, right and below, as far as they exist.
/// `columns`: pixels in a row; `pixels`: number of all pixels.
pub fn neighbours(index: usize, columns: usize, pixels: usize) -> impl Iterator<Item = usize> {
    let x = index % columns.max(1);
    let above = index.checked_sub(columns);
    let left = (x > 0).then(|| index - 1);
    let right = (x + 1 < columns).then_some(index + 1);
    let below = Some(index + columns).filter(|below| *below < pixels);
    [above, left, right, below].into_iter().flatten()
}

/// Converts a channel of sRGB, 0 to 255, to linear light, 0 to 1 (IEC 61966-2-1).
pub fn linear(channel: u8) -> f64 {
    srgb_decoded(f64::from(channel) / 255.0)
}

/// Converts colours to Oklab.
pub fn oklab(colors: impl Iterator<Item = Rgb>) -> Vec<Oklab> {
    let light: Vec<f64> = (0..=255).map(linear).collect();
    let of = |channel: u8| light.get(usize::from(channel)).copied().unwrap_or(1.0);
    let mix = |r: f64, g: f64, b: f64, weights: [f64; 3]| r * weights[0] + g * weights[1] + b * weights[2];
    colors
        .map(|color| {
            let (r, g, b) = (of(color.r), of(color.g), of(color.b));
            let l = libm::cbrt(mix(r, g, b, [0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9]));
            let m = libm::cbrt(mix(r, g, b, [0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6]));
            let s = libm::cbrt(mix(r, g, b, [0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5]));
            [
                mix(l, m, s, [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8]) as f32,
                mix(l, m, s, [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9]) as f32,
                mix(l, m, s, [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0]) as f32,
            ]
        })
        .collect()
}

/// Returns the distance of two colours. A distance of 0.02 is just visible; black and white are 1 apart.
pub fn difference(a: Oklab, b: Oklab) -> f32 {
    let square = |n: usize| (a[n] - b[n]) * (a[n] - b[n]);
    (square(0) + square(1) + square(2)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn oklab_has_grey_on_its_axis() {
        let colors = [Rgb::BLACK, Rgb::new(255, 255, 255), Rgb::new(255, 0, 0)];
        let lab = oklab(colors.into_iter());
        assert_eq!(lab[0], [0.0; 3]);
        assert!((lab[1][0] - 1.0).abs() < 1e-5 && lab[1][1].abs() < 1e-5 && lab[1][2].abs() < 1e-5);
        // Ottosson's table: red is at 0.628, 0.225, 0.126.
        assert!(difference(lab[2], [0.628, 0.225, 0.126]) < 1e-3, "{:?}", lab[2]);
    }

    #[test]
    fn neighbours_stay_within_the_picture() {
        let of = |index: usize| neighbours(index, 3, 9).collect::<Vec<usize>>();
        assert_eq!((of(0), of(4), of(8)), (vec![1, 3], vec![1, 3, 5, 7], vec![5, 7]));
    }
}
