//! TARGET-only robots on their straight drives: what their reports mean, and which of these robots need help.
//! TARGET-only robots understand the command TARGET but no routes.
//!
//! In this file, `place` is the index of a straight drive in the leg's list of drives.

use crate::event::Trouble;
use crate::run::driving::arrivals::{MISSED_M, is_there};
use crate::run::driving::drive::Driving;
use crate::run::next::Next;
use crate::run::pipeline::DrivenLeg;
use crate::run::run_context::RunContext;
use crate::run::target_commands::{ASK, PASSED_ERROR_M, beyond, grant_farther, send_target};
use lightbots_base::{Span, Vec2};
use lightbots_wire::Command;

/// Least progress by which a robot counts as moving, metres. Less may be noise of its position fixes.
const MOVED_M: f64 = 0.005;
/// Shortest time between requests to a TARGET-only robot for its place, while other robots wait for it to pass.
const ASK_AWAITED: Span = Span::from_millis(90);
/// Time between these requests divided by the number of robots in the run, because the answers share one link. In
/// fleets of fewer than 90 robots the time is [`ASK_AWAITED`]. In fleets of more than 500 it is [`ASK`], as for robots
/// for which no other waits.
const ASK_PER_ROBOT: Span = Span::from_millis(1);
/// A robot that reports its arrival within the arrival tolerance, but farther from its goal than this, is sent its
/// target again; metres. It stopped at an earlier target, or farther before its target than usual. The planner leaves
/// room for a little more than this.
const OFF_M: f64 = 0.015;
/// How often at most a robot is sent its target again because it stands beside its goal.
const CORRECTIONS: u8 = 2;

/// How long a robot may stand although it may drive on, and what then happens.
struct Standstill {
    /// At its goal without a report of arrival: the target is sent again, because the target or the report may be lost.
    told_again_after: Span,
    /// Beside its goal after a report of arrival: the robot counts as arrived.
    accepted_after: Span,
    /// At its goal without a report of arrival: the robot counts as arrived.
    believed_after: Span,
    /// Anywhere on its straight drive: an event names the robot.
    named_after: Span,
    /// Anywhere on its straight drive: the robot drops out after this many times `Config::late.wait`, the bound for
    /// late robots.
    dropped_after_bounds: i64,
}

/// Shorter times repeat targets to robots that are only slow; longer ones keep all robots waiting.
const STANDSTILL: Standstill = Standstill {
    told_again_after: Span::from_millis(250),
    accepted_after: Span::from_millis(1_000),
    believed_after: Span::from_millis(2_000),
    named_after: Span::from_millis(2_000),
    dropped_after_bounds: 2,
};

/// A TARGET-only robot drops out after a silence of this many times `Config::silence`. It reports only when asked, so
/// both a question and its answer must be delivered.
const SILENCE_BOUNDS: i64 = 4;

impl Driving {
    /// Handles a report of a TARGET-only robot with its place `at`, stage metres. `arrived`: the robot reports that it
    /// has reached its target. A robot that left its straight drive while no hold is on drops out.
    pub fn on_target_report(
        &mut self,
        cx: &mut RunContext,
        participant: usize,
        at: Vec2,
        arrived: bool,
    ) -> Next {
        let Some(DrivenLeg { leg, targets }) = &mut cx.pipeline.driven else { return Next::Stay };
        let Some(place) = targets.under_way(participant) else { return Next::Stay };
        let is_held = self.clock.is_held();
        let (drive, state) = (&leg.drives[place], &mut targets.states[place]);
        if !is_held && drive.distance_m(at) > MISSED_M {
            // The robot was lifted, and its way back may lead past others.
            return Next::drop(participant, Trouble::Missed);
        }
        let length_m = drive.length_m();
        let passed = (drive.share_at(at) - PASSED_ERROR_M / length_m).min(1.0);
        if (passed - state.passed) * length_m > MOVED_M {
            (state.passed, state.moved_at) = (passed, cx.now);
        }
        if state.granted >= 1.0 && (arrived || !is_held) {
            let (ended, next) = self.settle_target(cx, place, at, arrived);
            if ended {
                return next;
            }
        }
        self.let_follow(cx, place);
        Next::Stay
    }

    /// Handles the reported place `at` of a robot that may drive to the end of the straight drive `place`. Returns
    /// whether the straight drive is over, and the [`Next`] that its end leads to.
    fn settle_target(&mut self, cx: &mut RunContext, place: usize, at: Vec2, arrived: bool) -> (bool, Next) {
        let Some(DrivenLeg { leg, targets }) = &cx.pipeline.driven else { return (false, Next::Stay) };
        let (drive, state) = (leg.drives[place].clone(), targets.states[place]);
        let (off_m, stood) = (at.distance(drive.to), cx.now - state.moved_at);
        let there = is_there(at, drive.to, cx.io.config.arrival_tolerance_m);
        let index = cx.participant(drive.robot).robot;
        if there && arrived {
            let target = beyond(cx, &drive, cx.robot(drive.robot).original.short_m);
            cx.io.fleet.robot_mut(index).learn_short(drive.from, target, at);
        }
        if there && arrived && off_m > OFF_M && state.corrections < CORRECTIONS {
            self.correct(cx, place);
        } else if there && (arrived || stood > STANDSTILL.believed_after) {
            return (true, self.end_straight_drive(cx, place, None));
        } else if there && cx.now - state.sent_at.max(state.moved_at) > STANDSTILL.told_again_after {
            // The robot may never have received this target, and still be off by its tolerance.
            send_target(cx, place);
        } else if arrived && stood > STANDSTILL.accepted_after && off_m <= MISSED_M {
            return (true, self.end_straight_drive(cx, place, Some(off_m)));
        }
        (false, Next::Stay)
    }

