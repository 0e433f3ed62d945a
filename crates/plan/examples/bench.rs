//! Measures planning. One row per scene and size compares the planner with plain squared distances (CAPT) and with a
//! dense library solver.
//!
//! `cargo run --release -p lightbots-plan --example bench -- [--json] [--quick] [--robots N] [--scene NAME]`
#![allow(clippy::print_stdout, missing_docs)]

#[path = "common/cpu.rs"]
mod cpu;
#[path = "common/dice.rs"]
mod dice;
#[path = "bench/measure.rs"]
mod measure;
#[path = "bench/scenes.rs"]
mod scenes;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let given = |name: &str| arguments.iter().any(|argument| argument == name);
    let value = |name: &str| arguments.iter().skip_while(|argument| *argument != name).nth(1);
    let json = given("--json");
    let most = if given("--quick") { 1_000 } else { 10_000 };
    let sizes = match value("--robots").and_then(|text| text.parse().ok()) {
        Some(robots) => vec![robots],
        None => vec![30, 100, 1_000, 10_000],
    };
    if !json {
        println!("{}", measure::Row::HEADINGS);
    }
    for scene in
        scenes::ALL.iter().filter(|scene| value("--scene").is_none_or(|name| scene.name.contains(name)))
    {
        for &robots in sizes.iter().filter(|&&robots| robots <= most.min(scene.most)) {
            let row = measure::measure(scene.name, &(scene.build)(robots));
            println!("{}", if json { row.json() } else { row.text() });
        }
    }
}
