//! The eleven effects of the reference measurements of light on the wire, on 1,000 robots, and the records that they
//! need.

use lightbots_base::{LightCursor, Rgb, TICK, Vec2};
use lightbots_light::{
    Coordinate, Ease, Layers, LightContext, LightEffect, LightLayer, Linear, LitRobot, Look, Palette,
    PaletteStop, Wrap, lightness,
};
use lightbots_lighting::{LightFit, Tolerance, fit};

/// Number of columns of robots.
const COLUMNS: u32 = 40;
/// Number of rows of robots.
const ROWS: u32 = 25;
/// Distance between the numbers of two robots that are fitted.
const EVERY: usize = 100;
/// Duration of a stretch, ticks of 10 ms.
const STRETCH: u32 = 1_000;
/// Number of stretches that are fitted for each robot.
const STRETCHES: u32 = 3;

/// The effects, each with two colours or a hue.
fn effects() -> Vec<(&'static str, LightEffect, Look)> {
    let look = |speed_hz: f64| Look {
        place: Vec2::new(-2.0, -1.25),
        size_m: 2.0,
        speed_hz,
        palette: Palette::even(&[Rgb::new(0, 0, 40), Rgb::new(255, 160, 0)]),
        ..Look::default()
    };
    let rising = |speed_hz: f64| Look { palette: Palette::rising(Rgb::new(255, 255, 255)), ..look(speed_hz) };
    let rainbow = LightEffect::Rainbow { along: Coordinate::Line, saturation: 1.0 };
    vec![
        ("fade 4 s", LightEffect::Fade, Look { wrap: Wrap::Mirror, ease: Ease::Sine, ..look(0.25) }),
        ("rainbow wave 5 s", rainbow, look(0.2)),
        ("wave of light 2 s", LightEffect::Wave(Coordinate::Line), look(0.5)),
        (
            "twinkle 0.6 s each 4 s",
            LightEffect::Twinkle { density: 1.0 },
            Look { width: 0.15, ..rising(0.25) },
        ),
        ("chase 4 s", LightEffect::Chase(Coordinate::Line), Look { width: 0.2, ..look(0.25) }),
        ("strobe 3 Hz", LightEffect::Strobe, look(3.0)),
        ("fire", LightEffect::Fire, Look { palette: fire(), ..look(0.8) }),
        ("plasma", LightEffect::Plasma, look(0.2)),
        ("noise clouds", LightEffect::Noise { octaves: 2 }, look(0.2)),
        ("sparkle 10 Hz", LightEffect::Sparkle { density: 0.08 }, rising(10.0)),
        ("pulse 120 bpm", LightEffect::Pulse, Look { width: 0.01, ease: Ease::In, ..look(2.0) }),
    ]
}

fn fire() -> Palette {
    let stop = |at, colour| PaletteStop { at, colour: Linear::from_rgb(colour), opacity: 1.0 };
    let stops = vec![
        stop(0.0, Rgb::BLACK),
        stop(0.4, Rgb::new(200, 0, 0)),
        stop(0.8, Rgb::new(255, 160, 0)),
        stop(1.0, Rgb::new(255, 255, 160)),
    ];
    Palette { stops }
}

fn samples(layers: &Layers, index: u32, from: u32) -> Vec<Rgb> {
    let place = Vec2::new(f64::from(index % COLUMNS) * 0.1 - 2.0, f64::from(index / COLUMNS) * 0.1 - 1.25);
    let robot = LitRobot { index, count: COLUMNS * ROWS, place, ..LitRobot::default() };
    let at = |tick: u32| f64::from(from + tick) * TICK.as_secs();
    (0..=STRETCH).map(|tick| layers.colour(at(tick), &robot, &LightContext::default()).to_rgb()).collect()
}

/// Distance of a shown colour from the wanted one, the largest of its channels: in codes, and in units of L*.
fn distance(one: Rgb, other: Rgb) -> (u8, f64) {
    let pairs = [(one.r, other.r), (one.g, other.g), (one.b, other.b)];
    let far = pairs.map(|(one, other)| (one.abs_diff(other), (lightness(one) - lightness(other)).abs()));
    // Channels that differ by one code at most do not count, because one step is always allowed.
    far.into_iter()
        .filter(|&(codes, _)| codes > 1)
        .fold((0, 0.0), |worst, one| (worst.0.max(one.0), f64::max(worst.1, one.1)))
}

/// The largest distance of a robot's shown colours from the samples, in codes and units of L*.
fn worst(samples: &[Rgb], fit: &LightFit) -> (u8, f64) {
    let mut cursor = LightCursor::default();
    let shown = (0..samples.len()).map(|tick| cursor.at(fit.track(), TICK * tick as i64));
    shown
        .zip(samples)
        .map(|(shown, &wanted)| distance(shown, wanted))
        .fold((0, 0.0), |worst, one| (worst.0.max(one.0), f64::max(worst.1, one.1)))
}

/// What the light of an effect needs, per robot and second.
#[derive(Clone, Debug)]
pub struct Rate {
    pub effect: &'static str,
    pub records: f64,
    /// Bytes before the base64 encoding.
    pub bytes: f64,
}

/// Measures records and bytes of each effect. `check` gets the largest distance of each fit.
pub fn measured(
    tolerance: Tolerance,
    records_max: usize,
    mut check: impl FnMut(&str, (u8, f64)),
) -> Vec<Rate> {
    let seconds = f64::from(STRETCHES * STRETCH) * TICK.as_secs();
    let mut rate = |(name, effect, look): (&'static str, LightEffect, Look)| {
        let layers = Layers::new(vec![LightLayer::new(effect, look)]).expect("the layer is valid");
        let (mut records, mut bytes, mut robots) = (0, 0, 0);
        for index in (0..COLUMNS * ROWS).step_by(EVERY) {
            robots += 1;
            for stretch in 0..STRETCHES {
                let samples = samples(&layers, index, stretch * STRETCH);
                let fit = fit(&samples, tolerance, records_max);
                assert_eq!(fit.track().duration(), TICK * i64::from(STRETCH), "{name}");
                check(name, worst(&samples, &fit));
                records += fit.records.len();
                fit.track().encode(|_| bytes += 1);
            }
        }
        let each = f64::from(robots) * seconds;
        Rate { effect: name, records: f64::from(records as u32) / each, bytes: f64::from(bytes) / each }
    };
    effects().into_iter().map(&mut rate).collect()
}
