//! Paths of an assignment, with the proof's verdict.

use super::following;
use crate::cancel::Cancel;
use crate::margins::{COMFORT_M, MARGIN_M};
use crate::motion::{Profile, turn_time};
use crate::proof::{Proof, ProofInput, prove_unless};
use crate::{Closest, Path, Transition, TransitionProblem};
use lightbots_base::{Limits, Span};

/// Above this number of robots no following distance is looked for, because that takes too long.
const ROOM_MOST: usize = 1000;

/// Aim of a deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// Comfortable clearance between all pairs.
    Comfort,
    /// Room to stop behind a robot ahead, as well.
    Room,
}

/// Paths that may have contacts.
pub(super) struct Candidate {
    pub transition: Transition,
    /// The proof's verdict on the comfortable clearance, or on the following distance where that is the aim.
    pub proof: Proof,
    /// Number of conflicts below the comfortable clearance.
    uncomfortable: usize,
    /// Comfortable distance of centres, metres.
    comfort_m: f64,
    /// Contacts and faults: pairs closer than the least margin, and robots with illegal motion.
    pub wrong: usize,
}

impl Candidate {
    /// Straight lines with one progress; `start_of[goal]`. Robots without a goal stay.
    pub fn straight(problem: &TransitionProblem, start_of: &[usize], cancel: Cancel<'_>) -> Self {
        let mut ends = problem.starts.clone();
        let mut goal_of = vec![None; ends.len()];
        for (goal, &start) in start_of.iter().enumerate() {
            assert_eq!(goal_of[start], None, "robot {start} has one goal at most");
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

    /// Paths of one duration, driven `slower` times as slowly as possible. They are judged as if driven at full speed,
    /// so that the least duration does not depend on the asked duration.
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
        let duration = Path::longest(&paths);
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

    /// Whether it is free of contacts and faults.
    pub fn holds(&self) -> bool {
        self.wrong == 0
    }

    /// Pairs to displace; none where there are too many.
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

    /// Whether it has the comfortable clearance, and the following distance where that is the aim.
    pub fn is_comfortable(&self) -> bool {
        self.proof.holds()
    }

    /// The objective of the deformation: fewer contacts and faults, then fewer close pairs, then fewer pairs without the
    /// following distance.
    pub fn improves_on(&self, other: &Self) -> bool {
        self.wrong < other.wrong || (self.wrong == other.wrong && self.is_roomier_than(other))
    }

    /// The same without contacts and faults.
    pub fn is_roomier_than(&self, other: &Self) -> bool {
        let rank = |of: &Self| (of.uncomfortable, of.proof.conflicts.len());
        rank(self) < rank(other)
    }
}

/// Factor by which a drive of `duration` is slower than one of `least`; the rest for turning does not count.
pub(super) fn slower_than(least: Span, duration: Span, limits: &Limits) -> f64 {
    let rest = turn_time(core::f64::consts::FRAC_PI_2, limits);
    (duration - rest).as_secs() / (least - rest).as_secs().max(1e-6)
}

/// Empty paths: nothing else is tried with numbers that are not finite.
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

/// All robots stay for the asked duration.
pub(super) fn standing_still(problem: &TransitionProblem) -> Transition {
    let mut transition =
        Candidate::straight(&TransitionProblem { goals: Vec::new(), ..problem.clone() }, &[], Cancel::NEVER)
            .transition;
    transition.least = Span::ZERO;
    transition
}
