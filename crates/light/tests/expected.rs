//! Compares colours with the table of an independent script, `expected.py`.

use lightbots_base::{Rgb, Vec2};
use lightbots_light::*;
use std::collections::BTreeMap;

/// Largest difference of a channel. The script adds in another order.
const TOLERANCE: f64 = 1e-9;

fn stop(at: f64, light: [f64; 3], opacity: f64) -> PaletteStop {
    PaletteStop { at, colour: Linear::new(light[0], light[1], light[2]), opacity }
}

/// The settings of all scenes that do not set others.
fn look() -> Look {
    Look {
        place: Vec2::new(0.1, -0.2),
        angle: 0.5,
        size_m: 1.3,
        speed_hz: 0.45,
        width: 0.3,
        palette: Palette {
            stops: vec![
                stop(0.0, [1.0, 0.0, 0.0], 1.0),
                stop(0.4, [0.1, 0.6, 0.2], 0.8),
                stop(1.0, [0.0, 0.2, 1.0], 1.0),
            ],
        },
        ease: Ease::Smooth,
        wrap: Wrap::Mirror,
        seed: 42,
    }
}

fn robot(k: u32) -> LitRobot {
    let step = f64::from(k);
    LitRobot {
        index: (3 * k) % 7,
        count: 7,
        place: Vec2::new(-0.9 + 0.2 * step, 0.7 - 0.15 * step),
        speed_mps: 0.03 * step,
        frame: k / 3,
        pixel: None,
        colour: Linear::new(0.2, 0.1, 0.3),
        next_colour: Linear::new(0.9, 0.5, 0.1),
    }
}

fn film() -> FloorPicture {
    let pixel = |frame: u32, n: u32| {
        let codes = [40 * n + 7 * frame, 250 - 30 * n, (90 * n + frame) % 256].map(|code| code as u8);
        Rgb::new(codes[0], codes[1], codes[2])
    };
    let pixels = (0..2).flat_map(|frame| (0..6).map(move |n| pixel(frame, n))).collect();
    FloorPicture::new(3, 2, pixels).expect("two pictures of six pixels")
}

fn curve() -> Coordinate {
    Coordinate::Curve([(-1.0, 0.8), (0.0, 0.2), (0.5, -0.9)].map(|(x, y)| Vec2::new(x, y)).to_vec())
}

fn layer(effect: LightEffect, look: Look) -> LightLayer {
    LightLayer { from_s: 0.1, origin_s: 0.1, ..LightLayer::new(effect, look) }
}

fn stack() -> Vec<LightLayer> {
    let circle = MaskShape::Circle { centre: Vec2::ZERO, radius_m: 1.1 };
    let rainbow = LightEffect::Rainbow { along: Coordinate::Line, saturation: 0.9 };
    let half = OpacityCurve::constant(0.5);
    vec![
        LightLayer {
            from_s: 0.0,
            origin_s: 0.0,
            to_s: 3.0,
            ..layer(rainbow, Look { ease: Ease::Linear, ..look() })
        },
        LightLayer {
            blend: BlendMode::Screen,
            masks: vec![LightMask { feather_m: 0.4, ..LightMask::new(circle) }],
            opacity: OpacityCurve { points: vec![(0.5, 0.2), (1.5, 1.0), (3.0, 0.4)] },
            ..layer(LightEffect::Wave(Coordinate::Distance), Look { speed_hz: -0.8, seed: 1, ..look() })
        },
        LightLayer {
            blend: BlendMode::Overlay,
            masks: vec![LightMask::new(MaskShape::Frames { first: 1, last: 2 })],
            ..layer(LightEffect::Noise { octaves: 2 }, Look { seed: 9, ..look() })
        },
        LightLayer {
            blend: BlendMode::Difference,
            from_s: 2.0,
            origin_s: 2.0,
            ..layer(LightEffect::Plasma, Look { seed: 5, ..look() })
        },
        LightLayer { blend: BlendMode::Multiply, opacity: half, ..layer(LightEffect::ByRobot, look()) },
    ]
}

