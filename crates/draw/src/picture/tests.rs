//! Whole files: formats, ways, and what is refused.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, Rgba, RgbaImage};
use lightbots_base::random::split_mix;

use super::{PictureSettings, PictureWay, draw};
use crate::drawing::DrawingPart;

/// A red disc in the upper left quarter of a picture that is twice as wide as high.
fn disc(ground: [u8; 4]) -> DynamicImage {
    let pixel = |x: u32, y: u32| {
        let away = libm::hypot(f64::from(x) - 30.0, f64::from(y) - 20.0);
        Rgba(if away < 15.0 { [220, 20, 20, 255] } else { ground })
    };
    RgbaImage::from_fn(120, 60, pixel).into()
}

fn file(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let picture = if format == ImageFormat::Jpeg { picture.to_rgb8().into() } else { picture.clone() };
    picture.write_to(&mut bytes, format).expect("it can be written");
    bytes.into_inner()
}

fn part(bytes: &[u8], way: PictureWay) -> DrawingPart {
    let settings = PictureSettings { way, ..PictureSettings::default() };
    draw(bytes, &settings).expect("it can be drawn").drawing.parts.remove(0)
}

fn refusal(bytes: &[u8]) -> Option<&'static str> {
    draw(bytes, &PictureSettings::default()).err().map(|error| {
        assert!(error.message.ends_with('.'), "{}", error.message);
        error.code
    })
}

#[test]
fn a_thing_is_shown_as_silhouette_in_every_format() {
    let picture = disc([240, 240, 240, 255]);
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP] {
        let part = part(&file(&picture, format), PictureWay::Auto);
        let [area] = part.areas.as_slice() else { panic!("{format:?}: {} areas", part.areas.len()) };
        let [ring] = area.rings.as_slice() else { panic!("{format:?}: {} rings", area.rings.len()) };
        let middle = ring.iter().fold(lightbots_base::Vec2::ZERO, |sum, at| sum + *at) / ring.len() as f64;
        assert!(middle.distance(lightbots_base::Vec2::new(30.5, 39.5)) < 1.0, "{format:?}: {middle:?}");
        assert!(area.ink.color.r > 180 && area.ink.color.g < 80, "{format:?}: {:?}", area.ink.color);
    }
}

#[test]
fn the_way_can_be_chosen() {
    let bytes = file(&disc([0, 0, 0, 0]), ImageFormat::Png);
    let outline = part(&bytes, PictureWay::Outline);
    assert_eq!((outline.areas.len(), outline.strokes.len()), (0, 1));
    assert!(outline.strokes[0].closed && outline.raster.is_some());
    let tones = part(&bytes, PictureWay::Tones);
    let raster = tones.raster.expect("tones are a raster");
    assert_eq!((tones.areas.len(), raster.columns, raster.rows()), (0, 120, 60));
    assert!(raster.weights[20 * 120 + 30] > 0.9 && raster.weights[0] == 0.0);
}

#[test]
fn scenes_without_a_background_become_tones() {
    let mut state = 7;
    let scene = RgbaImage::from_fn(64, 64, |_, _| {
        let [r, g, b, ..] = split_mix(&mut state).to_le_bytes();
        Rgba([r, g, b, 255])
    });
    let made =
        draw(&file(&scene.into(), ImageFormat::Png), &PictureSettings::default()).expect("it has tones");
    assert_eq!(made.notes.iter().map(|note| note.code).collect::<Vec<_>>(), ["picture-tones"]);
    assert!(made.drawing.parts[0].areas.is_empty());
}

#[test]
fn black_things_are_lit_white() {
    let picture = RgbaImage::from_fn(60, 60, |x, y| {
        Rgba(if (20..40).contains(&x.max(y)) { [0, 0, 0, 255] } else { [255; 4] })
    });
    let part = part(&file(&picture.into(), ImageFormat::Png), PictureWay::Auto);
    assert_eq!(part.areas[0].ink.color.number(), 0xff_ffff);
}

