//! The input of the proof.

use crate::Path;
use lightbots_base::{Limits, Vec2};
use lightbots_show::Obstacle;

/// Tolerance for rounding when distances are compared, metres.
pub(super) const SLACK_M: f64 = 1e-6;

/// Paths to be checked, and the conditions that they must meet.
#[derive(Clone, Copy, Debug)]
pub struct ProofInput<'a> {
    /// `[robot]`: its path. All paths must last equally long.
    pub paths: &'a [Path],
    /// Centres of discs of a robot's size that do not move, stage metres.
    pub standing: &'a [Vec2],
    /// No-go areas that robots must not touch.
    pub obstacles: &'a [Obstacle],
    /// Half the floor's width and depth, metres. The floor's centre is the origin of stage space.
    pub half_floor: Vec2,
    /// Limits of the robots.
    pub limits: &'a Limits,
    /// Least distance that two centres must keep, metres. A pair that begins or ends closer must only keep the smaller
    /// of its distances at the beginning and the end.
    pub gap_m: f64,
    /// Least distance between a robot's rim and a no-go area, metres. A robot that begins or ends closer to the area
    /// must only keep the smaller of its distances at the beginning and the end.
    pub obstacle_gap_m: f64,
}
