//! Measures and raises stop-safety. Prints one row per scene and size of the planner's bench.
//!
//! `cargo run --release -p lightbots-plan --example stop_safe -- [--json] [--robots N] [--scene NAME] [--svg FILE]`
//!
//! With `--svg` the last row is drawn too: all paths, and a dot where a robot must not stop dead. Darker dots mean that
//! another robot lacks more room to stop.
#![allow(clippy::print_stdout, missing_docs)]

#[path = "common/cpu.rs"]
mod cpu;
#[path = "common/dice.rs"]
mod dice;
#[path = "bench/scenes.rs"]
mod scenes;

use core::fmt::Write as _;

use cpu::median_ms;
use lightbots_base::Span;
use lightbots_plan::proof::stop_safe::{StopSafety, stop_safety};
use lightbots_plan::{Path, TransitionProblem, raise, transition};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| arguments.iter().skip_while(|argument| *argument != name).nth(1);
    let json = arguments.iter().any(|argument| argument == "--json");
    let sizes = match value("--robots").and_then(|text| text.parse().ok()) {
        Some(robots) => vec![robots],
        None => vec![30, 100, 1_000, 10_000],
    };
    let wanted = |name: &str| value("--scene").is_none_or(|part| name.contains(part));
    for scene in scenes::ALL.iter().filter(|scene| !scene.name.starts_with("anew") && wanted(scene.name)) {
        for &robots in sizes.iter().filter(|&&robots| robots <= scene.most) {
            if let Some(row) = row(scene.name, &(scene.build)(robots)) {
                println!("{}", if json { row.json() } else { row.text() });
                if let Some(file) = value("--svg") {
                    std::fs::write(file, row.svg()).expect("the picture can be written");
                }
            }
        }
    }
}

struct Row {
    scene: &'static str,
    robots: usize,
    measure_ms: f64,
    raise_ms: f64,
    before: StopSafety,
    after: StopSafety,
    /// Duration after raising stop-safety, divided by the duration before.
    longer: f64,
    paths: Vec<Path>,
    half_m: f64,
}

/// Measures one scene. `None` if there is no plan.
fn row(scene: &'static str, problem: &TransitionProblem) -> Option<Row> {
    let plan = transition(problem).ok()?;
    let times = if plan.paths.len() > 2_000 { 1 } else { 5 };
    let mut before = StopSafety::default();
    let measure_ms = median_ms(times, || before = stop_safety(&plan.paths, &problem.limits));
    let (mut raised, mut after) = (plan.clone(), StopSafety::default());
    let raise_ms = median_ms(times, || {
        raised = plan.clone();
        after = raise(problem, &mut raised);
    });
    let longer = raised.duration.as_secs() / plan.duration.as_secs();
    let (robots, half_m) = (plan.paths.len(), problem.half_floor.x.max(problem.half_floor.y));
    Some(Row { scene, robots, measure_ms, raise_ms, before, after, longer, paths: raised.paths, half_m })
}

impl Row {
    fn text(&self) -> String {
        format!(
            "{:<18} {:>6} | {:>8.2} ms, raised {:>8.2} ms | {:.4} -> {:.4}, {:.4} x",
            self.scene,
            self.robots,
            self.measure_ms,
            self.raise_ms,
            self.before.share(),
            self.after.share(),
            self.longer
        )
    }

    fn json(&self) -> String {
        let missing_mm = |safety: &StopSafety| safety.worst().map_or(0.0, |worst| worst.missing_m * 1e3);
        format!(
            "{{\"scene\":\"{}\",\"robots\":{},\"measure_ms\":{:.3},\"both_ms\":{:.3},\"share_before\":{:.5},\
             \"share_after\":{:.5},\"longer\":{:.4},\"missing_mm_before\":{:.1},\"missing_mm_after\":{:.1}}}",
            self.scene,
            self.robots,
            self.measure_ms,
            self.raise_ms,
            self.before.share(),
            self.after.share(),
            self.longer,
            missing_mm(&self.before),
            missing_mm(&self.after)
        )
    }

    /// Draws the floor from above as SVG, 800 units wide.
    fn svg(&self) -> String {
        let scale = 400.0 / self.half_m;
        let mut svg = String::from(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-400 -400 800 800\">\n\
             <rect x=\"-400\" y=\"-400\" width=\"800\" height=\"800\" fill=\"#fff\"/>\n",
        );
        for path in &self.paths {
            let moments = (0..=path.as_ref().duration().0 / 200_000).map(|number| Span(number * 200_000));
            let places = moments.map(|at| path.as_ref().at(at).position * scale);
            let points: Vec<String> = places.map(|at| format!("{:.0},{:.0}", at.x, -at.y)).collect();
            let _ =
                writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"#c8cdd4\"/>", points.join(" "));
        }
        for one in &self.after.unsafe_moments {
            let (at, dark) = (one.place * scale, 0.15 + (one.missing_m / 0.015).min(1.0) * 0.85);
            let _ = writeln!(
                svg,
                "<circle cx=\"{:.0}\" cy=\"{:.0}\" r=\"3\" fill=\"#c0392b\" fill-opacity=\"{dark:.2}\"/>",
                at.x, -at.y
            );
        }
        svg.push_str("</svg>\n");
        svg
    }
}
