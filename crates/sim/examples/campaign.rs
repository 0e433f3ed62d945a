//! The fault campaign: `cargo run --release -p lightbots-sim --example campaign -- [--seeds N] [--from K] [--robots R]`.
//!
//! Each seed that violates an invariant prints its story and the command that replays it; exit code 1 then.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;
use std::time::Instant;

use lightbots_sim::Campaign;

const USAGE: &str = "usage: campaign [--seeds N] [--from K] [--robots R] [--tell]";

fn main() -> ExitCode {
    arguments::main(run)
}

/// What is asked for.
struct Options {
    seeds: u64,
    from: u64,
    robots: Option<usize>,
    /// Tell the stories of seeds that are fine, too.
    tells: bool,
}

/// Whether all seeds are fine.
fn run(args: &[String]) -> Result<bool, String> {
    let options = options(args)?;
    let began = Instant::now();
    let mut bad = 0;
    for seed in options.from..options.from.saturating_add(options.seeds) {
        let campaign = Campaign::play(seed, options.robots);
        bad += u64::from(!campaign.is_fine());
        if options.tells || !campaign.is_fine() {
            println!("{campaign}\n");
        }
    }
    println!(
        "{} of {} seeds fine in {:.1} s",
        options.seeds - bad,
        options.seeds,
        began.elapsed().as_secs_f64()
    );
    Ok(bad == 0)
}

fn options(args: &[String]) -> Result<Options, String> {
    let mut options = Options { seeds: 100, from: 0, robots: None, tells: false };
    let mut place = 0;
    while let Some(name) = args.get(place) {
        let number = || arguments::number(args, place + 1, 0, USAGE);
        match name.as_str() {
            "--seeds" => options.seeds = number()?,
            "--from" => options.from = number()?,
            "--robots" => options.robots = Some(number()? as usize),
            "--tell" => {
                options.tells = true;
                place += 1;
                continue;
            }
            other => return Err(format!("there is no option '{other}'; {USAGE}")),
        }
        place += 2;
    }
    Ok(options)
}
