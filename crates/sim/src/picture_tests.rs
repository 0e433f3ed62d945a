//! What robots show of a picture on the floor, step by step.

use super::*;
use crate::conditions::Conditions;
use crate::options::RehearsalOptions;
use lightbots_base::{Rgb, Vec2};
use lightbots_control::{Config, Controller, RecordedController};
use lightbots_lighting::LampSettings;
use lightbots_show::{
    Asset, AssetHash, Frame, Layer, LayerPicture, LayerSpan, Pixel, Setting, Show, back_rows,
};
use std::sync::Arc;

/// Eight robots that cross a picture of 12 m by 3 m with a colour on the left and another one on the right.
fn crossing(halves: [[u8; 3]; 2]) -> Show {
    let hash = AssetHash([7; 32]);
    let codes = halves.map(|half| [half; 8]).concat().repeat(4).concat();
    let asset = Asset {
        name: "halves.png".into(),
        media_type: "image/png".into(),
        bytes: 99,
        content: None,
        picture: Some(Arc::new(LayerPicture { width: 16, height: 4, codes })),
    };
    let settings = vec![
        ("picture".to_owned(), Setting::Text(hash.to_string())),
        ("size_m".to_owned(), Setting::Number(12.0)),
    ];
    let layer = Layer { name: String::new(), kind: "picture".into(), span: LayerSpan::Show, settings };
    let pixel = |id: u32, x: f64| Pixel {
        id,
        at: Vec2::new(x, f64::from(id) * 0.2 - 0.7),
        color: Rgb::new(0, 255, 0),
        ..Pixel::default()
    };
    let frame = |x: f64| Frame {
        air_time_s: 3.0,
        pixels: (0..8).map(|id| pixel(id, x)).collect(),
        ..Frame::default()
    };
    let frames = vec![frame(-1.3), frame(1.3)];
    Show { layers: vec![layer], assets: [(hash, asset)].into(), frames, ..Show::default() }
}

#[test]
fn robots_show_the_picture_on_the_floor_at_their_places_standing_and_driving() {
    cross([[255, 0, 0], [0, 0, 255]], LampSettings::default());
}

#[test]
fn lamps_are_sent_corrected_colours_and_snapshots_have_those_of_the_show() {
    let lamp = LampSettings { gamma: 2.0, gain: [0.5, 1.0, 0.25], ..LampSettings::default() };
    assert_eq!(lamp.sent(Rgb::new(200, 0, 0)), Rgb::new(166, 0, 0));
    cross([[200, 0, 0], [0, 90, 255]], lamp);
}

/// Robots cross the picture. Each must show the colour of the half that it is on, corrected for its lamp.
fn cross(halves: [[u8; 3]; 2], lamp: LampSettings) {
    let show = Arc::new(crossing(halves));
    let [left, right] = halves.map(|[r, g, b]| Rgb::new(r, g, b));
    let starts = back_rows(&show.stage, 8);
    let options = RehearsalOptions { seed: 5, conditions: Conditions::default(), robots: None };
    let mut play = Play::new(show, &starts, &[], &options, 30.0);
    play.controller = RecordedController::new(Controller::new(Config { lamp, ..Config::default() }));
    play.switch_on(None);
    let (mut places_before, mut seen, mut first_reached) = (vec![Vec2::ZERO; 8], [0; 4], None);
    let mut is_seen = false;
    while !play.is_over() {
        play.step();
        play.plan(&mut |_| {});
        // Robots are dark until the first frame, and light up on the last part of the way.
        if first_reached.is_none() && play.robots.world.places().iter().all(|place| place.x < -1.28) {
            first_reached = Some(play.now);
        }
        let is_lit = first_reached.is_some_and(|at| play.now > at + Span::from_millis(500));
        // All robots stand on the left then, and people see the colour of the show.
        if first_reached.is_some_and(|at| play.now == at + STEP * 32) {
            let snapshot = play.controller.snapshot(play.now);
            assert!(snapshot.robots.iter().all(|robot| is_about(robot.light, left)), "{snapshot:?}");
            is_seen = true;
        }
        for (robot, before) in places_before.iter_mut().enumerate() {
            let place = play.robots.world.places()[robot];
            let drives = place.distance(*before) > 1e-4;
            *before = place;
            // Light changes between the centres of pixels, 0.375 m from the middle; robots are off their plan by less.
            if !is_lit || place.x.abs() < 0.45 {
                continue;
            }
            let is_right = place.x > 0.0;
            let wanted = lamp.sent(if is_right { right } else { left });
            let shown = play.robots.light(robot);
            assert!(is_about(shown, wanted), "{shown} at {place:?}, {:?}", play.now);
            seen[usize::from(drives) + 2 * usize::from(is_right)] += 1;
        }
    }
    assert!(is_seen && seen.iter().all(|&count| count > 100), "standing and driving, red and blue: {seen:?}");
}

/// Whether no channel differs by more than 8 codes, about what the fit of light tracks allows.
fn is_about(shown: Rgb, wanted: Rgb) -> bool {
    let channels: [fn(Rgb) -> u8; 3] = [|colour| colour.r, |colour| colour.g, |colour| colour.b];
    channels.iter().all(|channel| channel(shown).abs_diff(channel(wanted)) <= 8)
}
