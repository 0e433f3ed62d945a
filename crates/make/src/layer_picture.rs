//! Reduces picture files to what layers of light project on the floor: few pixels and few pictures.

use lightbots_base::Rgb;
use lightbots_draw::DrawError;
use lightbots_draw::animation::{Still, stills};
use lightbots_draw::picture::Bitmap;
use lightbots_light::Linear;
use lightbots_show::LayerPicture;

/// Largest length of the longer side of a single picture, pixels, chosen by us. A floor of 10,000 robots needs 100 x 100.
const SIDE_MAX: usize = 256;
/// Largest length of the longer side of a film's pictures, pixels, chosen by us: with [`FILM_PICTURES_MAX`] pictures, a
/// film has at most 3 MB.
const FILM_SIDE_MAX: usize = 128;
/// Largest number of pictures of a film, chosen by us: 15 a second for 4 s. From a longer film, this number of pictures is
/// taken at equal intervals.
const FILM_PICTURES_MAX: usize = 60;

/// Reads the picture or film in a PNG, JPEG, WebP or GIF file and reduces its size. Transparent pixels become dark. In
/// the result, all pictures of a film last equally long; pictures of the file may therefore be repeated or left out.
///
/// # Errors
/// If the file has no pixels or is damaged, or its pictures are too large.
pub fn layer_picture(bytes: &[u8]) -> Result<LayerPicture, DrawError> {
    let stills = stills(bytes)?;
    let side_max = if stills.len() > 1 { FILM_SIDE_MAX } else { SIDE_MAX };
    let Some(first) = stills.first() else {
        return Err(DrawError::new("picture-format", "The file has no picture. Choose another."));
    };
    let (width, height) = size(&first.bitmap, side_max);
    let small: Vec<Vec<u8>> = stills.iter().map(|still| shrunk(&still.bitmap, width, height)).collect();
    let codes = moments(&stills).into_iter().flat_map(|number| small[number].iter().copied()).collect();
    // Width and height are at most `SIDE_MAX`.
    Ok(LayerPicture { width: width as u32, height: height as u32, codes })
}

/// Returns the numbers of columns and rows of a reduced picture: at least 1 each, the longer side at most `side_max`
/// pixels. A picture that is small enough keeps its size.
fn size(bitmap: &Bitmap, side_max: usize) -> (usize, usize) {
    let longer = bitmap.columns.max(bitmap.rows).max(1);
    let scaled = |side: usize| if longer <= side_max { side } else { side * side_max / longer };
    (scaled(bitmap.columns).max(1), scaled(bitmap.rows).max(1))
}

/// Returns the pictures of the reduced film as indices into `stills`. They all last equally long, so that an index may be
/// repeated or left out.
fn moments(stills: &[Still]) -> Vec<usize> {
    let lasts_s: f64 = stills.iter().map(|still| still.lasts_s).sum();
    let shortest_s = stills.iter().map(|still| still.lasts_s).fold(f64::INFINITY, f64::min);
    let count = ((lasts_s / shortest_s).round() as usize)
        .clamp(stills.len().min(FILM_PICTURES_MAX), FILM_PICTURES_MAX);
    let count = if stills.len() == 1 { 1 } else { count };
    let (mut number, mut end_s) = (0, stills[0].lasts_s);
    let shown = |nth: usize| {
        let at_s = (nth as f64 + 0.5) / count as f64 * lasts_s;
        while at_s >= end_s && number + 1 < stills.len() {
            number += 1;
            end_s += stills[number].lasts_s;
        }
        number
    };
    (0..count).map(shown).collect()
}

/// Reduces a picture to `width` by `height` pixels and returns their sRGB codes. Each pixel has the mean linear light of the
/// part of the large picture that it covers.
fn shrunk(bitmap: &Bitmap, width: usize, height: usize) -> Vec<u8> {
    let (columns, rows) = (shares(bitmap.columns, width), shares(bitmap.rows, height));
    let mut codes = Vec::with_capacity(3 * width * height);
    for row in &rows {
        for column in &columns {
            let mut sum = Linear::BLACK;
            for (y, tall) in row {
                for (x, wide) in column {
                    let [r, g, b, opacity] = bitmap.pixels[y * bitmap.columns + x];
                    let weight = tall * wide * f64::from(opacity) / 255.0;
                    sum = sum.zip(Linear::from_rgb(Rgb::new(r, g, b)), |sum, light| sum + light * weight);
                }
            }
            let Rgb { r, g, b } = sum.to_rgb();
            codes.extend([r, g, b]);
        }
    }
    codes
}

