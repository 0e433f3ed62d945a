//! Paints the contact sheet.

use std::error::Error;
use std::path::Path;

use image::{Rgb, RgbImage};
use lightbots_make::MadeFrame;

/// Side length of a cell, pixels.
const CELL: f64 = 110.0;

/// Number of sources in a row of the sheet.
const ACROSS: usize = 2;

/// Share of a cell that a picture fills.
const FILLED: f64 = 0.9;

/// A picture of cells with dots on black.
pub struct Sheet {
    image: RgbImage,
    columns: usize,
}

impl Sheet {
    pub fn new(sources: usize, columns: usize) -> Self {
        let (width, height) = (ACROSS * columns, sources.div_ceil(ACROSS));
        Self { image: RgbImage::new(width as u32 * CELL as u32, height as u32 * CELL as u32), columns }
    }

    /// Draws a frame into its cell. Each light is a disc nearly as wide as a robot, but 0.7 to 3.5 pixels in radius.
    pub fn draw(&mut self, source: usize, column: usize, made: &MadeFrame) {
        let scale = FILLED * CELL / made.size_m;
        let radius = (0.022 * scale).clamp(0.7, 3.5);
        let middle = [((source % ACROSS) * self.columns + column) as f64, (source / ACROSS) as f64];
        for pixel in &made.frame.pixels {
            let x = (middle[0] + 0.5) * CELL + pixel.at.x * scale;
            let y = (middle[1] + 0.5) * CELL - pixel.at.y * scale;
            self.disc(x, y, radius, [pixel.color.r, pixel.color.g, pixel.color.b]);
        }
    }

    fn disc(&mut self, x: f64, y: f64, radius: f64, color: [u8; 3]) {
        let reach = radius.ceil() as i64 + 1;
        for row in y as i64 - reach..=y as i64 + reach {
            for column in x as i64 - reach..=x as i64 + reach {
                let far = (column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y);
                let share = (radius + 0.5 - far).clamp(0.0, 1.0);
                let inside = u32::try_from(column).ok().zip(u32::try_from(row).ok());
                if let Some(old) =
                    inside.and_then(|(column, row)| self.image.get_pixel_mut_checked(column, row))
                {
                    let mixed =
                        |index: usize| f64::from(old.0[index]).max(share * f64::from(color[index])) as u8;
                    *old = Rgb([mixed(0), mixed(1), mixed(2)]);
                }
            }
        }
    }

    pub fn write(&self, file: &Path) -> Result<(), Box<dyn Error>> {
        Ok(self.image.save(file)?)
    }
}
