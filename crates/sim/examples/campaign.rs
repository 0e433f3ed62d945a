//! The fault campaign: `cargo xtask simulate [--seeds N] [--from K] [--robots R] [--tell] [--mutant NAME|all]`.
//!
//! Each seed that violates an invariant prints its story and the command that repeats it; the exit code is then 1. A
//! mutant (feature `mutants`) is a deliberate mistake. If no seed finds it, the exit code is 1 too.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;
use std::time::Instant;

use lightbots_sim::Campaign;

const USAGE: &str = "usage: simulate [--seeds N] [--from K] [--robots R] [--tell] [--mutant NAME|all]";

fn main() -> ExitCode {
    arguments::main(run)
}

/// The options of the command line.
struct Options {
    /// Number of seeds. `None` means 100, or 500 for a mutant.
    seeds: Option<u64>,
    from: u64,
    robots: Option<usize>,
    /// Whether stories of fine seeds are printed too.
    tells: bool,
    mutant: Option<String>,
}

/// Returns whether all seeds are fine, or all chosen mutants were found.
fn run(args: &[String]) -> Result<bool, String> {
    let options = options(args)?;
    match &options.mutant {
        Some(name) => mutants::run(&options, name),
        None => Ok(play_all(&options)),
    }
}

fn play_all(options: &Options) -> bool {
    let (began, seeds) = (Instant::now(), options.seeds.unwrap_or(100));
    let mut bad = 0;
    for seed in options.from..options.from.saturating_add(seeds) {
        let campaign = Campaign::play(seed, options.robots);
        bad += u64::from(!campaign.is_fine());
        if options.tells || !campaign.is_fine() {
            println!("{campaign}\n");
        }
    }
    println!("{} of {seeds} seeds fine in {:.1} s", seeds - bad, began.elapsed().as_secs_f64());
    bad == 0
}

fn options(args: &[String]) -> Result<Options, String> {
    let mut options = Options { seeds: None, from: 0, robots: None, tells: false, mutant: None };
    let mut place = 0;
    while let Some(name) = args.get(place) {
        if name == "--tell" {
            options.tells = true;
            place += 1;
            continue;
        }
        let value = args.get(place + 1).ok_or_else(|| format!("{name} needs a value; {USAGE}"))?;
        let number = || arguments::number(args, place + 1, 0, USAGE);
        match name.as_str() {
            "--seeds" => options.seeds = Some(number()?),
            "--from" => options.from = number()?,
            "--robots" => options.robots = Some(number()? as usize),
            "--mutant" => options.mutant = Some(value.clone()),
            other => return Err(format!("there is no option '{other}'; {USAGE}")),
        }
        place += 2;
    }
    Ok(options)
}

#[cfg(not(feature = "mutants"))]
mod mutants {
    /// Returns an error, because this build has no mutants.
    pub fn run(_: &super::Options, _: &str) -> Result<bool, String> {
        Err("mutants need `--features mutants`: use `cargo xtask simulate --mutant`".into())
    }
}

#[cfg(feature = "mutants")]
mod mutants {
    use super::{Campaign, Instant, Options};
    use lightbots_control::Mutant;

    /// Default number of seeds that are tried to find a mutant.
    const SEEDS_PER_MUTANT: u64 = 500;

    /// Returns whether all mutants of this name are found.
    pub fn run(options: &Options, name: &str) -> Result<bool, String> {
        let chosen: Vec<_> =
            Mutant::ALL.iter().filter(|(known, _)| name == "all" || name == *known).collect();
        if chosen.is_empty() {
            let names: Vec<_> = Mutant::ALL.iter().map(|(known, _)| *known).collect();
            return Err(format!("there is no mutant '{name}'; there are all, {}", names.join(", ")));
        }
        let mut is_every_found = true;
        for (name, mutant) in chosen {
            is_every_found &= is_found(options, name, *mutant);
        }
        Ok(is_every_found)
    }

    fn is_found(options: &Options, name: &str, mutant: Mutant) -> bool {
        let (began, seeds) = (Instant::now(), options.seeds.unwrap_or(SEEDS_PER_MUTANT));
        let took_s = || began.elapsed().as_secs_f64();
        for seed in options.from..options.from.saturating_add(seeds) {
            Mutant::plant(Some(mutant));
            let campaign = Campaign::play(seed, options.robots);
            Mutant::plant(None);
            let Some(violation) = campaign.violations.first() else { continue };
            println!("{name}: found by seed {seed} in {:.1} s: {violation}", took_s());
            if options.tells {
                println!("{campaign}\n");
            }
            return true;
        }
        println!("{name}: NOT FOUND by {seeds} seeds in {:.1} s", took_s());
        false
    }
}
