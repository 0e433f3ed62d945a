//! Robots exchange goals until their straight synchronised lines keep apart, without a longer longest line.
//!
//! The least sum of squared distances has no conflict while lines may be of any length (Turpin, Michael and Kumar 2014). A
//! limit on the length brings conflicts back near it. Min-conflicts search (Minton et al. 1992) removes most of them: it
//! looks for the exchange that lowers the sum of missing distances most.

use std::collections::BTreeSet;

use lightbots_base::Vec2;

use crate::cancel::Cancel;
use crate::margins::COMFORT_M;
use crate::{Closest, TransitionProblem};

/// Exchanges that are tried for each robot in conflict: with the robots whose starts or goals are nearest to its own. More
/// take longer and gain little: with 40, 1,000 robots from the rows into a hall kept as many conflicts (2026-11-24).
const PARTNERS: usize = 12;
/// Passes over all robots in conflict at most: a bound, chosen and not measured.
const PASSES: usize = 6;
/// Robots in conflict in a pass at most, as a share of all robots. A bound on the work for
/// fleets of thousands, chosen and not measured.
const MOST_SHARE: f64 = 0.25;
/// Squared missing distances below this are rounding, m².
const ROUNDING_M2: f64 = 1e-12;

/// `start_of[goal]` after exchanges, which begin with the robots of `conflicts`: pairs of starts or standing discs, as the
/// proof names them. No line is longer than `most_m` that was not before, and pinned goals keep their starts. `None` where
/// no exchange helps.
pub(super) fn exchanged(
    problem: &TransitionProblem,
    start_of: &[usize],
    conflicts: &[Closest],
    most_m: f64,
    cancel: Cancel<'_>,
) -> Option<Vec<usize>> {
    let mut search = Search::new(problem, start_of, most_m);
    let mut suspects = search.goals_of(conflicts, problem.starts.len());
    let most = (start_of.len() as f64 * MOST_SHARE) as usize + 2;
    let mut changed = false;
    for _ in 0..PASSES {
        if suspects.is_empty() || suspects.len() > most || cancel.is_wanted() {
            break;
        }
        let touched: Vec<usize> =
            suspects.iter().filter_map(|goal| search.improve(*goal)).flatten().collect();
        if touched.is_empty() {
            break;
        }
        changed = true;
        suspects.extend(touched);
        suspects.retain(|goal| search.missing(&search.lines[*goal], (*goal, *goal)) > ROUNDING_M2);
    }
    changed.then(|| search.start_of())
}

/// A straight line from a start to a goal, or a disc that stands.
#[derive(Clone, Copy, Debug)]
struct Line {
    from: Vec2,
    to: Vec2,
    start: usize,
}

impl Line {
    fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    fn to(self, to: Vec2) -> Self {
        Self { to, ..self }
    }

    /// Square of the distance that two lines miss where they are closest while both are driven with the same progress, m².
    /// Starts and goals closer than `wanted_m` need no more distance between them.
    fn missing(&self, other: &Self, wanted_m: f64) -> f64 {
        let (before, after) = (self.from - other.from, self.to - other.to);
        let change = after - before;
        let share = (-before.dot(change) / change.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let closest_squared = (before + change * share).length_squared();
        if closest_squared >= wanted_m * wanted_m {
            return 0.0;
        }
        let needed_m = wanted_m.min(before.length()).min(after.length());
        let missing_m = (needed_m - closest_squared.sqrt()).max(0.0);
        missing_m * missing_m
    }
}

struct Search {
    /// `[goal]`, then robots without a goal and standing discs.
    lines: Vec<Line>,
    /// `[goal]`: whether it may not be exchanged.
    is_pinned: Vec<bool>,
    goals: usize,
    most_m: f64,
    wanted_m: f64,
}

impl Search {
    fn new(problem: &TransitionProblem, start_of: &[usize], most_m: f64) -> Self {
        assert_eq!(start_of.len(), problem.goals.len(), "every goal has a start");
        let mut is_used = vec![false; problem.starts.len()];
        let mut lines = Vec::with_capacity(problem.starts.len() + problem.standing.len());
        for (&start, &to) in start_of.iter().zip(&problem.goals) {
            is_used[start] = true;
            lines.push(Line { from: problem.starts[start], to, start });
        }
        let idle = problem.starts.iter().zip(&is_used).filter(|(_, is_used)| !**is_used).map(|(at, _)| at);
        lines.extend(idle.chain(&problem.standing).map(|&at| Line { from: at, to: at, start: usize::MAX }));
        let is_pinned = |goal: usize| problem.pinned.get(goal).is_some_and(Option::is_some);
        Self {
            lines,
            is_pinned: (0..start_of.len()).map(is_pinned).collect(),
            goals: start_of.len(),
            most_m,
            wanted_m: problem.limits.contact_m() + COMFORT_M,
        }
    }

    fn start_of(&self) -> Vec<usize> {
        self.lines[..self.goals].iter().map(|line| line.start).collect()
    }

    /// Goals of the robots in conflict, in order; `robots` is how many there are.
    fn goals_of(&self, conflicts: &[Closest], robots: usize) -> BTreeSet<usize> {
        let mut goal_of = vec![None; robots];
        for (goal, line) in self.lines[..self.goals].iter().enumerate() {
            goal_of[line.start] = Some(goal);
        }
        let discs = conflicts.iter().flat_map(|found| [found.pair.0, found.pair.1]);
        discs.filter_map(|disc| goal_of.get(disc).copied().flatten()).collect()
    }

