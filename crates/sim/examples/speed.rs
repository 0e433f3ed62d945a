//! How fast rehearsals are: `cargo run --release -p lightbots-sim --example speed [ROBOTS…]`.
//!
//! For each fleet size a show of four random frames at the original's density (30 robots on 9 m²), with standard
//! conditions. Planning is timed apart.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show, Stage};
use lightbots_sim::{Dice, Progress, Purpose, RehearsalOptions, rehearse};

const FRAMES: u64 = 4;
const SPACING_M: f64 = 0.0774;

fn main() {
    let asked: Vec<usize> = std::env::args().skip(1).filter_map(|arg| arg.parse().ok()).collect();
    let sizes = if asked.is_empty() { vec![30, 100, 1_000] } else { asked };
    println!(
        "{:>7} {:>9} {:>9} {:>9} {:>12} {:>9}",
        "robots", "show s", "plan s", "play s", "x real time", "ns/step"
    );
    for robots in sizes {
        measure(robots);
    }
}

fn measure(robots: usize) {
    let show = random_show(robots);
    let (mut since, mut planning) = (Instant::now(), true);
    let (mut plan_s, mut play_s) = (0.0, 0.0);
    let mut book = |plans: bool| {
        *if planning { &mut plan_s } else { &mut play_s } += since.elapsed().as_secs_f64();
        (since, planning) = (Instant::now(), plans);
    };
    let options = RehearsalOptions::default();
    let report = rehearse(&show, &options, &mut |progress| book(progress == Progress::Planning));
    book(false);
    let robot_steps = report.duration_s / 0.016 * robots as f64;
    println!(
        "{robots:>7} {:>9.1} {plan_s:>9.2} {play_s:>9.2} {:>12.0} {:>9.0}  ok {} frames {} contacts {}",
        report.duration_s,
        report.duration_s / play_s,
        play_s / robot_steps * 1e9,
        report.ok,
        report.frames_played,
        report.contacts,
    );
    for issue in report.issues.iter().take(5) {
        println!("        {:?}: {}", issue.severity, issue.message);
    }
}

/// Frames of random places, far enough apart.
fn random_show(robots: usize) -> Show {
    let side_m = (robots as f64 * 0.3).sqrt();
    let stage = Stage { width_m: side_m, depth_m: side_m, ..Stage::default() };
    let frames = (0..FRAMES)
        .map(|frame| Frame {
            name: format!("random {frame}"),
            air_time_s: 0.5,
            transition_s: None,
            easing: Easing::Swift,
            identity: None,
            pixels: random_pixels(robots, 0.5 * side_m - 0.05, frame + 1),
        })
        .collect();
    Show { name: "speed".into(), stage, identity: Identity::Any, starts: None, music: None, frames }
}

fn random_pixels(count: usize, half_m: f64, seed: u64) -> Vec<Pixel> {
    let mut dice = Dice::new(seed, Purpose::Robots);
    let cells = (2.0 * half_m / SPACING_M) as usize + 1;
    let mut taken: Vec<Vec<Vec2>> = vec![Vec::new(); cells * cells];
    let mut pixels = Vec::new();
    while pixels.len() < count {
        let at = Vec2::new(dice.between(-half_m, half_m), dice.between(-half_m, half_m));
        let cell = |value: f64| ((value + half_m) / SPACING_M) as usize;
        let (column, row) = (cell(at.x).min(cells - 1), cell(at.y).min(cells - 1));
        let free = (row.saturating_sub(1)..=(row + 1).min(cells - 1)).all(|row| {
            (column.saturating_sub(1)..=(column + 1).min(cells - 1))
                .all(|column| taken[row * cells + column].iter().all(|other| other.distance(at) >= SPACING_M))
        });
        if free {
            taken[row * cells + column].push(at);
            pixels.push(Pixel { id: pixels.len() as u32, at, color: Rgb::new(255, 120, 0), robot: None });
        }
    }
    pixels
}
