//! Stop-safety: the moments at which a robot may stop dead (suddenly and for good, as if it had failed) without any
//! contact.
//!
//! Assumptions of the measurement: the dead robot stays where it is. A robot that would come near it before the fleet
//! rests brakes at the grip limit after the reaction time. As soon as the first robot brakes, one HOLD is sent. All
//! other robots drive on until this HOLD has eased them to rest.
//!
//! A braking robot becomes an obstacle too. It may begin to brake at any moment from the first when it may see the dead
//! robot to the last when it must brake. The robots behind it must be able to stop at each of these moments. Moments
//! are sampled.

mod corridor;
mod rows;
#[cfg(test)]
mod tests;

use super::grid::{Bounds, near_pairs};
use crate::Path;
use crate::cancel::{Cancel, Cancelled, unless};
use corridor::Corridor;
use lightbots_base::braking::{GRIP_MPS2, REACTION_S};
use lightbots_base::shape::point_to_segment;
use lightbots_base::{Limits, Span, Vec2};
use rows::Rows;
pub(crate) use rows::STEP;
use std::cmp::Reverse;
use std::collections::VecDeque;

/// Number of steps of 50 ms for which near pairs are searched at once.
const BLOCK: usize = 8;
/// Most sampled moments of a drive. Drives of more than 500 s are sampled less often than every 50 ms.
const MOST_MOMENTS: usize = 10_000;

/// Assumptions about a fleet in which one robot stops dead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopAssumptions {
    /// Time from the dead stop until the wheels of a near robot begin to brake, seconds.
    pub reaction_s: f64,
    /// Path time from the dead stop until a HOLD has eased the fleet to rest, if no robot sees the dead robot, seconds.
    /// Path time runs while robots drive along their paths, and stands during a HOLD.
    pub silence_s: f64,
    /// Path time from the moment at which a robot brakes for something unplanned until a HOLD has eased the fleet to
    /// rest, seconds.
    pub alarm_s: f64,
    /// Gap between rims below which two robots count as touching, metres.
    pub spare_m: f64,
    /// A robot brakes for another if its path would bring their rims closer than this gap, metres.
    pub wary_m: f64,
    /// Gap between rims beyond which a robot does not brake for another, metres.
    pub sight_m: f64,
}

impl Default for StopAssumptions {
    /// `reaction_s` is [`REACTION_S`]. `silence_s`: the controller requests a report from a silent robot after 0.56 s.
    /// It takes the robot for lost after 0.8 s, which it checks every 0.1 s, and sends a HOLD. This takes effect 0.15 s
    /// later, and its ease of 0.3 s costs half of that in path time. `alarm_s`: the report of a robot that brakes takes
    /// 0.02 s, then a HOLD follows as above. `spare_m` covers a path error of 3 mm. Places between two moments are
    /// interpolated linearly, with an error of at most 0.3 mm at 1 m/s².
    fn default() -> Self {
        Self {
            reaction_s: REACTION_S,
            silence_s: 1.2,
            alarm_s: 0.4,
            spare_m: 0.003,
            wary_m: 0.008,
            sight_m: 0.02,
        }
    }
}

/// The pairs of a robot and a moment of a transition at which a dead stop of that robot may lead to a contact. Also the
/// number of all pairs that were sampled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StopSafety {
    /// Number of sampled pairs of a robot that drives in this transition and a moment.
    pub moments: usize,
    /// Pairs of a robot and a moment at which its dead stop may lead to a contact, sorted by moment, then by robot.
    pub unsafe_moments: Vec<UnsafeMoment>,
    /// Time between two sampled moments: 50 ms, or more for drives of more than 500 s.
    pub pace: Span,
}

/// A robot that must not stop dead at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnsafeMoment {
    /// Index of the robot.
    pub robot: usize,
    /// The moment, counted from the transition's start.
    pub at: Span,
    /// Place of the robot at that moment, stage metres.
    pub place: Vec2,
    /// Index of the other robot that would touch `robot`. If `missing_m` is 0, the other robot can stop, but a third
    /// robot behind it cannot stop in turn.
    pub by: usize,
    /// Distance that `by` lacks to stop without touching `robot`, metres.
    pub missing_m: f64,
}

impl StopSafety {
    /// Share of the sampled `moments` at which robots may stop dead, 0 to 1; 1 if no robot drives.
    pub fn share(&self) -> f64 {
        1.0 - self.unsafe_moments.len() as f64 / self.moments.max(1) as f64
    }

