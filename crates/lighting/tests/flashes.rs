//! Warnings about flashes, for a hundred robots on three by three metres.

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_lighting::{DrivenLight, FlashWarning, LitFrame, ShowLight, flash_issue, flashes};
use lightbots_show::{Frame, Layer, LayerSpan, Setting, Show};

/// Air time of the frame, seconds.
const AIR_S: f64 = 10.0;

fn layer(kind: &str, name: &str, settings: &[(&str, Setting)]) -> Layer {
    let settings = settings.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    Layer { name: name.into(), kind: kind.into(), span: LayerSpan::Show, settings }
}

fn number(value: f64) -> Setting {
    Setting::Number(value)
}

fn colours(colours: [&str; 2]) -> Setting {
    Setting::List(colours.map(|text| Setting::Text(text.into())).to_vec())
}

/// A mask: a circle in the middle of the floor.
fn circle(radius_m: f64) -> Setting {
    let mask =
        vec![("shape".to_owned(), Setting::Text("circle".into())), ("radius_m".to_owned(), number(radius_m))];
    Setting::List(vec![Setting::Object(mask)])
}

fn found(layers: Vec<Layer>) -> Option<(FlashWarning, String)> {
    let show = Show { layers, frames: vec![Frame::default()], ..Show::default() };
    let (light, faults) = ShowLight::new(&show);
    assert_eq!(faults, []);
    let robot = |index: u32| DrivenLight {
        number: (index, 100),
        frame: 0,
        pixel: Some(index),
        colours: [Rgb::BLACK; 3],
        shines: [true; 2],
        path: None,
        goal: Vec2::new(f64::from(index % 10), f64::from(index / 10)) * 0.3 - Vec2::new(1.35, 1.35),
        drive: Span::ZERO,
    };
    let frame = LitFrame { air: Span::from_secs(AIR_S), robots: (0..100).map(robot).collect() };
    let warning = flashes(&light, &[frame], (3.0, 9.0))?;
    Some((warning, flash_issue(&show, &warning).message))
}

#[test]
fn two_flashes_a_second_are_fine_and_three_are_for_five_seconds() {
    assert_eq!(found(vec![layer("strobe", "", &[("speed_hz", number(2.0))])]), None);
    let (warning, message) =
        found(vec![layer("strobe", "Flash", &[("speed_hz", number(3.0))])]).expect("it lasts");
    assert!((5.0..7.0).contains(&warning.show_s), "{warning:?}");
    assert_eq!((warning.flashes, warning.layer, warning.is_red), (3, Some(0), false));
    assert!(message.starts_with("at 6.0 s, the layer \"Flash\": 3 flashes in a second"), "{message}");
}

#[test]
fn more_than_three_are_too_many_at_once_and_the_layer_is_named() {
    let calm = layer("rainbow", "", &[]);
    let wild = layer("sparkle", "Sparks", &[("speed_hz", number(15.0)), ("density", number(0.5))]);
    let (warning, message) = found(vec![calm, wild]).expect("robots flash");
    assert!(warning.show_s < 2.5 && warning.flashes > 3 && warning.layer == Some(1), "{warning:?}");
    assert!(message.contains("the layer \"Sparks\""), "{message}");
}

#[test]
fn dim_and_small_flashes_are_fine() {
    let dim = ("palette", colours(["#000000", "#404040"]));
    let fast = ("speed_hz", number(3.0));
    assert_eq!(found(vec![layer("strobe", "", &[fast.clone(), dim])]), None);
    // The first circle covers less than a quarter of a field of 0.75 m.
    assert_eq!(found(vec![layer("strobe", "", &[fast.clone(), ("masks", circle(0.16))])]), None);
    assert!(found(vec![layer("strobe", "", &[fast, ("masks", circle(0.8))])]).is_some());
}

#[test]
fn saturated_red_counts_where_its_luminance_does_not() {
    // The luminance of this red changes by only 0.05.
    let red = ("palette", colours(["#000000", "#800000"]));
    let (warning, _) =
        found(vec![layer("strobe", "", &[("speed_hz", number(3.0)), red])]).expect("it is red");
    assert!(warning.is_red);
    let blue = ("palette", colours(["#000000", "#000080"]));
    assert_eq!(found(vec![layer("strobe", "", &[("speed_hz", number(3.0)), blue])]), None);
}
