//! Stop-safety: at which moments a robot may stop dead without any contact.
//!
//! A robot that stops dead stands where it is from then on. Who would touch it before the fleet rests has seen it
//! after the reaction time and brakes at the grip limit; everybody else drives on until the fleet eases to rest on one
//! HOLD. Who brakes becomes an obstacle too, somewhere between the first moment at which it can stand and the last one
//! at which it must: whoever follows it must be able to stop in turn, at each of these moments. Moments are sampled.

mod rows;
#[cfg(test)]
mod tests;

use super::curve::share_of_foot;
use super::grid::{Bounds, near_pairs};
use crate::Path;
use crate::cancel::{Cancel, Cancelled, unless};
use lightbots_base::braking::{GRIP_MPS2, REACTION_S};
use lightbots_base::{Limits, Span, Vec2};
use rows::Rows;
use std::collections::VecDeque;

/// Time between two sampled moments.
pub(crate) const STEP: Span = Span::from_millis(50);
/// Moments sampled at most: of drives that take longer not every one is.
const MOST_MOMENTS: usize = 10_000;

/// What is assumed of a fleet of which one robot stops dead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopAssumptions {
    /// From the death until the wheels of who comes near begin to brake, seconds.
    pub reaction_s: f64,
    /// Path time until the fleet rests on a HOLD, seconds.
    pub rest_s: f64,
    /// Room between two rims that counts as a contact, metres.
    pub spare_m: f64,
    /// A robot may brake for another that stands this near to its way, rim to rim, metres.
    pub wary_m: f64,
}

impl Default for StopAssumptions {
    /// The reaction time of `base`. Nobody but those it is in the way of tells that a robot is dead before it has been
    /// silent for 0.56 s and was asked in vain for some 0.3 s; HOLD is said 0.15 s ahead and its ease of 0.3 s costs half
    /// of it. Robots are up to 3 mm off their paths. Places between two moments are taken from a straight line: at most
    /// 0.3 mm off it at 1 m/s².
    fn default() -> Self {
        Self { reaction_s: REACTION_S, rest_s: 1.2, spare_m: 0.003, wary_m: 0.008 }
    }
}

/// At which moments of a transition robots may stop dead.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StopSafety {
    /// Pairs of a robot that drives in this transition and a sampled moment of it.
    pub moments: usize,
    /// Those of them at which a contact may follow, by moment, then by robot.
    pub unsafe_moments: Vec<UnsafeMoment>,
    /// Time between two sampled moments: 50 ms but for drives of more than 500 s.
    pub pace: Span,
}

/// A robot that must not stop dead at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnsafeMoment {
    /// Which robot.
    pub robot: usize,
    /// When, after the transition's start.
    pub at: Span,
    /// Where it is then, stage metres.
    pub place: Vec2,
    /// Who touches it; where `missing_m` is 0: who can stop for it, but has somebody behind that cannot stop in turn.
    pub by: usize,
    /// How much room `by` is short of, metres.
    pub missing_m: f64,
}

impl StopSafety {
    /// The share of moments at which robots may stop dead, 0 to 1; 1 where nobody drives.
    pub fn share(&self) -> f64 {
        1.0 - self.unsafe_moments.len() as f64 / self.moments.max(1) as f64
    }

    /// The moment at which most room is missing.
    pub fn worst(&self) -> Option<&UnsafeMoment> {
        self.unsafe_moments
            .iter()
            .reduce(|worst, one| if one.missing_m > worst.missing_m { one } else { worst })
    }

    /// Whether a robot may stop dead at a moment: at the sampled moments before and after it.
    pub fn is_safe(&self, robot: usize, at: Span) -> bool {
        let near = |one: &&UnsafeMoment| one.robot == robot && (one.at - at).0.abs() < self.pace.0;
        !self.unsafe_moments.iter().any(|one| near(&one))
    }
}