    /// Returns the unsafe moment with the greatest `missing_m`; `None` if all moments are safe.
    pub fn worst(&self) -> Option<&UnsafeMoment> {
        self.unsafe_moments
            .iter()
            .reduce(|worst, one| if one.missing_m > worst.missing_m { one } else { worst })
    }

    /// Whether a robot may stop dead at a moment, counted from the transition's start. It may if the sampled moments
    /// before and after that moment are safe for this robot.
    pub fn is_safe(&self, robot: usize, at: Span) -> bool {
        let near = |one: &&UnsafeMoment| one.robot == robot && (one.at - at).0.abs() < self.pace.0;
        !self.unsafe_moments.iter().any(|one| near(&one))
    }
}

/// Measures a transition's stop-safety under the default [`StopAssumptions`].
///
/// `paths[robot]`: its timed path. All paths must last equally long, as for [`super::prove`].
pub fn stop_safety(paths: &[Path], limits: &Limits) -> StopSafety {
    measured(paths, limits, &StopAssumptions::default(), Cancel::NEVER)
}

/// [`stop_safety`] under other assumptions, cancelled once `is_wanted` returns `true`. `is_wanted` is called at least
/// once for every eight sampled moments.
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
    let duration = Path::longest(paths);
    let drives: Vec<bool> = paths.iter().map(|path| !path.as_ref().rests()).collect();
    let steps = (duration.0.max(0) / STEP.0) as usize + 1;
    let stride = steps.div_ceil(MOST_MOMENTS);
    let count = steps.div_ceil(stride);
    let law = Law::new(limits, *assumptions);
    let block = (BLOCK / stride).max(1);
    // After the last moment of the last block, all robots rest.
    let blocks = count.div_ceil(block);
    let behind = STEP * (blocks * block * stride) as i64;
    let mut rows = Rows::new(paths, law.ahead + (block - 1) * stride, behind);
    let mut sweep = Sweep { law, stride, cannot_brake: VecDeque::new(), found: Vec::new() };
    for number in (0..blocks).rev().take_while(|_| !cancel.is_wanted()) {
        rows.go_back(block * stride);
        let near = sweep.near(&rows, block, &drives);
        let moments = block.min(count - number * block);
        (0..moments).rev().for_each(|moment| sweep.look(&rows, moment * stride, &near));
    }
    // The sweep went from the last moment to the first, and at each moment from the last robot to the first.
    sweep.found.reverse();
    let pace = STEP * stride as i64;
    let moments = drives.iter().filter(|drives| **drives).count() * count;
    StopSafety { moments, unsafe_moments: sweep.found, pace }
}

/// A sweep over all sampled moments, from the last to the first, because a dead stop only affects later moments.
struct Sweep {
    law: Law,
    /// Number of steps of 50 ms from one sampled moment to the next.
    stride: usize,
    /// `[k][robot]`: whether another robot would touch the robot if the robot braked to rest k + 1 sampled moments
    /// after the current one.
    cannot_brake: VecDeque<Vec<bool>>,
    /// Unsafe moments that the sweep has found, the latest moment first.
    found: Vec<UnsafeMoment>,
}

/// A pair of robots: `robot` stops dead, and the path of `by` comes near its place.
struct Meeting {
    robot: usize,
    by: usize,
    braking: Braking,
    /// Whether a third robot would touch `by` if `by` began to brake at one of the moments at which it may.
    chained: bool,
}

impl Sweep {
    /// Finds the robots that must not stop dead at one moment, and adds them to `found`. A robot must not stop dead if
    /// another robot cannot stop before the two touch. Nor if another robot may brake for it at a moment at which a
    /// third robot would touch the braking robot.
    ///
    /// `row`: index of the moment in the window of `rows`.
    fn look(&mut self, rows: &Rows<'_>, row: usize, near: &Near) {
        let mut meetings = self.meetings(rows, row, near);
        let kept = self.law.ahead.div_ceil(self.stride);
        let oldest = if self.cannot_brake.len() < kept { None } else { self.cannot_brake.pop_back() };
        let mut cannot_brake = oldest.unwrap_or_default();
        cannot_brake.clear();
        cannot_brake.resize(near.corridors.len(), false);
        let alarm = steps(self.law.of.alarm_s);
        for group in meetings.chunk_by_mut(|a, b| a.robot == b.robot) {
            group.sort_by_key(|meeting| meeting.braking.last);
            // The first robot that brakes reports it, and the fleet rests soon after.
            let rests = group.first().map_or(0, |first| usize::from(first.braking.last) + alarm);
            let (robot, mut worst) = (group[0].robot, None::<&Meeting>);
            for one in group.iter().filter(|one| one.braking.is_contact() || one.chained) {
                let touches_by = |steps: usize| usize::from(one.braking.touched) <= steps;
                cannot_brake[robot] |= touches_by(alarm);
                let is_worse = worst.is_none_or(|worst| one.braking.missing_m > worst.braking.missing_m);
                if touches_by(rests) && is_worse {
                    worst = Some(one);
                }
            }
            self.found.extend(worst.map(|one| UnsafeMoment {
                robot,
                at: rows.first() + STEP * row as i64,
                place: rows.of(robot)[row],
                by: one.by,
                missing_m: f64::from(one.braking.missing_m),
            }));
        }
        self.cannot_brake.push_front(cannot_brake);
    }

