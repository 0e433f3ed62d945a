//! Fits of eleven effects on 1,000 robots: what is shown stays within the tolerance, and the records are few.

use lightbots_base::{LightCursor, Rgb, Span, TICK, Vec2};
use lightbots_light::{
    Coordinate, Ease, Layers, LightContext, LightEffect, LightLayer, Linear, LitRobot, Look, Palette,
    PaletteStop, Wrap, lightness,
};
use lightbots_lighting::{LightFit, Tolerance, fit};
use lightbots_wire::MAX_LIGHT_RECORDS;

const COLUMNS: u32 = 40;
const ROWS: u32 = 25;
/// Every hundredth robot is fitted.
const EVERY: usize = 100;
/// Duration of a stretch, in ticks, and number of stretches.
const STRETCH: u32 = 1_000;
const STRETCHES: u32 = 3;

/// The effects of the table in light.md, each with two colours or a hue of its own.
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

/// How far a shown channel is from the wanted one: in codes, and in units of L*.
fn distance(one: Rgb, other: Rgb) -> (u8, f64) {
    let pairs = [(one.r, other.r), (one.g, other.g), (one.b, other.b)];
    let far = pairs.map(|(one, other)| (one.abs_diff(other), (lightness(one) - lightness(other)).abs()));
    // Only the worse channel counts, and one step is always allowed.
    far.into_iter()
        .filter(|&(codes, _)| codes > 1)
        .fold((0, 0.0), |worst, one| (worst.0.max(one.0), f64::max(worst.1, one.1)))
}

/// The worst distance of what a robot shows from the samples.
fn worst(samples: &[Rgb], fit: &LightFit) -> (u8, f64) {
    let mut cursor = LightCursor::default();
    let shown = (0..samples.len()).map(|tick| cursor.at(fit.track(), TICK * tick as i64));
    shown
        .zip(samples)
        .map(|(shown, &wanted)| distance(shown, wanted))
        .fold((0, 0.0), |worst, one| (worst.0.max(one.0), f64::max(worst.1, one.1)))
}

/// Records and bytes of each effect, per robot and second.
fn measured(
    tolerance: Tolerance,
    records_max: usize,
    check: impl Fn(&str, (u8, f64)),
) -> Vec<(&'static str, f64, f64)> {
    let seconds = f64::from(STRETCHES * STRETCH) * TICK.as_secs();
    let rate = |(name, effect, look): (&'static str, LightEffect, Look)| {
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
        (name, f64::from(records as u32) / each, f64::from(bytes) / each)
    };
    effects().into_iter().map(rate).collect()
}

#[test]
fn two_units_of_lightness_take_few_records_and_are_kept() {
    let rates = measured(Tolerance::SIDE_BY_SIDE, MAX_LIGHT_RECORDS, |name, (_, units)| {
        assert!(units <= 2.0 + 1e-9, "{name}: {units} units of L*");
    });
    let mean =
        |value: fn(&(&str, f64, f64)) -> f64| rates.iter().map(value).sum::<f64>() / rates.len() as f64;
    let (records, bytes) = (mean(|rate| rate.1), mean(|rate| rate.2));
    let row = |name: &str, records: f64, bytes: f64| {
        format!("{name:24}{records:8.2}{bytes:8.1}{:8.1}\n", bytes * 4.0 / 3.0)
    };
    let rows = rates.iter().map(|(name, records, bytes)| row(name, *records, *bytes));
    let table: String = rows.chain([row("mean", records, bytes)]).collect();
    insta::assert_snapshot!(format!(
        "{:24}{:>8}{:>8}{:>8}\n{table}",
        "each second", "records", "bytes", "base64"
    ));
    // Targets of reference measurements with the same tolerance, without repeats.
    assert!(records <= 3.2 && bytes <= 13.0, "{records} records and {bytes} bytes in the mean");
    assert!(rates.iter().all(|rate| rate.1 <= 10.0 && rate.2 <= 40.0), "{rates:?}");
}

#[test]
fn one_step_of_each_channel_is_kept() {
    let rates = measured(Tolerance::OneStep, usize::MAX, |name, (codes, _)| assert_eq!(codes, 0, "{name}"));
    // Fire takes most: more than the 16 of the reference, because its flames are half as fast again.
    assert!(rates.iter().all(|rate| rate.1 <= 30.0), "{rates:?}");
}

#[test]
fn too_many_records_widen_the_tolerance_and_never_the_number() {
    let noise =
        |tick: u64| Rgb::from_number((tick.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u32 & 0xff_ffff);
    let samples: Vec<Rgb> = (0..1_001).filter_map(noise).collect();
    let fit = fit(&samples, Tolerance::OneStep, 50);
    assert!(fit.records.len() <= 50);
    assert_eq!(fit.track().duration(), Span::from_secs(10.0));
}
