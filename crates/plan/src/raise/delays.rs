//! Finds delays of single robots that make more moments stop-safe. At a stop-safe moment, a robot may stop dead and no
//! other robot touches it.
//!
//! Robot `by` may touch `robot` after `robot` stopped dead. Then `by` is delayed until it can stop, or else `robot` is
//! delayed until it follows `by`. If a delayed robot then comes too near to a third robot, the third robot is delayed
//! in turn, up to its largest delay. A chain of delays is kept only if no pair in it gets worse.

mod pair;

use crate::Path;
use crate::cancel::Cancel;
use crate::motion::ends;
use crate::proof::stop_safe::{STEP, StopSafety};
use lightbots_base::{Limits, Span, Vec2};
use pair::{LEVEL, PairLaw};
use std::collections::BTreeMap;

/// Longest delay of a robot. Pairs that could come near each other only with longer delays are not checked.
const MOST: Span = Span::from_millis(400);
/// Most checks of a pair at a moment, for each robot of the transition. When the checks are used up, the search ends
/// with the delays found until then.
const MOST_LOOKS: usize = 1_500;
/// Most checks of a pair at a moment, in all.
const MOST_LOOKS_IN_ALL: usize = 3_000_000;
/// Robots that are near each other are searched at each `STRIDE`-th moment only.
const STRIDE: usize = 4;
/// Most delays in one chain; a robot that is delayed twice counts twice.
const MOST_CHAIN: usize = 64;

/// Returns `[robot]`: the delay of its start. `before`: the stop-safety without delays. `most`: how much later than
/// planned the last robot may arrive.
pub(super) fn delays(
    paths: &[Path],
    before: &StopSafety,
    limits: &Limits,
    most: Span,
    cancel: Cancel<'_>,
) -> Vec<Span> {
    let mut search = Search::new(paths, limits, most);
    let mut pairs: Vec<(usize, usize)> = before
        .unsafe_moments
        .iter()
        .filter(|one| one.missing_m > 0.0)
        .map(|one| (one.robot, one.by))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    // All pairs are tried twice: in the second round, some chains fit that did not fit before.
    for (robot, by) in pairs.iter().chain(&pairs).copied() {
        if search.looks == 0 || cancel.is_wanted() {
            break;
        }
        if search.put_behind(robot, by).is_none() {
            search.put_behind(by, robot);
        }
    }
    search.levels.iter().map(|level| LEVEL * i64::from(*level)).collect()
}

/// A robot that may come near another robot. `first` and `last` are the first and the last moment at which it may, in
/// steps of 50 ms.
#[derive(Clone, Copy)]
struct Near {
    other: usize,
    first: usize,
    last: usize,
}

struct Search<'a> {
    law: PairLaw<'a>,
    /// `[robot][moment]`: its place without delays, stage metres. Moments are [`STEP`] apart.
    tracks: Vec<Vec<Vec2>>,
    /// `[robot]`: its delay, in units of [`LEVEL`].
    levels: Vec<u8>,
    /// `[robot]`: its largest allowed delay, in units of [`LEVEL`].
    most: Vec<u8>,
    /// Results of [`Search::near`] that are known, by robot.
    near: BTreeMap<usize, Vec<Near>>,
    /// Number of checks of a pair at a moment that are left.
    looks: usize,
}

impl<'a> Search<'a> {
    fn new(paths: &[Path], limits: &'a Limits, most: Span) -> Self {
        let duration = Path::longest(paths);
        let count = (duration.0 / STEP.0) as usize + 2;
        let track = |path: &Path| {
            (0..count).map(|moment| path.as_ref().at(STEP * moment as i64).position).collect::<Vec<_>>()
        };
        let most = |path: &Path| {
            let left = most + duration - ends(path);
            (left.0.clamp(0, MOST.0) / LEVEL.0) as u8
        };
        Self {
            law: PairLaw::new(limits),
            tracks: paths.iter().map(track).collect(),
            levels: vec![0; paths.len()],
            most: paths.iter().map(most).collect(),
            near: BTreeMap::new(),
            looks: (MOST_LOOKS * paths.len()).min(MOST_LOOKS_IN_ALL),
        }
    }