/// Divides a side of `length` pixels into `count` equal cells. Returns, for each cell, the indices of the pixels in it,
/// each with the share of the cell that the pixel covers.
fn shares(length: usize, count: usize) -> Vec<Vec<(usize, f64)>> {
    // In units of a `count`-th of a pixel, both pixels and cells begin at whole numbers.
    let cell = |nth: usize| {
        let (from, to) = (nth * length, (nth + 1) * length);
        let part =
            |pixel: usize| (to.min((pixel + 1) * count) - from.max(pixel * count)) as f64 / length as f64;
        (from / count..to.div_ceil(count)).map(|pixel| (pixel, part(pixel))).collect()
    };
    (0..count).map(cell).collect()
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use gif::{Encoder, Frame};
    use image::{ImageFormat, Rgba, RgbaImage};

    use super::*;

    fn png(picture: &RgbaImage) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn a_small_picture_keeps_its_codes_and_transparent_pixels_are_dark() {
        let pixels = [[1, 2, 3, 255], [200, 100, 0, 255], [255, 255, 255, 0], [0, 0, 255, 255]];
        let picture = RgbaImage::from_fn(2, 2, |x, y| Rgba(pixels[(2 * y + x) as usize]));
        let made = layer_picture(&png(&picture)).unwrap();
        assert_eq!((made.width, made.height), (2, 2));
        assert_eq!(made.codes, [1, 2, 3, 200, 100, 0, 0, 0, 0, 0, 0, 255]);
    }

    #[test]
    fn a_large_picture_becomes_the_mean_of_its_light() {
        // Half of the light of black and white stripes is the code 188.
        let stripes = RgbaImage::from_fn(512, 16, |x, _| Rgba([255 * (x % 2) as u8, 0, 0, 255]));
        let made = layer_picture(&png(&stripes)).unwrap();
        assert_eq!((made.width, made.height, made.pixels()), (256, 8, 2048));
        assert!(made.codes.chunks(3).all(|code| code == [188, 0, 0]));
        // Three pixels on two: 2/3 of the first and 1/3 of the second.
        let third = shares(3, 2);
        assert_eq!(third, [vec![(0, 2.0 / 3.0), (1, 1.0 / 3.0)], vec![(1, 1.0 / 3.0), (2, 2.0 / 3.0)]]);
    }

    #[test]
    fn a_film_has_each_picture_for_as_long_as_it_lasts_and_is_bounded() {
        let film = |delays: &[u16]| {
            let mut bytes = Vec::new();
            let mut encoder = Encoder::new(&mut bytes, 300, 2, &[0, 0, 0, 255, 255, 255]).unwrap();
            for (nth, delay) in delays.iter().enumerate() {
                let buffer = vec![u8::from(nth % 2 == 0); 600];
                let still =
                    Frame { width: 300, height: 2, delay: *delay, buffer: buffer.into(), ..Frame::default() };
                encoder.write_frame(&still).unwrap();
            }
            drop(encoder);
            layer_picture(&bytes).unwrap()
        };
        let made = film(&[10, 30]);
        let shown: Vec<u8> = made.codes.chunks(3 * 128).map(|picture| picture[0]).collect();
        assert_eq!((made.width, made.height, shown), (128, 1, vec![255, 0, 0, 0]));
        let long = film(&[5; 200]);
        assert_eq!(long.pixels(), 128 * FILM_PICTURES_MAX);
        assert_eq!(film(&[2, 6000]).pixels(), 128 * FILM_PICTURES_MAX);
    }

    #[test]
    fn hostile_files_are_refused_with_a_remedy() {
        let whole = png(&RgbaImage::from_fn(40, 40, |x, y| Rgba([(x * y) as u8, x as u8, 9, 255])));
        for end in 0..whole.len() - 12 {
            assert!(layer_picture(&whole[..end]).is_err_and(|error| error.message.ends_with('.')), "{end}");
        }
        // 10^9 pixels by the header, in 60 bytes.
        let mut huge = whole[..60].to_vec();
        huge[16..24].copy_from_slice(&[0, 0, 0x7a, 0x12, 0, 0, 0x7a, 0x12]);
        let checksum = crc32(&huge[12..29]);
        huge[29..33].copy_from_slice(&checksum.to_be_bytes());
        let refusal = layer_picture(&huge).unwrap_err();
        assert_eq!(refusal.code, "picture-too-large", "{refusal:?}");
        assert_eq!(layer_picture(b"<svg/>").unwrap_err().code, "picture-format");
        assert_eq!(layer_picture(b"").unwrap_err().code, "unknown-kind");
    }

    /// The checksum of a PNG's chunk.
    fn crc32(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(u32::MAX, |mut sum, byte| {
            sum ^= u32::from(*byte);
            (0..8).for_each(|_| sum = if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 });
            sum
        })
    }
}