    fn correct(&mut self, cx: &mut RunContext, place: usize) {
        if let Some(driven) = &mut cx.pipeline.driven {
            driven.targets.states[place].corrections += 1;
        }
        send_target(cx, place);
    }

    /// Lets robots that yield to the straight drive `place` go farther, if this is safe by now.
    fn let_follow(&self, cx: &mut RunContext, place: usize) {
        let follower = |cx: &RunContext, number: usize| {
            let driven = cx.pipeline.driven.as_ref()?;
            driven.targets.followers[place].get(number).copied()
        };
        let mut number = 0;
        while let Some(follower) = follower(cx, number) {
            grant_farther(cx, self.clock.is_held(), Some(follower));
            number += 1;
        }
    }

    /// Ends a straight drive. The robot begins its next one; after the last one it counts as arrived. `off_m`: how far
    /// from the end of the drive it stands, metres; `None` if it is near enough.
    fn end_straight_drive(&mut self, cx: &mut RunContext, place: usize, off_m: Option<f64>) -> Next {
        let Some(DrivenLeg { leg, targets }) = &mut cx.pipeline.driven else { return Next::Stay };
        let participant = leg.drives[place].robot;
        let next = (place + 1..leg.drives.len()).find(|&next| leg.drives[next].robot == participant);
        targets.states[place].done = true;
        targets.present[participant] = next;
        self.let_follow(cx, place);
        match (next, off_m) {
            (Some(_), _) => {
                grant_farther(cx, self.clock.is_held(), next);
                Next::Stay
            }
            (None, Some(off_m)) => self.accept_misaligned(cx, participant, off_m),
            (None, None) => self.arrive(cx, participant),
        }
    }

    /// Watches a TARGET-only robot that is on its way, or waits for others to pass. It drops out after a long silence
    /// or standstill. Otherwise it is asked for its place.
    pub fn watch_target_robot(&mut self, cx: &mut RunContext, participant: usize) -> Next {
        let silent = cx.now - cx.robot(participant).contact.heard.max(self.clock.began);
        if silent > cx.io.config.silence * SILENCE_BOUNDS {
            return Next::drop(participant, Trouble::Silent);
        }
        if self
            .standing_drive(cx, participant, cx.io.config.late.wait * STANDSTILL.dropped_after_bounds)
            .is_some()
        {
            return Next::drop(participant, Trouble::Missed);
        }
        self.name_stalled(cx, participant, silent);
        self.ask_target_robot(cx, participant);
        Next::Stay
    }

    /// The index of the straight drive on which a participant has made no progress for longer than `bound`. `None` if
    /// it makes progress, is not on a drive, has come as far as it may go, or all robots are held.
    fn standing_drive(&self, cx: &RunContext, participant: usize, bound: Span) -> Option<usize> {
        let DrivenLeg { leg, targets } = cx.pipeline.driven.as_ref()?;
        let place = targets.under_way(participant).filter(|_| !self.clock.is_held())?;
        targets.stands(place, &leg.drives[place], cx.now, bound).then_some(place)
    }

    /// Records an event that names a robot when it has made no progress for a while or falls silent; once each time.
    fn name_stalled(&self, cx: &mut RunContext, participant: usize, silent: Span) {
        let unheard = silent > cx.io.config.silence + cx.link.round_trip;
        let is_stalled = unheard || self.standing_drive(cx, participant, STANDSTILL.named_after).is_some();
        let Some(driven) = &mut cx.pipeline.driven else { return };
        let Some(present) = driven.targets.present[participant] else { return };
        let was_stalled = std::mem::replace(&mut driven.targets.states[present].is_stalled, is_stalled);
        if is_stalled && !was_stalled {
            cx.report_waiting(participant, if unheard { Trouble::Silent } else { Trouble::Late });
        }
    }

    /// Asks a robot where it is, and sends its target again if it makes no progress and no hold is on. Does nothing if
    /// it was asked a short time ago.
    fn ask_target_robot(&mut self, cx: &mut RunContext, participant: usize) {
        let Some(DrivenLeg { targets, .. }) = &cx.pipeline.driven else { return };
        let place = targets.under_way(participant);
        let awaited = place.is_some_and(|place| targets.is_awaited(place));
        let every = if awaited { ask_awaited_every(cx.roster.len()) } else { ASK };
        if cx.now - self.progress[participant].asked_at < every {
            return;
        }
        self.progress[participant].asked_at = cx.now;
        let is_due = |place: &usize| {
            let state = &targets.states[*place];
            !self.clock.is_held() && cx.now - state.sent_at.max(state.moved_at) >= ASK
        };
        // The target itself may have been lost. Sending it again changes nothing if it was not.
        if let Some(place) = place.filter(is_due) {
            send_target(cx, place);
        }
        cx.send(participant, &[Command::Uuid]);
    }
}

/// Time between requests to a robot for which other robots wait, in a run of `robots` robots.
fn ask_awaited_every(robots: usize) -> Span {
    (ASK_PER_ROBOT * robots as i64).clamp(ASK_AWAITED, ASK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn awaited_robots_are_asked_less_often_in_larger_fleets_within_bounds() {
        for (robots, ms) in [(1, 90), (90, 90), (200, 200), (500, 500), (2_000, 500)] {
            assert_eq!(ask_awaited_every(robots), Span::from_millis(ms), "{robots} robots");
        }
    }
}
