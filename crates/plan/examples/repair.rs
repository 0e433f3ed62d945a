//! Measures transitions of robots that are bound to their pixels, with many seeds:
//! `cargo run --release -p lightbots-plan --example repair -- [SCENE] [ROBOTS] [SEEDS]`.
#![allow(clippy::print_stdout)]

#[path = "common/cpu.rs"]
mod cpu;
#[path = "repair/crowds.rs"]
mod crowds;
#[path = "common/dice.rs"]
mod dice;
#[path = "common/places.rs"]
mod places;

use cpu::Watch;
use lightbots_plan::{TransitionProblem, transition};

/// Results for one scene and size.
#[derive(Default)]
struct Row {
    seeds: usize,
    millis: Vec<f64>,
    /// Duration divided by that of the longest straight line at full speed.
    over_straight: Vec<f64>,
    /// As `over_straight`, but with a turn and a ramp (0.62 s) added to the divisor.
    over_least: Vec<f64>,
    closest_mm: f64,
    pieces: usize,
}

impl Row {
    fn measure(&mut self, problem: &TransitionProblem, verbose: bool) {
        let watch = Watch::started();
        let plan = transition(problem);
        let millis = watch.ms();
        self.seeds += 1;
        self.millis.push(millis);
        let plan = match plan {
            Ok(plan) => plan,
            Err(stuck) => {
                println!("    {millis:.0} ms, stuck: {}; {} pixels", stuck.message, stuck.goals.len());
                return;
            }
        };
        let (seconds, straight) = (plan.duration.as_secs(), plan.lower_bound_s);
        self.over_straight.push(seconds / straight);
        self.over_least.push(seconds / (straight + 0.62));
        let closest_mm = plan.closest.map_or(f64::MAX, |closest| closest.distance_m * 1e3);
        self.closest_mm =
            closest_mm.min(if self.over_straight.len() == 1 { f64::MAX } else { self.closest_mm });
        self.pieces = plan.paths.iter().map(|path| path.pieces.len()).fold(self.pieces, usize::max);
        if verbose {
            println!(
                "    {millis:.0} ms, {seconds:.2} s, {:.2}, {closest_mm:.1} mm",
                seconds / (straight + 0.62)
            );
        }
    }

    fn print(mut self, name: &str, robots: usize) {
        let mut middle = |values: fn(&mut Row) -> &mut Vec<f64>| {
            let values = values(&mut self);
            values.sort_by(f64::total_cmp);
            let at = |index: usize| values.get(index).copied().unwrap_or(f64::NAN);
            (at(values.len() / 2), at(values.len().wrapping_sub(1)))
        };
        let (ms, most_ms) = middle(|row| &mut row.millis);
        let (straight, most_straight) = middle(|row| &mut row.over_straight);
        let (least, most_least) = middle(|row| &mut row.over_least);
        println!(
            "{name:<14} {robots:>5} {:>3}/{:<3} {ms:>7.1} {most_ms:>7.1} | {straight:>5.2} {most_straight:>5.2} | {least:>5.2} {most_least:>5.2} | {:>5.1} {:>4}",
            self.over_straight.len(),
            self.seeds,
            self.closest_mm,
            self.pieces
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |index: usize| arguments.get(index).filter(|text| *text != "all");
    let number = |index: usize| wanted(index).and_then(|text| text.parse::<usize>().ok());
    let sizes = number(1).map_or(vec![30, 100, 300, 1_000], |robots| vec![robots]);
    let seeds = number(2).unwrap_or(10) as u64;
    println!(
        "scene          robots solved ms: median, most | /straight   | /least      | closest mm, pieces"
    );
    for &(name, build) in
        crowds::ALL.iter().filter(|(name, _)| wanted(0).is_none_or(|part| name.contains(part.as_str())))
    {
        for &robots in &sizes {
            let mut row = Row::default();
            for seed in 1..=seeds {
                row.measure(&build(robots, seed), arguments.len() > 3);
            }
            row.print(name, robots);
        }
    }
}
