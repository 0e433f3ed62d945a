//! Measures the records of eleven effects, with both tolerances: `cargo run --release -p lightbots-lighting --example
//! fit`.
//! `cargo xtask bench light-fit` runs it.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../tests/effects/mod.rs"]
mod effects;

use effects::{Rate, measured};
use lightbots_lighting::Tolerance;
use lightbots_wire::MAX_LIGHT_RECORDS;

/// Rates of all effects and their mean, and the largest distance of shown colours from wanted ones.
struct Measured {
    rates: Vec<Rate>,
    /// Largest distance, codes and units of L*. Channels within one code count as equal.
    worst: (u8, f64),
}

fn main() {
    let seen = measure(Tolerance::SIDE_BY_SIDE);
    let exact = measure(Tolerance::OneStep);
    for (seen_rate, exact_rate) in seen.rates.iter().zip(&exact.rates) {
        println!(
            "{{\"effect\":\"{}\",\"records\":{:.2},\"bytes\":{:.1},\"base64\":{:.1},\"one_step:_records\":{:.2},\
             \"one_step:_bytes\":{:.1},\"one_step:_base64\":{:.1}}}",
            seen_rate.effect,
            seen_rate.records,
            seen_rate.bytes,
            encoded(seen_rate.bytes),
            exact_rate.records,
            exact_rate.bytes,
            encoded(exact_rate.bytes),
        );
    }
    eprintln!(
        "the worst: {:.2} units of L*, and {} codes where one step of each channel is kept",
        seen.worst.1,
        exact.worst.0.max(1)
    );
}

fn measure(tolerance: Tolerance) -> Measured {
    // With a tolerance of one step, 10 s of fire may need more records than a robot can store for a stretch.
    let records_max = if tolerance == Tolerance::OneStep { usize::MAX } else { MAX_LIGHT_RECORDS };
    let mut worst = (0, 0.0);
    let mut rates = measured(tolerance, records_max, |_, (codes, units)| {
        worst = (codes.max(worst.0), f64::max(units, worst.1));
    });
    let mean = |value: fn(&Rate) -> f64| rates.iter().map(value).sum::<f64>() / rates.len() as f64;
    rates.push(Rate { effect: "mean", records: mean(|rate| rate.records), bytes: mean(|rate| rate.bytes) });
    Measured { rates, worst }
}

/// Number of bytes after the base64 encoding.
fn encoded(bytes: f64) -> f64 {
    bytes * 4.0 / 3.0
}
