//! Film strips that show each effect at ten moments on a floor of 16 by 10 robots.

use image::{Rgb as Dot, RgbImage};
use lightbots_base::{Rgb, Vec2};
use lightbots_light::*;

/// Number of moments in a strip.
const MOMENTS: u32 = 10;
/// Time between two moments, seconds.
const STEP_S: f64 = 0.2;
/// Number of robots in a row, and number of rows.
const ROBOTS: (u32, u32) = (16, 10);
/// Distance between neighbouring robots, metres.
const SPACING_M: f64 = 0.2;
/// Side of a robot's square, and distance from one robot to the next, pixels.
const DOT: (u32, u32) = (5, 6);
/// Gap between two moments, pixels.
const GAP: u32 = 6;

/// The effects with settings that show them well, each with the name of its file.
fn scenes() -> Vec<(&'static str, LightEffect, Look)> {
    let heat = ["#000000", "#8a0a00", "#ff5a00", "#ffd060"].map(colour);
    let sea = ["#001040", "#0060c0", "#40e0c0", "#ffffff"].map(colour);
    let sunset = ["#2b0a5e", "#d81e5b", "#ffb347", "#2b0a5e"].map(colour);
    let with = |colours: &[Rgb]| Look { palette: Palette::even(colours), ..Look::default() };
    let glow = |colour_of: &str| Look { palette: Palette::rising(colour(colour_of)), ..Look::default() };
    let left = Vec2::new(-1.5, 0.0);
    let foot = Vec2::new(0.0, -1.0);
    let rainbow = LightEffect::Rainbow { along: Coordinate::Line, saturation: 1.0 };
    let scarlet = Look { palette: Palette::plain(colour("#ff2200")), ..Look::default() };
    let looped = Look { wrap: Wrap::Loop, size_m: 3.0, place: left, ..with(&sunset) };
    let up = core::f64::consts::FRAC_PI_2;
    vec![
        ("solid", LightEffect::Solid, scarlet),
        ("gradient", LightEffect::Gradient(Coordinate::Line), looped),
        ("fade", LightEffect::Fade, Look { wrap: Wrap::Mirror, ease: Ease::Sine, ..with(&sea) }),
        ("pulse", LightEffect::Pulse, Look { speed_hz: 1.0, width: 0.15, ease: Ease::In, ..glow("#ffffff") }),
        ("strobe", LightEffect::Strobe, Look { speed_hz: 2.0, width: 0.45, ..glow("#ffffff") }),
        ("twinkle", LightEffect::Twinkle { density: 0.5 }, Look { width: 0.9, ..glow("#ffe0a0") }),
        ("sparkle", LightEffect::Sparkle { density: 0.1 }, Look { speed_hz: 10.0, ..glow("#ffffff") }),
        ("rainbow", rainbow, Look { size_m: 3.2, ..Look::default() }),
        ("wave", LightEffect::Wave(Coordinate::Line), Look { size_m: 1.6, angle: 0.6, ..glow("#40a0ff") }),
        ("chase", LightEffect::Chase(spiral()), Look { width: 0.5, ..glow("#60ff60") }),
        ("ripple", LightEffect::Ripple, Look { size_m: 2.0, width: 0.2, ..glow("#80d0ff") }),
        ("plasma", LightEffect::Plasma, Look { size_m: 2.0, seed: 3, ..with(&sunset) }),
        ("noise", LightEffect::Noise { octaves: 3 }, Look { size_m: 0.8, ease: Ease::Smooth, ..with(&sea) }),
        ("fire", LightEffect::Fire, Look { place: foot, angle: up, size_m: 1.6, ..with(&heat) }),
        ("picture", LightEffect::Picture(0), Look { size_m: 2.4, ..Look::default() }),
        ("next-frame", LightEffect::NextFrame, Look { ease: Ease::Smooth, ..Look::default() }),
        ("by-robot", LightEffect::ByRobot, Look { wrap: Wrap::Mirror, seed: 1, ..with(&sunset) }),
        ("by-speed", LightEffect::BySpeed { top_mps: 0.27 }, with(&heat)),
    ]
}

fn colour(hex: &str) -> Rgb {
    Rgb::from_hex(hex).expect("a colour")
}

/// A spiral path of about two and a half turns around the centre.
fn spiral() -> Coordinate {
    let place = |step: u32| {
        let share = f64::from(step) / 60.0;
        Vec2::unit(16.0 * share) * share
    };
    Coordinate::Curve((0..=60).map(place).collect())
}

/// A picture of two film frames: a ring, and the ring with a dot.
fn ring() -> FloorPicture {
    let pixel = |x: u32, y: u32, dot: bool| {
        let from_centre = Vec2::new(f64::from(x) - 5.5, f64::from(y) - 3.5).length();
        match from_centre {
            far if (2.2..3.8).contains(&far) => colour("#ffcc00"),
            near if near < 1.2 && dot => colour("#ff0044"),
            _ => colour("#000830"),
        }
    };
    let picture = |dot| (0..8).flat_map(move |y| (0..12).map(move |x| pixel(x, y, dot)));
    FloorPicture::new(12, 8, picture(false).chain(picture(true)).collect()).expect("two whole pictures")
}

fn robot(column: u32, row: u32, moment: u32) -> LitRobot {
    let index = row * ROBOTS.0 + column;
    let from_middle = |number: u32, count: u32| f64::from(number) - f64::from(count - 1) / 2.0;
    let x = SPACING_M * from_middle(column, ROBOTS.0);
    let y = -SPACING_M * from_middle(row, ROBOTS.1);
    let next = if (column + row).is_multiple_of(2) { "#ff8800" } else { "#0088ff" };
    LitRobot {
        index,
        count: ROBOTS.0 * ROBOTS.1,
        place: Vec2::new(x, y),
        // Robots are faster from column to column, and all become faster with time.
        speed_mps: 0.27 * f64::from(column * (moment + 1)) / f64::from((ROBOTS.0 - 1) * MOMENTS),
        frame: 0,
        pixel: None,
        colour: Linear::from_rgb(colour("#14141e")),
        next_colour: Linear::from_rgb(colour(next)),
    }
}

/// The strip of each effect, with the name of its file.
pub fn strips() -> Vec<(String, RgbImage)> {
    let pictures = [ring()];
    let context = LightContext { pictures: &pictures, lead_s: 0.0 };
    let strip = |(name, effect, look): (&str, LightEffect, Look)| {
        let layers = Layers::new(vec![LightLayer::new(effect, look)]).expect("the layer is valid");
        (format!("{name}.png"), drawn(&layers, &context))
    };
    scenes().into_iter().map(strip).collect()
}

fn drawn(layers: &Layers, context: &LightContext<'_>) -> RgbImage {
    let panel = ROBOTS.0 * DOT.1 + GAP;
    let mut image = RgbImage::from_pixel(MOMENTS * panel - GAP, ROBOTS.1 * DOT.1, Dot([0x30, 0x30, 0x38]));
    for moment in 0..MOMENTS {
        for row in 0..ROBOTS.1 {
            for column in 0..ROBOTS.0 {
                let lit =
                    layers.colour(STEP_S * f64::from(moment), &robot(column, row, moment), context).to_rgb();
                let (left, top) = (moment * panel + column * DOT.1, row * DOT.1);
                for (x, y) in (0..DOT.0).flat_map(|x| (0..DOT.0).map(move |y| (x, y))) {
                    image.put_pixel(left + x, top + y, Dot([lit.r, lit.g, lit.b]));
                }
            }
        }
    }
    image
}
