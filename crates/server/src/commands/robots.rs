//! `robots`: simulated robots alone.

use std::path::Path;
use std::sync::Arc;

use lightbots_base::Vec2;
use lightbots_show::{Stage, back_rows};
use lightbots_sim::{Conditions, Faults, FleetConfig};

use super::count;
use crate::cli::{RobotsArguments, ShowArguments};
use crate::failure::{Failure, Outcome};
use crate::live::clock::Clock;
use crate::live::conductor::LOOK;
use crate::live::crowd::{Crowd, Losses};
use crate::numbers::place;
use crate::stop::Stop;
use crate::{open_files, say, show_file};

pub async fn run(arguments: RobotsArguments, stop: Stop) -> Outcome {
    stop.take_over();
    let faults = arguments.faults.as_deref().map(Faults::parse).transpose();
    let faults = faults.map_err(|error| Failure::input(format!("--faults: {error}")))?.unwrap_or_default();
    let broker = arguments.login.broker(&arguments.broker)?;
    open_files::raise_limit();
    let robots = arguments.count as usize;
    let (width_m, depth_m) = arguments.floor;
    let stage = Stage { width_m, depth_m, ..Stage::default() };
    let starts = starts(&arguments.start, &stage, robots)?;
    let conditions = faults.added_to(conditions(arguments.ideal));
    let config = FleetConfig { stage, starts, seed: seed(arguments.seed), conditions };
    let crowd =
        Crowd::start(&config, &broker, arguments.together as usize, (Clock::start(), Arc::default()), &stop);
    let connected = crowd.connections();
    let going = tokio::spawn(crowd.run(stop.clone()));
    say::note(&format!("{} connecting to {}; Ctrl-C stops them", count(robots, "robot"), broker));
    while !stop.is_wanted() && !connected.all() {
        tokio::time::sleep(LOOK).await;
    }
    if connected.all() {
        say::line(&format!("{} connected to {}", count(robots, "robot"), broker));
    }
    let losses = going.await.map_err(|error| Failure::problem(format!("the simulation failed: {error}")))?;
    if losses != Losses::default() {
        say::note(&losses.to_string());
    }
    Ok(true)
}

/// Reads the arguments of `--start` and returns one starting place for each robot.
fn starts(said: &[String], stage: &Stage, robots: usize) -> Result<Vec<Vec2>, Failure> {
    let words: Vec<&str> = said.iter().flat_map(|text| text.split_whitespace()).collect();
    match (said, words.as_slice()) {
        (_, ["rows"]) => Ok(back_rows(stage, robots)),
        ([only], [first, ..]) if place(first).is_none() => first_frame(only, stage, robots),
        _ => {
            let read = |text: &&str| {
                place(text).ok_or_else(|| {
                    Failure::input(format!(
                        "--start: '{text}' is neither 'rows', a show nor a place such as 0.5,-1.3"
                    ))
                })
            };
            enough(words.iter().map(read).collect::<Result<_, _>>()?, robots, "--start")
        }
    }
}

/// Returns the places of a show's first frame, one for each robot.
fn first_frame(path: &str, stage: &Stage, robots: usize) -> Result<Vec<Vec2>, Failure> {
    let reading = ShowArguments { floor: Some((stage.width_m, stage.depth_m)), identity: None };
    let show = show_file::open(Path::new(path), &reading)?.show;
    let first = show.frames.first().map(|frame| frame.pixels.iter().map(|pixel| pixel.at).collect());
    enough(first.unwrap_or_default(), robots, &format!("the first frame of {path}"))
}

fn enough(mut places: Vec<Vec2>, robots: usize, whence: &str) -> Result<Vec<Vec2>, Failure> {
    if places.len() < robots {
        let (have, want) = (count(places.len(), "place"), count(robots, "robot"));
        return Err(Failure::input(format!("{whence} has {have} for {want}: each robot needs one")));
    }
    places.truncate(robots);
    Ok(places)
}

/// Returns the conditions of simulated robots, without noise and slip if `ideal`.
pub(super) fn conditions(ideal: bool) -> Conditions {
    if ideal { Conditions::ideal() } else { Conditions::default() }
}

/// Returns the requested seed, or a random one if none was requested.
pub(super) fn seed(asked: Option<u64>) -> u64 {
    asked.unwrap_or_else(|| {
        let mut bytes = [0; 8];
        // Without random numbers of the system, process ids still make fleets differ.
        if getrandom::fill(&mut bytes).is_err() {
            return u64::from(std::process::id());
        }
        u64::from_le_bytes(bytes)
    })
}
