//! Random shows of mixed identities, pins and numbers of robots, checked, played and rehearsed.
//! `cargo run --release -p lightbots-sim --example identities [COUNT [FIRST [ideal | FAULTS]]]`; COUNT is 200 by
//! default.
//!
//! Prints lines for each show whose picture is not the frame, or whose run is not as planned. The exit code is then 1.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
mod hall;
mod scene;
mod verdict;

use std::process::ExitCode;

const USAGE: &str = "usage: identities [COUNT [FIRST [ideal | FAULTS]]]";

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether every show was fine.
fn run(args: &[String]) -> Result<bool, String> {
    let number = |index: usize, usual: u64| arguments::number(args, index, usual, USAGE);
    let (count, first) = (number(0, 200)?, number(1, 0)?);
    let conditions = arguments::conditions(args, 2)?;
    let mut wrong = 0;
    for number in first..first.saturating_add(count) {
        let scene = scene::scene(number);
        let faults = verdict::faults(number, &scene, &conditions);
        wrong += u64::from(!faults.is_empty());
        for fault in faults {
            println!("{number}: {} robots: {fault}", scene.starts.len());
        }
    }
    println!("{} of {count} fine", count - wrong);
    Ok(wrong == 0)
}
