//! Stop-safety: the moments at which a robot may stop dead without any contact.
//!
//! A robot that stops dead stays where it is. A robot that would touch it before the fleet rests brakes at the grip
//! limit after the reaction time. All other robots drive on until one HOLD, which is sent as soon as the first robot
//! brakes, has eased the fleet to rest. A robot that brakes becomes an obstacle too. It may brake at any moment from
//! the first at which it may see the dead robot to the last at which it must. Robots behind it must be able to stop in
//! turn at each of these moments. Moments are sampled.

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

/// Number of steps for which near pairs are searched once.
const BLOCK: usize = 8;
/// Most sampled moments; longer drives are sampled more coarsely.
const MOST_MOMENTS: usize = 10_000;

/// Assumptions about a fleet of which one robot stops dead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopAssumptions {
    /// Time from the stop until the wheels of a near robot begin to brake, seconds.
    pub reaction_s: f64,
    /// Path time from the stop until the fleet rests on a HOLD if no robot sees the dead one, seconds.
    pub silence_s: f64,
    /// Path time from the moment at which a robot brakes for something that is not in its plan until the fleet rests,
    /// seconds.
    pub alarm_s: f64,
    /// Gap between rims below which two robots count as in contact, metres.
    pub spare_m: f64,
    /// Gap between rims below which a robot may brake for another that is near its path, metres.
    pub wary_m: f64,
    /// Gap between rims beyond which a robot does not brake for another, metres.
    pub sight_m: f64,
}

impl Default for StopAssumptions {
    /// The reaction time is that of `base`. A silent robot is requested to report after 0.56 s and counts as lost after
    /// 0.8 s, which is checked every 0.1 s. Then a HOLD is sent. It takes effect 0.15 s later, and its ease of 0.3 s
    /// costs half of that. A robot that brakes reports it at once: the report takes 0.02 s, then a HOLD follows as
    /// above. Robots are up to 3 mm off their paths. Places between two moments are interpolated linearly, with an
    /// error of at most 0.3 mm at 1 m/s².
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

/// The moments of a transition at which robots may stop dead.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StopSafety {
    /// Number of pairs of a robot that drives in this transition and a sampled moment.
    pub moments: usize,
    /// Moments at which a dead stop may lead to a contact, sorted by moment, then by robot.
    pub unsafe_moments: Vec<UnsafeMoment>,
    /// Time between two sampled moments: 50 ms, or more for drives of more than 500 s.
    pub pace: Span,
}

/// A robot that must not stop dead at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnsafeMoment {
    /// Index of the robot.
    pub robot: usize,
    /// The moment, after the transition's start.
    pub at: Span,
    /// Place of the robot at that moment, stage metres.
    pub place: Vec2,
    /// Index of the robot that would touch it. If `missing_m` is 0, that robot can stop, but another behind that robot
    /// cannot stop in turn.
    pub by: usize,
    /// Distance that `by` lacks to stop in time, metres.
    pub missing_m: f64,
}

impl StopSafety {
    /// Share of moments at which robots may stop dead, 0 to 1; 1 where no robot drives.
    pub fn share(&self) -> f64 {
        1.0 - self.unsafe_moments.len() as f64 / self.moments.max(1) as f64
    }

    /// Returns the unsafe moment with the greatest `missing_m`; `None` if all moments are safe.
    pub fn worst(&self) -> Option<&UnsafeMoment> {
        self.unsafe_moments
            .iter()
            .reduce(|worst, one| if one.missing_m > worst.missing_m { one } else { worst })
    }

    /// Whether a robot may stop dead at a moment: the sampled moments before and after it are safe.
    pub fn is_safe(&self, robot: usize, at: Span) -> bool {
        let near = |one: &&UnsafeMoment| one.robot == robot && (one.at - at).0.abs() < self.pace.0;
        !self.unsafe_moments.iter().any(|one| near(&one))
    }
}

/// Measures a transition's stop-safety under the usual assumptions.
///
/// `paths[robot]`: all paths must last equally long, as for [`super::prove`].
pub fn stop_safety(paths: &[Path], limits: &Limits) -> StopSafety {
    measured(paths, limits, &StopAssumptions::default(), Cancel::NEVER)
}

/// [`stop_safety`] under other assumptions, cancelled as soon as `is_wanted` returns `true`. `is_wanted` is called once
/// for every eight moments.
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