    /// Finds the pairs of robots of which one may come near the other's place at a moment of a block.
    fn near(&self, rows: &Rows<'_>, block: usize, drives: &[bool]) -> Near {
        let robots = 0..drives.len();
        let boxes: Vec<Bounds> = robots.clone().map(|robot| rows.bounds(robot)).collect();
        let corridors: Vec<Corridor> = robots.clone().map(|robot| Corridor::around(rows.of(robot))).collect();
        let now = 0..(block - 1) * self.stride + 1;
        let places: Vec<Corridor> =
            robots.map(|robot| Corridor::around(&rows.of(robot)[now.clone()])).collect();
        let mut pairs = Vec::new();
        near_pairs(&boxes, self.law.wary_m, |i, j| {
            for (robot, by) in [(i, j), (j, i)] {
                let is_near = || corridors[by].is_near(&places[robot], self.law.wary_m);
                if drives[robot] && drives[by] && is_near() {
                    pairs.push((robot, by));
                }
            }
        });
        pairs.sort_by_key(|&(robot, _)| Reverse(robot));
        Near { corridors, pairs }
    }

    /// Returns a meeting for each pair of `near` of which `by` comes near the place of `robot` at the moment `row`.
    fn meetings(&self, rows: &Rows<'_>, row: usize, near: &Near) -> Vec<Meeting> {
        let mut meetings = Vec::new();
        for &(robot, by) in &near.pairs {
            let place = rows.of(robot)[row];
            if near.corridors[by].distance_m(place) >= self.law.wary_m {
                continue;
            }
            let track = &rows.of(by)[row..];
            let Some(braking) = self.law.judge(place, &|step| track[step]) else { continue };
            let moments = usize::from(braking.first).div_ceil(self.stride).max(1)
                ..=usize::from(braking.last).div_ceil(self.stride);
            let ahead = |moment: usize| self.cannot_brake.get(moment - 1);
            let chained = moments.filter_map(ahead).any(|cannot_brake| cannot_brake[by]);
            meetings.push(Meeting { robot, by, braking, chained });
        }
        meetings
    }
}

/// Pairs of robots that may come near each other in a block of moments.
struct Near {
    /// `[robot]`: corridor around its path, from the first moment of the block to the end of the window.
    corridors: Vec<Corridor>,
    /// `(robot, by)`: `by` may come near the place of `robot`. Sorted by `robot`, the greatest index first.
    pairs: Vec<(usize, usize)>,
}

/// How a robot brakes for another that has stopped dead in its way. Steps of 50 ms are counted from the dead stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Braking {
    /// First step in which the robot may begin to brake; 0 if it cannot stop in time.
    pub first: u8,
    /// Last step in which the robot may begin to brake; 0 if it cannot stop in time.
    pub last: u8,
    /// The step in which the robot would come nearer than [`Law::wary_m`] if it did not brake. If it is nearer already
    /// at the dead stop, that smaller distance counts.
    pub touched: u8,
    /// Distance that the robot lacks to stop in time, metres; 0 if it can stop.
    pub missing_m: f32,
}

impl Braking {
    /// Whether the robot cannot stop in time.
    pub fn is_contact(&self) -> bool {
        self.last == 0
    }
}

/// What counts as a contact, and how robots brake: [`StopAssumptions`] as distances of centres and numbers of steps.
pub(crate) struct Law {
    /// Distance of two centres below which robots count as touching, metres.
    contact_m: f64,
    /// Distance of two centres below which one robot brakes for the other, metres.
    wary_m: f64,
    /// Distance of two centres beyond which neither robot sees the other, metres.
    sight_m: f64,
    /// Longest distance that a robot drives in a step of 50 ms, metres.
    step_m: f64,
    /// Number of steps after a dead stop until the fleet rests at the latest.
    ahead: usize,
    of: StopAssumptions,
}

