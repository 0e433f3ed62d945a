//! Decodes files of pictures into small upright bitmaps, within limits of size and memory. Files that are cut off are
//! refused.

use std::io::Cursor;

use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};

use crate::error::DrawError;
use crate::picture::bitmap::Bitmap;

/// Largest length of the reduced bitmap's longer side, pixels: about five pixels for each robot in a row of 100.
pub const SIDE_MAX: u32 = 512;
/// Largest width and height of the picture in the file, pixels.
const FILE_SIDE_MAX: u32 = 8192;
/// Largest memory of the decoded picture, bytes: 44 million pixels with three channels.
const MEMORY_MAX: u64 = 128 << 20;

/// Decodes the picture in a PNG, JPEG or WebP file, turns it upright and reduces it, so that no side is longer than
/// [`SIDE_MAX`].
///
/// # Errors
/// Other formats, pictures that are too large, damaged or cut off.
pub fn decode(bytes: &[u8]) -> Result<Bitmap, DrawError> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|_| unknown())?;
    match reader.format() {
        Some(ImageFormat::Png | ImageFormat::WebP) => {}
        Some(ImageFormat::Jpeg) if ends(bytes) => {}
        Some(ImageFormat::Jpeg) => return Err(cut_off("its end marker is missing")),
        _ => return Err(unknown()),
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(FILE_SIDE_MAX);
    limits.max_image_height = Some(FILE_SIDE_MAX);
    limits.max_alloc = Some(MEMORY_MAX);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(refused)?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > FILE_SIDE_MAX || decoder.total_bytes() > MEMORY_MAX {
        return Err(too_large(&format!("{width} × {height} pixels")));
    }
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let whole = DynamicImage::from_decoder(decoder).map_err(refused)?;
    let mut small = if width.max(height) > SIDE_MAX { whole.thumbnail(SIDE_MAX, SIDE_MAX) } else { whole };
    small.apply_orientation(orientation);
    let small = small.into_rgba8();
    let (columns, rows) = (small.width() as usize, small.height() as usize);
    Ok(Bitmap { columns, rows, pixels: small.pixels().map(|pixel| pixel.0).collect() })
}

/// Whether a JPEG file has its end marker. The end marker of a preview that a camera put into the file does not count.
fn ends(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let (Some(0xff), Some(marker)) = (bytes.get(at), bytes.get(at + 1)) {
        match marker {
            0xd9 => return true,
            0xff => at += 1,
            0x00 | 0x01 | 0xd0..=0xd8 => at += 2,
            _ => {
                let length = bytes.get(at + 2).zip(bytes.get(at + 3));
                let Some(length) = length.map(|(high, low)| usize::from(*high) << 8 | usize::from(*low))
                else {
                    return false;
                };
                at += 2 + length;
            }
        }
        // Image data follows some segments and may lie between others. A marker in it is 0xff before any byte but 0 and
        // 0xd0 to 0xd7.
        at += bytes.get(at..).map_or(0, to_marker);
    }
    false
}

/// Returns the number of bytes before the next marker, or of all bytes if there is none.
fn to_marker(data: &[u8]) -> usize {
    let is_marker = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0x00 | 0xd0..=0xd7);
    data.windows(2).position(is_marker).unwrap_or(data.len())
}

fn unknown() -> DrawError {
    DrawError::new("picture-format", "This is no picture in PNG, JPEG or WebP. Save it as PNG or JPEG.")
}

fn cut_off(reason: &str) -> DrawError {
    let message = format!("The picture is damaged or cut off: {reason}. Copy or download the file again.");
    DrawError::new("picture-cut-off", message)
}

fn too_large(size: &str) -> DrawError {
    let message = format!(
        "The picture is too large, {size}: at most {FILE_SIDE_MAX} on a side and 44 million pixels in all. Make it smaller; \
         {SIDE_MAX} pixels are enough."
    );
    DrawError::new("picture-too-large", message)
}

fn refused(error: ImageError) -> DrawError {
    match error {
        ImageError::Limits(_) => too_large("by its header"),
        error => cut_off(&error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_jpeg_is_not_that_of_its_preview() {
        let preview = [0xff, 0xe1, 0, 6, 0xff, 0xd8, 0xff, 0xd9];
        let scan = [0xff, 0xda, 0, 2, 1, 2, 0xff, 0, 3, 0xff, 0xd0, 4];
        let file: Vec<u8> = [[0xff, 0xd8].as_slice(), &preview, &scan, &[0xff, 0xd9]].concat();
        assert!(ends(&file));
        assert!((0..file.len()).all(|end| !ends(&file[..end])));
    }
}
