//! Runs the schedule of solvers for one problem, and chooses among the solutions. Most solvers make a first guess, a
//! set of splines on which robots may touch. A deformation then separates the robots in sweeps over all contacts.

use std::cell::OnceCell;

use super::facts::Facts;
use super::from_lattice::from_lattice;
use super::guess::Guess;
use super::guesses::{Guesses, named};
use super::path_set::PathSet;
use super::schedule::{
    Budget, Group, MOST_STRETCH, MOST_TRIES, MOST_WORK, PITCH_M, SCHEDULE, Solver, SolverRow, WIDE,
};
use super::stop_and_go::{MOST_LOOKS, stop_and_go};
use super::trajectories::Trajectories;
use super::verify::{Rejected, verified};
use crate::explain::{ExplainedRow, Explanation, RowOutcome};
use crate::instance::Instance;
use crate::optimise::left_over::LeftOver;
use crate::optimise::relaxation::{Effort, Relaxation, relax};
use crate::order::{Chosen, PlanQuality, choose, percent};
use crate::proof::prove_unless;
use crate::proof::stop_safe::{StopAssumptions, measured};
use crate::roads::lattice::Lattice;
use crate::roads::shortest::shortest_paths;
use crate::roads::visibility::{MOST_WALLS, VisibilityGraph};
use crate::spline::set::SplineSet;
use crate::{Meeting, Path, Repaired, TransitionProblem};

/// Length of a span (a piece of a spline) that first guesses aim at, seconds: the time that the smallest curve takes at
/// full speed. Longer spans are less work, but follow curves less closely.
const SPAN_S: f64 = 0.25;
/// Length of a span in first guesses of successive halving, seconds: longer than [`SPAN_S`], because fewer spans are
/// less work.
const LONG_SPAN_S: f64 = 0.33;
/// Number of meetings per robot above which additional time does not help. A meeting is a pair of robots that still
/// touch.
const HOPELESS: usize = 3;
/// Most robots for which several solutions are compared. With more robots, the groups for small fleets are skipped, so
/// that the schedule mostly ends with the first acceptable solution.
const MOST_TO_COMPARE: usize = 600;
/// With more robots than this, successive halving runs first if the best guess needs more than [`LITTLE_PROMISED`]
/// times the least duration.
const MANY: usize = 350;
/// Time scale above which the best guess counts as slow; see [`MANY`].
const LITTLE_PROMISED: f64 = 1.16;
/// Number of guesses in the first round of successive halving.
const RACERS: usize = 2;
/// Most sweeps of each guess in the first round.
const FIRST_SWEEPS: usize = 7;
/// If a guess of the first round leaves fewer contacts per robot than this, no further guess takes part in that round.
const PROMISING: usize = 6;
/// Factor on the number of contacts of the first guess, when the guesses of the first round are compared. Below 1, it
/// favours this guess, which has the least badness.
const HEAD_START: f64 = 0.9;
/// Most rounds in which splines with illegal motion are smoothed, and contacts that follow are resolved.
const AMENDMENTS: usize = 4;
/// Most sweeps of each of those rounds.
const AMENDING_SWEEPS: usize = 72;
/// Ranking penalty on a floor with walls, because one braking robot blocks others there. A solution that aims at less
/// distance between centres than [`WIDE`] counts as 25 % longer.
const CLOSE: f64 = 1.25;

/// A solution that the proof accepts.
struct Candidate {
    /// Index of its row in `Run::rows`.
    row: usize,
    solution: Trajectories,
    /// Duration at full speed, multiplied by the penalty [`CLOSE`] if the solution `is_close`, seconds.
    lasts_s: f64,
    is_close: bool,
}

/// The result of a run of the schedule.
pub(crate) struct Solution {
    /// The chosen paths; or else the pairs of robots that still touch in the row that left the fewest pairs. Rows that
    /// left no pair, because they failed for another reason, do not count. `Err` is empty if no row left a pair.
    pub result: Result<Repaired, Vec<Meeting>>,
    pub explanation: Explanation,
}

/// Runs the schedule for one instance of a problem.
pub(super) fn run(problem: &TransitionProblem, instance: &Instance) -> Solution {
    let visibility = OnceCell::new();
    let paths = Lattice::new(instance, PITCH_M)
        .and_then(|lattice| shortest_paths(instance, &lattice, &visibility))
        .unwrap_or_default();
    let path_set = PathSet::new(instance, &paths);
    let guesses = (paths.len() == instance.robots()).then(|| Guesses::new(problem, instance, &path_set));
    let mut run = Run {
        problem,
        instance,
        visibility: &visibility,
        guesses: guesses.as_ref(),
        work: MOST_WORK,
        looks: MOST_LOOKS,
        candidates: Vec::new(),
        left_over: Vec::new(),
        rows: Vec::new(),
    };
    for group in &SCHEDULE {
        run.group(group);
    }
    run.outcome()
}

