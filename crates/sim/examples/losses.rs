//! Shows in which a share of the robots dies: `cargo run --release -p lightbots-sim --example losses [SEEDS] [SHOW…]`.
//!
//! Each seed draws the robots, and when they lose power: at random times while the show plays, or all at once. Prints
//! one line for each share, with sums over all seeds. It has the number of finished shows and the share of the last
//! frame's pixels that were shown. It also has how much longer the shows took than without a loss, and how often robots
//! touched.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;

use lightbots_base::{Span, random};
use lightbots_show::Show;
use lightbots_sim::{Breakdown, Conditions, RehearsalOptions, RehearsalReport, rehearse};

/// Shares of the robots that die, percent.
const SHARES: [usize; 5] = [0, 5, 10, 20, 30];
/// When all die at once, as a share of the show's duration without a loss.
const AT_ONCE: f64 = 0.4;

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every show was finished without a contact.
fn run(args: &[String]) -> Result<bool, String> {
    let seeds = arguments::number(args, 0, 5, "usage: losses [SEEDS] [SHOW…]")?;
    let mut is_fine = true;
    for path in arguments::show_files(args, 1) {
        let show = arguments::show(&path)?;
        println!("{path}: {} robots, {seeds} seeds", robots(&show));
        println!("| killed | when | finished | pixels shown (least) | extra time s (most) | contacts |");
        println!("|---|---|---|---|---|---|");
        for share in SHARES {
            for at_once in [false, true].into_iter().filter(|at_once| share > 0 || !at_once) {
                let sum = Sum::of(&show, share, at_once, seeds);
                let when = if at_once { "at once" } else { "one by one" };
                println!("| {share} % | {when} | {sum} |");
                is_fine &= sum.contacts == 0 && sum.finished == seeds;
            }
        }
    }
    Ok(is_fine)
}

fn robots(show: &Show) -> usize {
    show.frames.iter().map(|frame| frame.pixels.len()).max().unwrap_or(0)
}

fn play(show: &Show, killed: Vec<Breakdown>, seed: u64) -> RehearsalReport {
    let conditions = Conditions { killed, ..Conditions::default() };
    rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {})
}

/// Draws `count` different robots that die, by the seed.
fn drawn(count: usize, robots: usize, seed: u64) -> Vec<usize> {
    let mut state = seed;
    let mut left: Vec<usize> = (0..robots).collect();
    (0..count.min(robots))
        .map(|_| left.swap_remove((random::split_mix(&mut state) % left.len() as u64) as usize))
        .collect()
}

/// Sums over all runs with one share.
#[derive(Default)]
struct Sum {
    runs: u64,
    finished: u64,
    contacts: u64,
    shown: f64,
    shown_least: f64,
    extra_s: f64,
    extra_most_s: f64,
    bad_seeds: Vec<u64>,
}

impl Sum {
    fn of(show: &Show, share: usize, at_once: bool, seeds: u64) -> Self {
        let mut sum = Self { shown_least: 1.0, ..Self::default() };
        let count = robots(show) * share / 100;
        for seed in 1..=seeds {
            let undisturbed = play(show, Vec::new(), seed);
            let at = at_once.then(|| Span::from_secs(undisturbed.duration_s * AT_ONCE));
            let killed = drawn(count, robots(show), seed).into_iter();
            let killed = killed.map(|robot| Breakdown { robot: Some(robot), at }).collect();
            sum.add(&play(show, killed, seed), &undisturbed, show);
        }
        sum
    }

    fn add(&mut self, report: &RehearsalReport, undisturbed: &RehearsalReport, show: &Show) {
        let is_finished = report.frames_played == report.frames;
        let pixels = show.frames.last().map_or(0, |frame| frame.pixels.len());
        let shown = report.per_frame.last().map_or(0, |frame| frame.pixels_shown) as f64 / pixels as f64;
        let extra_s = report.duration_s - undisturbed.duration_s;
        self.runs += 1;
        self.finished += u64::from(is_finished);
        self.contacts += report.contacts;
        self.shown += shown;
        self.shown_least = self.shown_least.min(shown);
        self.extra_s += extra_s;
        self.extra_most_s = self.extra_most_s.max(extra_s);
        if !is_finished || report.contacts > 0 {
            self.bad_seeds.push(report.seed);
        }
    }
}

impl std::fmt::Display for Sum {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mean = |sum: f64| sum / self.runs as f64;
        write!(f, "{} of {} | {:.3} ({:.2})", self.finished, self.runs, mean(self.shown), self.shown_least)?;
        write!(f, " | {:.1} ({:.1}) | {}", mean(self.extra_s), self.extra_most_s, self.contacts)?;
        match self.bad_seeds.as_slice() {
            [] => Ok(()),
            seeds => write!(f, " (seeds {seeds:?})"),
        }
    }
}
