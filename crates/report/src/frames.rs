//! Frames while a recording is replayed: when robots left, how long the drive was planned to take, when they arrived.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId, Span};

use crate::figures::{ThreeFigures, round};
use crate::model::FrameFigures;
use crate::robots::AllRobots;

/// Largest number of frames that a report lists. A show that loops for a day would have more.
const FRAMES_MAX: usize = 2_000;

/// Notes about the frame that robots drive to or have reached last, and about all frames that they reached.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrameNotes {
    /// The frame that robots drive to or have reached, counted from 0.
    pub current: usize,
    left: Option<Instant>,
    planned_s: f64,
    /// Whether robots have reached the frame. The next departure then begins the drive to another frame.
    stands: bool,
    /// Whether the drive to the frame was planned anew. The durations of further departures are then not added to the
    /// planned duration.
    is_planned_anew: bool,
    arrivals: BTreeMap<RobotId, Instant>,
    pub list: Vec<FrameFigures>,
    pub spreads_s: Vec<f64>,
}

impl FrameNotes {
    /// Notes that robots leave for the frame with the index `frame` at `starts`. `duration` is the planned duration of the
    /// drive. If robots are on the way to this frame already, it is a further part of the same drive.
    pub fn leave(&mut self, frame: usize, starts: Instant, duration: Span) {
        if self.stands || self.left.is_none() || self.current != frame {
            (self.left, self.planned_s) = (Some(starts), duration.as_secs());
            (self.stands, self.is_planned_anew) = (false, false);
            self.arrivals.clear();
        } else if !self.is_planned_anew {
            self.planned_s += duration.as_secs();
        }
        self.current = frame;
    }

    /// Notes that the drive is planned anew.
    pub fn plan_anew(&mut self) {
        self.is_planned_anew = true;
    }

    /// Notes an arrival that a robot reports. Arrivals after all robots have reached the frame are ignored.
    pub fn arrive(&mut self, id: RobotId, now: Instant) {
        if !self.stands {
            self.arrivals.insert(id, now);
        }
    }

    /// Notes that all robots have reached the frame at `now`. `began` is the first departure of the run, `errors_m` are the
    /// distances of robots from their pixels, metres. Returns the planned duration of the drive, seconds.
    pub fn stand(
        &mut self,
        (frame, name): (usize, String),
        now: Instant,
        began: Instant,
        errors_m: &[f64],
        robots: &mut AllRobots,
    ) -> f64 {
        let first = self.arrivals.values().min().copied();
        let mut arrivals_s = Vec::with_capacity(self.arrivals.len());
        for (&id, &at) in &self.arrivals {
            let after_s = first.map_or(0.0, |first| (at - first).as_secs());
            arrivals_s.push(round(after_s, 3));
            if let Some(robot) = robots.get(id) {
                robot.arrivals += 1;
                robot.latest_s = robot.latest_s.max(after_s);
            }
        }
        arrivals_s.sort_unstable_by(f64::total_cmp);
        let spread_s = arrivals_s.last().copied().unwrap_or(0.0);
        let last = self.arrivals.values().max().copied().unwrap_or(now);
        let left = self.left.unwrap_or(began);
        self.spreads_s.push(spread_s);
        if self.list.len() < FRAMES_MAX {
            self.list.push(FrameFigures {
                frame,
                name,
                left_s: round((left - began).as_secs(), 3),
                stood_s: round((now - began).as_secs(), 3),
                planned_s: round(self.planned_s, 3),
                driven_s: round((last - left).as_secs(), 3),
                arrival_spread_s: spread_s,
                position_error_m: ThreeFigures::of(errors_m, 5),
                arrivals_s,
            });
        }
        self.stands = true;
        self.planned_s
    }
}
