//! Solves many small hard transitions. Prints one line for every kind, and one for each that is not solved:
//! `cargo run --release -p lightbots-plan --example sweep -- [KIND [COUNT [FIRST]]]`. The exit code is 1 if one is not
//! solved.
#![allow(clippy::print_stdout)]

#[path = "../common/cpu.rs"]
mod cpu;
mod crowds;
#[path = "../common/dice.rs"]
mod dice;
#[path = "../common/places.rs"]
mod places;
mod rooms;

use cpu::Watch;
use lightbots_plan::proof::prove;
use lightbots_plan::{TransitionProblem, transition};
use std::process::ExitCode;

/// The name of a kind of transition, and the function that makes a case from its number.
type Kind = (&'static str, fn(u64) -> TransitionProblem);

/// Results for one kind.
#[derive(Default)]
struct Row {
    cases: usize,
    ratios: Vec<f64>,
    millis: Vec<f64>,
    unproven: usize,
}

impl Row {
    /// Solves a problem and counts it. Returns what went wrong, if anything.
    fn solve(&mut self, problem: &TransitionProblem) -> Option<String> {
        let watch = Watch::started();
        let plan = transition(problem);
        let millis = watch.ms();
        self.cases += 1;
        self.millis.push(millis);
        let robots = problem.starts.len();
        let plan = match plan {
            Ok(plan) => plan,
            Err(stuck) => return Some(format!("{robots} robots, {millis:.0} ms: {}", stuck.message)),
        };
        self.ratios.push(plan.duration.as_secs() / (plan.lower_bound_s + 0.62));
        let proof = prove(&problem.to_prove(&plan.paths));
        let arrived =
            plan.goal_of.iter().enumerate().filter_map(|(robot, goal)| goal.map(|goal| (robot, goal)));
        let arrived =
            arrived.filter(|&(robot, goal)| plan.paths[robot].as_ref().end() == problem.goals[goal]);
        let whole = arrived.count() == problem.goals.len();
        let short = plan.paths.iter().all(|path| path.pieces.len() <= 128);
        if proof.holds() && whole && short {
            return None;
        }
        self.unproven += 1;
        let (conflicts, faults) = (proof.conflicts.len(), proof.faults.len());
        Some(format!("{robots} robots: {conflicts} conflicts, {faults} faults, whole {whole}, short {short}"))
    }

    fn print(&mut self, name: &str) {
        let spread = |values: &mut Vec<f64>| {
            values.sort_by(f64::total_cmp);
            let at = |share: f64| {
                let rank = (values.len() as f64 - 1.0) * share;
                values.get(rank as usize).copied().unwrap_or(f64::NAN)
            };
            [at(0.5), at(0.99), at(1.0)]
        };
        let (ratios, millis) = (spread(&mut self.ratios), spread(&mut self.millis));
        println!(
            "{name:<18} {:>5}/{:<5} {:>3} unproven | {:>5.2} {:>5.2} {:>5.2} | {:>7.1} {:>7.1} {:>7.1}",
            self.ratios.len(),
            self.cases,
            self.unproven,
            ratios[0],
            ratios[1],
            ratios[2],
            millis[0],
            millis[1],
            millis[2]
        );
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number =
        |index: usize, usual: u64| arguments.get(index).and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (count, first) = (number(1, 100), number(2, 0));
    let wanted = arguments.first().filter(|text| *text != "all");
    println!("kind                solved              | over the least time | ms: median, 99 %, most");
    let mut all_fine = true;
    let kinds = crowds::ALL.iter().chain(&rooms::ALL);
    for (name, build) in kinds.filter(|(name, _)| wanted.is_none_or(|part| name.contains(part.as_str()))) {
        let mut row = Row::default();
        for case in first..first + count {
            if let Some(wrong) = row.solve(&build(case)) {
                all_fine = false;
                println!("    {name} {case}: {wrong}");
            }
        }
        row.print(name);
    }
    if all_fine { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
