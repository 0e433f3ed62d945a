//! A candidate: paths for an assignment, with the proof's verdict.

use super::following;
use crate::cancel::Cancel;
use crate::margins::{COMFORT_M, MARGIN_M};
use crate::motion::{Profile, turn_time};
use crate::proof::{Proof, ProofInput, prove_unless};
use crate::{Closest, Path, Transition, TransitionProblem};
use lightbots_base::{Limits, Span};

/// Most robots for which following distances are checked, because the check takes long for more. A following distance
/// lets a robot stop behind another robot that stops dead.
const ROOM_MOST: usize = 1000;

/// What a deformation of straight lines aims at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// The comfortable clearance, [`COMFORT_M`], between all pairs.
    Comfort,
    /// The following distance as well: room for a robot to stop behind the robot ahead.
    Room,
}

/// Paths that may have contacts.
pub(super) struct Candidate {
    pub transition: Transition,
    /// The proof's verdict, with wider distances than for a plan. A pair counts as a conflict if it is closer than the
    /// comfortable clearance or, with at most [`ROOM_MOST`] robots, closer than its following distance.
    pub proof: Proof,
    /// Number of conflicts with less than the comfortable clearance.
    uncomfortable: usize,
    /// Distance of two centres with the comfortable clearance, metres.
    comfort_m: f64,
    /// Number of contacts and faults. A contact is a pair closer than the least margin, [`MARGIN_M`]; a fault is
    /// illegal motion of a robot.
    pub wrong: usize,
}

impl Candidate {
    /// Makes a candidate of straight lines on which all robots have the same progress. `start_of[goal]` is the start of
    /// the robot for that goal; robots without a goal stay.
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

    /// Makes a candidate of paths of equal duration, which are driven `slower` times as slowly as the limits allow.
    /// Following distances are checked as at full speed, so that the least duration does not depend on the asked
    /// duration. If cancelled, the verdict means nothing.
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

    /// Whether the candidate is free of contacts and faults.
    pub fn holds(&self) -> bool {
        self.wrong == 0
    }

    /// Returns the pairs that a deformation with this aim must displace; none if there are too many.
    pub fn worth_deforming(&self, aim: Aim) -> Vec<Closest> {
        let is_asked = |found: &&Closest| aim == Aim::Room || found.distance_m < self.comfort_m;
        let robots = self.transition.paths.len();
        let most = match aim {
            Aim::Comfort => robots / 8 + 4,
            // A row of robots that turns has about as many pairs in line as robots.
            Aim::Room => robots,
        };
        let asked = self.proof.conflicts.iter().filter(is_asked).copied();
        let asked: Vec<Closest> = asked.take(most + 1).collect();
        if asked.len() > most { Vec::new() } else { asked }
    }

    /// Whether all pairs have the comfortable clearance and, with at most [`ROOM_MOST`] robots, their following
    /// distance, and all motion is legal.
    pub fn is_comfortable(&self) -> bool {
        self.proof.holds()
    }

    /// Whether this candidate is better than `other`. Fewer contacts and faults count first, then fewer pairs without
    /// comfortable clearance, then fewer pairs without their following distance.
    pub fn improves_on(&self, other: &Self) -> bool {
        self.wrong < other.wrong || (self.wrong == other.wrong && self.is_roomier_than(other))
    }

    /// [`Self::improves_on`], but contacts and faults do not count.
    pub fn is_roomier_than(&self, other: &Self) -> bool {
        let rank = |of: &Self| (of.uncomfortable, of.proof.conflicts.len());
        rank(self) < rank(other)
    }
}

/// Factor by which a drive that lasts `duration` is slower than a drive that lasts `least`. The rest at the beginning,
/// in which robots turn, does not count.
pub(super) fn slower_than(least: Span, duration: Span, limits: &Limits) -> f64 {
    let rest = turn_time(core::f64::consts::FRAC_PI_2, limits);
    (duration - rest).as_secs() / (least - rest).as_secs().max(1e-6)
}

/// Makes a transition with empty paths, for problems with numbers that are not finite or not sensible.
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

/// Makes a transition in which all robots stay for the asked duration, or for no time if none is asked.
pub(super) fn standing_still(problem: &TransitionProblem) -> Transition {
    let mut transition =
        Candidate::straight(&TransitionProblem { goals: Vec::new(), ..problem.clone() }, &[], Cancel::NEVER)
            .transition;
    transition.least = Span::ZERO;
    transition
}
