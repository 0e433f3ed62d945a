//! Random pairs of frames, planned, proven and rehearsed with noise and slip:
//! `cargo run --release -p lightbots-sim --example pairs [COUNT [FIRST]]`, 10,000 unless told otherwise.
//!
//! A line for each pair that is not solved, not proven or not free of contact; exit code 1 then.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod scene;

use std::process::ExitCode;

use lightbots_sim::{Conditions, RehearsalOptions, rehearse};

const ROBOTS: u64 = 200;

fn main() -> ExitCode {
    let numbers: Result<Vec<u64>, _> = std::env::args().skip(1).map(|text| text.parse()).collect();
    let Ok(numbers) = numbers else {
        eprintln!("usage: pairs [COUNT [FIRST]]");
        return ExitCode::from(2);
    };
    let count = numbers.first().copied().unwrap_or(10_000);
    let first = numbers.get(1).copied().unwrap_or(0);
    let mut ratios = Vec::new();
    let mut failed = 0;
    for number in first..first.saturating_add(count) {
        let show = scene::pair(number, ROBOTS);
        let options = RehearsalOptions { seed: number, conditions: Conditions::default(), robots: None };
        let report = rehearse(&show, &options, &mut |_| {});
        ratios.push(report.duration_s / report.lower_bound_s.max(0.1));
        if !report.ok {
            failed += 1;
            let why = report.issues.first().map_or("no reason given", |issue| issue.message.as_str());
            println!("pair {number}: {} robots, {:?}: {why}", report.robots, show.identity);
        }
    }
    ratios.sort_by(f64::total_cmp);
    let at =
        |share: f64| ratios.get(((ratios.len() as f64 - 1.0) * share) as usize).copied().unwrap_or(f64::NAN);
    println!(
        "{} of {count} fine; duration over the bound: median {:.2}, most {:.2}",
        count - failed,
        at(0.5),
        at(1.0)
    );
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
