//! What a preflight (a test of all robots before a show) finds about one robot.

use crate::event::Trouble;
use crate::leg::Leg;
use crate::preflight::{DrivenTrack, OFF_RAD, PreflightFinding, PreflightRobot};
use crate::robot::KnownRobot;
use lightbots_base::shape::point_to_segment;
use lightbots_base::{Vec2, difference};
use lightbots_wire::RobotState;
use std::f64::consts::FRAC_PI_2;

/// A path counts as straight if no place of it is farther than this from the line between its ends, metres. If a path
/// bends close to its end, a robot cannot turn as fast as the path (R35), so its heading is not checked.
const STRAIGHT_M: f64 = 0.000_5;
/// A heading is checked if the planned clearance to other robots is at least this, metres. With less, the robot may
/// give way by turning (R49).
const ROOM_M: f64 = 0.01;
/// Number of steps in which a path is sampled to find out whether it is straight.
const MOMENTS: i64 = 40;

/// What was found about one participant.
#[derive(Clone, Debug, Default)]
pub(super) struct RobotTest {
    pub findings: Vec<PreflightFinding>,
    pub off_m: Option<f64>,
    off_rad: Option<f64>,
    /// What the robot reported on the present drive.
    pub track: DrivenTrack,
    /// Where the robot stood before the present drive, stage metres.
    stood: Option<Vec2>,
    /// Sum of angles, radians counter-clockwise, one for each drive that was long enough: from the robot's reported
    /// headings to the direction in which it drove. Also the number of angles in the sum.
    askew: (f64, u32),
    /// Whether the place that the robot reached on a way back was checked.
    pub is_done: bool,
}

impl RobotTest {
    /// The test of a robot that stands at `stood`, stage metres.
    pub fn new(stood: Vec2) -> Self {
        Self { stood: Some(stood), ..Self::default() }
    }

    /// Adds a finding, unless there is one of its kind already. A `Failed` after `DidNotStop` is not added either.
    pub fn find(&mut self, finding: PreflightFinding) {
        let same = |known: &PreflightFinding| {
            std::mem::discriminant(known) == std::mem::discriminant(&finding)
                || matches!((known, &finding), (PreflightFinding::DidNotStop, PreflightFinding::Failed(_)))
        };
        if !self.findings.iter().any(same) {
            self.findings.push(finding);
        }
    }

    /// Compares a reported heading with the planned direction. After the way back, also compares the headings on the
    /// way with the directions in which the robot really drove.
    pub fn judge_heading(&mut self, leg: &Leg, participant: usize, (at, heading): (Vec2, f64)) {
        let has_room = leg.robots[participant].room_m >= ROOM_M;
        let planned = straight_direction(leg, participant).filter(|_| has_room);
        let off_planned = planned.map(|planned| off_line(heading, planned));
        let before = self.stood.replace(at);
        if let Some(askew_rad) = before.and_then(|before| self.track.askew_rad(at - before)) {
            self.askew = (self.askew.0 + askew_rad, self.askew.1 + 1);
        }
        self.track = DrivenTrack::default();
        let is_back = leg.frame % 2 == 1 && self.askew.1 > 0;
        let off_driven = is_back.then(|| (self.askew.0 / f64::from(self.askew.1)).abs());
        self.off_rad = [self.off_rad, off_planned, off_driven].into_iter().flatten().reduce(f64::max);
        if let Some(off_rad) = off_planned.filter(|off| *off > OFF_RAD) {
            self.find(PreflightFinding::OffHeading { off_rad });
        }
        if let Some(off_rad) = off_driven.filter(|off| *off > OFF_RAD) {
            self.find(PreflightFinding::DrivesAskew { off_rad });
        }
    }

    /// The result of the robot. `has_room`: the preflight had a drive for it.
    pub fn result(&self, robot: &KnownRobot, has_room: bool) -> PreflightRobot {
        let mut findings = self.findings.clone();
        if findings.is_empty() && !self.is_done {
            findings.push(if has_room { PreflightFinding::Unfinished } else { PreflightFinding::NoRoom });
        }
        let (off_m, off_rad) = (self.off_m, self.off_rad);
        PreflightRobot { id: robot.id, findings, off_m, off_rad, limited: robot.is_original() }
    }
}

/// The result of a robot that is not part of the run, with the reason. `None` if it is not admitted.
pub(super) fn untested(robot: &KnownRobot) -> Option<PreflightRobot> {
    let why = match robot.reported.state {
        _ if !robot.is_admitted => return None,
        _ if robot.namesakes.are_there() => Trouble::Shared,
        _ if !robot.is_heard() => Trouble::Silent,
        Some(RobotState::Faulty) => Trouble::Faulty,
        _ if robot.reported.at.is_none() => Trouble::Lost,
        // The robot came while others were tested.
        _ => return Some(row(robot, PreflightFinding::Unfinished)),
    };
    Some(row(robot, PreflightFinding::Failed(why)))
}

fn row(robot: &KnownRobot, finding: PreflightFinding) -> PreflightRobot {
    let limited = robot.is_original();
    PreflightRobot { id: robot.id, findings: vec![finding], off_m: None, off_rad: None, limited }
}

/// The direction of a participant's path on the stage, radians. `None` if it has no path, stays in place, or its path
/// bends.
fn straight_direction(leg: &Leg, participant: usize) -> Option<f64> {
    let path = leg.path(participant).filter(|path| !path.as_ref().rests())?.as_ref();
    let (start, end, duration) = (path.start, path.end(), path.duration());
    let mut between = (1..MOMENTS).map(|moment| path.at(duration * moment / MOMENTS).position);
    between.all(|at| point_to_segment(at, start, end) <= STRAIGHT_M).then(|| (end - start).angle())
}

/// The angle between a heading and a line with the given direction, radians, from 0 to a quarter turn. It is never
/// more, because robots also drive backwards.
fn off_line(heading: f64, direction: f64) -> f64 {
    let off = difference(heading, direction).abs();
    if off > FRAC_PI_2 { std::f64::consts::PI - off } else { off }
}
