//! Pictures that move as one: `cargo run --release -p lightbots-sim --example motions [ROBOTS…]`.
//!
//! Prints one line for each motion and number of robots. It has the time to plan the show, the least duration of the
//! motion and the share of stop-safe moments. Results of a rehearsal under standard conditions follow.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
mod shows;

use std::process::ExitCode;
use std::time::Instant;

use lightbots_plan::ShowOptions;
use lightbots_show::{PictureMotion, starting_places};
use lightbots_sim::{RehearsalOptions, rehearse};

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every rehearsal was fine.
fn run(args: &[String]) -> Result<bool, String> {
    let usage = "usage: motions [ROBOTS...]";
    let given: Result<Vec<usize>, String> =
        (0..args.len()).map(|index| Ok(arguments::number(args, index, 0, usage)? as usize)).collect();
    let counts = if args.is_empty() { vec![30, 100, 1_000] } else { given? };
    println!("motion    robots  plan ms  least s  stop-safe  contacts  tracking mm (p99, max)  false brakes");
    let mut is_fine = true;
    for count in counts {
        for motion in shows::motions(count) {
            is_fine &= line(&motion, count);
        }
    }
    Ok(is_fine)
}

fn line(motion: &PictureMotion, count: usize) -> bool {
    let show = shows::show(motion, count);
    let begin = Instant::now();
    let plan = lightbots_plan::show(&show, &starting_places(&show), &ShowOptions::default());
    let plan_ms = begin.elapsed().as_secs_f64() * 1e3;
    let report = rehearse(&show, &RehearsalOptions::default(), &mut |_| {});
    println!(
        "{:<9} {count:>6} {plan_ms:>8.1} {:>8.2} {:>9.3} % {:>8} {:>12.1} {:>6.1} {:>16}",
        motion.name(),
        plan.transitions.get(1).map_or(f64::NAN, |transition| transition.least.as_secs()),
        plan.stop_safety.get(1).map_or(f64::NAN, |safety| safety.share() * 100.0),
        report.contacts,
        report.tracking_error_m.p99 * 1e3,
        report.tracking_error_m.max * 1e3,
        report.brakes.unfounded,
    );
    for issue in plan.issues.iter().chain(report.issues.iter().filter(|issue| issue.is_error())).take(4) {
        println!("          {:?}: {}", issue.severity, issue.message);
    }
    plan.ok() && report.ok && plan.issues.is_empty()
}
