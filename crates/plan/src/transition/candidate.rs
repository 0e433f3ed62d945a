//! Paths for a settled assignment, with what the proof says of them.

use super::MARGIN_M;
use crate::motion::Profile;
use crate::proof::{Proof, ProofInput, prove};
use crate::{Path, Transition, TransitionProblem};
use lightbots_base::Span;

/// A transition that may turn out not to hold.
pub(super) struct Candidate {
    pub transition: Transition,
    pub proof: Proof,
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
        let proof = prove(&ProofInput {
            paths: &paths,
            standing: &problem.standing,
            obstacles: &problem.obstacles,
            half_floor: problem.half_floor,
            limits: &problem.limits,
            gap_m: problem.limits.contact_m() + MARGIN_M,
        });
        let duration = paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO);
        let closest = proof.closest;
        let transition =
            Transition { goal_of, paths, duration, least: duration, lower_bound_s: 0.0, closest };
        Self { transition, proof }
    }

    /// The least distance between two rims, metres.
    pub fn rims_m(&self, problem: &TransitionProblem) -> f64 {
        self.proof.closest.map_or(f64::INFINITY, |closest| closest.distance_m - problem.limits.contact_m())
    }

    /// How much is wrong.
    pub fn conflicts(&self) -> usize {
        self.proof.conflicts.len() + self.proof.faults.len()
    }
}

/// Everybody stays where they are, as long as the problem asks for.
pub(super) fn standing_still(problem: &TransitionProblem) -> Transition {
    let mut transition =
        Candidate::straight(&TransitionProblem { goals: Vec::new(), ..problem.clone() }, &[]).transition;
    transition.least = Span::ZERO;
    transition
}