#[test]
fn pictures_are_turned_as_the_camera_says() {
    let bytes = file(&disc([240, 240, 240, 255]), ImageFormat::Jpeg);
    // Exif with one entry: orientation (0x112) is 6, a quarter turn clockwise.
    let exif = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";
    let length = (exif.len() as u16 + 2).to_be_bytes();
    let turned = [&bytes[..2], &[0xff, 0xe1], &length, exif, &bytes[2..]].concat();
    let raster = part(&turned, PictureWay::Tones).raster.expect("tones are a raster");
    assert_eq!((raster.columns, raster.rows()), (60, 120));
}

#[test]
fn large_pictures_are_made_small() {
    let picture = RgbaImage::from_pixel(2000, 30, Rgba([200; 4]));
    let raster =
        part(&file(&picture.into(), ImageFormat::Png), PictureWay::Tones).raster.expect("tones are a raster");
    assert_eq!((raster.columns, raster.rows()), (512, 8));
}

#[test]
fn files_that_are_no_pictures_are_refused() {
    assert_eq!(refusal(b""), Some("picture-format"));
    assert_eq!(refusal(b"only text, though its name ends in .png"), Some("picture-format"));
    assert_eq!(refusal(b"GIF89a\x01\0\x01\0\0\0\0;"), Some("picture-format"));
    let plain = RgbaImage::from_pixel(9, 9, Rgba([0, 0, 0, 255]));
    assert_eq!(refusal(&file(&plain.into(), ImageFormat::Png)), Some("picture-empty"));
}

/// A PNG with only its header, width and height in pixels.
fn png_header(side: u32) -> Vec<u8> {
    let mut bytes = file(&RgbaImage::new(1, 1).into(), ImageFormat::Png);
    bytes[16..20].copy_from_slice(&side.to_be_bytes());
    bytes[20..24].copy_from_slice(&side.to_be_bytes());
    let mut crc = u32::MAX;
    for byte in &bytes[12..29] {
        crc ^= u32::from(*byte);
        (0..8).for_each(|_| crc = crc >> 1 ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 });
    }
    bytes[29..33].copy_from_slice(&(!crc).to_be_bytes());
    bytes
}

#[test]
fn headers_of_huge_pictures_are_refused() {
    assert_eq!(refusal(&png_header(30_000)), Some("picture-too-large"));
    assert_eq!(refusal(&png_header(8_000)), Some("picture-too-large"));
    let mut jpeg = file(&disc([0, 0, 0, 255]), ImageFormat::Jpeg);
    let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("it is a baseline JPEG");
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0xff, 0xdc, 0xff, 0xdc]);
    assert_eq!(refusal(&jpeg), Some("picture-too-large"));
    // A lossless WebP of 38 bytes: 14 bits each for the width minus one and the height minus one.
    let size = (8_000u32 - 1) | (8_000 - 1) << 14;
    let chunk = [b"VP8L".as_slice(), &18u32.to_le_bytes(), &[0x2f], &size.to_le_bytes(), &[0; 13]].concat();
    let webp = [b"RIFF".as_slice(), &(chunk.len() as u32 + 4).to_le_bytes(), b"WEBP", &chunk].concat();
    assert_eq!((webp.len(), refusal(&webp)), (38, Some("picture-too-large")));
}

#[test]
fn files_cut_off_anywhere_are_refused() {
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP] {
        let bytes = file(&disc([240, 240, 240, 255]), format);
        // The end mark of a PNG and the padding of a WebP hold no part of the picture.
        let spare = match format {
            ImageFormat::Png => 12,
            ImageFormat::WebP => 1,
            _ => 0,
        };
        let whole = bytes.len() - spare;
        for end in 0..whole {
            assert!(refusal(&bytes[..end]).is_some(), "{format:?}: {end} of {}", bytes.len());
        }
    }
}

#[test]
fn damaged_files_are_drawn_or_refused() {
    let mut state = 25;
    let mut below = |count: usize| (split_mix(&mut state) % count as u64) as usize;
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP] {
        let whole = file(&disc([240, 240, 240, 255]), format);
        for _ in 0..150 {
            let mut bytes = whole.clone();
            for _ in 0..1 + below(4) {
                bytes[below(whole.len())] = below(256) as u8;
            }
            if let Ok(made) = draw(&bytes, &PictureSettings::default()) {
                assert!(made.drawing.points().all(|at| at.is_finite()));
            }
        }
    }
}
