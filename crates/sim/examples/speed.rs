//! Measures the speed of rehearsals: `cargo run --release -p lightbots-sim --example speed [--json] [ROBOTS…]`.
//!
//! For each fleet size it rehearses a show of four random frames at the original's density (30 robots on 9 m²). It
//! prints the median of several runs under standard conditions. Planning is timed separately.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Pixel, Show, Stage};
use lightbots_sim::{Dice, Progress, Purpose, RehearsalOptions, RehearsalReport, rehearse};

/// Number of frames of a show.
const FRAMES: u64 = 4;
/// Least distance between two pixels of a frame, metres.
const SPACING_M: f64 = 0.0774;

/// Result and times of the rehearsals of one size.
struct Measured {
    report: RehearsalReport,
    plan_s: f64,
    play_s: f64,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let json = arguments.iter().any(|argument| argument == "--json");
    let asked: Vec<usize> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    let sizes = if asked.is_empty() { vec![30, 100, 1_000, 10_000] } else { asked };
    for robots in sizes {
        let show = random_show(robots);
        let rounds = (30_000 / robots).clamp(1, 9);
        let mut measured: Vec<Measured> = (0..rounds).map(|_| measure(&show)).collect();
        measured.sort_by(|a, b| a.play_s.total_cmp(&b.play_s));
        print(robots, &measured[rounds / 2], json);
    }
}

fn measure(show: &Show) -> Measured {
    let (mut since, mut planning) = (Instant::now(), true);
    let (mut plan_s, mut play_s) = (0.0, 0.0);
    let mut book = |plans: bool| {
        *if planning { &mut plan_s } else { &mut play_s } += since.elapsed().as_secs_f64();
        (since, planning) = (Instant::now(), plans);
    };
    let options = RehearsalOptions::default();
    let report = rehearse(show, &options, &mut |progress| book(progress == Progress::Planning));
    book(false);
    Measured { report, plan_s, play_s }
}

/// Prints one line per size. The keys of the JSON are the names of the columns.
fn print(robots: usize, measured: &Measured, json: bool) {
    let Measured { report, plan_s, play_s } = measured;
    let steps = report.duration_s / 0.016 * robots as f64;
    let (factor, whole) = (report.duration_s / play_s, report.duration_s / (plan_s + play_s));
    let row = format!(
        "{{\"robots\":{robots},\"show_s\":{:.1},\"plan_s\":{plan_s:.3},\"play_s\":{play_s:.3},\"times_real_time\":{factor:.1},\
         \"with_planning\":{whole:.1},\"ns_a_robot_step\":{:.0},\"ok\":{},\"contacts\":{},\"state_hash\":\"{}\"}}",
        report.duration_s,
        play_s / steps * 1e9,
        report.ok,
        report.contacts,
        report.state_hash,
    );
    println!("{row}");
    for issue in report.issues.iter().take(if json { 0 } else { 5 }) {
        println!("        {:?}: {}", issue.severity, issue.message);
    }
}

/// A show of random frames, whose pixels are `SPACING_M` apart or more.
fn random_show(robots: usize) -> Show {
    let side_m = (robots as f64 * 0.3).sqrt();
    let stage = Stage { width_m: side_m, depth_m: side_m, ..Stage::default() };
    let frames = (0..FRAMES)
        .map(|frame| Frame {
            name: format!("random {frame}"),
            air_time_s: 0.5,
            transition_s: None,
            easing: Easing::Swift,
            pixels: random_pixels(robots, 0.5 * side_m - 0.05, frame + 1),
            ..Frame::default()
        })
        .collect();
    Show { name: "speed".into(), stage, frames, ..Show::default() }
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
            pixels.push(Pixel {
                id: pixels.len() as u32,
                at,
                color: Rgb::new(255, 120, 0),
                ..Pixel::default()
            });
        }
    }
    pixels
}
