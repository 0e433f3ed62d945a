//! Finds the pairs of discs that come too close, and the closest pair. Discs are robots and standing discs.

use super::grid::{Bounds, near_pairs};
use super::input::{ProofInput, SLACK_M};
use super::timeline::{self, Stretch};
use super::verdict::Closest;
use crate::cancel::Cancel;
use lightbots_base::{Span, Vec2};
use std::collections::BTreeMap;

/// Number of pairs between two polls of the cancellation.
const POLLED: usize = 4096;
/// Most slices of time into which the drive is divided.
const MOST_SLICES: f64 = 2000.0;

/// Returns all pairs that come closer than allowed, and the closest pair of all. At least one of a pair is a robot.
/// `horizon`: duration of the drive.
pub(super) fn judge(
    input: &ProofInput<'_>,
    horizon: Span,
    cancel: Cancel<'_>,
) -> (Vec<Closest>, Option<Closest>) {
    let discs = Discs::new(input, horizon.0.max(1));
    let mut verdict = Verdict { input, closest: None, conflicts: BTreeMap::new() };
    if discs.first.len() > 2 {
        let mut slice = Slice::default();
        let step_m = discs.step_m(input);
        let count = (discs.longest_m / step_m).ceil().clamp(1.0, MOST_SLICES) as i64;
        let mut cursors = vec![0; discs.first.len() - 1];
        for number in (0..count).take_while(|_| !cancel.is_wanted()) {
            let from_us = (i128::from(discs.horizon_us) * i128::from(number) / i128::from(count)) as i64;
            let to_us = (i128::from(discs.horizon_us) * i128::from(number + 1) / i128::from(count)) as i64;
            slice.cut(&discs, &mut cursors, from_us, to_us);
            slice.judge(&discs, &mut verdict, cancel);
        }
    }
    (verdict.conflicts.into_values().collect(), verdict.closest)
}

/// Robots and standing discs over time.
struct Discs {
    /// Pieces of all discs' paths, one disc after the other.
    stretches: Vec<Stretch>,
    /// `first[disc]..first[disc + 1]`: range of a disc's stretches.
    first: Vec<usize>,
    horizon_us: i64,
    /// Greatest length of the control polygon of a path, metres; the path itself is no longer.
    longest_m: f64,
    /// Distance, at the start, of the closest pair of discs of which one is a robot, metres. The least distance during
    /// the drive is at most this.
    closest_at_start_m: f64,
}

impl Discs {
    fn new(input: &ProofInput<'_>, horizon_us: i64) -> Self {
        let (mut stretches, mut first) = (Vec::new(), vec![0]);
        let mut longest_m = 0.0f64;
        for path in input.paths {
            timeline::stretches(path, horizon_us, &mut stretches);
            let own = &stretches[first[first.len() - 1]..];
            let length = own.iter().map(|stretch| stretch.polygon_m()).sum();
            longest_m = longest_m.max(length);
            first.push(stretches.len());
        }
        for &at in input.standing {
            stretches.push(Stretch { begin_us: 0, end_us: horizon_us, curve: [at; 4] });
            first.push(stretches.len());
        }
        let starts: Vec<Vec2> = first[..first.len() - 1].iter().map(|&own| stretches[own].curve[0]).collect();
        let closest_at_start_m = closest_two(&starts, input.paths.len());
        Self { stretches, first, horizon_us, longest_m, closest_at_start_m }
    }

    /// Longest distance that a robot should drive in a slice of time, metres: half the usual distance of neighbours, so
    /// that few boxes overlap.
    fn step_m(&self, input: &ProofInput<'_>) -> f64 {
        let area = 4.0 * input.half_floor.x.abs() * input.half_floor.y.abs();
        let usual = (area / self.first.len() as f64).sqrt() / 2.0;
        usual.max(input.gap_m).clamp(1e-3, 1e3)
    }

    /// Returns the places where the motion of a disc begins and ends, stage metres.
    fn ends(&self, disc: usize) -> (Vec2, Vec2) {
        (self.stretches[self.first[disc]].curve[0], self.stretches[self.first[disc + 1] - 1].curve[3])
    }
}

