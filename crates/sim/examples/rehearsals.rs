//! Many rehearsals of one show: `cargo run --release -p lightbots-sim --example rehearsals SHOW [FAULTS [SEED [SEEDS]]]`.
//!
//! Prints one line for each seed, with its issues. FAULTS may be `ideal`, or empty for standard conditions.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;
use std::time::Instant;

use lightbots_show::Show;
use lightbots_sim::{RehearsalOptions, rehearse};

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every rehearsal was fine.
fn run(args: &[String]) -> Result<bool, String> {
    let usage = "usage: rehearsals SHOW [FAULTS [SEED [SEEDS]]]";
    let path = args.first().ok_or(usage)?;
    let show = arguments::show(path)?;
    let conditions = arguments::conditions(args, 1)?;
    let number = |index: usize, usual: u64| arguments::number(args, index, usual, usage);
    let (first, count) = (number(2, 1)?, number(3, 1)?);
    let mut failed = 0;
    for seed in first..first.saturating_add(count) {
        let options = RehearsalOptions { seed, conditions: conditions.clone(), robots: None };
        failed += u64::from(!line(&show, &options));
    }
    println!("{} of {count} fine", count - failed);
    Ok(failed == 0)
}

/// Rehearses once, and prints the result in one line and each issue in another. Returns whether the result was fine.
fn line(show: &Show, options: &RehearsalOptions) -> bool {
    let begin = Instant::now();
    let report = rehearse(show, options, &mut |_| {});
    println!(
        "seed {:>4} {} {}/{} frames {:.2} s (bound {:.2}) contacts {} edge {} ({:.1} mm) closest {:.1} mm spread {:.0}/{:.0} ms \
         error {:.1}/{:.1}/{:.1} mm estimate {:.1}/{:.1} tracking {:.1}/{:.1} mm clocks {:.1} ms lost {}/{} dropouts {} hash {} {:.0}x",
        options.seed,
        if report.ok { "fine" } else { "BAD " },
        report.frames_played,
        report.frames,
        report.duration_s,
        report.lower_bound_s,
        report.contacts,
        report.wall_contacts,
        report.wall_pressed_m * 1e3,
        report.closest_m.unwrap_or(f64::NAN) * 1e3,
        report.arrival_spread_s.median * 1e3,
        report.arrival_spread_s.max * 1e3,
        report.position_error_m.median * 1e3,
        report.position_error_m.p99 * 1e3,
        report.position_error_m.max * 1e3,
        report.estimate_error_m.p99 * 1e3,
        report.estimate_error_m.max * 1e3,
        report.tracking_error_m.p99 * 1e3,
        report.tracking_error_m.max * 1e3,
        report.clock_spread_s.max * 1e3,
        report.messages.lost,
        report.messages.sent,
        report.dropouts,
        report.state_hash,
        report.duration_s / begin.elapsed().as_secs_f64(),
    );
    let (errors, others): (Vec<_>, Vec<_>) = report.issues.iter().partition(|issue| issue.is_error());
    for issue in errors.into_iter().chain(others).take(8) {
        println!("          {:?}: {}", issue.severity, issue.message);
    }
    report.ok
}
