//! Shows as the audience sees them, to compare a show with the same show after writing and reading.
#![allow(dead_code)] // Each test uses a part of it.

use lightbots_base::{Piece, Rgb, Span, Vec2};
use lightbots_exchange::sequence_picture;
use lightbots_lighting::{PlannedDrive, PlannedShow, SeenRobot, ShowLight, attach_pictures};
use lightbots_plan::{Path, ShowOptions, ShowPlan, show as plan_show};
use lightbots_show::{
    Frame, Identity, Layer, LayerSpan, PictureMotion, Pixel, Setting, Show, starting_places,
};
use std::sync::Arc;

/// The plan of a show. Panics if the plan has errors.
pub fn planned(show: &Show) -> ShowPlan {
    let plan = plan_show(show, &starting_places(show), &ShowOptions::default());
    assert!(plan.ok(), "{:?}", plan.issues);
    plan
}

/// A show of four robots that drive lines and curves. Pixels change colour, one of them to a dark colour.
pub fn small_show() -> Show {
    let colours = [[255, 0, 0], [0, 255, 64], [20, 30, 200], [255, 255, 255]];
    let pixel = |id: usize, turn: f64, shift: usize| {
        let [r, g, b] = colours[(id + shift) % 4];
        Pixel {
            id: id as u32,
            at: Vec2::unit(turn + id as f64 * std::f64::consts::FRAC_PI_2) * 0.4,
            color: Rgb::new(r, g, b),
            ..Pixel::default()
        }
    };
    let frame = |turn: f64, shift: usize| Frame {
        air_time_s: 1.5,
        pixels: (0..4).map(|id| pixel(id, turn, shift)).collect(),
        ..Frame::default()
    };
    let turned = Frame {
        motion: Some(PictureMotion::Turn { center: Vec2::ZERO, turn: 1.2, size: 1.0 }),
        ..frame(1.5, 1)
    };
    let mut last = frame(2.9, 2);
    last.pixels.iter_mut().for_each(|pixel| pixel.at = pixel.at * 1.7);
    Show {
        name: "Small \"show\"".into(),
        identity: Identity::Fixed,
        music: Some("march.ogg".into()),
        frames: vec![frame(0.3, 0), turned, last],
        ..Show::default()
    }
}

/// The show of [`small_show`] with layers that fade and step over drives and pictures.
pub fn lit_show() -> Show {
    let layer = |kind: &str, settings: Vec<(&str, Setting)>| Layer {
        name: String::new(),
        kind: kind.into(),
        span: LayerSpan::Show,
        settings: settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
    };
    let number = Setting::Number;
    let layers = vec![
        layer("rainbow", vec![("speed_hz", number(0.2)), ("opacity", number(0.7))]),
        layer("strobe", vec![("speed_hz", number(1.0)), ("blend", Setting::Text("multiply".into()))]),
    ];
    Show { layers, ..small_show() }
}

/// Places and colours of a show's robots at each of `moments_s` by its plan. Moments are seconds from the start of the
/// drive to the first frame.
pub fn seen(show: &Show, plan: &ShowPlan, moments_s: &[f64]) -> Vec<Vec<SeenRobot>> {
    let (light, faults) = ShowLight::new(show);
    assert!(faults.is_empty(), "{faults:?}");
    scenes(&PlannedShow::new(show, plan, &light), moments_s)
}

/// Places and colours of a show's robots at each of `moments_s` by its trajectories alone, which robots need not be
/// able to drive. Moments are seconds from the start of the drive to the first frame. Pixel n is robot n.
pub fn prescribed(show: &mut Show, moments_s: &[f64]) -> Vec<Vec<SeenRobot>> {
    let dark = attach_pictures(show, |_, asset| {
        sequence_picture(asset.content.as_ref().expect("it is there")).map(Arc::new)
    });
    assert!(dark.is_empty(), "{dark:?}");
    let (light, faults) = ShowLight::new(show);
    assert!(faults.is_empty(), "{faults:?}");
    let pixels: Vec<Option<u32>> = (0..).take(show.frames[0].pixels.len()).map(Some).collect();
    let mut places = show.starts.clone().expect("an import has starts");
    let paths: Vec<Vec<Path>> = show.frames.iter().map(|frame| paths(show, frame, &mut places)).collect();
    let longest =
        |paths: &[Path]| paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO);
    let drives = paths.iter().map(|paths| PlannedDrive { pixels: &pixels, paths, duration: longest(paths) });
    scenes(&PlannedShow::of_drives(show, drives.collect(), &light), moments_s)
}

