//! Generated pictures with the noise, shadows and soft edges of photographs, and an animation.

use std::error::Error;
use std::io::Cursor;

use image::{ImageFormat, Rgb, RgbImage};
use lightbots_base::random::split_mix;

type Bytes = Result<Vec<u8>, Box<dyn Error>>;

/// Width and height of a generated photograph, pixels.
const SIDE: u32 = 320;

/// A lit ball on a dark ground, as JPEG.
pub fn ball() -> Bytes {
    photograph(ImageFormat::Jpeg, |x, y| {
        let square = x * x + y * y;
        if square > 0.64 {
            return [14.0, 14.0, 18.0];
        }
        let z = (0.64 - square).sqrt();
        let light = ((-0.5 * x + 0.6 * y + 0.7 * z) / 0.8).max(0.05);
        [250.0 * light, 190.0 * light, 80.0 * light]
    })
}

/// A red mug on a table in front of a wall, as JPEG.
pub fn mug() -> Bytes {
    photograph(ImageFormat::Jpeg, |x, y| {
        let body = x.abs() < 0.4 && y.abs() < 0.5;
        let from_handle = ((x - 0.45).powi(2) + y * y).sqrt();
        let handle = x > 0.38 && (0.2..0.33).contains(&from_handle);
        if body || handle {
            let shade = 1.0 - 0.5 * (x + 0.1).abs();
            return [200.0 * shade, 40.0 * shade, 45.0 * shade];
        }
        let wall = 0.9 + 0.1 * y;
        [215.0 * wall, 212.0 * wall, 205.0 * wall]
    })
}

/// Hills under an evening sky, as JPEG.
pub fn hills() -> Bytes {
    photograph(ImageFormat::Jpeg, |x, y| {
        let ridge = |base: f64, wave: f64, phase: f64| base + 0.16 * (wave * x + phase).sin();
        if y < ridge(-0.55, 4.0, 0.4) {
            [18.0, 28.0, 24.0]
        } else if y < ridge(-0.15, 3.0, 2.0) {
            [50.0, 70.0, 66.0]
        } else {
            let near_sun = (-6.0 * ((x - 0.3).powi(2) + (y - 0.25).powi(2))).exp();
            [120.0 + 135.0 * near_sun, 80.0 + 150.0 * near_sun, 90.0 + 60.0 * near_sun]
        }
    })
}

/// A leaf on paper, as PNG.
pub fn leaf() -> Bytes {
    photograph(ImageFormat::Png, |x, y| {
        let (along, across) = (0.707 * (x + y), 0.707 * (y - x));
        let half = 0.34 * (1.0 - (along / 0.85).powi(2)).max(0.0);
        if across.abs() < half || (along < -0.6 && along > -1.05 && across.abs() < 0.03) {
            let vein = if across.abs() < 0.02 { 1.35 } else { 1.0 };
            return [60.0 * vein, 140.0 * vein, 50.0 * vein];
        }
        [236.0, 234.0, 226.0]
    })
}

/// A heart that makes a quarter turn in two seconds, as GIF.
pub fn turning_heart() -> Bytes {
    /// Number of pictures of the animation.
    const PICTURES: u16 = 20;
    /// Width and height of each picture, pixels.
    const WIDE: u16 = 96;
    let mut bytes = Vec::new();
    let mut encoder = gif::Encoder::new(&mut bytes, WIDE, WIDE, &[0, 0, 0, 255, 60, 90])?;
    for picture in 0..PICTURES {
        let (sin, cos) = (f64::from(picture) * std::f64::consts::FRAC_PI_2 / f64::from(PICTURES)).sin_cos();
        let cells = (0..WIDE * WIDE).map(|cell| {
            let [x, y] =
                [cell % WIDE, cell / WIDE].map(|at| (f64::from(at) + 0.5) * 2.6 / f64::from(WIDE) - 1.3);
            u8::from(in_heart(cos * x + sin * y, sin * x - cos * y))
        });
        let frame = gif::Frame {
            delay: 10,
            ..gif::Frame::from_indexed_pixels(WIDE, WIDE, cells.collect::<Vec<u8>>(), None)
        };
        encoder.write_frame(&frame)?;
    }
    drop(encoder);
    Ok(bytes)
}

fn in_heart(x: f64, y: f64) -> bool {
    (x * x + y * y - 0.8).powi(3) - x * x * y * y * y <= 0.0
}

/// A picture of the colours that `shade` returns for x and y from -1 to 1, y up, with the noise of a sensor. Colours
/// are red, green and blue, 0 to 255.
fn photograph(format: ImageFormat, shade: impl Fn(f64, f64) -> [f64; 3]) -> Bytes {
    let mut state = 7;
    let mut grain = || (split_mix(&mut state) % 13) as f64 - 6.0;
    let image = RgbImage::from_fn(SIDE, SIDE, |column, row| {
        let at = |cell: u32| (f64::from(cell) + 0.5) * 2.0 / f64::from(SIDE) - 1.0;
        Rgb(shade(at(column), -at(row)).map(|value| (value + grain()).clamp(0.0, 255.0) as u8))
    });
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format)?;
    Ok(bytes.into_inner())
}