/// Measures a transition's stop-safety under the usual assumptions.
///
/// `paths[robot]`: all of one duration, as [`super::prove`] wants them.
pub fn stop_safety(paths: &[Path], limits: &Limits) -> StopSafety {
    measured(paths, limits, &StopAssumptions::default(), Cancel::NEVER)
}

/// The same under other assumptions, given up as soon as `is_wanted` says so: it is asked once for each moment.
pub fn stop_safety_unless(
    paths: &[Path],
    limits: &Limits,
    assumptions: &StopAssumptions,
    is_wanted: &dyn Fn() -> bool,
) -> Result<StopSafety, Cancelled> {
    unless(is_wanted, |cancel| measured(paths, limits, assumptions, cancel))
}

pub(crate) fn measured(
    paths: &[Path],
    limits: &Limits,
    assumptions: &StopAssumptions,
    cancel: Cancel<'_>,
) -> StopSafety {
    let duration = paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO);
    let drives: Vec<bool> = paths.iter().map(|path| !path.as_ref().rests()).collect();
    let steps = (duration.0.max(0) / STEP.0) as usize + 1;
    let stride = steps.div_ceil(MOST_MOMENTS);
    let count = steps.div_ceil(stride);
    let law = Law::new(limits, *assumptions);
    let mut rows = Rows::new(paths, law.ahead(), STEP * ((count - 1) * stride) as i64);
    let mut sweep = Sweep { law, stride, is_unsafe: VecDeque::new(), found: Vec::new() };
    for _ in (0..count).take_while(|_| !cancel.is_wanted()) {
        sweep.look(&rows, &drives);
        rows.go_back(stride);
    }
    // The latest moment was looked at first, and of each moment the first robots too.
    sweep.found.reverse();
    let pace = STEP * stride as i64;
    let moments = drives.iter().filter(|drives| **drives).count() * count;
    StopSafety { moments, unsafe_moments: sweep.found, pace }
}

/// A look at all moments, from the last to the first, as everything that follows a death follows it later.
struct Sweep {
    law: Law,
    /// Steps from one moment to the next.
    stride: usize,
    /// `is_unsafe[moments ahead][robot]`, of the moments looked at last.
    is_unsafe: VecDeque<Vec<bool>>,
    found: Vec<UnsafeMoment>,
}

impl Sweep {
    /// Who must not stop dead at the first of the rows: whom somebody touches, and for whom somebody must brake who must
    /// not stop in turn at one of the moments at which it may come to stand.
    fn look(&mut self, rows: &Rows<'_>, drives: &[bool]) {
        let boxes: Vec<Bounds> = (0..drives.len()).map(|robot| rows.bounds(robot)).collect();
        let reach_m = self.law.wary_m;
        let mut here: Vec<UnsafeMoment> = Vec::new();
        near_pairs(&boxes, reach_m, |i, j| {
            for (robot, by) in [(i, j), (j, i)] {
                let place = rows.at(0, robot);
                let point = Bounds { min: place, max: place };
                if !drives[robot] || !drives[by] || point.distance_squared(&boxes[by]) >= reach_m * reach_m {
                    continue;
                }
                let Some((last, missing_m)) = self.law.judge(place, &|step| rows.at(step, by)) else {
                    continue;
                };
                let later = usize::from(last).div_ceil(self.stride);
                if last == 0 || self.is_unsafe.iter().take(later).any(|is_unsafe| is_unsafe[by]) {
                    let missing_m = f64::from(missing_m);
                    here.push(UnsafeMoment { robot, at: rows.first(), place, by, missing_m });
                }
            }
        });
        // Of several who touch one robot the worst counts.
        here.sort_by(|a, b| {
            b.robot.cmp(&a.robot).then(b.missing_m.total_cmp(&a.missing_m)).then(a.by.cmp(&b.by))
        });
        here.dedup_by_key(|one| one.robot);
        let kept = self.law.ahead().div_ceil(self.stride);
        let mut is_unsafe =
            if self.is_unsafe.len() < kept { None } else { self.is_unsafe.pop_back() }.unwrap_or_default();
        is_unsafe.clear();
        is_unsafe.resize(drives.len(), false);
        here.iter().for_each(|one| is_unsafe[one.robot] = true);
        self.is_unsafe.push_front(is_unsafe);
        self.found.append(&mut here);
    }
}

