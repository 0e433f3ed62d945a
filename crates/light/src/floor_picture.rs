//! Pictures and films that are projected on the floor.

use crate::colour::Linear;
use lightbots_base::Rgb;

/// Largest number of pixels in all pictures of a film together, chosen by us. It stands for 12 MB of memory, or 17
/// pictures of 640 x 360 pixels. A picture for a floor of 10,000 robots needs 100 x 100 pixels.
pub const PICTURE_PIXELS_MAX: usize = 4_000_000;

/// A picture or film, decoded.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorPicture {
    width: usize,
    height: usize,
    /// Pixels of the pictures, which follow one another, each row by row from the top left.
    pixels: Vec<Rgb>,
    /// `[code]`: linear light of an sRGB code. A table, because decoding the four pixels of a lookup would take twelve
    /// powers.
    light: Vec<f64>,
}

impl FloorPicture {
    /// A film of pictures with `width` by `height` pixels. In `pixels`, the pictures follow one another, each row by row
    /// from the top left.
    ///
    /// # Errors
    /// A line for people if there are no pixels, more than [`PICTURE_PIXELS_MAX`], or no whole number of pictures.
    pub fn new(width: usize, height: usize, pixels: Vec<Rgb>) -> Result<Self, String> {
        let area = width.saturating_mul(height);
        if area == 0 || pixels.is_empty() || !pixels.len().is_multiple_of(area) {
            let found = pixels.len();
            return Err(format!(
                "{found} pixels do not fill pictures of {width} x {height}: decode them again"
            ));
        }
        if pixels.len() > PICTURE_PIXELS_MAX {
            let found = pixels.len();
            return Err(format!(
                "{found} pixels, {PICTURE_PIXELS_MAX} are the most: make the picture smaller"
            ));
        }
        let light = (0..=255).map(|code| Linear::from_rgb(Rgb::new(code, 0, 0)).r).collect();
        Ok(Self { width, height, pixels, light })
    }

    /// Number of pictures.
    pub fn frames(&self) -> usize {
        self.pixels.len() / (self.width * self.height)
    }

    /// Height over width.
    pub fn aspect(&self) -> f64 {
        self.height as f64 / self.width as f64
    }

    /// Light at a place of the picture with the index `frame`: `across` from the left and `down` from the top, both 0 to 1.
    /// Light is interpolated bilinearly between the centres of pixels, and constant beyond the outermost centres. If
    /// `frame` is too large, the last picture is taken.
    pub fn at(&self, frame: usize, across: f64, down: f64) -> Linear {
        let (left, right, x) = between(across, self.width);
        let (top, bottom, y) = between(down, self.height);
        let start = frame.min(self.frames() - 1) * self.width * self.height;
        let pixel = |column: usize, row: usize| self.linear(self.pixels[start + row * self.width + column]);
        let upper = pixel(left, top).lerp(pixel(right, top), x);
        upper.lerp(pixel(left, bottom).lerp(pixel(right, bottom), x), y)
    }

    /// Light of one pixel of the first picture; `None` if column or row, counted from 0, is outside of the picture.
    pub fn pixel(&self, column: usize, row: usize) -> Option<Linear> {
        let is_inside = column < self.width && row < self.height;
        is_inside.then(|| self.linear(self.pixels[row * self.width + column]))
    }

    fn linear(&self, pixel: Rgb) -> Linear {
        let [r, g, b] = [pixel.r, pixel.g, pixel.b].map(|code| self.light[usize::from(code)]);
        Linear::new(r, g, b)
    }
}

/// Returns the indices of the two pixels whose centres enclose a position. The third value is how far the position is from
/// the first centre to the second, 0 to 1. `share` is the position along a side of `count` pixels, 0 to 1.
fn between(share: f64, count: usize) -> (usize, usize, f64) {
    let last = (count - 1) as f64;
    let along = (share * count as f64 - 0.5).clamp(0.0, last);
    let first = along as usize;
    (first.min(count - 1), (first + 1).min(count - 1), along - libm::floor(along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centres_of_pixels_are_exact_and_corners_hold() {
        let pixels = [10, 20, 30, 40].map(|code| Rgb::new(code, code, code)).to_vec();
        let picture = FloorPicture::new(2, 2, pixels).expect("it is whole");
        let code = |across, down| picture.at(0, across, down).to_rgb().r;
        assert_eq!([code(0.25, 0.25), code(0.75, 0.25), code(0.25, 0.75), code(0.0, 0.0)], [10, 20, 30, 10]);
        assert_eq!([code(1.0, 1.0), code(f64::INFINITY, 2.0)], [40, 40]);
    }

    #[test]
    fn absurd_pictures_are_refused() {
        assert!(FloorPicture::new(0, 2, vec![Rgb::BLACK]).is_err());
        assert!(FloorPicture::new(usize::MAX, 2, vec![Rgb::BLACK]).is_err());
        assert!(FloorPicture::new(2, 2, vec![Rgb::BLACK; 6]).is_err());
        let most = vec![Rgb::BLACK; PICTURE_PIXELS_MAX + 1];
        assert!(FloorPicture::new(1, 1, most).is_err_and(|message| message.contains("smaller")));
    }
}
