//! First guesses of one problem, ranked by their badness. A first guess is a set of paths on which robots may still
//! touch.

use super::guess::{Guess, Manner};
use super::path_set::PathSet;
use super::schedule::{Pick, ROOMY};
use crate::TransitionProblem;
use crate::instance::Instance;
use crate::motion::progress::ProgressLaw;
use crate::optimise::contacts::Clearances;

/// Penalty on the badness of a guess in [`Guesses::diverse`] if its manner differs from that of a better guess only in
/// the bow.
const ALIKE: f64 = 0.06;

/// Shortest paths and first guesses of one problem. Every robot has a path.
pub(super) struct Guesses<'a> {
    pub path_set: &'a PathSet<'a>,
    /// First guesses, the least badness first; not all if the planner was cancelled.
    pub ranked: Vec<Guess<'a>>,
    /// Duration of the longest path at full speed, seconds.
    pub least_s: f64,
}

impl<'a> Guesses<'a> {
    pub fn new(problem: &TransitionProblem, instance: &Instance, path_set: &'a PathSet<'a>) -> Self {
        let easing = problem.easing;
        let mut ranked: Vec<Guess> = Manner::all()
            .take_while(|_| !instance.cancel.is_wanted())
            .map(|manner| Guess::new(path_set, easing, manner, ROOMY.robots_m))
            .collect();
        ranked.sort_by(|a, b| a.badness.total_cmp(&b.badness));
        let least_s = ProgressLaw::new(path_set.longest_m, &instance.limits, easing, 1.0).drive_s;
        Self { path_set, ranked, least_s }
    }

    /// Returns the guess that a row in minimum time takes. `None` for a rank that no guess has, and for [`Pick::Plain`]
    /// if [`Pick::Best`] is the same guess.
    pub fn pick(&self, pick: Pick) -> Option<&Guess<'a>> {
        let best = self.ranked.first()?;
        match pick {
            Pick::Best => Some(best),
            Pick::Plain if best.manner == Manner::default() => None,
            Pick::Plain => self.ranked.iter().find(|guess| guess.manner == Manner::default()),
            Pick::Ranked(rank) => self.ranked.get(rank),
        }
    }

    /// Returns the guesses in another order. A guess that differs from a better guess only in its bow comes later,
    /// because it mostly fails if the better one fails. Of several guesses with equal trajectories, only the best is
    /// returned.
    pub fn diverse(&self) -> Vec<&Guess<'a>> {
        let all = &self.ranked;
        let straight = |at: usize| Manner { bow: 0.0, ..all[at].manner };
        let is_alike = |at: usize| (0..at).any(|before| straight(before) == straight(at));
        let weigh = |at: usize| all[at].badness + if is_alike(at) { ALIKE } else { 0.0 };
        let is_same = |at: usize| (0..at).any(|before| all[before].is_like(&all[at]));
        let different = (0..all.len()).filter(|&at| !is_same(at));
        let mut order: Vec<(f64, usize)> = different.map(|at| (weigh(at), at)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        order.into_iter().map(|(_, at)| &all[at]).collect()
    }
}

/// Describes a manner, and the distance between centres that `clearances` has, in a few words, for the explanation.
pub(super) fn named(manner: Manner, clearances: Clearances) -> String {
    let Manner { bow, early, level, spread, staged } = manner;
    let flags = [(early, "early"), (level, "level"), (spread, "spread"), (staged, "staged")];
    let mut words: Vec<String> =
        flags.iter().filter(|(is, _)| *is).map(|(_, name)| (*name).to_string()).collect();
    if bow != 0.0 {
        words.push(format!("bow {bow}"));
    }
    if words.is_empty() {
        words.push("together".into());
    }
    format!("{}, {:.1} mm between centres", words.join(", "), clearances.robots_m * 1e3)
}
