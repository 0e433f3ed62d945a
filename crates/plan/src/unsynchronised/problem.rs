//! The problem that an order of straight drives solves, and the stages of its solution.

use super::free_space::FreeSpace;
use super::straight::StraightDrive;
use crate::Path;
use lightbots_base::Vec2;

/// Drives that begin and end with all robots at rest.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveStage {
    /// Straight drives of robots without a common clock, in order. A drive that would meet an earlier one yields to it.
    Targets(Vec<StraightDrive>),
    /// Timed paths of the synchronised robots, `(robot, path)`.
    Routes(Vec<(usize, Path)>),
}

/// Starts and goals of robots of which some have no common clock.
#[derive(Clone, Copy, Debug)]
pub struct UnsynchronisedProblem<'a> {
    /// The floor.
    pub space: FreeSpace<'a>,
    /// `[robot]`: its start, stage metres.
    pub starts: &'a [Vec2],
    /// `[robot]`: its goal, stage metres. Spare robots have one too.
    pub goals: &'a [Vec2],
    /// `[robot]`: whether it has no common clock.
    pub unsynchronised: &'a [bool],
    /// Discs that do not move, stage metres.
    pub standing: &'a [Vec2],
}
