//! The bound on recovery from dropouts: a number of replans for each robot that dropped out, and a time. If it is
//! exceeded, the run ends with a reason.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId, Span};

use crate::event::Trouble;

/// Largest number of replans for each robot that dropped out. Two are enough if a dead robot was pushed beside its
/// path. If a robot still obstructs others after three, it is not where they see it.
const REPLANS: usize = 3;
/// Least bound on the time of recovery for each dropout, for shows that are shorter than this. A robot that falls
/// silent, a drive that is interrupted and a slow drive around the robot take 10 s.
const LEAST: Span = Span::from_millis(10_000);

/// Replans and time that dropouts have cost, compared with their bounds.
#[derive(Clone, Debug, Default)]
pub(crate) struct RecoveryBound {
    /// Number of dropouts.
    dropouts: usize,
    /// The robot that dropped out last, and why. `None` before the first dropout.
    last: Option<(RobotId, Trouble)>,
    /// Whether the next plan is made because of a dropout.
    replanning: bool,
    /// Number of new plans that were made because of dropouts.
    replans: usize,
    /// `[frame]`: planned duration of the drive to the frame, plus its air time (stay of robots in it), by the first
    /// plan.
    planned: BTreeMap<usize, Span>,
    /// When the present frame would have been reached without recovery. `None` if recovery does not delay it.
    due: Option<Instant>,
    /// Time by which recovery delayed earlier frames, in all.
    lost: Span,
    /// Since when the run waits for the operator. `None` if it does not.
    paused: Option<Instant>,
}

impl RecoveryBound {
    /// Notes the planned duration of the drive to a frame plus its air time. Only the first plan of a frame counts.
    pub fn planned(&mut self, frame: usize, takes: Span) {
        self.planned.entry(frame).or_insert(takes);
    }

    /// Counts a robot that dropped out.
    pub fn dropped_out(&mut self, robot: RobotId, why: Trouble) {
        self.dropouts += 1;
        self.last = Some((robot, why));
    }

    /// Notes that all is about to be planned again, because a robot dropped out now or because an earlier one stands in
    /// the way. `due`: when robots would have reached the frame. Does nothing before the first dropout.
    pub fn begins(&mut self, due: Instant) {
        if self.dropouts > 0 {
            self.replanning = true;
            self.due.get_or_insert(due);
        }
    }

    /// Counts a new plan, if it was made because of a dropout.
    pub fn replanned(&mut self) {
        self.replans += usize::from(std::mem::take(&mut self.replanning));
    }

    /// Adds the delay of the frame that robots have reached, if recovery delayed it, to the time lost by recovery.
    pub fn reached(&mut self, now: Instant) {
        if let Some(due) = self.due.take() {
            self.lost += (now - due).max(Span::ZERO);
        }
    }

    /// Notes at each call whether the run waits for the operator, by a pause or for GO. This time does not count as
    /// lost.
    pub fn pause(&mut self, now: Instant, paused: bool) {
        match self.paused {
            None if paused => self.paused = Some(now),
            Some(since) if !paused => {
                self.paused = None;
                self.put_off(now - since);
            }
            _ => {}
        }
    }

    /// Excludes the time `by` from what recovery has cost, for example because the broker was away.
    pub fn put_off(&mut self, by: Span) {
        if let Some(due) = &mut self.due {
            *due += by;
        }
    }

    /// The reason to end the run if recovery has cost too much, or will have by `until`; a text for people, without a
    /// full stop. `None` if it has not, before the first dropout, and while the run waits for the operator.
    pub fn exceeded(&self, until: Instant) -> Option<String> {
        let (robot, why) = self.last.filter(|_| self.paused.is_none())?;
        let advice = "take it off the floor, then play on from this frame";
        if self.replanning && self.replans >= REPLANS * self.dropouts {
            return Some(format!(
                "robot {robot} {why}, and {REPLANS} new plans did not lead past it: {advice}"
            ));
        }
        let planned = self.planned.values().fold(Span::ZERO, |sum, takes| sum + *takes).max(LEAST);
        let late = self.due.map_or(Span::ZERO, |due| (until - due).max(Span::ZERO));
        (self.lost + late > planned * self.dropouts as i64).then(|| {
            format!("robot {robot} {why}, and driving around it would take longer than the show: {advice}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn at(secs: u64) -> Instant {
        Instant(secs * 1_000_000)
    }

    fn died() -> RecoveryBound {
        let mut bound = RecoveryBound::default();
        bound.planned(0, Span::from_millis(40_000));
        bound.dropped_out(RobotId::new("r7").unwrap(), Trouble::Silent);
        bound.begins(at(20));
        bound
    }

    #[test]
    fn three_replans_are_made_for_each_robot_that_dropped_out() {
        let mut bound = died();
        for _ in 0..3 {
            assert_eq!(bound.exceeded(at(20)), None);
            bound.replanned();
            bound.begins(at(20));
        }
        let why = bound.exceeded(at(20)).unwrap();
        let said = "robot r7 does not report, and 3 new plans did not lead past it: take it off the floor, then play on from this frame";
        assert_eq!(why, said);
        bound.dropped_out(RobotId::new("r8").unwrap(), Trouble::Late);
        assert_eq!(bound.exceeded(at(20)), None);
    }

    #[test]
    fn plans_for_robots_that_come_back_do_not_count() {
        let mut bound = died();
        bound.replanned();
        (0..9).for_each(|_| bound.replanned());
        bound.begins(at(20));
        assert_eq!(bound.exceeded(at(20)), None);
    }

    #[test]
    fn one_robot_costs_no_more_time_than_the_show_takes() {
        let mut bound = died();
        assert_eq!(bound.exceeded(at(60)), None);
        assert!(bound.exceeded(at(61)).unwrap().contains("longer than the show"));
        // Time that is lost in one frame counts in the next.
        bound.reached(at(50));
        bound.begins(at(70));
        assert_eq!(bound.exceeded(at(80)), None);
        assert!(bound.exceeded(at(81)).is_some());
    }

    #[test]
    fn neither_pauses_nor_a_broker_that_is_away_count() {
        let mut bound = died();
        bound.pause(at(30), true);
        assert_eq!(bound.exceeded(at(500)), None);
        bound.pause(at(500), false);
        bound.put_off(Span::from_millis(5_000));
        assert_eq!(bound.exceeded(at(535)), None);
        assert!(bound.exceeded(at(536)).is_some());
    }
}
