//! Progress of TARGET-only robots (they understand the command TARGET but no routes) on their straight drives.
//!
//! A straight drive yields to another one if its robot has to wait for that one's robot to pass. In this file, `place`
//! is the index of a straight drive in the leg's list of drives.

use crate::leg::Leg;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_plan::unsynchronised::StraightDrive;

/// A robot closer than this to the point up to which it may go has done what it was told, metres. It stops up to 20 mm
/// before its target, and its last report may be 10 mm behind.
const RESTS_M: f64 = 0.06;

/// Progress of all straight drives of a leg.
#[derive(Clone, Debug, Default)]
pub(crate) struct TargetProgress {
    /// `[straight drive]`: how far its robot is.
    pub states: Vec<DriveState>,
    /// `[straight drive]`: indices of the straight drives that yield to it.
    pub followers: Vec<Vec<usize>>,
    /// `[participant]`: index of the straight drive that its robot is on or begins next. `None` after the last one, or
    /// if the robot has none.
    pub present: Vec<Option<usize>>,
    /// Whether the leg is from a journal, which does not say how far robots are on their straight drives.
    pub is_of_journal: bool,
}

/// Progress of one straight drive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DriveState {
    /// Share of the drive's length that the robot has surely passed, 0 to 1.
    pub passed: f64,
    /// Share of the drive's length up to which the robot may go, 0 to 1. It is 0 until the robot is sent off.
    pub granted: f64,
    /// When a target was last sent to the robot.
    pub sent_at: Instant,
    /// When the robot was last allowed to go farther, made progress, or was sent on after a hold.
    pub moved_at: Instant,
    /// How often the target was sent again because the robot stood beside its goal.
    pub corrections: u8,
    /// Whether the robot has completed the drive.
    pub done: bool,
    /// Whether the robot makes no progress or is silent at present, which an event has reported.
    pub is_stalled: bool,
}

impl TargetProgress {
    /// The progress of a leg (drive of all robots) whose straight drives have not begun.
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
        Self { states: vec![state; leg.drives.len()], followers, present, is_of_journal: false }
    }

    /// The progress of a leg from a journal.
    pub fn of_journal(leg: &Leg) -> Self {
        Self { is_of_journal: true, ..Self::new(leg) }
    }

    /// Index of the straight drive that a participant is on. `None` if it was not sent off yet, or has ended its last
    /// one.
    pub fn under_way(&self, participant: usize) -> Option<usize> {
        let place = self.present.get(participant).copied().flatten()?;
        let state = &self.states[place];
        (state.granted > 0.0 && !state.done).then_some(place)
    }

    /// Whether any robot that yields to the straight drive `place` may not yet drive to the end of its own.
    pub fn is_awaited(&self, place: usize) -> bool {
        self.followers[place].iter().any(|&follower| self.states[follower].granted < 1.0)
    }

    /// Whether a robot has made no progress on its straight drive for longer than `bound`, although it may go on.
    pub fn stands(&self, place: usize, drive: &StraightDrive, now: Instant, bound: Span) -> bool {
        let state = &self.states[place];
        let rests = state.granted < 1.0 && (state.granted - state.passed) * drive.length_m() < RESTS_M;
        !rests && now - state.moved_at > bound
    }

    /// Whether a participant makes no progress on its present straight drive or is silent, which an event has reported.
    pub fn is_stalled(&self, participant: usize) -> bool {
        let present = self.present.get(participant).copied().flatten();
        present.is_some_and(|place| self.states[place].is_stalled)
    }

    /// Share of the lengths of all straight drives that robots have passed, by their reports, 0 to 1. It is 1 if there
    /// are no drives.
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

    /// Places where a robot that fell silent on its straight drive may stand, stage metres, at most `step_m` apart.
    /// Empty if it is on none. If the leg is from a journal, the robot may be anywhere on all its straight drives.
    pub fn whereabouts(&self, leg: &Leg, participant: usize, step_m: f64) -> Vec<Vec2> {
        if self.is_of_journal {
            let drives = leg.drives.iter().filter(|drive| drive.robot == participant);
            return drives.flat_map(|drive| places(drive, (0.0, 1.0), step_m)).collect();
        }
        let Some(place) = self.under_way(participant) else { return Vec::new() };
        let state = &self.states[place];
        places(&leg.drives[place], (state.passed, state.granted), step_m).collect()
    }
}

/// Places on a straight drive from the share `first` of its length to the share `last`, stage metres, at most `step_m`
/// apart.
fn places(drive: &StraightDrive, (first, last): (f64, f64), step_m: f64) -> impl Iterator<Item = Vec2> {
    let steps = ((last - first) * drive.length_m() / step_m).ceil().max(1.0);
    (0..=steps as usize).map(move |step| drive.at(first + (last - first) * step as f64 / steps))
}
