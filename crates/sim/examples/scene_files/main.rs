//! Writes the scenes of the benchmark as files: `cargo run --release -p lightbots-sim --example scene_files FOLDER
//! [ROBOTS…]`.
//!
//! Each scene of docs/benchmarks.md becomes the last drive of a show, by default with 30, 100 and 1,000 robots. The
//! file `scenes.csv` lists file, scene, robots and the seed of the rehearsals. Another program that reads the files
//! then solves the same problems: starts, pixels, which robot shows which pixel, and the obstacles.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
#[path = "../../../plan/examples/bench/scenes.rs"]
mod bench;
#[path = "../../../plan/examples/common/dice.rs"]
mod dice;

use std::path::Path;
use std::process::ExitCode;

use lightbots_base::{Rgb, Vec2};
use lightbots_exchange::LIGHTBOTS;
use lightbots_plan::TransitionProblem;
use lightbots_show::{Frame, Identity, Obstacle, Pixel, Show, Stage};
use lightbots_sim::RehearsalOptions;

const USAGE: &str = "usage: scene_files FOLDER [ROBOTS…]";
/// Default numbers of robots.
const ROBOTS: [usize; 3] = [30, 100, 1_000];
/// Air time of each picture, seconds.
const AIR_S: f64 = 1.0;

fn main() -> ExitCode {
    arguments::main(run)
}

fn run(args: &[String]) -> Result<bool, String> {
    let [folder, counts @ ..] = args else { return Err(USAGE.to_owned()) };
    let counts = match counts {
        [] => ROBOTS.to_vec(),
        counts => counts
            .iter()
            .map(|text| text.parse().map_err(|_| format!("'{text}' is no number; {USAGE}")))
            .collect::<Result<Vec<usize>, String>>()?,
    };
    let folder = Path::new(folder);
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    // The seed of the benchmark's rehearsals.
    let seed = RehearsalOptions::default().seed;
    let mut list = "file,scene,robots,rehearsal_seed\n".to_owned();
    for scene in bench::ALL {
        for &robots in counts.iter().filter(|&&robots| robots <= scene.most) {
            let problem = (scene.build)(robots);
            let name = format!("{} {robots}", scene.name);
            let file = format!("{}.lightbots.json", name.replace('°', "").replace(' ', "-").to_lowercase());
            list += &format!("{file},{},{},{seed}\n", scene.name, problem.starts.len());
            write(&folder.join(&file), &LIGHTBOTS.write(&show(name, &problem), None).bytes)?;
        }
    }
    write(&folder.join("scenes.csv"), list.as_bytes())?;
    println!("{} scenes are in {}", list.lines().count() - 1, folder.display());
    Ok(true)
}

/// The problem as a show. Standing robots become disc obstacles. With bound pixels, the ids of a first picture at the
/// starts say which robot is which.
fn show(name: String, problem: &TransitionProblem) -> Show {
    let TransitionProblem { starts, goals, pinned, standing, half_floor, limits, .. } = problem;
    let of_robots: Vec<(usize, Vec2)> =
        pinned.iter().zip(goals).filter_map(|(robot, &at)| Some(((*robot)?, at))).collect();
    let (identity, frames) = if of_robots.is_empty() {
        (Identity::Any, vec![frame(goals.iter().copied().enumerate())])
    } else {
        (Identity::Fixed, vec![frame(starts.iter().copied().enumerate()), frame(of_robots.into_iter())])
    };
    let radius_m = limits.contact_m() / 2.0;
    let obstacles = standing.iter().map(|&at| Obstacle::Disc { at, radius_m }).collect();
    let (width_m, depth_m) = (2.0 * half_floor.x, 2.0 * half_floor.y);
    let stage = Stage { width_m, depth_m, obstacles, ..Stage::default() };
    Show { name, stage, identity, starts: Some(starts.clone()), frames, ..Show::default() }
}

/// A picture of pixels with their ids and places.
fn frame(pixels: impl Iterator<Item = (usize, Vec2)>) -> Frame {
    let pixel = |(id, at): (usize, Vec2)| Pixel {
        id: id as u32,
        at,
        color: Rgb::new(90, 90, 255),
        ..Pixel::default()
    };
    Frame { air_time_s: AIR_S, pixels: pixels.map(pixel).collect(), ..Frame::default() }
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(file, bytes).map_err(|error| format!("{}: {error}", file.display()))
}
