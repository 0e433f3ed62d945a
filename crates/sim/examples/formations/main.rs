//! Drives from the usual starting rows to grids, hexagons, discs, rings and rows of many spacings, rehearsed without
//! and with noise and slip: `cargo run --release -p lightbots-sim --example formations [OPTION VALUE]…`; see `--help`.
//!
//! Prints a line for each rehearsal that fails, and a summary for each kind of conditions. The exit code is 1 if any
//! failed.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
mod case;
mod shapes;
mod slice;
mod tally;
mod verdict;

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

use lightbots_sim::RehearsalReport;

use case::Case;
use slice::{Slice, USAGE};
use tally::Tally;

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every case passed.
fn run(args: &[String]) -> Result<bool, String> {
    if args.iter().any(|argument| matches!(argument.as_str(), "--help" | "-h" | "help")) {
        println!("{USAGE}");
        return Ok(true);
    }
    let slice = Slice::read(args)?;
    let cases = slice.cases();
    let mut tallies: Vec<Tally> = slice.runs.iter().map(|_| Tally::default()).collect();
    rehearse_all(&slice, &cases, &mut |case, reports| {
        for ((run, report), tally) in slice.runs.iter().zip(reports).zip(&mut tallies) {
            let passes = verdict::passes(&report, run.required);
            tally.add(case.index, &report, passes);
            if !passes || slice.shows_all {
                println!("{case}, {}: {}", run.name, verdict::line(&report));
            }
        }
    });
    for (run, tally) in slice.runs.iter().zip(&tallies) {
        println!("{}: {}", run.name, tally.line());
    }
    let fine = tallies.iter().all(Tally::is_fine);
    if !fine {
        println!("again: cargo xtask formations --cases NUMBER --seed {}", slice.seed);
    }
    Ok(fine)
}

/// Rehearses the cases on several threads. Calls `done` in the order of the cases, with one report for each kind of
/// conditions.
fn rehearse_all(slice: &Slice, cases: &[Case], done: &mut dyn FnMut(&Case, Vec<RehearsalReport>)) {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..slice.jobs.min(cases.len()) {
            let (next, sender) = (&next, sender.clone());
            scope.spawn(move || {
                while let Some((nth, case)) = next_of(cases, next) {
                    let rehearsed = |run: &slice::Run| verdict::rehearsed(case, &run.conditions, slice.seed);
                    // Sending cannot fail: the receiver lives until all threads have ended.
                    let _ = sender.send((nth, slice.runs.iter().map(rehearsed).collect::<Vec<_>>()));
                }
            });
        }
        drop(sender);
        let (mut due, mut early) = (0, BTreeMap::new());
        for (nth, reports) in receiver {
            early.insert(nth, reports);
            while let Some(reports) = early.remove(&due) {
                done(&cases[due], reports);
                due += 1;
            }
        }
    });
}

/// Takes the next case that no thread has taken. `None` after the last one.
fn next_of<'a>(cases: &'a [Case], next: &AtomicUsize) -> Option<(usize, &'a Case)> {
    let nth = next.fetch_add(1, Ordering::Relaxed);
    Some((nth, cases.get(nth)?))
}
