//! Paths for a settled assignment, with what the proof says of them.

use super::{COMFORT_M, MARGIN_M};
use crate::motion::Profile;
use crate::proof::{Proof, ProofInput, prove};
use crate::{Closest, Path, Transition, TransitionProblem};
use lightbots_base::Span;

/// A transition that may turn out not to hold.
pub(super) struct Candidate {
    pub transition: Transition,
    /// What the proof says when asked for comfortable distances.
    pub proof: Proof,
    /// How much of that must not be: single robots' faults, and pairs closer than the least margin.
    pub wrong: usize,
}

impl Candidate {
    /// Straight synchronised lines; `start_of[goal]`. Robots without a goal stay.
    pub fn straight(problem: &TransitionProblem, start_of: &[usize]) -> Self {
        let mut ends = problem.starts.clone();
        let mut goal_of = vec![None; ends.len()];
        for (goal, &start) in start_of.iter().enumerate() {
            ends[start] = problem.goals[goal];
            goal_of[start] = Some(goal);
        }
        let lines = || problem.starts.iter().zip(&ends);
        let longest_m = lines().map(|(from, to)| from.distance(*to)).fold(0.0, f64::max);
        let quickest = Profile::quickest(longest_m, problem.easing, &problem.limits);
        let profile = quickest.stretched(problem.duration.unwrap_or(Span::ZERO));
        let paths = lines().map(|(&from, &to)| profile.path(from, to)).collect();
        let mut candidate = Self::of_paths(problem, paths, goal_of);
        candidate.transition.least = quickest.duration();
        candidate
    }

    /// Any paths, all equally long.
    pub fn of_paths(problem: &TransitionProblem, paths: Vec<Path>, goal_of: Vec<Option<usize>>) -> Self {
        let gap_m = problem.limits.contact_m() + COMFORT_M;
        let proof = prove(&ProofInput { gap_m, ..problem.to_prove(&paths) });
        let duration = paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO);
        let closest = proof.closest;
        let transition =
            Transition { goal_of, paths, duration, least: duration, lower_bound_s: 0.0, closest };
        let least = problem.limits.contact_m() + MARGIN_M;
        let place = |disc: usize, at_end: bool| match transition.paths.get(disc) {
            Some(path) if at_end => path.as_ref().end(),
            Some(path) => path.start,
            None => problem.standing[disc - transition.paths.len()],
        };
        let is_wrong = |found: &&Closest| {
            let (i, j) = found.pair;
            let ends = place(i, false).distance(place(j, false)).min(place(i, true).distance(place(j, true)));
            found.distance_m < least.min(ends) - 1e-6
        };
        let wrong = proof.conflicts.iter().filter(is_wrong).count() + proof.faults.len();
        Self { transition, proof, wrong }
    }

    /// Whether it may be driven.
    pub fn holds(&self) -> bool {
        self.wrong == 0
    }

    /// Whether it leaves room for robots that do not follow exactly.
    pub fn is_comfortable(&self) -> bool {
        self.proof.holds()
    }

    /// Fewer things wrong, then fewer pairs that are close.
    pub fn is_better_than(&self, other: &Self) -> bool {
        (self.wrong, self.proof.conflicts.len()) < (other.wrong, other.proof.conflicts.len())
    }
}

/// Everybody stays where they are, as long as the problem asks for.
pub(super) fn standing_still(problem: &TransitionProblem) -> Transition {
    let mut transition =
        Candidate::straight(&TransitionProblem { goals: Vec::new(), ..problem.clone() }, &[]).transition;
    transition.least = Span::ZERO;
    transition
}