    /// Makes the exchange of one goal's robot with another that lowers the missing distances most: the goals whose
    /// lines changed, or are near a line that did.
    fn improve(&mut self, goal: usize) -> Option<Vec<usize>> {
        let own = self.lines[goal];
        let before = self.missing(&own, (goal, goal));
        if self.is_pinned[goal] || before <= ROUNDING_M2 {
            return None;
        }
        let mut best: Option<(f64, usize)> = None;
        for partner in self.partners(goal) {
            let other = self.lines[partner];
            let (one, two) = (own.to(other.to), other.to(own.to));
            if one.length().max(two.length()) > self.most_m.max(own.length()).max(other.length()) {
                continue;
            }
            let skip = (goal, partner);
            let was =
                self.missing(&own, skip) + self.missing(&other, skip) + own.missing(&other, self.wanted_m);
            let is = self.missing(&one, skip) + self.missing(&two, skip) + one.missing(&two, self.wanted_m);
            if is < was - ROUNDING_M2 && best.is_none_or(|(gain, _)| was - is > gain) {
                best = Some((was - is, partner));
            }
        }
        let (_, partner) = best?;
        let (from, start) = (own.from, own.start);
        let other = self.lines[partner];
        self.lines[goal] = Line { from: other.from, start: other.start, ..own };
        self.lines[partner] = Line { from, start, ..other };
        let is_near = |other: &usize| {
            let line = &self.lines[*other];
            [goal, partner].iter().any(|one| self.lines[*one].missing(line, self.wanted_m) > ROUNDING_M2)
        };
        Some((0..self.goals).filter(|other| *other == goal || *other == partner || is_near(other)).collect())
    }

    /// What a line misses to all others but two, m².
    fn missing(&self, line: &Line, skip: (usize, usize)) -> f64 {
        let others = self.lines.iter().enumerate().filter(|(index, _)| *index != skip.0 && *index != skip.1);
        others.map(|(_, other)| line.missing(other, self.wanted_m)).sum()
    }

    /// Goals whose robots may exchange with that of one goal: those with the nearest starts and the nearest goals.
    fn partners(&self, goal: usize) -> Vec<usize> {
        let own = self.lines[goal];
        let nearest = |far: &dyn Fn(&Line) -> f64| {
            let is_open = |other: &usize| *other != goal && !self.is_pinned[*other];
            let mut order: Vec<(f64, usize)> =
                (0..self.goals).filter(is_open).map(|other| (far(&self.lines[other]), other)).collect();
            let most = PARTNERS.min(order.len());
            if most > 0 && most < order.len() {
                order.select_nth_unstable_by(most, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            }
            order.truncate(most);
            order.into_iter().map(|(_, other)| other).collect::<Vec<_>>()
        };
        let mut found = nearest(&|line| (line.from - own.from).length_squared());
        found.extend(nearest(&|line| (line.to - own.to).length_squared()));
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeded::Seeded;
    use lightbots_base::{Limits, Span};

    /// Two robots side by side whose goals are one behind the other, and a third far away.
    fn crossing() -> TransitionProblem {
        TransitionProblem {
            starts: vec![Vec2::new(0.0, 0.0), Vec2::new(0.1, 0.0), Vec2::new(1.0, 1.0)],
            goals: vec![Vec2::new(0.1, 0.5), Vec2::new(0.0, 0.5), Vec2::new(1.0, 1.2)],
            ..TransitionProblem::on_floor(Vec2::new(2.0, 2.0), Limits::ELISA_3)
        }
    }

    fn conflict() -> Closest {
        Closest { distance_m: 0.0, at: Span::ZERO, pair: (0, 1), place: Vec2::ZERO }
    }

    fn exchanged_in(problem: &TransitionProblem, most_m: f64) -> Option<Vec<usize>> {
        exchanged(problem, &[0, 1, 2], &[conflict()], most_m, Cancel::NEVER)
    }

    #[test]
    fn robots_that_cross_exchange_goals() {
        assert_eq!(exchanged_in(&crossing(), 0.6), Some(vec![1, 0, 2]));
    }

    #[test]
    fn pinned_goals_keep_their_robots() {
        let problem = TransitionProblem { pinned: vec![Some(0), None, None], ..crossing() };
        assert_eq!(exchanged_in(&problem, 0.6), None);
    }

    #[test]
    fn exchanges_leave_fewer_conflicts_and_no_longer_line() {
        let mut seeded = Seeded::new(3);
        for _ in 0..20 {
            let mut places = |y_m: f64| -> Vec<Vec2> {
                (0..30).map(|i| Vec2::new(f64::from(i) * 0.1, y_m + seeded.between(0.0, 0.05))).collect()
            };
            let (starts, goals) = (places(0.0), places(1.5));
            let floor = TransitionProblem::on_floor(Vec2::new(4.0, 2.0), Limits::ELISA_3);
            let problem = TransitionProblem { starts, goals, ..floor };
            // Each robot is within a few places of its goal, in no order.
            let mut start_of: Vec<usize> = (0..30).collect();
            (0..28).for_each(|goal| start_of.swap(goal, goal + seeded.below(3)));
            let missing = |start_of: &[usize]| {
                let search = Search::new(&problem, start_of, f64::INFINITY);
                (0..30).map(|goal| search.missing(&search.lines[goal], (goal, goal))).sum::<f64>()
            };
            let longest = |start_of: &[usize]| {
                let length = |goal: usize| problem.starts[start_of[goal]].distance(problem.goals[goal]);
                (0..30).map(length).fold(0.0, f64::max)
            };
            let pairs = (1..30).map(|other| Closest { pair: (other - 1, other), ..conflict() });
            let pairs: Vec<Closest> = pairs.collect();
            let Some(found) = exchanged(&problem, &start_of, &pairs, longest(&start_of), Cancel::NEVER)
            else {
                continue;
            };
            assert!(missing(&found) < missing(&start_of));
            assert!(longest(&found) <= longest(&start_of));
            let mut sorted = found.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..30), "each robot has one goal");
        }
    }
}