impl Law {
    pub fn new(limits: &Limits, of: StopAssumptions) -> Self {
        let step_m = (limits.speed_mps * STEP.as_secs() * 1.01).max(1e-4);
        let [contact_m, wary_m] = [of.spare_m, of.wary_m.max(of.spare_m)].map(|m| limits.contact_m() + m);
        let sight_m = limits.contact_m() + of.sight_m;
        let ahead = steps(of.silence_s.max(of.alarm_s)).clamp(2, 100);
        Self { contact_m, wary_m, sight_m, step_m, ahead, of }
    }

    /// Returns how a robot brakes after another robot stopped dead at `place`. `at(step)` is the planned place of the
    /// braking robot `step` steps after the dead stop. `None` if its path comes nowhere nearer to `place` than `wary_m`
    /// or, if that is less, its distance at the dead stop.
    pub fn judge(&self, place: Vec2, at: &impl Fn(usize) -> Vec2) -> Option<Braking> {
        let apart_m = place.distance(at(0));
        let need_m = self.contact_m.min(apart_m) - 1e-6;
        let wary_m = self.wary_m.min(apart_m) - 1e-6;
        let touched = self.touched(place, at, wary_m)?;
        // Reaction and braking end within three steps.
        if touched < 3 {
            let missing_m = (need_m - self.stopped_m(place, at, self.of.reaction_s)) as f32;
            if missing_m > 0.0 {
                return Some(Braking { first: 0, last: 0, touched: touched as u8, missing_m });
            }
        }
        // It may begin to brake in any step up to the one in which it comes near, as long as it still stops in time.
        let in_time = |step: &usize| self.rolling_m(place, at, *step as f64 * STEP.as_secs()) >= wary_m;
        let last = (1..=touched).rev().find(in_time).unwrap_or(1);
        let in_sight = |step: &usize| (at(*step) - place).length_squared() < self.sight_m * self.sight_m;
        let first = (1..last).find(in_sight).unwrap_or(last);
        Some(Braking { first: first as u8, last: last as u8, touched: touched as u8, missing_m: 0.0 })
    }

    /// Returns the step in which a robot comes nearer to `place` than `need_m`; `None` if it does not within `ahead`
    /// steps.
    fn touched(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, need_m: f64) -> Option<usize> {
        let mut step = 0;
        while step < self.ahead {
            let spare_m = point_to_segment(place, at(step), at(step + 1)) - need_m;
            if spare_m < 0.0 {
                return Some(step);
            }
            // A robot drives at most `step_m` in a step, so it cannot come too near in the skipped steps.
            step += (spare_m / self.step_m) as usize + 1;
        }
        None
    }

    /// Least distance of a robot from `place` if its wheels begin to brake `delay_s` after the dead stop, metres.
    fn stopped_m(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, delay_s: f64) -> f64 {
        let steps = 0..self.step_of(delay_s);
        let before = steps.map(|step| point_to_segment(place, at(step), at(step + 1)));
        before.fold(self.rolling_m(place, at, delay_s), f64::min)
    }

    /// Least distance of a robot from `place` if its wheels begin to brake `delay_s` after the dead stop, metres.
    /// Counted only from the beginning of the step in which they begin to brake.
    fn rolling_m(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, delay_s: f64) -> f64 {
        let (step, step_s) = (self.step_of(delay_s), STEP.as_secs());
        let (from, to) = (at(step), at(step + 1));
        let speed_mps = from.distance(to) / step_s;
        // While it brakes, a robot drives as far as in half that time at its speed before.
        let share = (delay_s + speed_mps / (2.0 * GRIP_MPS2)) / step_s - step as f64;
        point_to_segment(place, from, from.lerp(to, share))
    }

    /// Index of the step that contains the moment `delay_s` after the dead stop, at most the last step.
    fn step_of(&self, delay_s: f64) -> usize {
        ((delay_s / STEP.as_secs() + 1e-9) as usize).min(self.ahead - 1)
    }
}

/// Converts seconds to whole steps of 50 ms, rounded up.
fn steps(seconds: f64) -> usize {
    (seconds / STEP.as_secs() - 1e-9).ceil().max(0.0) as usize
}
