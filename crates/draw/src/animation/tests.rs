//! Whole files: times, composition, and what is refused.

use gif::{DisposalMethod, Encoder, Frame};
use image::{ImageFormat, Rgba, RgbaImage};
use lightbots_base::Vec2;
use lightbots_base::random::split_mix;

use super::{Animation, of_pictures, read};
use crate::picture::PictureSettings;

/// Black, white and red.
const PALETTE: [u8; 9] = [0, 0, 0, 255, 255, 255, 255, 0, 0];

/// A GIF of frames on a square canvas with sides of `canvas` pixels.
fn gif(canvas: u16, frames: &[Frame<'static>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, canvas, canvas, &PALETTE).expect("the palette is small");
    frames.iter().for_each(|frame| encoder.write_frame(frame).expect("it is written into memory"));
    drop(encoder);
    bytes
}

/// A frame of `side` by `side` pixels, with a square of colour `index` of the palette on white. The square has the
/// columns and rows from `from` to before `to`.
fn square(side: u16, from: u16, to: u16, index: u8) -> Frame<'static> {
    let inside = |n: u16| (from..to).contains(&(n % side)) && (from..to).contains(&(n / side));
    let buffer: Vec<u8> = (0..side * side).map(|n| if inside(n) { index } else { 1 }).collect();
    Frame { width: side, height: side, delay: 20, buffer: buffer.into(), ..Frame::default() }
}

fn animation(bytes: &[u8]) -> Animation {
    read(bytes, &PictureSettings::default()).expect("it is an animation")
}

fn refusal(bytes: &[u8]) -> Option<&'static str> {
    read(bytes, &PictureSettings::default()).err().map(|error| {
        assert!(error.message.ends_with('.'), "{}", error.message);
        error.code
    })
}

fn middle(animation: &Animation, frame: usize) -> Vec2 {
    let (low, high) = animation.frames[frame].drawing.bounds().expect("it shows something");
    let part = &animation.frames[frame].drawing.parts[0];
    let points: Vec<Vec2> = part.areas.iter().flat_map(|area| area.rings.iter().flatten()).copied().collect();
    assert!(low.x <= high.x && !points.is_empty());
    points.iter().fold(Vec2::ZERO, |sum, at| sum + *at) / points.len() as f64
}

#[test]
fn frames_have_silhouettes_and_times() {
    let frames: Vec<Frame> = (0..4).map(|n| square(60, 5 + 5 * n, 25 + 5 * n, 2)).collect();
    let animation = animation(&gif(60, &frames));
    assert_eq!(
        animation.times_s().iter().map(|at| (at * 10.0).round()).collect::<Vec<_>>(),
        [0.0, 2.0, 4.0, 6.0]
    );
    let first = middle(&animation, 0);
    assert!(first.distance(Vec2::new(15.0, 45.0)) < 1.5, "{first:?}");
    assert!(middle(&animation, 3).distance(Vec2::new(30.0, 30.0)) < 1.5);
    assert!(animation.frames[0].drawing.parts[0].areas[0].ink.color.r > 200);
    let [near, far] = [animation.change(0, 1), animation.change(0, 3)];
    assert!(animation.change(2, 2) < 1e-9 && 0.0 < near && near < far, "{near} {far}");
}

#[test]
fn frames_are_composed_by_their_disposal() {
    let whole = square(60, 10, 20, 2);
    let small = |dispose| Frame {
        left: 40,
        top: 40,
        width: 10,
        height: 10,
        dispose,
        buffer: vec![2; 100].into(),
        ..Frame::default()
    };
    let nothing =
        || Frame { width: 1, height: 1, transparent: Some(0), buffer: vec![0].into(), ..Frame::default() };
    let rings = |dispose| {
        let animation = animation(&gif(60, &[whole.clone(), small(dispose), nothing()]));
        let count = |frame: usize| animation.frames[frame].drawing.parts[0].areas[0].rings.len();
        (count(1), count(2))
    };
    assert_eq!(rings(DisposalMethod::Keep), (2, 2));
    // What only a single picture shows is smoothed away.
    assert_eq!(rings(DisposalMethod::Previous), (1, 1));
    // A transparent hole in the canvas.
    assert_eq!(rings(DisposalMethod::Background), (1, 2));
}

