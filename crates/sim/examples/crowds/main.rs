//! Deaths and other faults in dense fleets that cross, with fixed identity:
//! `cargo run --release -p lightbots-sim --example crowds SCENE ROBOTS [FAULTS [SEED [SEEDS]]]`.
//!
//! Prints one line for each seed, and a summary at the end. A line has all contacts, those after the first replan
//! began, and the number of replans. It also has the processor time of the slowest plan during the run, and the run's
//! duration as a multiple of the planned one. FAULTS may be `ideal`, or empty for standard conditions.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
#[path = "../../../plan/examples/bench/scenes.rs"]
#[allow(dead_code)]
mod bench;
#[path = "../../../plan/examples/common/cpu.rs"]
mod cpu;
#[path = "../../../plan/examples/common/dice.rs"]
mod dice;
mod scenes;

use std::process::ExitCode;

use lightbots_show::Show;
use lightbots_sim::{Progress, RehearsalOptions, RehearsalReport, rehearse};

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every rehearsal was fine.
fn run(args: &[String]) -> Result<bool, String> {
    let usage = format!("usage: crowds {} ROBOTS [FAULTS [SEED [SEEDS]]]", scenes::NAMES.join("|"));
    let number = |index: usize, usual: u64| arguments::number(args, index, usual, &usage);
    let robots = number(1, 200)? as usize;
    let show = args.first().and_then(|name| scenes::show(name, robots)).ok_or(&usage)?;
    let conditions = arguments::conditions(args, 2)?;
    let (first, count) = (number(3, 1)?, number(4, 1)?);
    let mut sum = Summary::default();
    for seed in first..first.saturating_add(count) {
        let options = RehearsalOptions { seed, conditions: conditions.clone(), robots: None };
        sum.add(&line(&show, &options));
    }
    println!("{} {robots}: {sum}", args[0]);
    Ok(sum.fine == sum.runs)
}

/// The results of one rehearsal.
struct Line {
    report: RehearsalReport,
    /// Processor time of the slowest plan during the run, milliseconds.
    plan_ms: f64,
}

impl Line {
    /// The run's duration as a multiple of the planned one.
    fn stretch(&self) -> f64 {
        self.report.duration_s / self.report.planned_s.max(1e-3)
    }

    fn is_fine(&self) -> bool {
        self.report.ok && self.stretch() <= 2.0
    }
}

/// Rehearses once, prints the results and returns them.
fn line(show: &Show, options: &RehearsalOptions) -> Line {
    let mut began: Option<cpu::Watch> = None;
    let mut plans_ms = Vec::new();
    let report = rehearse(show, options, &mut |progress| match progress {
        Progress::Planning => began = Some(cpu::Watch::started()),
        Progress::Playing { .. } => plans_ms.extend(began.take().map(|watch| watch.ms())),
        Progress::Departing { .. } | Progress::Stepped { .. } | Progress::Logged(_) => {}
    });
    // The first plan is the check of the whole show, and the second the plan with which the run begins.
    let replans_ms: Vec<f64> = plans_ms.iter().skip(2).map(|ms| ms.round()).collect();
    let line = Line { plan_ms: replans_ms.iter().copied().fold(0.0, f64::max), report };
    let report = &line.report;
    println!(
        "seed {:>4} {} {}/{} frames, {:.1} s = {:.2} x planned, contacts {} ({} after a replan), replans {}, \
         plans {replans_ms:?} ms, brakes {} ({} false), dropouts {}, hash {}",
        options.seed,
        if line.is_fine() { "fine" } else { "BAD " },
        report.frames_played,
        report.frames,
        report.duration_s,
        line.stretch(),
        report.contacts,
        report.contacts_after_replan,
        report.replans,
        report.brakes.all,
        report.brakes.unfounded,
        report.dropouts,
        report.state_hash,
    );
    if !line.is_fine() {
        for issue in report.issues.iter().take(25) {
            println!("          {:?}: {}", issue.severity, issue.message);
        }
    }
    line
}

/// Sums and extremes over all seeds.
#[derive(Default)]
struct Summary {
    runs: usize,
    fine: usize,
    with_contact: usize,
    with_second: usize,
    contacts: u64,
    second: u64,
    unfinished: usize,
    replans_most: usize,
    plan_ms: f64,
    stretch: f64,
    long: usize,
    dropouts: usize,
}

impl Summary {
    fn add(&mut self, line: &Line) {
        let report = &line.report;
        self.runs += 1;
        self.fine += usize::from(line.is_fine());
        self.with_contact += usize::from(report.contacts > 0);
        self.with_second += usize::from(report.contacts_after_replan > 0);
        self.contacts += report.contacts;
        self.second += report.contacts_after_replan;
        self.unfinished += usize::from(report.frames_played < report.frames);
        self.replans_most = self.replans_most.max(report.replans);
        self.plan_ms = self.plan_ms.max(line.plan_ms);
        self.stretch = self.stretch.max(line.stretch());
        self.long += usize::from(line.stretch() > 2.0);
        self.dropouts += report.dropouts;
    }
}

impl std::fmt::Display for Summary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} of {} fine; runs with contacts {} ({} contacts), after a replan {} ({}); unfinished {}; dropouts {}; \
             most replans {}; slowest plan {:.0} ms; longest {:.2} x planned, {} runs over 2 x",
            self.fine,
            self.runs,
            self.with_contact,
            self.contacts,
            self.with_second,
            self.second,
            self.unfinished,
            self.dropouts,
            self.replans_most,
            self.plan_ms,
            self.stretch,
            self.long,
        )
    }
}
