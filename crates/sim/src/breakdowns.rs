//! Breakdowns: which robot breaks down, how and when.

use lightbots_base::Span;

use crate::conditions::{Breakdown, Conditions};
use crate::dice::{Dice, Purpose};
use crate::timetable::Timetable;

/// How a robot breaks down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// Its power fails.
    Killed,
    /// Messages from the robot are lost from now on. The robot still receives messages.
    Muted,
    /// Its wheels stop turning.
    Stuck,
    /// Its link breaks.
    Cut,
    /// Its link is restored.
    Linked,
    /// It gets no position fixes.
    Blinded,
    /// It gets position fixes again.
    Seeing,
}

/// All breakdowns of a rehearsal.
#[derive(Clone, Debug)]
pub(crate) struct Breakdowns {
    /// Index of each affected robot and what happens to it, by the time since the first departure.
    coming: Timetable<(usize, Fate)>,
    /// Indices of the robots that [`Self::count`] counts, each once.
    broke_down: Vec<usize>,
    /// `[robot]`: whether the robot is muted. This does not end.
    mute: Vec<bool>,
    /// `[robot]`: whether the robot's link is broken at present.
    cut: Vec<bool>,
}

impl Breakdowns {
    /// Makes the breakdowns in `conditions`. A breakdown without a robot gets a random robot. A breakdown without a
    /// time gets a random time between a tenth and eight tenths of `planned_s` after the first departure. `planned_s`:
    /// planned duration of the show, seconds. Breakdowns whose robot index is `robots` or more are dropped.
    pub fn new(conditions: &Conditions, robots: usize, planned_s: f64, seed: u64) -> Self {
        let mut dice = Dice::new(seed, Purpose::Breakdowns);
        let mut fate_of = |breakdown: &Breakdown, fate| {
            let (chance_robot, chance_at) = (dice.below(robots as u64) as usize, dice.between(0.1, 0.8));
            let at = breakdown.at.unwrap_or_else(|| Span::from_secs(chance_at * planned_s));
            (at, (breakdown.robot.unwrap_or(chance_robot), fate))
        };
        let mut coming: Vec<_> = conditions.killed.iter().map(|b| fate_of(b, Fate::Killed)).collect();
        coming.extend(conditions.muted.iter().map(|b| fate_of(b, Fate::Muted)));
        coming.extend(conditions.stuck.iter().map(|b| fate_of(b, Fate::Stuck)));
        let outages =
            [(&conditions.cut, Fate::Cut, Fate::Linked), (&conditions.blind, Fate::Blinded, Fate::Seeing)];
        for (outages, begins, ends) in outages {
            for (breakdown, over) in outages {
                let (at, (robot, fate)) = fate_of(breakdown, begins);
                coming.extend([(at, (robot, fate)), (at + *over, (robot, ends))]);
            }
        }
        coming.retain(|&(_, (robot, _))| robot < robots);
        coming.sort_by_key(|&(_, (robot, _))| core::cmp::Reverse(robot));
        Self {
            coming: Timetable::new(coming),
            broke_down: Vec::new(),
            mute: vec![false; robots],
            cut: vec![false; robots],
        }
    }

    /// Removes and returns the next breakdown or recovery: the robot's index, and what happens. `None` if none is due
    /// at `since_begin`, the time since the first departure.
    pub fn next_until(&mut self, since_begin: Span) -> Option<(usize, Fate)> {
        let (robot, fate) = self.coming.next_until(since_begin)?;
        match fate {
            Fate::Muted => self.mute[robot] = true,
            Fate::Cut | Fate::Linked => self.cut[robot] = fate == Fate::Cut,
            _ => {}
        }
        if !self.broke_down.contains(&robot) {
            self.broke_down.push(robot);
        }
        Some((robot, fate))
    }

    /// Whether all messages from the robot are lost at present, because it is muted or its link is broken.
    #[inline]
    pub fn is_mute(&self, robot: usize) -> bool {
        self.mute[robot] || self.cut[robot]
    }

    /// Whether all messages to the robot are lost at present, because its link is broken.
    #[inline]
    pub fn is_deaf(&self, robot: usize) -> bool {
        self.cut[robot]
    }

    /// Number of robots that have broken down until now, including robots that have recovered.
    pub fn count(&self) -> usize {
        self.broke_down.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faults::Faults;

    #[test]
    fn what_passes_ends_after_its_time() {
        let conditions = Faults::parse("cut=1@2s+3s,blind=0@4s").unwrap().added_to(Conditions::ideal());
        let mut breakdowns = Breakdowns::new(&conditions, 2, 100.0, 1);
        let mut until = |millis| {
            let fate = breakdowns.next_until(Span::from_millis(millis));
            (fate, breakdowns.is_mute(1), breakdowns.is_deaf(1))
        };
        assert_eq!(until(2_000), (Some((1, Fate::Cut)), true, true));
        assert_eq!(until(4_999), (Some((0, Fate::Blinded)), true, true));
        assert_eq!(until(5_000), (Some((1, Fate::Linked)), false, false));
        assert_eq!(until(9_000), (Some((0, Fate::Seeing)), false, false));
    }

    #[test]
    fn breakdowns_come_in_order_and_once() {
        let conditions =
            Faults::parse("kill=2@3s,mute=1@1s,kill=random,kill=99@0").unwrap().added_to(Conditions::ideal());
        let mut breakdowns = Breakdowns::new(&conditions, 5, 100.0, 1);
        assert_eq!(breakdowns.next_until(Span::from_millis(900)), None);
        assert_eq!(breakdowns.next_until(Span::from_millis(5_000)), Some((1, Fate::Muted)));
        assert_eq!(breakdowns.next_until(Span::from_millis(5_000)), Some((2, Fate::Killed)));
        assert_eq!(breakdowns.next_until(Span::from_millis(5_000)), None);
        let (robot, fate) = breakdowns.next_until(Span::from_millis(80_000)).unwrap();
        assert!(robot < 5 && fate == Fate::Killed);
        assert!(breakdowns.is_mute(1) && !breakdowns.is_mute(2));
        assert_eq!(breakdowns.next_until(Span(i64::MAX)), None);
    }
}