/// The paths to a frame from `places`, which become the ends of the paths.
fn paths(show: &Show, frame: &Frame, places: &mut [Vec2]) -> Vec<Path> {
    let way = |pixel: usize| {
        show.trajectories.iter().find(|way| way.frame == frame.id && way.pixel as usize == pixel)
    };
    let mut paths = Vec::new();
    for (pixel, place) in places.iter_mut().enumerate() {
        let mut path = Path { start: *place, pieces: Vec::new() };
        if let Some(way) = way(pixel) {
            assert!(way.start.distance(*place) < 1e-3, "a way begins where its robot stands");
            path.pieces.push(Piece::rest(*place, Span::from_secs(way.at_s)));
            let mut begin = 0.0;
            for piece in &way.pieces {
                let (from, duration) = (path.as_ref().end(), Span::from_secs(piece.end_s - begin));
                path.pieces.push(match piece.controls {
                    Some([c1, c2]) => Piece { duration, c1, c2, end: piece.end },
                    None => Piece::straight(from, piece.end, duration),
                });
                begin = piece.end_s;
            }
        }
        *place = path.as_ref().end();
        paths.push(path);
    }
    paths
}

fn scenes(planned: &PlannedShow<'_>, moments_s: &[f64]) -> Vec<Vec<SeenRobot>> {
    let mut scenes = planned.scenes();
    let mut at = |at_s: &f64| {
        let mut scene = Vec::new();
        scenes.at(*at_s, &mut scene);
        scene
    };
    moments_s.iter().map(&mut at).collect()
}

/// Differences between two performances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Largest distance between the places of a robot at one moment, millimetres.
    pub place_mm: f64,
    /// Largest distance of a channel from the range of the other performance's channels within [`Self::time_ms`],
    /// codes.
    pub codes: u8,
    /// Largest shift in time of colours, milliseconds: the least time, in steps of 5 ms, within which all differ by
    /// `codes_max` at most.
    pub time_ms: usize,
}

/// Compares two performances, sampled every 5 ms. Robot n of `one` is robot `order[n]` of `other`.
pub fn apart(one: &[Vec<SeenRobot>], other: &[Vec<SeenRobot>], order: &[usize], codes_max: u8) -> Apart {
    let mut place_mm = 0.0_f64;
    for (one, other) in one.iter().zip(other) {
        for (robot, seen) in one.iter().enumerate() {
            place_mm = place_mm.max(seen.place.distance(other[order[robot]].place) * 1e3);
        }
    }
    let codes = |steps: usize| {
        let mut worst = 0;
        for (moment, one) in one.iter().enumerate() {
            let near = moment.saturating_sub(steps)..=(moment + steps).min(other.len() - 1);
            for (robot, seen) in one.iter().enumerate() {
                let colours = near.clone().map(|moment| other[moment][order[robot]].colour);
                worst = worst.max(outside(seen.colour, colours));
            }
        }
        worst
    };
    let steps = (0..40).find(|steps| codes(*steps) <= codes_max).expect("colours are alike within 200 ms");
    Apart { place_mm, codes: codes(steps), time_ms: 5 * steps }
}

/// Largest distance of a channel of `colour` from the range of the same channel in `others`, codes.
fn outside(colour: Rgb, others: impl Iterator<Item = Rgb>) -> u8 {
    let (mut low, mut high) = ([255; 3], [0; 3]);
    for Rgb { r, g, b } in others {
        for (channel, code) in [r, g, b].into_iter().enumerate() {
            low[channel] = code.min(low[channel]);
            high[channel] = code.max(high[channel]);
        }
    }
    let codes = [colour.r, colour.g, colour.b].into_iter().zip(low.into_iter().zip(high));
    codes
        .map(|(code, (low, high))| low.saturating_sub(code).max(code.saturating_sub(high)))
        .max()
        .unwrap_or(0)
}

/// Moments every 5 ms until the end of a plan, seconds from the start of the drive to the first frame.
pub fn moments(plan: &ShowPlan) -> Vec<f64> {
    (0..(plan.duration_s * 200.0) as usize).map(|nth| nth as f64 * 0.005).collect()
}

/// `order[n]` is the robot of `other` that is nearest to robot n of `one`.
pub fn order(one: &[SeenRobot], other: &[SeenRobot]) -> Vec<usize> {
    let nearest = |seen: &SeenRobot| {
        let gap = |other: &SeenRobot| other.place.distance(seen.place);
        (0..other.len()).min_by(|a, b| gap(&other[*a]).total_cmp(&gap(&other[*b]))).unwrap()
    };
    one.iter().map(nearest).collect()
}