    /// Delays robot `later` until it would not touch robot `sooner` after `sooner` stopped dead, and the reverse.
    /// Delays other robots as far as that requires. `None`, with all delays as before, if that is impossible or too few
    /// checks are left.
    fn put_behind(&mut self, sooner: usize, later: usize) -> Option<()> {
        let pair = self.near(later).iter().find(|near| near.other == sooner).copied()?;
        if self.cost(later, &pair)? == 0 {
            return Some(());
        }
        let kept = self.levels.clone();
        let done = self.chain(later, pair);
        if done.is_none() {
            self.levels = kept;
        }
        done
    }

    fn chain(&mut self, later: usize, pair: Near) -> Option<()> {
        let before = self.levels.clone();
        self.delay(later, &pair, 0)?;
        let mut open = vec![later];
        let mut delayed = 1;
        while let Some(robot) = open.pop() {
            for near in self.near(robot) {
                let now = self.levels[robot];
                let allowed = self.cost_at(robot, &near, (before[robot], before[near.other]))?;
                if self.cost_at(robot, &near, (now, self.levels[near.other]))? <= allowed {
                    continue;
                }
                delayed += 1;
                if delayed > MOST_CHAIN {
                    return None;
                }
                let seen_by_other = Near { other: robot, ..near };
                self.delay(near.other, &seen_by_other, allowed)?;
                open.push(near.other);
            }
        }
        Some(())
    }

    /// Raises a robot's delay to the least greater delay at which the cost of the pair is at most `allowed`. `None` if
    /// no delay suffices, or too few checks are left.
    fn delay(&mut self, robot: usize, pair: &Near, allowed: u32) -> Option<()> {
        for level in self.levels[robot] + 1..=self.most[robot] {
            if self.cost_at(robot, pair, (level, self.levels[pair.other]))? <= allowed {
                self.levels[robot] = level;
                return Some(());
            }
        }
        None
    }

    fn cost(&mut self, robot: usize, pair: &Near) -> Option<u32> {
        self.cost_at(robot, pair, (self.levels[robot], self.levels[pair.other]))
    }

    /// Returns the cost that [`PairLaw::cost`] gives a pair with the delays `levels`, which are in units of [`LEVEL`];
    /// `None` if too few checks are left.
    fn cost_at(&mut self, robot: usize, pair: &Near, levels: (u8, u8)) -> Option<u32> {
        self.looks = self.looks.checked_sub(pair.last - pair.first + 1)?;
        let tracks = (&self.tracks[robot][..], &self.tracks[pair.other][..]);
        Some(self.law.cost(tracks, levels, (pair.first, pair.last)))
    }

    /// Returns all robots that may come near `robot` if robots are delayed by up to [`MOST`].
    fn near(&mut self, robot: usize) -> Vec<Near> {
        if let Some(known) = self.near.get(&robot) {
            return known.clone();
        }
        let own = &self.tracks[robot];
        let reach_m = self.law.reach_m(MOST + STEP * STRIDE as i64);
        let pad = (MOST.0 / STEP.0) as usize + STRIDE;
        let near = |other: usize| {
            let track = &self.tracks[other];
            let is_near = |moment: &usize| own[*moment].distance(track[*moment]) < reach_m;
            let mut moments = (0..own.len()).step_by(STRIDE).filter(is_near);
            let first = moments.next()?;
            let last = moments.next_back().unwrap_or(first);
            Some(Near { other, first: first.saturating_sub(pad), last: last + pad })
        };
        let found: Vec<Near> =
            (0..self.tracks.len()).filter(|other| *other != robot).filter_map(near).collect();
        // A moment in this search takes about a tenth of the work of a check of a pair.
        self.looks = self.looks.saturating_sub(self.tracks.len() * own.len() / (10 * STRIDE));
        self.near.insert(robot, found.clone());
        found
    }
}
