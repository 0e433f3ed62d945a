//! The input of the proof.

use crate::Path;
use lightbots_base::{Limits, Vec2};
use lightbots_show::Obstacle;

/// Tolerance for rounding when distances are compared, metres.
pub(super) const SLACK_M: f64 = 1e-6;

/// Paths to be checked, and the conditions that they must meet.
#[derive(Clone, Copy, Debug)]
pub struct ProofInput<'a> {
    /// The path of each robot.
    pub paths: &'a [Path],
    /// Discs of a robot's size that do not move, stage metres.
    pub standing: &'a [Vec2],
    /// No-go areas.
    pub obstacles: &'a [Obstacle],
    /// Half the floor's width and depth, metres.
    pub half_floor: Vec2,
    /// Limits of the robots.
    pub limits: &'a Limits,
    /// Least distance of two centres, metres. A pair that begins or ends closer must only keep the smaller of those
    /// two distances.
    pub gap_m: f64,
    /// Least distance between a robot's rim and an obstacle, metres. A robot that begins or ends closer must only keep
    /// that distance.
    pub obstacle_gap_m: f64,
}
