//! One row: our plan, squared distances alone (CAPT), and a dense library solver.

use lightbots_base::{Piece, Span, Vec2};
use lightbots_plan::assignment::Choice;
use lightbots_plan::proof::{ProofInput, prove};
use lightbots_plan::{Path, TransitionProblem, transition};
use std::time::Instant;

/// Robots up to which the dense solver is run; it needs memory and time for every pair.
const DENSE_MOST: usize = 1_000;

/// What was measured.
pub struct Row {
    scene: &'static str,
    robots: usize,
    /// Median of the whole plan with its proof, milliseconds.
    plan_ms: f64,
    /// `None`: no plan was found.
    ratio: Option<f64>,
    closest_mm: f64,
    capt_ms: f64,
    capt_ratio: f64,
    capt_conflicts: usize,
    dense_ms: Option<f64>,
}

/// Plans a scene several times.
pub fn measure(scene: &'static str, problem: &TransitionProblem) -> Row {
    let robots = problem.starts.len();
    let mut plan = None;
    let plan_ms = median_ms(robots, || plan = transition(problem).ok());
    let mut capt = None;
    let capt_ms = median_ms(robots, || capt = Some(squares_alone(problem)));
    let (longest_m, capt_conflicts) = capt.unwrap_or_default();
    let bottleneck_m = Choice::new(&problem.starts, &problem.goals, &problem.pinned)
        .map_or(0.0, |choice| choice.bottleneck_m());
    let least_s = bottleneck_m / problem.limits.speed_mps + 0.62;
    Row {
        scene,
        robots,
        plan_ms,
        ratio: plan.as_ref().map(|plan| plan.duration.as_secs() / least_s),
        closest_mm: plan.and_then(|plan| plan.closest).map_or(0.0, |closest| closest.distance_m * 1e3),
        capt_ms,
        capt_ratio: (longest_m / problem.limits.speed_mps + 0.62) / least_s,
        capt_conflicts,
        dense_ms: (robots <= DENSE_MOST).then(|| median_ms(robots, || dense(problem))),
    }
}

fn median_ms(robots: usize, mut work: impl FnMut()) -> f64 {
    let times = if robots > 2_000 { 1 } else { 7 };
    let mut taken: Vec<f64> = (0..times)
        .map(|_| {
            let (began, began_cpu) = (Instant::now(), cpu_ms());
            work();
            let wall_ms = began.elapsed().as_secs_f64() * 1e3;
            // Short work is rarely interrupted, and the processor's own account is coarse.
            let cpu = cpu_ms().zip(began_cpu).filter(|_| wall_ms > 8.0);
            cpu.map_or(wall_ms, |(after, before)| after - before)
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[times / 2]
}

/// What this thread has computed so far, milliseconds, so that a busy machine does not falsify times. Linux only.
fn cpu_ms() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? / 1e6)
}

/// Least squares without a bottleneck, straight synchronised lines, judged: its longest way and its conflicts.
fn squares_alone(problem: &TransitionProblem) -> (f64, usize) {
    // Far more slack than the floor has room for: any way is within reach.
    let choice = Choice::new(&problem.starts, &problem.goals, &[]);
    let Some(start_of) = choice.and_then(|choice| choice.least_squares().solve(1e6)) else { return (0.0, 0) };
    let mut longest = 0.0f64;
    let mut paths = vec![Path::default(); problem.starts.len()];
    for (goal, &start) in start_of.iter().enumerate() {
        longest = longest.max(problem.starts[start].distance(problem.goals[goal]));
    }
    let time = Span::from_secs(longest / problem.limits.speed_mps * 2.0 + 2.0);
    for (goal, &start) in start_of.iter().enumerate() {
        let (from, to) = (problem.starts[start], problem.goals[goal]);
        let drive = Piece { duration: time, c1: from, c2: to, end: to };
        paths[start] = Path { start: from, pieces: vec![Piece::rest(from, Span::from_millis(350)), drive] };
    }
    let proof = prove(&ProofInput {
        paths: &paths,
        standing: &[],
        obstacles: &[],
        half_floor: problem.half_floor + Vec2::new(1.0, 1.0),
        limits: &problem.limits,
        gap_m: problem.limits.contact_m() + 0.003,
        obstacle_gap_m: 0.003,
    });
    (longest, proof.conflicts.len())
}

fn dense(problem: &TransitionProblem) {
    let costs: Vec<f64> = problem
        .goals
        .iter()
        .flat_map(|goal| problem.starts.iter().map(|start| (*goal - *start).length_squared()))
        .collect();
    let _ = lsap::solve(problem.goals.len(), problem.starts.len(), &costs, false);
}

impl Row {
    pub const HEADINGS: &'static str =
        "scene              robots   plan ms  /T_min  closest mm |  CAPT ms  /T_min  conflicts | dense ms";

    pub fn text(&self) -> String {
        let optional = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.2}"));
        format!(
            "{:<18} {:>6} {:>9.2} {:>7} {:>11.1} | {:>8.2} {:>7.2} {:>10} | {:>8}",
            self.scene,
            self.robots,
            self.plan_ms,
            self.ratio.map_or("none".into(), |ratio| format!("{ratio:.3}")),
            self.closest_mm,
            self.capt_ms,
            self.capt_ratio,
            self.capt_conflicts,
            optional(self.dense_ms)
        )
    }

    pub fn json(&self) -> String {
        let optional = |value: Option<f64>| value.map_or("null".into(), |value| format!("{value:.4}"));
        format!(
            "{{\"scene\":\"{}\",\"robots\":{},\"plan_ms\":{:.3},\"ratio\":{},\"closest_m\":{:.5},\"capt_ms\":{:.3},\"capt_ratio\":{:.4},\"capt_conflicts\":{},\"dense_ms\":{}}}",
            self.scene,
            self.robots,
            self.plan_ms,
            optional(self.ratio),
            self.closest_mm / 1e3,
            self.capt_ms,
            self.capt_ratio,
            self.capt_conflicts,
            optional(self.dense_ms)
        )
    }
}
