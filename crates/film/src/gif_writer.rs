//! Writes films as GIF. All pictures share one palette, which keeps resting parts from flickering. Only changed pixels
//! are written.

use std::fmt;
use std::io::Write;

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

/// Number of colours of a palette.
pub const GIF_COLOURS: usize = 255;
/// Palette index of pixels that keep the colour of the previous picture: the transparent colour.
const AS_BEFORE: u8 = GIF_COLOURS as u8;
/// Largest number of pixels from which a palette is made.
const SAMPLES_MAX: usize = 300_000;
/// A pixel is dark if all its channels, 0 to 255, are below this.
const DARK: u8 = 24;
/// One of this number of dark pixels goes into the palette. Most of a floor is dark; if all dark pixels counted, lights
/// would get few colours.
const DARK_SHARE: usize = 24;
/// Sampling factor of the NeuQuant algorithm: it learns from one of this number of samples. 1 gives the best palette; a
/// factor of 10 is ten times as fast.
const LEARNING: i32 = 3;
/// Number of upper bits of each channel that decide which colour of the palette a pixel gets.
const BITS: u32 = 6;
/// Entry of `GifPalette::nearest` for a colour that was not looked up yet.
const UNKNOWN: u16 = u16::MAX;

/// Why a GIF cannot be written.
#[derive(Debug)]
pub struct GifError(String);

impl fmt::Display for GifError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for GifError {}

impl From<gif::EncodingError> for GifError {
    fn from(error: gif::EncodingError) -> Self {
        Self(error.to_string())
    }
}

/// The colours of a film.
pub struct GifPalette {
    colours: NeuQuant,
    /// Palette index of the nearest colour. The upper [`BITS`] of red, green and blue are the position in this list.
    /// [`UNKNOWN`] until it is first needed.
    nearest: Vec<u16>,
}

impl fmt::Debug for GifPalette {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GifPalette").finish_non_exhaustive()
    }
}

impl GifPalette {
    /// Makes a palette from some pictures of a film. A picture has three bytes for each pixel: red, green and blue.
    pub fn new<'a>(pictures: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut samples = Vec::new();
        let mut dark = 0;
        for pixel in pictures.into_iter().flat_map(|picture| picture.chunks_exact(3)) {
            let is_dark = pixel.iter().all(|channel| *channel < DARK);
            dark += usize::from(is_dark);
            if !is_dark || dark % DARK_SHARE == 1 {
                samples.push([pixel[0], pixel[1], pixel[2], 255]);
            }
        }
        let every = samples.len().div_ceil(SAMPLES_MAX).max(1);
        let mut samples: Vec<u8> = samples.into_iter().step_by(every).flatten().collect();
        // Learning needs a minimum number of pixels.
        samples.resize(samples.len().max(4 * 1024), 0);
        let colours = NeuQuant::new(LEARNING, GIF_COLOURS, &samples);
        Self { colours, nearest: vec![UNKNOWN; 1 << (3 * BITS)] }
    }

    fn index(&mut self, pixel: &[u8]) -> u8 {
        let key = pixel.iter().fold(0, |key, channel| key << BITS | usize::from(channel >> (8 - BITS)));
        if self.nearest[key] == UNKNOWN {
            // The middle of all colours with this key. The index then does not depend on which of them came first.
            let middle = |channel: &u8| (channel >> (8 - BITS) << (8 - BITS)) | 1 << (7 - BITS);
            let [r, g, b] = [&pixel[0], &pixel[1], &pixel[2]].map(middle);
            self.nearest[key] = self.colours.index_of(&[r, g, b, 255]).min(GIF_COLOURS - 1) as u16;
        }
        self.nearest[key] as u8
    }
}

/// Writes the pictures of a film to a GIF.
pub struct GifWriter<W: Write> {
    encoder: Encoder<W>,
    palette: GifPalette,
    size: (usize, usize),
    /// Palette indices of the pixels of the last picture.
    shown: Vec<u8>,
    /// The last frame. It is not written yet, because following pictures that are equal only prolong it.
    waiting: Option<Frame<'static>>,
    fps: f64,
    /// Number of pictures that were added.
    pictures: u64,
}

impl<W: Write> fmt::Debug for GifWriter<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GifWriter")
            .field("size", &self.size)
            .field("pictures", &self.pictures)
            .finish_non_exhaustive()
    }
}

impl<W: Write> GifWriter<W> {
    /// Writes the header of a film of `width` by `height` pixels with `fps` pictures per second. Players repeat the film for
    /// ever.
    ///
    /// # Errors
    /// If the header cannot be written, or the picture is too large for a GIF.
    pub fn new(to: W, (width, height): (u32, u32), fps: f64, palette: GifPalette) -> Result<Self, GifError> {
        let (Ok(across), Ok(down)) = (u16::try_from(width), u16::try_from(height)) else {
            return Err(GifError(format!("a GIF has at most 65535 x 65535 pixels, not {width} x {height}")));
        };
        let mut colours = palette.colours.color_map_rgb();
        colours.resize(3 * 256, 0);
        let mut encoder = Encoder::new(to, across, down, &colours)?;
        encoder.set_repeat(Repeat::Infinite)?;
        let size = (usize::from(across), usize::from(down));
        let shown = vec![AS_BEFORE; size.0 * size.1];
        Ok(Self { encoder, palette, size, shown, waiting: None, fps, pictures: 0 })
    }

