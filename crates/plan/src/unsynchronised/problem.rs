//! The problem that an order of straight drives solves, and the stages of its solution.

use super::free_space::FreeSpace;
use super::straight::StraightDrive;
use crate::Path;
use lightbots_base::Vec2;

/// A stage of the solution. All robots are at rest when it begins and when it ends.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveStage {
    /// Straight drives of robots without a common clock, in order. A drive that would meet an earlier drive yields to
    /// it.
    Targets(Vec<StraightDrive>),
    /// Timed paths of the synchronised robots: `(index of the robot, path)`.
    Routes(Vec<(usize, Path)>),
}

/// Starts and goals of robots, some of which have no common clock.
#[derive(Clone, Copy, Debug)]
pub struct UnsynchronisedProblem<'a> {
    /// The floor, its no-go areas, and the distances to keep.
    pub space: FreeSpace<'a>,
    /// `[robot]`: its start, stage metres.
    pub starts: &'a [Vec2],
    /// `[robot]`: its goal, stage metres. Spare robots need a goal too, for example their start.
    pub goals: &'a [Vec2],
    /// `[robot]`: whether the robot has no common clock.
    pub unsynchronised: &'a [bool],
    /// Discs that do not move, stage metres.
    pub standing: &'a [Vec2],
}
