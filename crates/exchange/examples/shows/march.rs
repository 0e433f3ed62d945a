//! A show of a hundred robots to music. Each picture begins with a bar, and the light follows the beats.

use std::f64::consts::TAU;

use lightbots_base::Vec2;
use lightbots_exchange::asset_of;
use lightbots_show::{BeatGrid, Beats, Frame, PictureMotion, Show};

use super::color::{BLUE, CYAN, GOLD, ORANGE, RED, ROSE, VIOLET, WHITE, gradient, rainbow};
use super::draw::{frame, shaded, show as on_floor};
use super::galaxy::arm;
use super::heart::outline;
use super::stroke::{along, around, ring, row};
use super::timeline::{moved, turned, with_layers};

/// Number of robots of the show.
const ROBOTS: usize = 100;
/// The music, made by `cargo run --release -p lightbots-music --example beats`, cut and packed by ffmpeg.
const MUSIC: &[u8] = include_bytes!("march.ogg");
/// File name of the music.
const FILE: &str = "march.ogg";
/// Time from one picture to the next, seconds: four bars of four beats, at 120 beats a minute.
const PICTURE_S: f64 = 8.0;
/// Duration of the drive to a picture, seconds. The picture is shown for the rest of its bars.
const DRIVE_S: f64 = 6.0;

/// Layers: light that follows the beats.
const LIGHT: &str = r##"
{"name": "Beat", "kind": "pulse", "settings": {"palette": ["#909090", "#ffffff"], "speed_hz": 2, "width": 0.15,
    "blend": "multiply", "runs_freely": true}},
{"name": "Bars", "kind": "chase", "frames": ["3", "4"], "settings": {"along": "angle", "palette": ["#303030", "#ffffff"],
    "speed_hz": 0.5, "width": 0.8, "blend": "multiply", "runs_freely": true}},
{"name": "Glitter", "kind": "sparkle", "frames": ["6", "7"], "settings": {"palette": ["#000000", "#ffffff"], "speed_hz": 4,
    "density": 0.1, "blend": "screen", "runs_freely": true}}
"##;

pub fn show() -> Show {
    let (rings, heart) = (rings(), heart());
    let breath = PictureMotion::Breathe { center: Vec2::ZERO, size: 1.1, times: 2 };
    let frames = vec![
        march(),
        wheel(),
        rings.clone(),
        turned(&rings, "Rings turn", 0.0, TAU / 10.0),
        star(),
        heart.clone(),
        moved(&heart, "The heart breathes", 0.0, breath),
    ];
    let mut frames: Vec<Frame> = frames.into_iter().map(on_bars).collect();
    // The music begins when robots have reached the first picture, so its drive may take any time.
    frames[0].transition_s = None;
    let show = Show {
        music: Some(FILE.into()),
        assets: [asset_of(FILE, "audio/ogg", MUSIC.into())].into(),
        beats: Some(Beats { grid: BeatGrid::Steady { bpm: 120.0, offset_s: 0.0 }, per_bar: 4 }),
        ..on_floor("March", 4.0, frames)
    };
    with_layers(show, LIGHT)
}

fn on_bars(frame: Frame) -> Frame {
    Frame { transition_s: Some(DRIVE_S), air_time_s: PICTURE_S - DRIVE_S, ..frame }
}

fn march() -> Frame {
    let rows = (0..5).flat_map(|nth| row(Vec2::new(0.0, -0.6 + 0.3 * f64::from(nth)), 0.17, 20));
    frame("March", 0.0, shaded(rows, |at| gradient(&[RED, ORANGE, GOLD], (at.x + 1.7) / 3.4)))
}

fn wheel() -> Frame {
    let places = (0..5).flat_map(|nth| along(&arm(f64::from(nth) / 5.0, 1.7, 0.25), ROBOTS / 5));
    frame("Wheel", 0.0, shaded(places, |at| gradient(&[WHITE, GOLD, ROSE, VIOLET], at.length() / 1.7)))
}

fn rings() -> Frame {
    let places = [(10, 0.4), (20, 0.8), (30, 1.2), (40, 1.6)];
    let places = places.into_iter().flat_map(|(count, radius_m)| ring(Vec2::ZERO, radius_m, count, 0.0));
    frame("Rings", 0.0, shaded(places, |at| rainbow(at.length() / 1.8)))
}

fn star() -> Frame {
    let corner = |nth: i32| {
        let radius_m = if nth % 2 == 0 { 1.75 } else { 0.75 };
        Vec2::unit(TAU * (0.25 + f64::from(nth) / 10.0)) * radius_m
    };
    let line: Vec<Vec2> = (0..=10).map(corner).collect();
    frame("Star", 0.0, shaded(around(&line, ROBOTS), |at| gradient(&[WHITE, CYAN, BLUE], at.length() - 0.7)))
}

/// A frame of three hearts, one inside the other.
fn heart() -> Frame {
    let hearts = [(56, 1.6), (32, 1.0), (12, 0.45)];
    let places = hearts.into_iter().flat_map(|(count, size_m)| around(&outline(Vec2::ZERO, size_m), count));
    frame("Heart", 0.0, shaded(places, |at| gradient(&[RED, ROSE, ORANGE], (at.y + 1.5) / 3.0)))
}