#[test]
fn long_and_large_animations_are_bounded() {
    let tiny = Frame { width: 1, height: 1, buffer: vec![2].into(), ..Frame::default() };
    let mut frames = vec![square(60, 10, 30, 2)];
    frames.extend(std::iter::repeat_n(tiny.clone(), 10_000));
    let long = animation(&gif(60, &frames));
    assert_eq!((long.frames.len(), long.notes[0].code), (300, "animation-cut"));
    assert_eq!(refusal(&gif(u16::MAX, &[tiny])), Some("animation-too-large"));
    let huge = Frame { width: 1, height: 1, buffer: vec![2].into(), ..Frame::default() };
    let mut bytes = gif(60, &[huge]);
    let block = bytes.iter().rposition(|byte| *byte == 0x2c).expect("it has a frame");
    bytes[block + 5..block + 9].copy_from_slice(&[0xff; 4]);
    assert_eq!(refusal(&bytes), Some("animation-cut-off"));
}

#[test]
fn pictures_in_a_row_are_an_animation() {
    let picture = |x: u32, side: u32| {
        let inside = |at: u32, from: u32| (from * side / 50..(from + 15) * side / 50).contains(&at);
        let image = RgbaImage::from_fn(side, side, |column, row| {
            Rgba(if inside(column, x) && inside(row, 10) { [0, 200, 0, 255] } else { [255; 4] })
        });
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Png).expect("it can be written");
        bytes.into_inner()
    };
    let files = [picture(5, 50), picture(10, 100), picture(15, 50)];
    let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    let animation = of_pictures(&files, 0.5, &PictureSettings::default()).expect("they are pictures");
    assert_eq!(animation.times_s(), [0.0, 0.5, 1.0]);
    assert!(middle(&animation, 1).distance(Vec2::new(17.5, 32.5)) < 1.5, "{:?}", middle(&animation, 1));
    let wrong = of_pictures(&[files[0], b"no"], 0.5, &PictureSettings::default());
    assert!(wrong.is_err_and(|error| error.message.starts_with("Picture 2 of 2: ")));
    assert!(of_pictures(&files, f64::NAN, &PictureSettings::default()).is_err());
    assert!(of_pictures(&[], 1.0, &PictureSettings::default()).is_err());
}

#[test]
fn webp_headers_are_bounded() {
    // The 30 bytes of a header with the animation flag, and a canvas of 8,000 pixels on each side.
    let side = &(8_000u32 - 1).to_le_bytes()[..3];
    let extended = [b"VP8X".as_slice(), &10u32.to_le_bytes(), &[2, 0, 0, 0], side, side].concat();
    let control = [b"ANIM".as_slice(), &6u32.to_le_bytes(), &[0; 6]].concat();
    let inner = [b"VP8L".as_slice(), &18u32.to_le_bytes(), &[0x2f; 18]].concat();
    let length = (16 + inner.len() as u32).to_le_bytes();
    let frame = [b"ANMF".as_slice(), &length, &[0; 16], &inner].concat();
    let chunks = [extended, control, frame].concat();
    let file = [b"RIFF".as_slice(), &(chunks.len() as u32 + 4).to_le_bytes(), b"WEBP", &chunks].concat();
    assert_eq!(refusal(&file), Some("animation-too-large"));
    assert_eq!(refusal(b"1,2,red"), Some("animation-single"));
    assert_eq!(refusal(b"%PDF"), Some("unknown-kind"));
}

#[test]
fn damaged_files_are_read_or_refused() {
    let whole = gif(30, &[square(30, 5, 15, 2), square(30, 10, 20, 2)]);
    let settings = PictureSettings::default();
    for end in 0..whole.len() - 1 {
        if let Ok(animation) = read(&whole[..end], &settings) {
            assert!(
                animation.frames.len() < 2 || !animation.notes.is_empty() || end + 2 >= whole.len(),
                "{end}"
            );
        }
    }
    let mut state = 25;
    let mut below = |count: usize| (split_mix(&mut state) % count as u64) as usize;
    for _ in 0..300 {
        let mut bytes = whole.clone();
        for _ in 0..1 + below(4) {
            bytes[below(whole.len())] = below(256) as u8;
        }
        if let Ok(animation) = read(&bytes, &settings) {
            assert!(animation.frames.iter().all(|frame| frame.drawing.points().all(|at| at.is_finite())));
        }
    }
}