fn scenes() -> BTreeMap<&'static str, Vec<LightLayer>> {
    let own = look;
    let rainbow = |along, saturation| LightEffect::Rainbow { along, saturation };
    let still = Look { wrap: Wrap::Once, speed_hz: 0.0, ease: Ease::Out, ..own() };
    let looping = Look { wrap: Wrap::Loop, ..own() };
    let linear = Look { ease: Ease::Linear, ..own() };
    let back = Look { speed_hz: -0.2, ..looping.clone() };
    let single = [
        ("solid", LightEffect::Solid, own()),
        ("gradient-line", LightEffect::Gradient(Coordinate::Line), own()),
        ("gradient-distance", LightEffect::Gradient(Coordinate::Distance), looping.clone()),
        ("gradient-angle", LightEffect::Gradient(Coordinate::Angle), back),
        ("gradient-still", LightEffect::Gradient(Coordinate::Line), still),
        ("fade", LightEffect::Fade, Look { speed_hz: 0.3, wrap: Wrap::Once, ..own() }),
        ("breathe", LightEffect::Fade, Look { ease: Ease::Sine, ..own() }),
        ("pulse", LightEffect::Pulse, Look { ease: Ease::In, ..own() }),
        ("strobe", LightEffect::Strobe, Look { speed_hz: 2.9, width: 0.4, ..own() }),
        ("twinkle", LightEffect::Twinkle { density: 0.8 }, Look { width: 0.8, ..own() }),
        ("sparkle", LightEffect::Sparkle { density: 0.5 }, Look { speed_hz: 10.0, ..own() }),
        ("rainbow-order", rainbow(Coordinate::Order, 1.0), linear.clone()),
        ("rainbow-line", rainbow(Coordinate::Line, 0.7), own()),
        ("wave-line", LightEffect::Wave(Coordinate::Line), own()),
        ("wave-distance", LightEffect::Wave(Coordinate::Distance), linear.clone()),
        ("chase-order", LightEffect::Chase(Coordinate::Order), Look { width: 0.6, ..own() }),
        ("chase-curve", LightEffect::Chase(curve()), Look { width: 0.9, speed_hz: -0.45, ..own() }),
        ("ripple", LightEffect::Ripple, Look { width: 0.5, ..own() }),
        ("plasma", LightEffect::Plasma, own()),
        ("noise", LightEffect::Noise { octaves: 3 }, own()),
        ("fire", LightEffect::Fire, linear),
        ("picture", LightEffect::Picture(0), Look { size_m: 2.4, ..own() }),
        ("next-frame", LightEffect::NextFrame, Look { speed_hz: 0.3, ..own() }),
        ("by-robot", LightEffect::ByRobot, looping),
        ("by-speed", LightEffect::BySpeed { top_mps: 0.25 }, own()),
    ];
    let single = single.into_iter().map(|(name, effect, look)| (name, vec![layer(effect, look)]));
    single.chain([("stack", stack())]).collect()
}

#[test]
fn every_effect_gives_the_values_of_the_independent_script() {
    let pictures = [film()];
    let context = LightContext { pictures: &pictures, lead_s: 0.0 };
    let mut unread = scenes();
    let mut layers = BTreeMap::new();
    let mut lines = 0;
    for line in include_str!("expected.csv").lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [name, moment, t_s, wanted @ ..] = fields.as_slice() else { panic!("{line} has too few fields") };
        if let Some(scene) = unread.remove(name) {
            layers.insert(name.to_string(), Layers::new(scene).expect("the scene is valid"));
        }
        let moment: u32 = moment.parse().expect("a number");
        let found = layers[*name].colour(t_s.parse().expect("a number"), &robot(moment), &context);
        let wanted: Vec<f64> = wanted.iter().map(|channel| channel.parse().expect("a number")).collect();
        for (found, wanted) in [found.r, found.g, found.b].iter().zip(&wanted) {
            assert!((found - wanted).abs() < TOLERANCE, "{line}: {found} instead of {wanted}");
        }
        lines += 1;
    }
    assert_eq!(
        (unread.keys().count(), lines),
        (0, 10 * layers.len()),
        "{:?} are not in the table",
        unread.keys()
    );
}
