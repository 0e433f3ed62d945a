//! Shows of three frames, with a picture that moves as one between the first two and an ordinary drive back.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, PictureMotion, Pixel, Show, Stage};

/// Distance between neighbours in a picture, metres.
const PITCH_M: f64 = 0.1;
/// Distance between rows of the winding line, metres. Robots turn at the ends of rows.
const ROW_M: f64 = 0.16;

/// A show of three frames: a picture, the same after the motion, and the first one again. The picture is a grid, or a
/// winding row for the motion in which robots follow each other.
pub fn show(motion: &PictureMotion, count: usize) -> Show {
    let places = match motion {
        PictureMotion::Follow { .. } => winding(count),
        _ => grid(count),
    };
    let picture = |places: Vec<Vec2>| Frame { air_time_s: 1.0, pixels: pixels(&places), ..Frame::default() };
    let first = picture(places.clone());
    let moved: Vec<Vec2> = lightbots_plan::moved(motion, &first).into_values().collect();
    let second = Frame { motion: Some(motion.clone()), ..picture(moved) };
    let side_m = 3.0_f64.max((count as f64).sqrt() * PITCH_M * 2.4 + 1.5);
    let stage = Stage { width_m: side_m, depth_m: side_m + 1.0, ..Stage::default() };
    Show { stage, frames: vec![first, second, picture(places)], ..Show::default() }
}

fn pixels(places: &[Vec2]) -> Vec<Pixel> {
    let color = Rgb::new(255, 120, 0);
    places.iter().zip(0..).map(|(&at, id)| Pixel { id, at, color, ..Pixel::default() }).collect()
}

fn grid(count: usize) -> Vec<Vec2> {
    let side = (count as f64).sqrt().ceil() as usize;
    let middle = (side as f64 - 1.0) / 2.0;
    let place = |id: usize| Vec2::new((id % side) as f64 - middle, (id / side) as f64 - middle) * PITCH_M;
    (0..count).map(place).collect()
}

fn winding(count: usize) -> Vec<Vec2> {
    let side = ((count as f64 * PITCH_M / ROW_M).sqrt().ceil() as usize).max(2);
    let rows = count.div_ceil(side) as f64;
    let place = |id: usize| {
        let (row, nth) = (id / side, id % side);
        let column = if row.is_multiple_of(2) { nth } else { side - 1 - nth };
        let x = (column as f64 - side as f64 / 2.0) * PITCH_M;
        Vec2::new(x, (rows / 2.0 - row as f64) * ROW_M)
    };
    (0..count).map(place).collect()
}

/// The five motions of `count` robots, with their names.
pub fn motions(count: usize) -> Vec<PictureMotion> {
    let first = winding(count)[0];
    vec![
        PictureMotion::Travel { along: vec![Vec2::new(0.3, 0.15), Vec2::new(0.5, -0.1)] },
        PictureMotion::Turn { center: Vec2::ZERO, turn: std::f64::consts::FRAC_PI_2, size: 1.0 },
        PictureMotion::Breathe { center: Vec2::ZERO, size: 1.3, times: 2 },
        PictureMotion::Follow {
            along: vec![
                first,
                first + Vec2::new(-0.15, 0.1),
                first + Vec2::new(-0.1, 0.4),
                first + Vec2::new(0.6, 0.5),
            ],
        },
        PictureMotion::Wave { radius_m: 0.04, direction: 0.0, length_m: 1.0, times: 2 },
    ]
}