struct Run<'a> {
    problem: &'a TransitionProblem,
    instance: &'a Instance<'a>,
    visibility: &'a OnceCell<VisibilityGraph>,
    guesses: Option<&'a Guesses<'a>>,
    /// Work that is left for the groups of the schedule, in units of [`Budget`].
    work: usize,
    /// Number of checks of two robots' moves that stop-and-go may still make.
    looks: usize,
    candidates: Vec<Candidate>,
    /// Pairs of robots that still touch in the row that left the fewest pairs. Rows that left no pair do not count;
    /// empty if there is no other row.
    left_over: Vec<Meeting>,
    rows: Vec<ExplainedRow>,
}

impl Run<'_> {
    fn facts(&self) -> Facts {
        let best = self.fastest();
        let stretch = self.guesses.and_then(|guesses| guesses.ranked.first()).map_or(1.0, Guess::stretch);
        let robots = self.instance.robots();
        Facts {
            is_large: self.is_large(),
            promises_little: robots > MANY && stretch > LITTLE_PROMISED,
            has_walls: self.has_walls(),
            is_hopeless: best.is_none() && self.left_over.len() > robots * HOPELESS,
            is_solved: best.is_some(),
            is_close: best.is_some_and(|best| best.is_close),
            lasts_s: best.map_or(f64::INFINITY, |best| best.lasts_s),
            least_s: self.guesses.map_or(0.0, |guesses| guesses.least_s),
            work: self.work,
            tries: 0,
            is_faster: false,
            was_faster: false,
        }
    }

    fn is_large(&self) -> bool {
        self.instance.robots() > MOST_TO_COMPARE
    }

    /// Whether there are walls, and few enough of them for a visibility graph.
    fn has_walls(&self) -> bool {
        (1..=MOST_WALLS).contains(&self.instance.walls.len())
    }

    /// The fastest solution until now by `lasts_s`, on which the schedule's conditions depend. The final choice is made in
    /// [`Run::outcome`] by the order on candidate plans.
    fn fastest(&self) -> Option<&Candidate> {
        self.candidates.iter().min_by(|one, other| one.lasts_s.total_cmp(&other.lasts_s))
    }

    fn is_cancelled(&self) -> bool {
        self.instance.cancel.is_wanted()
    }

    /// Runs the rows of a group until its target is reached, at most [`MOST_TRIES`] of them. Reports the group as
    /// skipped if its condition does not hold, if it needs shortest paths and a robot has none, or if cancelled.
    fn group(&mut self, group: &Group) {
        let facts = self.facts();
        let needs_guesses = !matches!(group.rows[0].solver, Solver::StopAndGo { .. });
        if self.is_cancelled() || (needs_guesses && self.guesses.is_none()) || !group.when.holds(&facts) {
            self.report(group.name.into(), RowOutcome::Skipped(group.when.why_not()));
            return;
        }
        self.work = match group.budget {
            Budget::Left => self.work,
            Budget::AtMost(work) => self.work.min(work),
            Budget::AtLeast(work) => self.work.max(work),
            Budget::Of(work) => work,
        };
        let before_s = facts.lasts_s;
        let (mut tries, mut is_faster) = (0, false);
        for row in group.rows {
            if tries == MOST_TRIES {
                break;
            }
            tries += usize::from(self.row(row, tries));
            let was_faster = is_faster;
            let facts = self.facts();
            is_faster |= facts.lasts_s < before_s;
            if group.until.is_reached(&Facts { tries, is_faster, was_faster, ..facts }) {
                break;
            }
        }
    }

    /// Runs a row. `tries`: number of rows of the group that ran before it. Returns `false`, and reports nothing, if
    /// there is no guess for the row.
    fn row(&mut self, row: &SolverRow, tries: usize) -> bool {
        let (wide, is_large) = (WIDE.robots_m, self.is_large());
        let SolverRow { solver, clearances, stretch, sweeps } = *row;
        let effort = |stretch: f64, hurry: bool| Effort { sweeps, stretch, hurry, clearances };
        match (solver, self.guesses) {
            (Solver::StopAndGo { pitch_m, off_edge_m }, _) => self.stop_and_go(pitch_m, off_edge_m),
            (Solver::SuccessiveHalving, Some(guesses)) => self.successive_halving(guesses, row),
            (Solver::MinimumTime(pick), Some(guesses)) => {
                let Some(guess) = guesses.pick(pick) else { return false };
                let slower = if tries >= MOST_TRIES / 2 { guess.stretch() } else { 1.0 };
                let effort = effort((stretch / slower).max(1.8), false);
                let name = format!("minimum time, {}", named(guess.manner, clearances));
                self.relax(name, guess.splines(slower, SPAN_S), effort);
            }
            (Solver::WithSlack { manner, times, least_s }, Some(guesses)) => {
                let guess = Guess::new(guesses.path_set, self.problem.easing, manner, wide);
                let lasts_s = guess.least_s().max(least_s) * times;
                let name = format!("with slack × {times}, {}", named(manner, clearances));
                self.relax(name, guess.splines_lasting(lasts_s, SPAN_S), effort(stretch, is_large));
            }
            (Solver::FromLattice { pitch_m }, _) => {
                let lattice = Lattice::new(self.instance, pitch_m);
                self.lattice("from lattice", lattice, pitch_m, effort(stretch, true));
            }
            (Solver::ThroughGaps { pitch_m }, _) => {
                let instance = self.instance;
                let visibility = self.visibility.get_or_init(|| VisibilityGraph::new(instance));
                let lattice = visibility.lattice(instance, pitch_m);
                self.lattice("through gaps", lattice, pitch_m, effort(stretch, true));
            }
            (_, None) => return false,
        }
        true
    }

    fn lattice(&mut self, what: &str, lattice: Option<Lattice>, pitch_m: f64, effort: Effort) {
        let clearance_mm = effort.clearances.walls_m * 1e3;
        let name = format!("{what}, pitch {:.1} mm, {clearance_mm:.1} mm off walls", pitch_m * 1e3);
        match lattice.and_then(|lattice| from_lattice(self.instance, &lattice)) {
            Some(splines) => self.relax(name, splines, effort),
            None => self.report(name, RowOutcome::NoGuess),
        }
    }

    /// Deforms one or two guesses by a few sweeps each. Then finishes the deformation of the guess with the fewest
    /// contacts, and of further guesses in turn. Ends once a solution is acceptable or [`MOST_TRIES`] guesses were
    /// tried.
    fn successive_halving(&mut self, guesses: &Guesses<'_>, row: &SolverRow) {
        let (instance, clearances) = (self.instance, row.clearances);
        let diverse = guesses.diverse();
        // Guesses that are both `level` and `early` mostly win, so a second guess is not needed.
        let is_favourite = diverse.first().is_some_and(|first| first.manner.level && first.manner.early);
        let mut starts = diverse.into_iter().take(MOST_TRIES).map(|guess| {
            let slower = guess.stretch();
            let stretch = (MOST_STRETCH / slower).max(1.8);
            let effort = Effort { sweeps: row.sweeps, stretch, hurry: true, clearances };
            (guess.manner, guess.splines(slower, LONG_SPAN_S), effort)
        });
        let mut racers = Vec::new();
        for (manner, splines, effort) in starts.by_ref().take(RACERS) {
            let mut racer = Relaxation::new(instance, splines, effort);
            racer.go_on(FIRST_SWEEPS, &mut self.work);
            let resolved = racer.resolved();
            let head_start = if racers.is_empty() { HEAD_START } else { 1.0 };
            racers.push((resolved as f64 * head_start, manner, racer, effort));
            let is_enough = is_favourite || resolved < instance.robots() * PROMISING;
            if is_enough || self.is_cancelled() {
                break;
            }
        }
        racers.sort_by(|(one, ..), (other, ..)| one.total_cmp(other));
        let racers = racers.into_iter().map(|(_, manner, racer, effort)| (manner, racer, effort));
        let late = starts
            .map(|(manner, splines, effort)| (manner, Relaxation::new(instance, splines, effort), effort));
        for (manner, racer, effort) in racers.chain(late) {
            self.finish(format!("successive halving, {}", named(manner, clearances)), racer, effort);
            // Cancellation is polled here, because making a guess of a large fleet takes long, even if no work is left
            // to deform it.
            if self.facts().is_acceptable() || self.is_cancelled() {
                break;
            }
        }
    }

    fn stop_and_go(&mut self, pitch_m: f64, off_edge_m: f64) {
        let name = format!("stop-and-go, pitch {:.0} mm", pitch_m * 1e3);
        let instance = self.instance;
        let visibility = self.visibility.get_or_init(|| VisibilityGraph::new(instance));
        let roadmap = (pitch_m, off_edge_m);
        let found = stop_and_go(instance, visibility, roadmap, self.problem.duration, &mut self.looks);
        let Some(found) = found else { return self.report(name, RowOutcome::NoGuess) };
        if !prove_unless(&self.problem.to_prove(&found.paths), instance.cancel).holds() {
            return self.report(name, RowOutcome::Rejected { contacts: 0 });
        }
        let lasts_s = found.least.as_secs();
        self.keep(name, Trajectories::StopAndGo(found), lasts_s, false);
    }

    /// Deforms a first guess, and keeps or rejects the result.
    fn relax(&mut self, name: String, splines: SplineSet, effort: Effort) {
        self.finish(name, Relaxation::new(self.instance, splines, effort), effort);
    }

    /// Finishes a deformation, which may have begun already, and keeps or rejects its result.
    fn finish(&mut self, name: String, mut relaxation: Relaxation, effort: Effort) {
        relaxation.go_on(effort.sweeps, &mut self.work);
        match relaxation.outcome().and_then(|splines| self.amended(splines, effort)) {
            Ok(splines) => {
                let is_close = self.has_walls() && effort.clearances.robots_m < WIDE.robots_m;
                let lasts_s = splines.least_span_s(&self.instance.limits) * splines.spans as f64;
                let penalty = if is_close { CLOSE } else { 1.0 };
                self.keep(name, Trajectories::Splines(splines), lasts_s * penalty, is_close);
            }
            Err(left) => {
                self.report(name, left.outcome());
                let left = left.meetings;
                if self.left_over.is_empty() || (1..self.left_over.len()).contains(&left.len()) {
                    self.left_over = left;
                }
            }
        }
    }

    /// Returns the splines as soon as the proof accepts them. Splines with illegal motion are smoothed, and contacts
    /// that follow are resolved. `Err` if the proof rejects the last splines too, contacts cannot be resolved, or
    /// slower driving and smoothing cannot help. It has the contacts that are left, if these are known.
    fn amended(&mut self, mut splines: SplineSet, effort: Effort) -> Result<SplineSet, LeftOver> {
        let effort = Effort { sweeps: AMENDING_SWEEPS, stretch: 1.2, ..effort };
        for _ in 0..AMENDMENTS {
            let Rejected { splines: mut rejected, faulty_spans } =
                match verified(self.problem, self.instance, splines) {
                    Ok(splines) => return Ok(splines),
                    Err(rejected) => rejected,
                };
            if faulty_spans.is_empty() {
                return Err(LeftOver::BY_PROOF);
            }
            faulty_spans.into_iter().for_each(|(robot, span)| rejected.smooth(robot, span));
            splines = relax(self.instance, rejected, effort, &mut self.work)?;
        }
        verified(self.problem, self.instance, splines).map_err(|_| LeftOver::BY_PROOF)
    }

    fn keep(&mut self, name: String, solution: Trajectories, lasts_s: f64, is_close: bool) {
        let duration = solution.least(self.instance);
        self.candidates.push(Candidate { row: self.rows.len(), solution, lasts_s, is_close });
        self.report(name, RowOutcome::Solved { duration, stop_safe_percent: None });
    }

    fn report(&mut self, solver: String, outcome: RowOutcome) {
        self.rows.push(ExplainedRow { solver, outcome });
    }

    /// Chooses among all solutions by the order on candidate plans (`order.rs`), and makes the explanation.
    fn outcome(mut self) -> Solution {
        let repaired = |candidate: &Candidate| candidate.solution.repaired(self.problem, self.instance);
        let mut plans: Vec<Repaired> = self.candidates.iter().map(repaired).collect();
        let quality = |plan: &Repaired| PlanQuality { contacts: 0, duration: Path::longest(&plan.paths) };
        let qualities: Vec<PlanQuality> = plans.iter().map(quality).collect();
        let (limits, cancel) = (&self.problem.limits, self.instance.cancel);
        let stop_safe_percent = |index: usize| {
            let paths = &plans[index].paths;
            percent(measured(paths, limits, &StopAssumptions::default(), cancel).share())
        };
        let Some(Chosen { index, reason, stop_safe_percents }) = choose(&qualities, stop_safe_percent) else {
            let explanation =
                Explanation { rows: self.rows, chosen: None, reason: "no row was solved".into() };
            return Solution { result: Err(self.left_over), explanation };
        };
        for (index, measured) in stop_safe_percents {
            let row = &mut self.rows[self.candidates[index].row];
            if let RowOutcome::Solved { stop_safe_percent, .. } = &mut row.outcome {
                *stop_safe_percent = Some(measured);
            }
        }
        let chosen = Some(self.candidates[index].row);
        let explanation = Explanation { rows: self.rows, chosen, reason: reason.into() };
        Solution { result: Ok(plans.swap_remove(index)), explanation }
    }
}
