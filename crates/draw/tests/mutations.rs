//! Seeded mutations of good files for every decoder. Each is read, or refused with one line, and never panics.
//!
//! `LIGHTBOTS_MUTATIONS=100000 cargo test -p lightbots-draw --release --test mutations` tries more of them than the usual
//! run. Bytes that break a decoder are written to `corpus`, whose files every run reads.

#[path = "../../exchange/tests/mutator/mod.rs"]
mod mutator;
#[path = "../../exchange/tests/numbers/mod.rs"]
mod numbers;

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use image::{ImageFormat, Rgba, RgbaImage};
use lightbots_draw::picture::PictureSettings;
use lightbots_draw::text::{Font, TextSettings};
use lightbots_draw::{DrawError, animation, list, picture, svg, text};
use mutator::{corpus_files, keep_broken, mutant, rounds};
use numbers::Numbers;

/// Number of mutations of each file in a usual run.
const USUAL: usize = 150;

/// A decoder, and the name of its folder in the corpus.
type Decoder = (&'static str, fn(&[u8]) -> Result<(), DrawError>);

/// The decoders that are tested.
const DECODERS: [Decoder; 5] = [
    ("svg", |bytes| svg::draw(bytes).map(drop)),
    ("picture", |bytes| picture::draw(bytes, &PictureSettings::default()).map(drop)),
    ("animation", |bytes| animation::read(bytes, &PictureSettings::default()).map(drop)),
    ("list", |bytes| list::read(bytes).map(drop)),
    ("font", |bytes| {
        let font = Font::read(bytes)?;
        text::draw(&TextSettings::new("Ag \u{e9}", &font)).map(drop)
    }),
];

/// A picture of half a ring at the left edge, on a transparent ground.
fn small_picture() -> RgbaImage {
    RgbaImage::from_fn(24, 24, |x, y| {
        let distance = f64::from(x).hypot(f64::from(y) - 12.0);
        if (6.0..9.0).contains(&distance) { Rgba([255, 120, 0, 255]) } else { Rgba([0, 0, 0, 0]) }
    })
}

fn encoded(format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let picture = image::DynamicImage::ImageRgba8(small_picture());
    let picture = if format == ImageFormat::Jpeg { picture.to_rgb8().into() } else { picture };
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn small_gif() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = gif::Encoder::new(&mut bytes, 24, 24, &[]).unwrap();
    for turned in [false, true] {
        let picture = if turned { image::imageops::rotate90(&small_picture()) } else { small_picture() };
        let pixels: Vec<u8> = picture.pixels().map(|pixel| u8::from(pixel.0[3] > 0)).collect();
        let mut frame = gif::Frame::from_palette_pixels(24, 24, pixels, [0, 0, 0, 255, 120, 0], Some(0));
        frame.delay = 10;
        encoder.write_frame(&frame).unwrap();
    }
    drop(encoder);
    bytes
}

const SVG: &[u8] = br##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 30"><defs><g id="a"><path
d="M1 2 C 3 4, 5 6, 7 8 A 3 2 30 1 0 12 9 Z" fill="#f80" stroke="red" stroke-width="2" stroke-dasharray="1 2"/></g>
<clipPath id="c"><circle cx="5" cy="5" r="4"/></clipPath></defs><style>.b{fill:hsl(20,50%,50%)}</style>
<use href="#a" transform="rotate(20) scale(1.5 -1)"/><g clip-path="url(#c)" opacity="0.5"><rect class="b" width="9"
height="50%" rx="1"/></g><polyline points="1,1 2,3 4,5" fill="none" stroke="#00f"/></svg>"##;

const LIST: &[u8] = b"0,5;1,5;255;0;10\n-1;2e1;0;0;0\n3;4;1;2;3\n";

/// Good files of the decoder with this name.
fn seeds(decoder: &str) -> Vec<Vec<u8>> {
    match decoder {
        "svg" => vec![SVG.to_vec()],
        "picture" => [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP].map(encoded).into(),
        "animation" => vec![small_gif()],
        "list" => vec![LIST.to_vec(), b"1.5, 2.0, #ff8800\n0, 1, orange\n".to_vec()],
        _ => vec![include_bytes!("../fonts/NotoSansHebrew-Bold-part.ttf").to_vec()],
    }
}

fn corpus(decoder: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(decoder)
}

/// Whether a decoder reads the bytes. The refusal must be one line.
fn is_read((name, decode): Decoder, bytes: &[u8]) -> bool {
    match catch_unwind(AssertUnwindSafe(|| decode(bytes))) {
        Ok(Ok(())) => true,
        Ok(Err(error)) => {
            assert!(!error.message.contains('\n') && error.message.len() < 400, "{}", error.message);
            false
        }
        Err(_) => {
            let file = keep_broken(&corpus(name), bytes);
            panic!("the decoder {name} breaks at {}; keep that file", file.display());
        }
    }
}

#[test]
fn no_mutation_breaks_a_decoder() {
    let mut numbers = Numbers(1);
    for decoder in DECODERS {
        let (mut were_read, mut tried) = (0, 0);
        for good in seeds(decoder.0) {
            assert!(is_read(decoder, &good), "a good file of {} is refused", decoder.0);
            for _ in 0..rounds(USUAL) {
                tried += 1;
                were_read += usize::from(is_read(decoder, &mutant(&good, 3, &mut numbers)));
            }
        }
        assert!(were_read > 0 && were_read < tried, "{}: {were_read} of {tried} are read", decoder.0);
    }
}

#[test]
fn files_that_broke_a_decoder_once_do_not_any_more() {
    for decoder in DECODERS {
        for bytes in corpus_files(&corpus(decoder.0)) {
            is_read(decoder, &bytes);
        }
    }
}
