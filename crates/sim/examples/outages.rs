//! A show of 30 robots whose broker freezes or is gone:
//! `cargo run --release -p lightbots-sim --example outages [SEEDS] [SHOW…]`.
//!
//! Prints one line for each kind of outage and its length, with sums over all seeds and moments. They count finished
//! shows, robots that dropped out or touched, and how often the operator had to press.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;

use lightbots_show::Show;
use lightbots_sim::RehearsalReport;

/// When outages begin, seconds after the first departure.
const MOMENTS_S: [f64; 6] = [0.7, 2.3, 3.9, 6.1, 9.5, 13.2];
/// Lengths of the outages, seconds.
const LENGTHS_S: [f64; 9] = [0.5, 1.0, 1.3, 1.7, 2.5, 4.0, 10.0, 20.0, 40.0];

fn main() -> ExitCode {
    arguments::main(run)
}

fn run(args: &[String]) -> Result<bool, String> {
    let seeds = arguments::number(args, 0, 5, "usage: outages [SEEDS] [SHOW…]")?;
    for path in arguments::show_files(args, 1) {
        let show = arguments::show(&path)?;
        println!("{path}: {seeds} seeds at {} moments", MOMENTS_S.len());
        for kind in ["freeze", "gone"] {
            for length_s in LENGTHS_S {
                println!("{kind} {length_s:4.1} s: {}", Sum::of(&show, kind, length_s, seeds)?);
            }
        }
    }
    Ok(true)
}

/// Sums over all runs with one kind and length of outage.
#[derive(Default)]
struct Sum {
    runs: usize,
    finished: usize,
    dropouts: usize,
    contacts: u64,
    presses: usize,
    links_lost: usize,
    delay_s: f64,
    worst: String,
}

impl Sum {
    fn of(show: &Show, kind: &str, length_s: f64, seeds: u64) -> Result<Self, String> {
        let mut sum = Self::default();
        for seed in 1..=seeds {
            let undisturbed = arguments::play(show, "", seed)?;
            for at_s in MOMENTS_S {
                let faults = format!("{kind}={at_s}s+{length_s}s");
                sum.add(&arguments::play(show, &faults, seed)?, &undisturbed, &faults);
            }
        }
        Ok(sum)
    }

    fn add(&mut self, report: &RehearsalReport, undisturbed: &RehearsalReport, faults: &str) {
        let count = |code| arguments::count(report, code);
        let is_finished = report.frames_played == report.frames;
        self.runs += 1;
        self.finished += usize::from(is_finished);
        self.dropouts += report.dropouts;
        self.contacts += report.contacts;
        self.presses += count("pressed");
        self.links_lost += count("link-lost");
        self.delay_s = self.delay_s.max(report.duration_s - undisturbed.duration_s);
        if !is_finished || report.dropouts > 0 || report.contacts > 0 {
            self.worst = format!("; the last bad one: seed {}, {faults}", report.seed);
        }
    }
}

impl core::fmt::Display for Sum {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { runs, finished, dropouts, contacts, presses, links_lost, delay_s, worst } = self;
        write!(
            f,
            "{finished} of {runs} finished, {dropouts} dropouts, {contacts} contacts, {links_lost} links lost, {presses} presses, at most {delay_s:.1} s longer{worst}"
        )
    }
}