    /// Adds the next picture of the film: red, green and blue of each pixel, row by row from the top left.
    ///
    /// # Errors
    /// If the previous frame cannot be written. It is written now, unless the new picture only prolongs it.
    pub fn add(&mut self, picture: &[u8]) -> Result<(), GifError> {
        let next: Vec<u8> = picture.chunks_exact(3).map(|pixel| self.palette.index(pixel)).collect();
        let moment = |pictures: u64| (pictures as f64 * 100.0 / self.fps).round() as u64;
        let delay = moment(self.pictures + 1) - moment(self.pictures);
        self.pictures += 1;
        match (self.changed(&next), &mut self.waiting) {
            (None, Some(waiting)) if u64::from(waiting.delay) + delay <= u64::from(u16::MAX) => {
                waiting.delay += delay as u16;
                return Ok(());
            }
            (changed, waiting) => {
                let frame = frame(self.size.0, changed.unwrap_or([0, 0, 1, 1]), &self.shown, &next, delay);
                if let Some(before) = waiting.replace(frame) {
                    self.encoder.write_frame(&before)?;
                }
            }
        }
        self.shown = next;
        Ok(())
    }

    /// Writes the last picture and ends the film.
    ///
    /// # Errors
    /// If the last picture or the end of the file cannot be written.
    pub fn finish(mut self) -> Result<W, GifError> {
        if let Some(last) = self.waiting.take() {
            self.encoder.write_frame(&last)?;
        }
        self.encoder.into_inner().map_err(|error| GifError(error.to_string()))
    }

    /// Returns left, top, right and bottom of the smallest area that contains all differences between `next` and the last
    /// picture, pixels. Right and bottom are exclusive. `None` if nothing differs.
    fn changed(&self, next: &[u8]) -> Option<[usize; 4]> {
        let mut area: Option<[usize; 4]> = None;
        for (index, _) in next.iter().zip(&self.shown).enumerate().filter(|(_, (new, old))| new != old) {
            let (x, y) = (index % self.size.0, index / self.size.0);
            let [left, top, right, bottom] = area.unwrap_or([x, y, x, y]);
            area = Some([left.min(x), top.min(y), right.max(x + 1), bottom.max(y + 1)]);
        }
        area
    }
}

/// Returns a GIF frame for an area. Pixels of the area that differ between `shown` and `next` get their new colours, all
/// others are transparent. `delay` is in hundredths of a second.
fn frame(
    width: usize,
    [left, top, right, bottom]: [usize; 4],
    shown: &[u8],
    next: &[u8],
    delay: u64,
) -> Frame<'static> {
    let mut buffer = Vec::with_capacity((right - left) * (bottom - top));
    for row in top..bottom {
        let row = row * width + left..row * width + right;
        let pixels = shown[row.clone()].iter().zip(&next[row]);
        buffer.extend(pixels.map(|(old, new)| if old == new { AS_BEFORE } else { *new }));
    }
    Frame {
        delay: delay as u16,
        dispose: DisposalMethod::Keep,
        transparent: Some(AS_BEFORE),
        left: left as u16,
        top: top as u16,
        width: (right - left) as u16,
        height: (bottom - top) as u16,
        buffer: buffer.into(),
        ..Frame::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gif::{ColorOutput, DecodeOptions};

    /// A dark picture of 40 by 20 pixels with a red square at `x`.
    fn picture(x: usize) -> Vec<u8> {
        let mut bytes = vec![6; 3 * 40 * 20];
        for row in 5..10 {
            for column in x..x + 5 {
                bytes[3 * (row * 40 + column)..][..3].copy_from_slice(&[250, 20, 20]);
            }
        }
        bytes
    }

    fn written(pictures: &[Vec<u8>], fps: f64) -> Vec<u8> {
        let palette = GifPalette::new(pictures.iter().map(Vec::as_slice));
        let mut writer = GifWriter::new(Vec::new(), (40, 20), fps, palette).unwrap();
        pictures.iter().for_each(|picture| writer.add(picture).unwrap());
        writer.finish().unwrap()
    }

    #[test]
    fn a_film_comes_back_with_its_colours_and_times() {
        let pictures = [picture(3), picture(3), picture(9)];
        let bytes = written(&pictures, 30.0);
        assert_eq!(bytes, written(&pictures, 30.0), "the same bytes");
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut decoder = options.read_info(&bytes[..]).unwrap();
        let first = decoder.read_next_frame().unwrap().unwrap().clone();
        // Two equal pictures become one: 3.33 and 6.67 hundredths of a second round to 7.
        assert_eq!((first.width, first.height, first.delay), (40, 20, 7));
        let pixel = |x: usize, y: usize| &first.buffer[4 * (y * 40 + x)..][..3];
        let near = |found: &[u8], wanted: [u8; 3]| {
            found.iter().zip(wanted).all(|(found, wanted)| found.abs_diff(wanted) <= 6)
        };
        assert!(near(pixel(5, 7), [250, 20, 20]) && near(pixel(20, 15), [6, 6, 6]), "{:?}", pixel(5, 7));
        let second = decoder.read_next_frame().unwrap().unwrap();
        // Only the changed area: both squares.
        assert_eq!((second.left, second.top, second.width, second.height), (3, 5, 11, 5));
        assert_eq!(second.delay, 3);
        assert!(decoder.read_next_frame().unwrap().is_none());
    }

    #[test]
    fn a_picture_that_is_too_large_is_refused() {
        let palette = GifPalette::new([]);
        let error = GifWriter::new(Vec::new(), (70_000, 20), 20.0, palette).unwrap_err();
        assert!(error.to_string().contains("65535"), "{error}");
    }
}
