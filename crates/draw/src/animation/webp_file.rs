//! Animated WebP files.

use std::io::Cursor;

use image::codecs::webp::WebPDecoder;
use image::{AnimationDecoder, ImageDecoder};

use crate::animation::still::{
    PIXELS_MAX, STILLS_MAX, Still, Stills, damaged, lasts_s, sample, small, too_large,
};
use crate::error::DrawError;
use crate::picture::Bitmap;

/// Largest allowed width and height of the file's canvas, pixels. The decoder then holds several canvases of 17 MB
/// each.
const CANVAS_MAX: u32 = 2048;

/// Reads the pictures of an animated WebP file. A file that is cut off in its middle gives the pictures before that
/// point.
///
/// # Errors
/// A canvas that is too large, a file with a single picture, or a file without a whole picture.
pub fn stills(bytes: &[u8]) -> Result<Stills, DrawError> {
    let decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > CANVAS_MAX {
        return Err(too_large(width, height, CANVAS_MAX));
    }
    if !decoder.has_animation() {
        let message = "The WebP file has a single picture. Load it as a picture.";
        return Err(DrawError::new("animation-single", message));
    }
    let most = STILLS_MAX.min((PIXELS_MAX / u64::from(width * height).max(1)) as usize);
    let mut found = Stills::default();
    for frame in decoder.into_frames() {
        let frame = match frame {
            Ok(frame) => frame,
            Err(error) if found.stills.is_empty() => return Err(damaged(&error.to_string())),
            Err(_) => {
                found.cut = true;
                break;
            }
        };
        if found.stills.len() == most {
            found.cut = true;
            break;
        }
        let (milliseconds, parts) = frame.delay().numer_denom_ms();
        let lasts_s = lasts_s(milliseconds / parts.max(1));
        found.stills.push(Still { bitmap: reduced(frame.buffer()), lasts_s });
    }
    if found.stills.is_empty() { Err(damaged("it has no pictures")) } else { Ok(found) }
}

fn reduced(large: &image::RgbaImage) -> Bitmap {
    let (width, height) = (large.width() as usize, large.height() as usize);
    let (columns, rows) = small(width, height);
    let pixel = |index: usize| {
        let x = sample(index % columns, columns, width) as u32;
        let y = sample(index / columns, rows, height) as u32;
        large.get_pixel_checked(x, y).map_or([0; 4], |pixel| pixel.0)
    };
    Bitmap { columns, rows, pixels: (0..columns * rows).map(pixel).collect() }
}
