//! Random floors with obstacles and gaps, planned, proven and rehearsed with noise and slip.
//! `cargo run --release -p lightbots-sim --example floors [COUNT [FIRST [FAULTS [DIR]]]]`; COUNT is 500 by default.
//!
//! Prints a line for each floor where a robot touches or gets lost, and for each that the planner refuses, with its
//! reason. Their shows are saved in DIR if it is named. Totals follow at the end. The exit code is 1 if robots touched
//! or a rehearsal failed.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
mod scene;

use std::process::ExitCode;

use lightbots_exchange::LIGHTBOTS;
use lightbots_show::{Issue, Show};
use lightbots_sim::{RehearsalOptions, RehearsalReport, rehearse};

/// Largest number of robots on a floor. More robots make each rehearsal take longer.
const ROBOTS: u64 = 60;
const USAGE: &str = "usage: floors [COUNT [FIRST [FAULTS [DIR]]]]";

fn main() -> ExitCode {
    arguments::main(run)
}

/// Number of floors per outcome, and contacts.
#[derive(Default)]
struct Tally {
    fine: u64,
    refused: u64,
    touched: u64,
    contacts: u64,
    walls: u64,
    other: u64,
}

/// Rehearses the floors. Returns whether no robots touched and no rehearsal failed.
fn run(args: &[String]) -> Result<bool, String> {
    let number = |index: usize, usual: u64| arguments::number(args, index, usual, USAGE);
    let (count, first) = (number(0, 500)?, number(1, 0)?);
    let conditions = arguments::conditions(args, 2)?;
    let mut tally = Tally::default();
    for number in first..first.saturating_add(count) {
        let show = scene::floor(number, ROBOTS);
        let options = RehearsalOptions { seed: number, conditions: conditions.clone(), robots: None };
        let report = rehearse(&show, &options, &mut |_| {});
        if !tally.count(number, &report)
            && let Some(directory) = args.get(3)
        {
            keep(&show, directory, number)?;
        }
    }
    let Tally { fine, refused, touched, contacts, walls, other } = tally;
    println!(
        "{fine} of {count} fine, {refused} refused, {other} otherwise; {touched} with {contacts} contacts"
    );
    println!("the floor's edge was touched {walls} times");
    Ok(touched + other == 0)
}

impl Tally {
    /// Counts a floor and prints what was wrong. Returns whether all was well.
    fn count(&mut self, number: u64, report: &RehearsalReport) -> bool {
        self.walls += report.wall_contacts;
        let refused = report.messages.sent == 0;
        let which = match () {
            () if report.contacts > 0 => {
                self.contacts += report.contacts;
                &mut self.touched
            }
            () if refused => &mut self.refused,
            () if !report.ok => &mut self.other,
            () => &mut self.fine,
        };
        *which += 1;
        if report.ok && report.wall_contacts == 0 {
            return true;
        }
        let error = report.issues.iter().find(|issue| issue.is_error()).or(report.issues.first());
        let what = if refused { "refused" } else { "BAD" };
        let why = error.map_or("no reason given", |issue: &Issue| issue.message.as_str());
        println!(
            "floor {number}: {what}, {} robots, {} contacts, {} with the edge: {why}",
            report.robots, report.contacts, report.wall_contacts
        );
        refused
    }
}

fn keep(show: &Show, directory: &str, number: u64) -> Result<(), String> {
    let path = format!("{directory}/floor-{number}.json");
    std::fs::write(&path, LIGHTBOTS.write(show, None).bytes).map_err(|error| format!("{path}: {error}"))
}
