//! Shows in which dense fleets cross: two frames with fixed identity, driven there and back.

use lightbots_base::{Rgb, Vec2};
use lightbots_plan::TransitionProblem;
use lightbots_show::{Easing, Frame, Identity, Pixel, Show, Stage};

use crate::bench;

/// Distance between neighbours of the two halves that swap places, metres.
const SWAP_M: f64 = 0.1;
/// Gap between the halves, metres: room for a column of robots between them.
const AISLE_M: f64 = 0.3;
/// Distance between neighbours on the ring, metres.
const RING_M: f64 = 0.08;
/// Floor around the outermost places, metres.
const RIM_M: f64 = 0.2;
/// Air time of each picture, seconds.
const AIR_S: f64 = 0.5;

/// Names of all scenes: two halves that swap places, a ring that crosses to the other side, and scenes of the planner's
/// bench (docs/benchmarks.md).
pub const NAMES: [&str; 6] = ["swap", "ring", "D", "halves", "mirrored", "grid"];

/// The show of a scene with this number of robots, with their starts. `None` if there is no such scene.
pub fn show(name: &str, robots: usize) -> Option<Show> {
    let places = match name {
        "swap" => swap(robots),
        "ring" => ring(robots),
        _ => {
            let known = NAMES.contains(&name).then(|| format!("fixed {name}"))?;
            let scene = bench::ALL.iter().find(|scene| scene.name == known)?;
            let TransitionProblem { starts, goals, half_floor, .. } = (scene.build)(robots);
            (starts, goals, half_floor)
        }
    };
    Some(there_and_back(&format!("{name} {robots}"), places))
}

/// Starts, goals and half of the floor's size, metres.
type Places = (Vec<Vec2>, Vec<Vec2>, Vec2);

fn there_and_back(name: &str, (starts, goals, half_floor): Places) -> Show {
    let frame = |name: &str, places: &[Vec2]| Frame {
        name: name.into(),
        air_time_s: AIR_S,
        transition_s: None,
        easing: Easing::Swift,
        pixels: (0..)
            .zip(places)
            .map(|(id, &at)| Pixel { id, at, color: Rgb::new(90, 90, 255), ..Pixel::default() })
            .collect(),
        ..Frame::default()
    };
    let frames = vec![frame("from", &starts), frame("to", &goals), frame("back", &starts)];
    let stage = Stage { width_m: 2.0 * half_floor.x, depth_m: 2.0 * half_floor.y, ..Stage::default() };
    Show {
        name: name.into(),
        stage,
        identity: Identity::Fixed,
        starts: Some(starts),
        frames,
        ..Show::default()
    }
}

/// Two blocks beside each other. Each robot drives to the same place in the other block.
fn swap(robots: usize) -> Places {
    let half = robots / 2;
    let columns = (half as f64).sqrt().ceil() as usize;
    let rows = half.div_ceil(columns);
    let across_m = columns as f64 * SWAP_M + AISLE_M;
    let at = |i: usize| {
        let (column, row) = ((i % half) % columns, (i % half) / columns);
        let x = (column as f64 - (columns as f64 - 1.0) / 2.0) * SWAP_M;
        let side = if i < half { -0.5 } else { 0.5 };
        Vec2::new(x + side * across_m, (row as f64 - (rows as f64 - 1.0) / 2.0) * SWAP_M)
    };
    let starts: Vec<Vec2> = (0..half * 2).map(at).collect();
    let goals = (0..half * 2).map(|i| starts[(i + half) % (half * 2)]).collect();
    let half_floor = Vec2::new(across_m, rows as f64 * SWAP_M / 2.0) + Vec2::new(RIM_M, RIM_M);
    (starts, goals, half_floor)
}

/// A ring. Each robot drives to the opposite place.
fn ring(robots: usize) -> Places {
    let angle = std::f64::consts::TAU / robots as f64;
    let radius_m = RING_M / 2.0 / (angle / 2.0).sin();
    let starts: Vec<Vec2> = (0..robots).map(|i| Vec2::unit(angle * i as f64) * radius_m).collect();
    let goals = starts.iter().map(|&at| -at).collect();
    let half_m = radius_m + RIM_M;
    (starts, goals, Vec2::new(half_m, half_m))
}