/// A sweep over all moments, from the last to the first, because a dead stop only affects later moments.
struct Sweep {
    law: Law,
    /// Steps from one moment to the next.
    stride: usize,
    /// `[moments ahead][robot]`: whether another robot would touch the robot if it braked to rest at that moment.
    cannot_brake: VecDeque<Vec<bool>>,
    found: Vec<UnsafeMoment>,
}

/// The effect of `robot`, which has stopped dead, on `by`.
struct Meeting {
    robot: usize,
    by: usize,
    braking: Braking,
    /// Whether a third robot would touch `by` if `by` braked at one of the moments at which it may or must.
    chained: bool,
}

impl Sweep {
    /// Finds the robots that must not stop dead at one moment. These are robots that another would touch. They are also
    /// robots for which another may brake at a moment at which that one must not stop.
    ///
    /// `row`: index of the moment in the rows.
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

    /// Finds the robots that may come near the place of another at a moment of a block.
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

    /// Returns every pair of which `by` comes near the place of `robot`, in the order of the pairs.
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

/// Robots that may come near others in a block of moments.
struct Near {
    /// `[robot]`: corridor around its path from the first moment of the block on.
    corridors: Vec<Corridor>,
    /// `(robot, by)`: a robot, and another that may come near its place. Sorted by robot, the last one first.
    pairs: Vec<(usize, usize)>,
}

/// How a robot brakes for another that stands in its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Braking {
    /// First step ahead in which it may begin to brake; 0 if it cannot stop in time.
    pub first: u8,
    /// Last step ahead in which it may begin to brake; 0 if it cannot stop in time.
    pub last: u8,
    /// The step in which it would come near if it did not brake.
    pub touched: u8,
    /// Distance that it lacks to stop in time, metres.
    pub missing_m: f32,
}

impl Braking {
    /// Whether it cannot stop in time.
    pub fn is_contact(&self) -> bool {
        self.last == 0
    }
}

/// Rules: what counts as a contact, and how robots brake.
pub(crate) struct Law {
    contact_m: f64,
    /// Distance of two centres within which one may brake for the other, metres.
    wary_m: f64,
    /// Distance of two centres beyond which neither sees the other, metres.
    sight_m: f64,
    /// The farthest a robot drives in a step, metres.
    step_m: f64,
    /// Number of steps ahead that matter.
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

    /// Returns how a robot, which is `at(steps ahead)`, brakes after another stopped dead at `place`; `None` if it does
    /// not come near.
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

    /// Returns the step in which a robot comes nearer to a place than `need_m`; `None` if it does not.
    fn touched(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, need_m: f64) -> Option<usize> {
        let mut step = 0;
        while step < self.ahead {
            let spare_m = point_to_segment(place, at(step), at(step + 1)) - need_m;
            if spare_m < 0.0 {
                return Some(step);
            }
            // It drives no farther than this in a step.
            step += (spare_m / self.step_m) as usize + 1;
        }
        None
    }

    /// Least distance of a robot from a place if its wheels begin to brake after `delay_s`, metres.
    fn stopped_m(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, delay_s: f64) -> f64 {
        let steps = 0..self.step_of(delay_s);
        let before = steps.map(|step| point_to_segment(place, at(step), at(step + 1)));
        before.fold(self.rolling_m(place, at, delay_s), f64::min)
    }

    /// Least distance of a robot from a place after the begin of the step in which its wheels begin to brake, metres.
    fn rolling_m(&self, place: Vec2, at: &impl Fn(usize) -> Vec2, delay_s: f64) -> f64 {
        let (step, step_s) = (self.step_of(delay_s), STEP.as_secs());
        let (from, to) = (at(step), at(step + 1));
        let speed_mps = from.distance(to) / step_s;
        // While it brakes, a robot drives as far as in half that time at its speed before.
        let share = (delay_s + speed_mps / (2.0 * GRIP_MPS2)) / step_s - step as f64;
        point_to_segment(place, from, from.lerp(to, share))
    }

    fn step_of(&self, delay_s: f64) -> usize {
        ((delay_s / STEP.as_secs() + 1e-9) as usize).min(self.ahead - 1)
    }
}

/// A time in whole steps, rounded up.
fn steps(seconds: f64) -> usize {
    (seconds / STEP.as_secs() - 1e-9).ceil().max(0.0) as usize
}
