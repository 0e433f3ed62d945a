//! The preflight, a test of all robots: each drives 50 mm out and back, is stopped on its way out, and blinks.
//!
//! [`rounds`](rounds::rounds) chooses directions, and [`show`] makes frames of them. The planner plans and proves these
//! frames like any show. `run/preflight_check` compares reports with the plan, and [`PreflightReport`] is the result.

mod driven_track;
mod report;
mod rounds;

pub(crate) use driven_track::DrivenTrack;
pub(crate) use report::{OFF_M, OFF_RAD};
pub use report::{PreflightFinding, PreflightReport, PreflightRobot};
pub(crate) use rounds::{TestedRobot, rounds};

use lightbots_base::{Rgb, RobotId, Vec2};
use lightbots_show::{Frame, Pixel, Show, Stage};

/// Id of the first pixel of a preflight. It is far above the ids of shows, so that no binding by the operator concerns
/// these pixels.
const FIRST_ID: u32 = 4_100_000_000;
/// Colour of robots that stand during the present round.
const RESTS: Rgb = Rgb::new(0x18, 0x18, 0x18);
/// Colour of robots that drive in the present round.
const DRIVES: Rgb = Rgb::new(0x20, 0x60, 0xa0);
/// Duration of each drive, seconds. At full speed 50 mm would take 0.5 s. A robot that is not tested yet drives slowly,
/// which leaves time for a stop on its way.
const DRIVE_S: f64 = 2.5;
/// How long robots stand after a drive, seconds. In this time the reported places settle, and robots are asked for
/// their places several times.
const STANDS_S: f64 = 4.6;

/// Returns the show of a preflight. Each round has two frames: one with the goals of the robots, and one that leads
/// back to their places. `robots`: names and places of the robots, stage metres; `rounds`: their goals as [`rounds()`]
/// returns them.
pub(crate) fn show(
    name: String,
    stage: Stage,
    robots: &[(RobotId, Vec2)],
    rounds: &[Vec<Option<Vec2>>],
) -> Show {
    let frame = |name: String, goals: &[Option<Vec2>], is_out: bool| {
        let pixel = |(index, (&(robot, at), goal)): (u32, (&(RobotId, Vec2), &Option<Vec2>))| Pixel {
            id: FIRST_ID + index,
            at: goal.filter(|_| is_out).unwrap_or(at),
            color: if goal.is_some() { DRIVES } else { RESTS },
            robot: Some(robot.as_str().to_owned()),
            ..Pixel::default()
        };
        let pixels = (0..).zip(robots.iter().zip(goals)).map(pixel).collect();
        Frame { name, air_time_s: STANDS_S, transition_s: Some(DRIVE_S), pixels, ..Frame::default() }
    };
    let mut frames = Vec::new();
    for (round, goals) in rounds.iter().enumerate() {
        frames.push(frame(format!("Out {}", round + 1), goals, true));
        frames.push(frame(format!("Back {}", round + 1), goals, false));
    }
    Show { name, stage, frames, ..Show::default() }
}
