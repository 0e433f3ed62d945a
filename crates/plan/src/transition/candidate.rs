//! Paths for a settled assignment, with what the proof says of them.

use super::following;
use crate::cancel::Cancel;
use crate::margins::{COMFORT_M, MARGIN_M};
use crate::motion::{Profile, turn_time};
use crate::proof::{Proof, ProofInput, prove_unless};
use crate::{Closest, Path, Transition, TransitionProblem};
use lightbots_base::{Limits, Span};

/// Among more robots than this nobody looks for room to stop behind others: it would take too long.
const ROOM_MOST: usize = 1000;

/// What ways are deformed for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// Nobody passes nearer than is comfortable.
    Comfort,
    /// Who drives behind another could stop if that died, as well.
    Room,
}

/// A transition that may turn out not to hold.
pub(super) struct Candidate {
    pub transition: Transition,
    /// What the proof says when asked for comfortable distances; where room was asked for, for that.
    pub proof: Proof,
    /// How many of its conflicts are closer than comfortable, and not only too near to who is ahead.
    uncomfortable: usize,
    /// Least distance of centres that is comfortable, metres.
    comfort_m: f64,
    /// How much of that must not be: single robots' faults, and pairs closer than the least margin.
    pub wrong: usize,
}

impl Candidate {
    /// Straight synchronised lines; `start_of[goal]`. Robots without a goal stay.
    pub fn straight(problem: &TransitionProblem, start_of: &[usize], cancel: Cancel<'_>) -> Self {
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
        let slower = slower_than(quickest.duration(), profile.duration(), &problem.limits);
        let mut candidate = Self::of_paths(problem, paths, goal_of, slower, cancel);
        candidate.transition.least = quickest.duration();
        candidate
    }

    /// Any paths, all equally long, on which everybody drives this many times as slowly as they could: they are judged as
    /// if they did, so that the least time does not depend on the time that was asked for.
    pub fn of_paths(
        problem: &TransitionProblem,
        paths: Vec<Path>,
        goal_of: Vec<Option<usize>>,
        slower: f64,
        cancel: Cancel<'_>,
    ) -> Self {
        let comfort_m = problem.limits.contact_m() + COMFORT_M - 1e-6;
        let gap_m =
            if paths.len() <= ROOM_MOST { following::widest_m(&problem.limits) } else { comfort_m + 1e-6 };
        let mut proof = prove_unless(&ProofInput { gap_m, ..problem.to_prove(&paths) }, cancel);
        if cancel.is_wanted() {
            proof = Proof::default();
        }
        let wanted_m = |found: &Closest| following::wanted_m(&paths, found, &problem.limits, slower);
        proof.conflicts.retain(|found| found.distance_m < wanted_m(found) - 1e-6);
        let uncomfortable = proof.conflicts.iter().filter(|found| found.distance_m < comfort_m).count();
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
        Self { transition, proof, uncomfortable, comfort_m, wrong }
    }

    /// Whether it may be driven.
    pub fn holds(&self) -> bool {
        self.wrong == 0
    }

    /// Pairs for which ways are to be deformed; none where they are too many.
    pub fn worth_deforming(&self, aim: Aim) -> Vec<Closest> {
        let is_asked = |found: &&Closest| aim == Aim::Room || found.distance_m < self.comfort_m;
        let robots = self.transition.paths.len();
        let most = match aim {
            Aim::Comfort => robots / 8 + 4,
            // Rows that turn have as many pairs in line as robots.
            Aim::Room => robots,
        };
        let asked = self.proof.conflicts.iter().filter(is_asked).copied();
        let asked: Vec<Closest> = asked.take(most + 1).collect();
        if asked.len() > most { Vec::new() } else { asked }
    }

    /// Whether it leaves room for robots that do not follow exactly.
    pub fn is_comfortable(&self) -> bool {
        self.proof.holds()
    }

    /// Fewer things wrong, then fewer pairs that are close, then fewer that are too near to who is ahead.
    pub fn is_better_than(&self, other: &Self) -> bool {
        self.wrong < other.wrong || (self.wrong == other.wrong && self.is_roomier_than(other))
    }

    /// The same, whatever else is wrong.
    pub fn is_roomier_than(&self, other: &Self) -> bool {
        let rank = |of: &Self| (of.uncomfortable, of.proof.conflicts.len());
        rank(self) < rank(other)
    }
}

/// How many times as slow a drive is that takes one time, rest for turning included, instead of a least time.
pub(super) fn slower_than(least: Span, duration: Span, limits: &Limits) -> f64 {
    let rest = turn_time(core::f64::consts::FRAC_PI_2, limits);
    (duration - rest).as_secs() / (least - rest).as_secs().max(1e-6)
}

/// No path at all for anybody: nothing is looked at, as nothing can be counted on.
pub(super) fn unmoved(problem: &TransitionProblem) -> Transition {
    Transition {
        goal_of: vec![None; problem.starts.len()],
        paths: problem.starts.iter().map(|&start| Path { start, pieces: Vec::new() }).collect(),
        duration: Span::ZERO,
        least: Span::ZERO,
        lower_bound_s: 0.0,
        closest: None,
    }
}

/// Everybody stays where they are, as long as the problem asks for.
pub(super) fn standing_still(problem: &TransitionProblem) -> Transition {
    let mut transition =
        Candidate::straight(&TransitionProblem { goals: Vec::new(), ..problem.clone() }, &[], Cancel::NEVER)
            .transition;
    transition.least = Span::ZERO;
    transition
}
