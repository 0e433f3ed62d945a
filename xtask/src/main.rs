//! Build, try, test and measure LightBots: `cargo xtask <command>`.

mod bench;
mod browser;
mod demo;
mod fuzz;
mod house;
mod shell;
mod test;
mod tidy;
mod tools;
mod walk;
mod webots;

use std::process::ExitCode;

/// Text of `--help`.
const HELP: &str = "\
cargo xtask <command>

  demo [ARGS]      build everything and start `lightbots run` on an example show; ARGS are passed on
  test [PART…]     run the tests, all of them or some: tidy ui lint rust firmware e2e licences
  browser          build the module that the screen runs as WebAssembly; `npm run build` does this first
  bench [PART…]    measure and write docs/benchmarks.md; an unknown PART names them all
  pairs [COUNT [FIRST [FAULTS]]]   rehearse random pairs of frames, ten thousand unless told otherwise: for the night
  fuzz [NAME [SECONDS]]   let fuzzers that follow the code's branches look for files and messages that break it
  simulate [--seeds N] [--from K] [--robots R] [--tell] [--mutant NAME|all]   the fault campaign: docs/campaign.md
  formations [OPTION VALUE]…       rehearse drives to grids, hexagons, discs, rings and rows of every spacing; see --help
  webots [--robots N] [--floor METRES] [--blind]   write the Webots worlds and put the driver in place
  webots paces [SHOW…]   play shows with the Webots driver in slow and pausing worlds: a quarter of an hour
  tidy             check the source tree itself: dependencies, circles of files, names, lengths
  house [--json] [--tree DIR] [--list KEY]   count what makes the source tree easy or hard to read; --help explains
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let rest = arguments.get(1..).unwrap_or_default();
    let outcome = match arguments.first().map(String::as_str) {
        Some("demo") => demo::run(rest),
        Some("test") => test::run(rest),
        Some("browser") => browser::build(),
        Some("bench") => bench::run(rest),
        Some("pairs") => shell::cargo(&example("pairs", rest)),
        Some("simulate") => shell::cargo(&campaign(rest)),
        Some("fuzz") => fuzz::run(rest),
        Some("formations") => shell::cargo(&example("formations", rest)),
        Some("tidy") => tidy::run(),
        Some("house") => house::run(rest),
        Some("webots") => webots::run(rest),
        Some("help" | "--help" | "-h") => {
            println!("{HELP}");
            return ExitCode::SUCCESS;
        }
        other => {
            eprint!(
                "{}{HELP}",
                other.map(|name| format!("xtask has no command '{name}'\n\n")).unwrap_or_default()
            );
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Arguments of cargo that run the fault campaign, with the feature `mutants` if `--mutant` is among them.
fn campaign(rest: &[String]) -> Vec<&str> {
    let mut program = example("campaign", rest);
    if rest.iter().any(|argument| argument == "--mutant") {
        program.splice(5..5, ["--features", "mutants"]);
    }
    program
}

/// Arguments of cargo that run an example of the simulator with the arguments `rest`.
fn example<'a>(name: &'a str, rest: &'a [String]) -> Vec<&'a str> {
    let program = ["run", "--quiet", "--release", "--package", "lightbots-sim", "--example", name, "--"];
    program.into_iter().chain(rest.iter().map(String::as_str)).collect()
}
