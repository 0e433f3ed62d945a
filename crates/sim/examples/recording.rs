//! Measures the cost of a recording: `cargo run --release -p lightbots-sim --example recording SHOW [FAULTS [SEED
//! [MINUTES]]]`.
//!
//! Repeats the show for about MINUTES of virtual time. Rehearses it without and with a log in turn and replays the log.
//! Prints the medians of the durations and the size of the log.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "arguments/mod.rs"]
mod arguments;

use std::process::ExitCode;
use std::time::Instant;

use lightbots_control::{LogEnd, replay};
use lightbots_show::Show;
use lightbots_sim::{Progress, RehearsalOptions, rehearse, rehearse_recorded};

/// Number of timed runs of each kind.
const ROUNDS: usize = 9;

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether the replay equals the rehearsal bit by bit.
fn run(args: &[String]) -> Result<bool, String> {
    let usage = "usage: recording SHOW [FAULTS [SEED [MINUTES]]]";
    let path = args.first().ok_or(usage)?;
    let show = arguments::show(path)?;
    let conditions = arguments::conditions(args, 1)?;
    let (seed, minutes) = (arguments::number(args, 2, 1, usage)?, arguments::number(args, 3, 1, usage)?);
    let options = RehearsalOptions { seed, conditions, robots: None };
    let once_s = rehearse(&show, &options, &mut |_| {}).duration_s.max(1.0);
    let show = repeated(&show, (minutes as f64 * 60.0 / once_s).ceil() as usize);

    let (mut without, mut with, mut log) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        let began = Instant::now();
        rehearse(&show, &options, &mut |_| {});
        without.push(began.elapsed().as_secs_f64());
        log.clear();
        let began = Instant::now();
        rehearse_recorded(&show, &options, Vec::new(), &mut |progress| {
            if let Progress::Logged(bytes) = progress {
                log.extend_from_slice(bytes);
            }
        });
        with.push(began.elapsed().as_secs_f64());
    }
    let began = Instant::now();
    let report = replay(&log, &mut |_| {}).map_err(|error| error.to_string())?;
    let replay_s = began.elapsed().as_secs_f64();
    let minutes = report.lasted.as_secs() / 60.0;
    let (without_s, with_s) = (median(without), median(with));
    println!(
        "{} robots, {minutes:.1} min: {without_s:.3} s without a log, {with_s:.3} s with it ({:+.1} %); {} bytes, {:.0} a \
         robot and minute",
        report.robots,
        (with_s / without_s - 1.0) * 100.0,
        log.len(),
        log.len() as f64 / report.robots.max(1) as f64 / minutes,
    );
    println!(
        "replayed in {replay_s:.3} s: {} inputs, {} messages, {} plans, {} outputs; difference {:?}",
        report.inputs, report.messages, report.plans, report.outputs, report.difference
    );
    Ok(report.difference.is_none() && report.end == LogEnd::Complete)
}

/// The show with its frames repeated `times` times.
fn repeated(show: &Show, times: usize) -> Show {
    let frames = std::iter::repeat_n(&show.frames, times.max(1)).flatten().cloned().collect();
    Show { frames, ..show.clone() }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
