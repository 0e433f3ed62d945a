//! What recovery may cost: replans for each robot that dropped out, and time. Then the run ends and says why.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId, Span};

use crate::event::Trouble;

/// Replans for each robot that dropped out. Two are enough where a dead robot was pushed beside its path. A robot that
/// still obstructs others after three is not where others see it.
const REPLANS: usize = 3;
/// Recovery may take this long even in a show that is shorter. A robot that falls silent, a drive that is broken off and
/// a slow one around it take 10 s.
const LEAST: Span = Span::from_millis(10_000);

/// Replans and time that dropouts have cost until now.
#[derive(Clone, Debug, Default)]
pub(crate) struct RecoveryBound {
    /// Robots that dropped out, and the last one of them.
    dropouts: usize,
    last: Option<(RobotId, Trouble)>,
    /// The next plan is made because of one of them.
    replanning: bool,
    replans: usize,
    /// By frame: how long the drive to it and its air time were planned to take first.
    planned: BTreeMap<usize, Span>,
    /// When the present frame would have been reached without recovery.
    due: Option<Instant>,
    /// Time that recovery has cost in the frames before.
    lost: Span,
    paused: Option<Instant>,
}

impl RecoveryBound {
    /// A frame was planned; later plans of the same frame change nothing.
    pub fn planned(&mut self, frame: usize, takes: Span) {
        self.planned.entry(frame).or_insert(takes);
    }

    /// A robot dropped out.
    pub fn dropped_out(&mut self, robot: RobotId, why: Trouble) {
        self.dropouts += 1;
        self.last = Some((robot, why));
    }

    /// Robots are about to be planned anew because one dropped out, or because one that did stands in their way. `due`:
    /// when the frame would have been reached.
    pub fn begins(&mut self, due: Instant) {
        if self.dropouts > 0 {
            self.replanning = true;
            self.due.get_or_insert(due);
        }
    }

    /// There is a new plan from where robots stopped.
    pub fn replanned(&mut self) {
        self.replans += usize::from(std::mem::take(&mut self.replanning));
    }

    /// The frame stands.
    pub fn reached(&mut self, now: Instant) {
        if let Some(due) = self.due.take() {
            self.lost += (now - due).max(Span::ZERO);
        }
    }

    /// The operator pauses the run, or lets it go on: that time does not count.
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

    /// Time that passed does not count: the broker was away.
    pub fn put_off(&mut self, by: Span) {
        if let Some(due) = &mut self.due {
            *due += by;
        }
    }

    /// Why the run ends, if recovery has cost too much, or will have by `until`; for people, without a full stop.
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
        // What is lost in one frame is lost in the next.
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
