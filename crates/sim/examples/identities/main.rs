//! Random shows of mixed identities, pins and numbers of robots, checked, played and rehearsed:
//! `cargo run --release -p lightbots-sim --example identities [COUNT [FIRST [ideal]]]`, 200 unless told otherwise.
//!
//! Lines for each show whose picture is not the frame, or whose run is not what was planned; exit code 1 then.
#![allow(clippy::print_stdout)]

mod hall;
mod scene;
mod verdict;

use std::process::ExitCode;

use lightbots_sim::Conditions;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let number = |nth: usize, usual: u64| args.get(nth).and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (count, first) = (number(0, 200), number(1, 0));
    let is_ideal = args.get(2).is_some_and(|word| word == "ideal");
    let conditions = if is_ideal { Conditions::ideal() } else { Conditions::default() };
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
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