/// The least distance between two of `places`, of which at least one is among the first `moving`, metres; infinite if
/// there are no two.
fn closest_two(places: &[Vec2], moving: usize) -> f64 {
    let mut bounds = Bounds::EMPTY;
    places.iter().for_each(|&place| bounds.include(place));
    let wide = bounds.max.x - bounds.min.x >= bounds.max.y - bounds.min.y;
    let key = |place: usize| if wide { places[place].x } else { places[place].y };
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_unstable_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    let mut least = f64::INFINITY;
    for (rank, &a) in order.iter().enumerate() {
        for &b in &order[rank + 1..] {
            if key(b) - key(a) >= least {
                break;
            }
            if a.min(b) < moving {
                least = least.min(places[a].distance(places[b]));
            }
        }
    }
    least
}

/// All discs during a slice of time.
#[derive(Default)]
struct Slice {
    from_us: i64,
    to_us: i64,
    cuts: Vec<Stretch>,
    first: Vec<usize>,
    boxes: Vec<Bounds>,
}

impl Slice {
    /// Cuts the motion of all discs from `from_us` to `to_us`, microseconds after the start. `cursors[disc]`: index of
    /// the disc's piece at or before `from_us`, among its own pieces.
    fn cut(&mut self, discs: &Discs, cursors: &mut [usize], from_us: i64, to_us: i64) {
        (self.from_us, self.to_us) = (from_us, to_us);
        self.cuts.clear();
        self.boxes.clear();
        self.first.clear();
        for (disc, cursor) in cursors.iter_mut().enumerate() {
            let own = &discs.stretches[discs.first[disc]..discs.first[disc + 1]];
            self.first.push(self.cuts.len());
            let mut bounds = Bounds::EMPTY;
            while *cursor + 1 < own.len() && own[*cursor].end_us <= from_us {
                *cursor += 1;
            }
            for stretch in &own[*cursor..] {
                if stretch.begin_us >= to_us {
                    break;
                }
                let (begin_us, end_us) = (stretch.begin_us.max(from_us), stretch.end_us.min(to_us));
                let cut = Stretch { begin_us, end_us, curve: stretch.between(begin_us, end_us) };
                cut.curve.iter().for_each(|&place| bounds.include(place));
                self.cuts.push(cut);
            }
            self.boxes.push(bounds);
        }
        self.first.push(self.cuts.len());
    }

    fn judge(&self, discs: &Discs, verdict: &mut Verdict<'_>, cancel: Cancel<'_>) {
        let reach = verdict.reach_m().min(discs.closest_at_start_m.max(verdict.input.gap_m) + SLACK_M);
        let (mut pairs, mut is_over) = (0usize, false);
        near_pairs(&self.boxes, reach, |i, j| {
            pairs += 1;
            is_over |= pairs.is_multiple_of(POLLED) && cancel.is_wanted();
            if is_over || i >= verdict.input.paths.len() {
                return;
            }
            let reach = verdict.reach_m();
            if self.boxes[i].distance_squared(&self.boxes[j]) >= reach * reach {
                return;
            }
            let own = |disc: usize| &self.cuts[self.first[disc]..self.first[disc + 1]];
            if let Some((distance_m, at_us, place)) =
                timeline::closest(own(i), own(j), self.from_us, self.to_us, reach)
            {
                verdict.hear(discs, Closest { distance_m, at: Span(at_us), pair: (i, j), place });
            }
        });
    }
}

/// The closest pair and the conflicts that were found.
struct Verdict<'a> {
    input: &'a ProofInput<'a>,
    closest: Option<Closest>,
    conflicts: BTreeMap<(usize, usize), Closest>,
}

impl Verdict<'_> {
    /// Distance from which a pair is neither a conflict nor the closest pair, metres.
    fn reach_m(&self) -> f64 {
        self.closest.map_or(f64::INFINITY, |closest| closest.distance_m).max(self.input.gap_m)
    }

    fn hear(&mut self, discs: &Discs, found: Closest) {
        if self.closest.is_none_or(|closest| found.distance_m < closest.distance_m) {
            self.closest = Some(found);
        }
        if found.distance_m >= self.input.gap_m - SLACK_M {
            return;
        }
        let ((a0, a1), (b0, b1)) = (discs.ends(found.pair.0), discs.ends(found.pair.1));
        let need = self.input.gap_m.min(a0.distance(b0)).min(a1.distance(b1));
        if found.distance_m < need - SLACK_M {
            let known = self.conflicts.entry(found.pair).or_insert(found);
            if found.distance_m < known.distance_m {
                *known = found;
            }
        }
    }
}
