//! Measures one row: our plan, squared distances alone (CAPT), and a dense library solver.

use crate::cpu::median_ms;
use lightbots_base::{Piece, Span};
use lightbots_plan::assignment::Choice;
use lightbots_plan::proof::prove;
use lightbots_plan::{Path, TransitionProblem, transition};

/// Most robots with which the dense solver is run, because it needs memory and time for every pair.
const DENSE_MOST: usize = 1_000;

/// Results of one row.
pub struct Row {
    scene: &'static str,
    robots: usize,
    /// Our whole plan with its proof. `None` if no plan was found.
    ours: Option<Way>,
    /// Time of our planner if it found no plan, milliseconds.
    plan_ms: f64,
    closest_mm: f64,
    /// Squared distances alone. `None` if a robot is bound to a pixel, because then hardly anything is left to assign.
    capt: Option<Way>,
    /// The dense solver. `None` if a robot is bound to a pixel, and with more than [`DENSE_MOST`] robots.
    dense: Option<Way>,
}

/// Results of one planner.
#[derive(Clone, Copy)]
struct Way {
    /// Median duration of planning, milliseconds.
    ms: f64,
    /// Duration of the plan divided by T_min. T_min is the time for the bottleneck distance at full speed, and 0.62 s
    /// for a quarter turn and a ramp.
    ratio: f64,
    /// Number of pairs of robots that come too close.
    conflicts: usize,
}

/// Plans a scene several times and returns the results.
pub fn measure(scene: &'static str, problem: &TransitionProblem) -> Row {
    let robots = problem.starts.len();
    let bottleneck_m = Choice::new(&problem.starts, &problem.goals, &problem.pinned)
        .map_or(0.0, |choice| choice.bottleneck_m());
    let least_s = bottleneck_m / problem.limits.speed_mps + 0.62;
    let times = if robots > 2_000 { 1 } else { 7 };
    let mut plan = None;
    let plan_ms = median_ms(times, || plan = transition(problem).ok());
    let ours = plan.as_ref().map(|plan| Way {
        ms: plan_ms,
        ratio: plan.duration.as_secs() / least_s,
        conflicts: judged(problem, &plan.paths),
    });
    let straight = |ms: f64, start_of: &[usize]| {
        let (longest_m, paths) = lines(problem, start_of);
        let ratio = (longest_m / problem.limits.speed_mps + 0.62) / least_s;
        Way { ms, ratio, conflicts: judged(problem, &paths) }
    };
    let is_bound = problem.pinned.iter().any(Option::is_some);
    let capt = (!is_bound).then(|| {
        let mut start_of = Vec::new();
        let ms = median_ms(times, || {
            start_of = squares_alone(problem);
            judged(problem, &lines(problem, &start_of).1);
        });
        straight(ms, &start_of)
    });
    let dense = (!is_bound && robots <= DENSE_MOST).then(|| {
        let mut start_of = Vec::new();
        let ms = median_ms(times, || start_of = dense(problem));
        straight(ms, &start_of)
    });
    let closest_mm = plan.and_then(|plan| plan.closest).map_or(0.0, |closest| closest.distance_m * 1e3);
    Row { scene, robots, ours, plan_ms, closest_mm, capt, dense }
}

/// The assignment with the least sum of squared distances, without a bottleneck: `start_of[goal]`.
fn squares_alone(problem: &TransitionProblem) -> Vec<usize> {
    // This slack is far more than the floor is wide, so every distance is allowed.
    let choice = Choice::new(&problem.starts, &problem.goals, &[]);
    choice.and_then(|choice| choice.least_squares().solve(1e6)).unwrap_or_default()
}

/// Straight synchronised lines for an assignment, and the length of the longest line, metres.
fn lines(problem: &TransitionProblem, start_of: &[usize]) -> (f64, Vec<Path>) {
    let way = |(goal, &start): (usize, &usize)| problem.starts[start].distance(problem.goals[goal]);
    let longest_m = start_of.iter().enumerate().map(way).fold(0.0, f64::max);
    let time = Span::from_secs(longest_m / problem.limits.speed_mps * 2.0 + 2.0);
    let mut paths = vec![Path::default(); problem.starts.len()];
    for (goal, &start) in start_of.iter().enumerate() {
        let (from, to) = (problem.starts[start], problem.goals[goal]);
        let drive = Piece { duration: time, c1: from, c2: to, end: to };
        paths[start] = Path { start: from, pieces: vec![Piece::rest(from, Span::from_millis(350)), drive] };
    }
    (longest_m, paths)
}

/// Number of pairs of robots that come too close.
fn judged(problem: &TransitionProblem, paths: &[Path]) -> usize {
    prove(&problem.to_prove(paths)).conflicts.len()
}

/// The assignment of a dense solver with the least sum of squared distances: `start_of[goal]`.
fn dense(problem: &TransitionProblem) -> Vec<usize> {
    let costs: Vec<f64> = problem
        .goals
        .iter()
        .flat_map(|goal| problem.starts.iter().map(|start| (*goal - *start).length_squared()))
        .collect();
    lsap::solve(problem.goals.len(), problem.starts.len(), &costs, false)
        .map_or(Vec::new(), |(_, start_of)| start_of)
}

impl Row {
    pub const HEADINGS: &'static str = "scene              robots |   plan ms  /T_min  conflicts  closest mm |  CAPT ms  /T_min  conflicts | dense ms  /T_min  conflicts";

    pub fn text(&self) -> String {
        let way = |way: Option<Way>| match way {
            Some(Way { ms, ratio, conflicts }) => format!("{ms:>9.2} {ratio:>7.3} {conflicts:>10}"),
            None => format!("{:>9} {:>7} {:>10}", "-", "-", "-"),
        };
        let ours =
            self.ours.map_or(format!("{:>9.2}    none          -", self.plan_ms), |ours| way(Some(ours)));
        format!(
            "{:<18} {:>6} | {ours} {:>11.1} | {} | {}",
            self.scene,
            self.robots,
            self.closest_mm,
            way(self.capt),
            way(self.dense)
        )
    }

    pub fn json(&self) -> String {
        let way = |name: &str, way: Option<Way>| match way {
            Some(Way { ms, ratio, conflicts }) => {
                format!("\"{name}_ms\":{ms:.3},\"{name}_ratio\":{ratio:.4},\"{name}_conflicts\":{conflicts}")
            }
            None => format!("\"{name}_ms\":null,\"{name}_ratio\":null,\"{name}_conflicts\":null"),
        };
        let ours = match self.ours {
            None => format!("\"plan_ms\":{:.3},\"plan_ratio\":null,\"plan_conflicts\":null", self.plan_ms),
            found => way("plan", found),
        };
        format!(
            "{{\"scene\":\"{}\",\"robots\":{},{ours},\"closest_m\":{:.5},{},{}}}",
            self.scene,
            self.robots,
            self.closest_mm / 1e3,
            way("capt", self.capt),
            way("dense", self.dense)
        )
    }
}
