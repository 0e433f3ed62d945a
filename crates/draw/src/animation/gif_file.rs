//! Reads GIF files and composes their pictures at reduced size. In a GIF, a picture may change only a part of the
//! picture before.

use std::num::NonZeroU64;

use gif::{ColorOutput, DecodeOptions, DisposalMethod, Frame, MemoryLimit};

use crate::animation::still::{
    PIXELS_MAX, STILLS_MAX, Still, Stills, damaged, lasts_s, sample, small, too_large,
};
use crate::error::DrawError;
use crate::picture::Bitmap;

/// Largest allowed width and height of the file's canvas, pixels.
const CANVAS_MAX: u32 = 4096;
/// Largest memory of the decoder for one picture, bytes.
const MEMORY_MAX: NonZeroU64 = NonZeroU64::new(64 << 20).expect("64 MiB are not zero");

/// Reads the pictures of a GIF file. A file that is cut off in its middle gives the pictures before that point.
///
/// # Errors
/// A canvas that is too large, or a file without a whole picture.
pub fn stills(bytes: &[u8]) -> Result<Stills, DrawError> {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    options.set_memory_limit(MemoryLimit::Bytes(MEMORY_MAX));
    let mut decoder = options.read_info(bytes).map_err(|error| damaged(&error.to_string()))?;
    let (width, height) = (u32::from(decoder.width()), u32::from(decoder.height()));
    if width.max(height) > CANVAS_MAX {
        return Err(too_large(width, height, CANVAS_MAX));
    }
    let mut canvas = SmallCanvas::new(width as usize, height as usize);
    let mut found = Stills::default();
    let mut pixels = 0;
    loop {
        let frame = match decoder.read_next_frame() {
            Ok(Some(frame)) => frame,
            Ok(None) => break,
            Err(error) if found.stills.is_empty() => return Err(damaged(&error.to_string())),
            Err(_) => {
                found.cut = true;
                break;
            }
        };
        pixels += u64::from(frame.width) * u64::from(frame.height);
        if found.stills.len() == STILLS_MAX || pixels > PIXELS_MAX {
            found.cut = true;
            break;
        }
        let bitmap = canvas.show(frame);
        found.stills.push(Still { bitmap, lasts_s: lasts_s(u32::from(frame.delay) * 10) });
    }
    if found.stills.is_empty() { Err(damaged("it has no pictures")) } else { Ok(found) }
}

/// What the canvas of a GIF shows, at reduced size.
struct SmallCanvas {
    width: usize,
    height: usize,
    shown: Bitmap,
}

impl SmallCanvas {
    fn new(width: usize, height: usize) -> Self {
        let (columns, rows) = small(width, height);
        Self { width, height, shown: Bitmap { columns, rows, pixels: vec![[0; 4]; columns * rows] } }
    }

    /// Draws a frame on the canvas and returns what the canvas shows then. Afterwards the canvas is left for the next
    /// frame as this frame's disposal method says.
    fn show(&mut self, frame: &Frame) -> Bitmap {
        let before = self.shown.clone();
        let mut after = before.clone();
        let (columns, rows) = (self.shown.columns, self.shown.rows);
        for row in 0..rows {
            let Some(y) = sample(row, rows, self.height).checked_sub(usize::from(frame.top)) else {
                continue;
            };
            for column in 0..columns {
                let x = sample(column, columns, self.width).checked_sub(usize::from(frame.left));
                let Some(x) = x.filter(|x| *x < usize::from(frame.width) && y < usize::from(frame.height))
                else {
                    continue;
                };
                let at = (y * usize::from(frame.width) + x) * 4;
                let index = row * columns + column;
                if let Some([r, g, b, 255]) = frame.buffer.get(at..at + 4) {
                    self.shown.pixels[index] = [*r, *g, *b, 255];
                }
                after.pixels[index] = [0; 4];
            }
        }
        let next = match frame.dispose {
            DisposalMethod::Any | DisposalMethod::Keep => self.shown.clone(),
            DisposalMethod::Background => after,
            DisposalMethod::Previous => before,
        };
        std::mem::replace(&mut self.shown, next)
    }
}
