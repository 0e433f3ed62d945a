//! Shows whose controller is killed at random moments and continued by another controller: `cargo run --release -p
//! lightbots-sim --example crashes [KILLS] [SHOW…]`.
//!
//! Prints one line for each show: how many of the runs were found and finished, dropouts, contacts, and how long robots
//! took to stand.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;

use lightbots_show::Show;
use lightbots_sim::{Dice, Purpose, RehearsalReport};

/// Thresholds of a random number from 0 to 1. How many of them it exceeds chooses the range of `AWAY_S`.
const SHARES: [f64; 2] = [0.4, 0.95];
/// Ranges of the time without a controller, seconds: robots still drive, robots stand, and so late that the controller
/// asks before it continues.
const AWAY_S: [(f64, f64); 3] = [(0.1, 2.0), (2.0, 12.0), (31.0, 60.0)];

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every run was finished without a contact.
fn run(args: &[String]) -> Result<bool, String> {
    let kills = arguments::number(args, 0, 100, "usage: crashes [KILLS] [SHOW…]")?;
    let mut is_fine = true;
    for path in arguments::show_files(args, 1) {
        let sum = Sum::of(&arguments::show(&path)?, kills)?;
        is_fine &= sum.finished == kills && sum.contacts == 0;
        println!("{path}: {sum}");
    }
    Ok(is_fine)
}

/// Sums over all runs.
#[derive(Default)]
struct Sum {
    runs: u64,
    taken_up: u64,
    finished: u64,
    dropouts: usize,
    contacts: u64,
    presses: usize,
    stop_s: f64,
    bad: Vec<String>,
}

impl Sum {
    fn of(show: &Show, kills: u64) -> Result<Self, String> {
        let duration_s = arguments::play(show, "", 1)?.duration_s;
        let mut sum = Self::default();
        for seed in 1..=kills {
            let mut dice = Dice::new(seed, Purpose::Scene);
            let drawn = dice.unit();
            let kind = SHARES.iter().filter(|share| drawn > **share).count();
            let (from_s, to_s) = AWAY_S[kind];
            let at_s = dice.between(0.0, duration_s - 0.1);
            let faults = format!("crash={at_s:.3}s+{:.3}s", dice.between(from_s, to_s));
            sum.add(&arguments::play(show, &faults, seed)?, &faults);
        }
        Ok(sum)
    }

    fn add(&mut self, report: &RehearsalReport, faults: &str) {
        let count = |code| arguments::count(report, code);
        let is_finished = report.frames_played == report.frames;
        let stop_s = report.stop_after_crash_s.unwrap_or(0.0);
        self.runs += 1;
        self.taken_up += count("taken-up") as u64;
        self.finished += u64::from(is_finished);
        self.dropouts += report.dropouts;
        self.contacts += report.contacts;
        self.presses += count("pressed");
        self.stop_s = self.stop_s.max(stop_s);
        if !is_finished || report.dropouts > 0 || report.contacts > 0 || stop_s > 2.2 {
            self.bad.push(format!("seed {}, {faults}, {stop_s:.3} s", report.seed));
        }
    }
}

impl core::fmt::Display for Sum {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { runs, taken_up, finished, dropouts, contacts, presses, stop_s, bad } = self;
        write!(
            f,
            "{taken_up} of {runs} found, {finished} finished, {dropouts} dropouts, {contacts} contacts, {presses} presses; robots \
             stand after {stop_s:.3} s at most"
        )?;
        bad.iter().try_for_each(|line| write!(f, "\n  {line}"))
    }
}
