//! Random pairs of frames, planned, proven and rehearsed with noise and slip.
//! `cargo run --release -p lightbots-sim --example pairs [COUNT [FIRST [FAULTS]]]`; COUNT is 10,000 by default.
//!
//! Prints a line for each pair that is not solved, not proven or not free of contact, with the command that repeats it.
//! Their numbers follow at the end. The exit code is then 1.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
mod scene;

use std::process::ExitCode;

use lightbots_sim::{RehearsalOptions, rehearse};

/// Largest number of robots of a pair. More robots make each rehearsal take longer.
const ROBOTS: u64 = 200;
const USAGE: &str = "\
usage: pairs [COUNT [FIRST [FAULTS]]]
Rehearses COUNT random pairs of frames (10,000) from number FIRST (0) on, with noise and slip, and FAULTS on top, such as
loss=5%,kill=random. The same number gives the same pair and the same run: `cargo xtask pairs 1 NUMBER` repeats one.";

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every pair was fine.
fn run(args: &[String]) -> Result<bool, String> {
    if args.iter().any(|argument| matches!(argument.as_str(), "--help" | "-h" | "help")) {
        println!("{USAGE}");
        return Ok(true);
    }
    let number = |index: usize, usual: u64| arguments::number(args, index, usual, USAGE);
    let (count, first) = (number(0, 10_000)?, number(1, 0)?);
    let conditions = arguments::conditions(args, 2)?;
    let mut ratios = Vec::new();
    let mut failed = Vec::new();
    for number in first..first.saturating_add(count) {
        let show = scene::pair(number, ROBOTS);
        let options = RehearsalOptions { seed: number, conditions: conditions.clone(), robots: None };
        let report = rehearse(&show, &options, &mut |_| {});
        ratios.push(report.duration_s / report.lower_bound_s.max(0.1));
        if !report.ok {
            failed.push(number.to_string());
            let worst = report.issues.iter().find(|issue| issue.is_error()).or(report.issues.first());
            let why = worst.map_or("no reason given", |issue| issue.message.as_str());
            println!("pair {number}: {} robots, {:?}: {why}", report.robots, show.identity);
            let faults = args.get(2).map_or(String::new(), |text| format!(" {text}"));
            println!("  again: cargo xtask pairs 1 {number}{faults}");
        }
    }
    ratios.sort_by(f64::total_cmp);
    let at =
        |share: f64| ratios.get(((ratios.len() as f64 - 1.0) * share) as usize).copied().unwrap_or(f64::NAN);
    println!(
        "{} of {count} fine; duration over the bound: median {:.2}, most {:.2}",
        count - failed.len() as u64,
        at(0.5),
        at(1.0)
    );
    if !failed.is_empty() {
        println!("not fine: {}", failed.join(", "));
    }
    Ok(failed.is_empty())
}
