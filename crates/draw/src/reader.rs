//! Reads capital letters and digits from lights, as a viewer does without being told what is written.
//!
//! The templates are 36 signs in a bold face and in a single-line face, blurred like the lights. They are compared by
//! normalised cross-correlation over several scales and shifts. The width of the blur depends on the letter's height,
//! as in [`crate::readability`].

use lightbots_base::Vec2;

use crate::drawing::DrawingPart;
use crate::geometry::bounds;
use crate::light_image::LightImage;
use crate::readability::{SIGMA, drawn};
use crate::text::{self, Font, TextSettings};

/// The signs that the reader knows.
const SIGNS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

/// Typefaces of the templates: one with areas and one with lines, because viewers read both.
const FACES: [&str; 2] = ["lato", "hershey-sans"];

/// Heights of the templates, as multiples of the height of the letter that is read. Smaller templates are tried because
/// lights lie inside a letter's edge.
const SCALES: [f64; 5] = [0.76, 0.87, 1.0, 1.15, 1.32];

/// Distance by which lights are shifted against the templates in each direction, as a share of the letter's height.
const SHIFT: f64 = 0.04;

/// Half the width and half the height of the image in which signs are compared, in heights of the letter.
const HALF: Vec2 = Vec2::new(0.95, 0.75);

/// Reads signs from lights. Making its templates takes some milliseconds, so keep the reader for further readings.
pub struct SignReader {
    templates: Vec<(char, LightImage)>,
}

/// The sign that lights look like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignRead {
    /// The sign whose template is most like the lights.
    pub sign: char,
    /// Normalised cross-correlation between that template and the lights, 0 to 1.
    pub correlation: f64,
}

impl Default for SignReader {
    fn default() -> Self {
        let fonts = FACES.iter().filter_map(|name| Font::built_in(name));
        let parts: Vec<(char, DrawingPart)> = fonts
            .flat_map(|font| SIGNS.chars().filter_map(move |sign| Some((sign, part(&font, sign)?))))
            .collect();
        let templates = parts.iter().flat_map(|(sign, part)| {
            let points = points(part);
            SCALES.map(|scale| (*sign, image(&points, scale, Vec2::ZERO)))
        });
        Self { templates: templates.collect() }
    }
}

impl SignReader {
    /// Whether the reader knows a sign.
    pub fn knows(sign: char) -> bool {
        SIGNS.contains(sign)
    }

    /// Returns the sign that lights look like. If `sign` is a digit, only digits are compared, else only letters.
    /// `height`: height of the letter in the unit of `places`. `None` if there are no lights or the reader does not
    /// know `sign`.
    pub fn read(&self, places: &[Vec2], height: f64, sign: char) -> Option<SignRead> {
        if places.is_empty() || height <= 0.0 || !Self::knows(sign) {
            return None;
        }
        let lights: Vec<(Vec2, f64)> = places.iter().map(|at| (*at * (1.0 / height), 1.0)).collect();
        let steps = [-SHIFT, 0.0, SHIFT];
        let views: Vec<LightImage> =
            steps.iter().flat_map(|x| steps.map(|y| image(&lights, 1.0, Vec2::new(*x, y)))).collect();
        let rivals =
            self.templates.iter().filter(|(rival, _)| rival.is_ascii_digit() == sign.is_ascii_digit());
        let alike = rivals.flat_map(|(rival, template)| {
            views.iter().map(|view| SignRead { sign: *rival, correlation: view.correlation(template) })
        });
        alike.max_by(|a, b| a.correlation.total_cmp(&b.correlation))
    }
}

/// Returns a sign as a font draws it, at a size at which capital letters are 1 high. `None` if the font cannot draw it.
fn part(font: &Font, sign: char) -> Option<DrawingPart> {
    let words = sign.to_string();
    text::draw(&TextSettings::new(&words, font)).ok()?.drawing.parts.into_iter().next()
}

/// Samples of what a part draws, each with the strength of its light.
fn points(part: &DrawingPart) -> Vec<(Vec2, f64)> {
    drawn(part, SIGMA / 4.0).iter().map(|sample| (sample.at, sample.mass)).collect()
}

/// Draws points as an image: their box is centred, scaled by `scale`, then shifted by `shift`.
fn image(points: &[(Vec2, f64)], scale: f64, shift: Vec2) -> LightImage {
    let (low, high) = bounds(points.iter().map(|(at, _)| at)).unwrap_or_default();
    let middle = low.lerp(high, 0.5);
    let placed = points.iter().map(|(at, strength)| ((*at - middle) * scale + shift, *strength));
    LightImage::new(placed, HALF * -1.0, HALF, SIGMA)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_reads_as_itself_and_a_ring_of_lights_as_an_o() {
        let reader = SignReader::default();
        let font = Font::built_in("lato").unwrap();
        for sign in SIGNS.chars() {
            let places: Vec<Vec2> = points(&part(&font, sign).unwrap()).iter().map(|(at, _)| *at).collect();
            assert_eq!(reader.read(&places, 1.0, sign).unwrap().sign, sign);
        }
        let ring: Vec<Vec2> = (0..24)
            .map(|i| f64::from(i) * std::f64::consts::TAU / 24.0)
            .map(|turn| Vec2::new(libm::cos(turn), libm::sin(turn)) * 0.4)
            .collect();
        let read = reader.read(&ring, 1.0, 'A').unwrap();
        assert!(read.sign == 'O' && read.correlation > 0.85, "{read:?}");
    }

    #[test]
    fn what_is_no_sign_is_not_read() {
        let reader = SignReader::default();
        assert_eq!(reader.read(&[], 1.0, 'A'), None);
        assert_eq!(reader.read(&[Vec2::ZERO], 1.0, '?'), None);
    }
}
