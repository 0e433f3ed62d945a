//! Notes of each robot while a recording is replayed.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId};
use lightbots_wire::{Report, RobotState, Topic};

use crate::figures::CountedNumbers;
use crate::figures::{ThreeFigures, round};
use crate::model::RobotFigures;
use crate::track::{PlaceTrack, SAMPLES_MAX};

/// Largest number of robots in a report, which is also the largest number that the controller remembers.
const ROBOTS_MAX: usize = 20_000;

/// Notes of one robot.
#[derive(Clone, Debug, Default)]
pub(crate) struct RobotNotes {
    pub arrivals: usize,
    pub latest_s: f64,
    pub errors_m: Vec<f64>,
    off_m: f64,
    /// The count of brakes that the robot reported last; `None` before its first report with more than a place.
    counted: Option<u32>,
    brakes: u64,
    /// Smallest gap to another robot that the robot reported on a route or on arrival, metres. The second value is when it
    /// reported the gap, the third the index of the frame at that time.
    pub near: Option<(f64, Instant, usize)>,
    messages: u64,
    battery: Option<(u8, u8)>,
    pub planned: PlaceTrack,
    pub driven: PlaceTrack,
    /// Moments at which the robot's light was found changed, and the new colours (R·65536 + G·256 + B).
    pub lights: Vec<(Instant, u32)>,
    pub lost: Option<Instant>,
}

/// All robots, by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct AllRobots {
    pub by_name: BTreeMap<RobotId, RobotNotes>,
    /// Every distance from its route that a driving or held robot reported, metres.
    pub offs_m: CountedNumbers,
}

impl AllRobots {
    /// The notes of a robot, which are made if it has none yet. `None` if there are notes of [`ROBOTS_MAX`] other robots.
    pub fn get(&mut self, id: RobotId) -> Option<&mut RobotNotes> {
        if self.by_name.len() >= ROBOTS_MAX && !self.by_name.contains_key(&id) {
            return None;
        }
        Some(self.by_name.entry(id).or_default())
    }

    /// Leaves out places, more and more coarsely, until at most [`SAMPLES_MAX`] are kept for all robots together. Stops
    /// after ten rounds in any case.
    pub fn thin(&mut self) {
        let count = |robots: &Self| -> usize {
            robots.by_name.values().map(|robot| robot.planned.count() + robot.driven.count()).sum()
        };
        // Each round doubles the tolerance and keeps fewer places. At a few metres, one line per track is left.
        for _ in 0..10 {
            if count(self) <= SAMPLES_MAX {
                return;
            }
            for robot in self.by_name.values_mut() {
                robot.planned.thin();
                robot.driven.thin();
            }
        }
    }

    /// Notes what a robot's report says. `frame` is the frame that robots drive to or have reached, counted from 0.
    pub fn receive(&mut self, now: Instant, topic: Topic, report: &Report, frame: usize) {
        let Some(robot) = self.get(report.id) else { return };
        robot.messages += 1;
        if let Some(at) = report.at {
            robot.driven.add(now.as_secs(), at);
        }
        let Some(details) = &report.details else { return };
        if let Some(percent) = details.battery {
            robot.battery = Some((robot.battery.map_or(percent, |battery| battery.0), percent));
        }
        // A count lower than the one before has begun at 0 again: the robot was switched on.
        let before = robot.counted.replace(details.brakes).unwrap_or(details.brakes);
        let base = if details.brakes < before { 0 } else { before };
        robot.brakes += u64::from(details.brakes - base);
        let on_route = matches!(details.state, RobotState::Driving | RobotState::Held);
        if let Some(near_m) = details.near_m.filter(|_| on_route || topic == Topic::Arrival)
            && robot.near.is_none_or(|near| near_m < near.0)
        {
            robot.near = Some((near_m, now, frame));
        }
        if let Some(off_m) = details.off_m.filter(|_| on_route) {
            robot.off_m = robot.off_m.max(off_m);
            self.offs_m.add(off_m);
        }
    }

    /// Number of brakes of all robots.
    pub fn brakes(&self) -> u64 {
        self.by_name.values().map(|robot| robot.brakes).sum()
    }
}

impl RobotNotes {
    /// The robot's row in the table of the report.
    pub fn figures(&self, id: RobotId) -> RobotFigures {
        RobotFigures {
            name: id.as_str().to_owned(),
            arrivals: self.arrivals,
            latest_s: round(self.latest_s, 3),
            position_error_m: ThreeFigures::of(&self.errors_m, 5),
            off_m: round(self.off_m, 5),
            brakes: self.brakes,
            near_m: self.near.map(|near| round(near.0, 5)),
            messages: self.messages,
            battery_began: self.battery.map(|battery| battery.0),
            battery_ended: self.battery.map(|battery| battery.1),
            is_lost: self.lost.is_some(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn received(texts: &[&str]) -> RobotFigures {
        let mut robots = AllRobots::default();
        for (at, text) in (1..).zip(texts) {
            let report = Report::decode(text.as_bytes()).unwrap();
            robots.receive(Instant(at * 1_000_000), Topic::Status, &report, 2);
        }
        let (id, notes) = robots.by_name.first_key_value().unwrap();
        notes.figures(*id)
    }

    #[test]
    fn brakes_before_the_run_do_not_count_and_a_restart_loses_none() {
        let figures = received(&[
            "r7 0 0 state=idle brakes=5 bat=80",
            "r7 0 0 state=driving brakes=7",
            "r7 0 0 state=idle",
            "r7 0 0 state=idle brakes=1 bat=78",
        ]);
        assert_eq!((figures.brakes, figures.messages), (3, 4));
        assert_eq!((figures.battery_began, figures.battery_ended), (Some(80), Some(78)));
    }

    #[test]
    fn a_gap_of_an_earlier_run_does_not_count() {
        let figures =
            received(&["r7 0 0 state=idle near=0.001", "r7 0 0 state=driving off=0.004 near=0.0123"]);
        assert_eq!((figures.near_m, figures.off_m), (Some(0.0123), 0.004));
    }
}
