//! Prints hashes of many rehearsals: `cargo run --release -p lightbots-sim --example hashes [SHOW…]`.
//!
//! A change that only moves or renames code leaves every line as it was: compare the output before and after. Each line
//! names a show, the conditions and the `state_hash`. The shows are the given files (by default all of `shows/`), the
//! crossing scenes and 200 random pairs.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
#[path = "../../../plan/examples/bench/scenes.rs"]
#[allow(dead_code)]
mod bench;
#[path = "../../../plan/examples/common/dice.rs"]
mod dice;
#[path = "../pairs/scene.rs"]
mod pairs;
#[path = "../crowds/scenes.rs"]
mod scenes;

use std::path::Path;
use std::process::ExitCode;

use lightbots_show::Show;
use lightbots_sim::{RehearsalOptions, rehearse};

/// Faults with which each show is rehearsed: none, and sets that exercise recovery, silence and the search for
/// TARGET-only robots.
const FAULTS: [&str; 5] = ["", "ideal", "loss=5%,kill=random", "stuck=random,gps=4mm", "original=10"];
/// Number of random pairs. Every tenth of them is also rehearsed with a kill.
const PAIRS: u64 = 200;
/// Most robots of a random pair. It is small so that all pairs take two minutes.
const PAIR_ROBOTS: u64 = 60;
/// Crossing scenes and their numbers of robots.
const CROSSINGS: [(&str, usize); 4] = [("D", 30), ("swap", 60), ("ring", 40), ("halves", 100)];
/// Most robots of a show that is rehearsed with faults. Larger shows take too long.
const MOST_WITH_FAULTS: usize = 150;

fn main() -> ExitCode {
    arguments::main(run)
}

fn run(args: &[String]) -> Result<bool, String> {
    let paths = if args.is_empty() { example_shows()? } else { args.to_vec() };
    for path in &paths {
        let show = read(path)?;
        let name = Path::new(path).file_name().map_or(path.as_str(), |name| name.to_str().unwrap_or(path));
        under_all_conditions(name, &show)?;
    }
    for (name, robots) in CROSSINGS {
        let show = scenes::show(name, robots).ok_or_else(|| format!("there is no scene '{name}'"))?;
        under_all_conditions(&format!("{name} {robots}"), &show)?;
    }
    for number in 0..PAIRS {
        let show = pairs::pair(number, PAIR_ROBOTS);
        line(&format!("pair {number}"), "", &show, number)?;
        if number % 10 == 0 {
            line(&format!("pair {number}"), "kill=random", &show, number)?;
        }
    }
    Ok(true)
}

fn example_shows() -> Result<Vec<String>, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shows");
    let entries = std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<String> = entries
        .flatten()
        .map(|entry| entry.path().display().to_string())
        .filter(|path| lightbots_exchange::for_file(path).is_some())
        .collect();
    paths.sort();
    Ok(paths)
}

fn read(path: &str) -> Result<Show, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{path}: {error}"))?;
    Ok(lightbots_exchange::read(&bytes, Some(path)).map_err(|error| format!("{path}: {error}"))?.show)
}

fn under_all_conditions(name: &str, show: &Show) -> Result<(), String> {
    let robots = show.frames.first().map_or(0, |frame| frame.pixels.len());
    let count = if robots > MOST_WITH_FAULTS { 2 } else { FAULTS.len() };
    FAULTS[..count].iter().try_for_each(|faults| line(name, faults, show, 7))
}

fn line(name: &str, faults: &str, show: &Show, seed: u64) -> Result<(), String> {
    let conditions = arguments::conditions(&[faults.to_string()], 0)?;
    let report = rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    println!(
        "{name} [{faults}] {} contacts {} {:.2} s",
        report.state_hash, report.contacts, report.duration_s
    );
    Ok(())
}