/// What counts as a contact, and how robots brake.
pub(crate) struct Law {
    contact_m: f64,
    /// Distance of two centres within which one may brake for the other, metres.
    wary_m: f64,
    /// The farthest anybody drives in a step, metres.
    step_m: f64,
    of: StopAssumptions,
}

impl Law {
    pub fn new(limits: &Limits, of: StopAssumptions) -> Self {
        let step_m = (limits.speed_mps * STEP.as_secs() * 1.01).max(1e-4);
        let [contact_m, wary_m] = [of.spare_m, of.wary_m.max(of.spare_m)].map(|m| limits.contact_m() + m);
        Self { contact_m, wary_m, step_m, of }
    }

    /// How many steps ahead a robot must be looked at.
    fn ahead(&self) -> usize {
        (self.of.rest_s / STEP.as_secs()).ceil().clamp(2.0, 100.0) as usize
    }

    /// What becomes of who is `at(steps ahead)` if somebody else stops dead at a place: the last step in which it may begin
    /// to brake, 0 where it cannot stop in time, and how much room it is short of, metres. `None`: nothing.
    pub fn judge(&self, place: Vec2, at: &impl Fn(usize) -> Vec2) -> Option<(u8, f32)> {
        let apart_m = place.distance(at(0));
        let need_m = self.contact_m.min(apart_m) - 1e-6;
        let wary_m = self.wary_m.min(apart_m) - 1e-6;
        let touched = self.touched(place, at, wary_m)?;
        // Reaction and braking end within three steps.
        if touched < 3 {
            let missing_m = need_m - self.stopped_m(place, at, self.of.reaction_s);
            if missing_m > 0.0 {
                return Some((0, missing_m as f32));
            }
        }
        // It may begin to brake in any step before it comes near; in that one if it stands before.
        let in_time = |step: &usize| self.rolling_m(place, at, *step as f64 * STEP.as_secs()) >= wary_m;
        let last = (1..=touched).rev().find(in_time).unwrap_or(1);
        Some((last as u8, 0.0))
    }

    /// The step in which a robot comes nearer to a place than it must.
    fn touched(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, need_m: f64) -> Option<usize> {
        let mut step = 0;
        while step < self.ahead() {
            let spare_m = distance_m(place, at(step), at(step + 1)) - need_m;
            if spare_m < 0.0 {
                return Some(step);
            }
            // It drives no farther than this in a step.
            step += (spare_m / self.step_m) as usize + 1;
        }
        None
    }

    /// How near a robot comes to a place if its wheels begin to brake after `delay_s`, metres.
    fn stopped_m(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, delay_s: f64) -> f64 {
        let steps = 0..self.step_of(delay_s);
        let before = steps.map(|step| distance_m(place, at(step), at(step + 1)));
        before.fold(self.rolling_m(place, at, delay_s), f64::min)
    }

    /// The same from the begin of the step in which it begins to brake.
    fn rolling_m(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, delay_s: f64) -> f64 {
        let (step, step_s) = (self.step_of(delay_s), STEP.as_secs());
        let (from, to) = (at(step), at(step + 1));
        let speed_mps = from.distance(to) / step_s;
        // Braking takes the way of half its time.
        let share = (delay_s + speed_mps / (2.0 * GRIP_MPS2)) / step_s - step as f64;
        distance_m(place, from, from.lerp(to, share))
    }

    fn step_of(&self, delay_s: f64) -> usize {
        ((delay_s / STEP.as_secs() + 1e-9) as usize).min(self.ahead() - 1)
    }
}

/// Distance of a place from the line segment between two others, metres.
pub(crate) fn distance_m(place: Vec2, from: Vec2, to: Vec2) -> f64 {
    let (start, chord) = (from - place, to - from);
    (start + chord * share_of_foot(start, chord)).length()
}
