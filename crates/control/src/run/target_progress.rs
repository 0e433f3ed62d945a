//! How far robots that know TARGET only are on their straight drives.

use crate::leg::Leg;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_plan::unsynchronised::StraightDrive;

/// A robot that stands this near to how far it may go has done what it was told, metres. Such a robot stops up to 20 mm
/// before its target, and its report may be 10 mm old.
const RESTS_M: f64 = 0.06;

/// How far all straight drives of a leg are.
#[derive(Clone, Debug, Default)]
pub(crate) struct TargetProgress {
    /// `[straight drive]`.
    pub states: Vec<DriveState>,
    /// `[straight drive]`: those that yield to it.
    pub followers: Vec<Vec<usize>>,
    /// `[participant]`: the straight drive that it is on, or drives next.
    pub present: Vec<Option<usize>>,
}

/// How far one straight drive is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DriveState {
    /// Share of the drive that surely lies behind the robot, 0 to 1.
    pub passed: f64,
    /// Share of the drive that the robot was told to go, 0 to 1; 0: it has not begun.
    pub granted: f64,
    /// When the robot was told last.
    pub sent_at: Instant,
    /// When the robot was told to go farther or made progress last.
    pub moved_at: Instant,
    /// How often the robot was told again because it stood beside its goal.
    pub corrections: u8,
    /// The drive is over.
    pub done: bool,
    /// An event said that the robot makes no progress.
    pub is_stalled: bool,
}

impl TargetProgress {
    /// No straight drive of the leg has begun.
    pub fn new(leg: &Leg) -> Self {
        let state = DriveState {
            passed: 0.0,
            granted: 0.0,
            sent_at: Instant::ZERO,
            moved_at: Instant::ZERO,
            corrections: 0,
            done: false,
            is_stalled: false,
        };
        let mut followers = vec![Vec::new(); leg.drives.len()];
        let mut present = vec![None; leg.robots.len()];
        for (place, drive) in leg.drives.iter().enumerate().rev() {
            present[drive.robot] = Some(place);
            drive.yields.iter().for_each(|yields| followers[yields.to].push(place));
        }
        Self { states: vec![state; leg.drives.len()], followers, present }
    }

    /// The straight drive that a participant is on, if it was told to go.
    pub fn under_way(&self, participant: usize) -> Option<usize> {
        let place = self.present.get(participant).copied().flatten()?;
        let state = &self.states[place];
        (state.granted > 0.0 && !state.done).then_some(place)
    }

    /// Whether a robot that yields to this straight drive may not drive to its end yet.
    pub fn is_awaited(&self, place: usize) -> bool {
        self.followers[place].iter().any(|&follower| self.states[follower].granted < 1.0)
    }

    /// Whether the robot has stood still for longer than `bound` although it was told to go on.
    pub fn stands(&self, place: usize, drive: &StraightDrive, now: Instant, bound: Span) -> bool {
        let state = &self.states[place];
        let rests = state.granted < 1.0 && (state.granted - state.passed) * drive.length_m() < RESTS_M;
        !rests && now - state.moved_at > bound
    }

    /// Whether other robots wait for a participant: it makes no progress as told, or is silent.
    pub fn is_stalled(&self, participant: usize) -> bool {
        let present = self.present.get(participant).copied().flatten();
        present.is_some_and(|place| self.states[place].is_stalled)
    }

    /// Share of the lengths of all straight drives that lies behind their robots, by what these reported; 0 to 1.
    pub fn share(&self, leg: &Leg) -> f64 {
        let whole_m: f64 = leg.drives.iter().map(StraightDrive::length_m).sum();
        let passed_m: f64 = leg
            .drives
            .iter()
            .zip(&self.states)
            .map(|(drive, state)| drive.length_m() * if state.done { 1.0 } else { state.passed })
            .sum();
        if whole_m > 0.0 { passed_m / whole_m } else { 1.0 }
    }

    /// Where a robot may stand that fell silent on its straight drive: stage metres, about every `step_m`.
    pub fn whereabouts(&self, leg: &Leg, participant: usize, step_m: f64) -> Vec<Vec2> {
        let Some(place) = self.under_way(participant) else { return Vec::new() };
        let (drive, state) = (&leg.drives[place], &self.states[place]);
        let steps = ((state.granted - state.passed) * drive.length_m() / step_m).ceil().max(1.0);
        let share = |step: usize| state.passed + (state.granted - state.passed) * step as f64 / steps;
        (0..=steps as usize).map(|step| drive.at(share(step))).collect()
    }
}
