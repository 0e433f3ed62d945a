//! How robots drive to a frame, for example so that the previous picture moves as one formation.

use lightbots_base::Vec2;
use serde::{Deserialize, Serialize};

/// How robots drive from the previous frame's picture to a frame, if not on the planner's shortest drive. Places are in
/// stage metres. Angles are in radians, counter-clockwise; directions count from the x axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PictureMotion {
    /// The formation travels without turning, and each robot keeps its place in the formation.
    Travel {
        /// Displacements from the formation's first place, metres, in order. The formation moves along a smooth curve
        /// from `(0, 0)` through all of them; a single displacement gives a straight line.
        along: Vec<Vec2>,
    },
    /// The formation turns about a point, and may grow or shrink meanwhile.
    Turn {
        /// Centre of the turn.
        center: Vec2,
        /// Angle of the whole turn, radians; positive: counter-clockwise.
        turn: f64,
        /// Factor by which the distances from the centre have changed at the end of the turn.
        size: f64,
    },
    /// The formation grows or shrinks about a point, and returns.
    Breathe {
        /// Centre of the change of size.
        center: Vec2,
        /// Factor on the distances from the centre when the formation is largest or smallest.
        size: f64,
        /// How often the formation changes its size and returns.
        times: u32,
    },
    /// The robots form a line and follow a leader along a curve. The leader is the robot nearest to the start of the
    /// curve. Each further place in the line goes to the remaining robot that is nearest to the robot before it.
    Follow {
        /// Places through which the leader drives, in order.
        along: Vec<Vec2>,
    },
    /// Each robot drives circles. The farther a robot stands in a direction, the later it begins, so that a wave runs
    /// through the formation.
    Wave {
        /// Radius of the circles, metres.
        radius_m: f64,
        /// Direction in which the wave runs, radians.
        direction: f64,
        /// Wanted distance from one crest to the next, metres. It is longer if the last robots would begin too late in
        /// the drive.
        length_m: f64,
        /// Number of circles of each robot.
        times: u32,
    },
    /// The planner's drive, but robots start one after another, in the order of their places along a direction.
    Stagger {
        /// The direction in which the starts of robots run through the formation, radians.
        direction: f64,
        /// Time from the start of the first robot to the start of the last one, seconds.
        delay_s: f64,
    },
    /// A drive through further pictures, without a stop.
    Morph {
        /// The pictures in order. Each picture is a list of places.
        through: Vec<Vec<Vec2>>,
    },
}

impl PictureMotion {
    /// Names in files and on screens, in the order of the variants.
    pub const NAMES: [&'static str; 7] = ["travel", "turn", "breathe", "follow", "wave", "stagger", "morph"];

    /// The name in files and on screens.
    pub fn name(&self) -> &'static str {
        let index = match self {
            Self::Travel { .. } => 0,
            Self::Turn { .. } => 1,
            Self::Breathe { .. } => 2,
            Self::Follow { .. } => 3,
            Self::Wave { .. } => 4,
            Self::Stagger { .. } => 5,
            Self::Morph { .. } => 6,
        };
        Self::NAMES[index]
    }

    /// Whether each robot keeps its pixel id: true for all motions but `Stagger` and `Morph`. The frame then has the
    /// pixel ids of the previous frame, at other places.
    pub fn is_of_formation(&self) -> bool {
        !matches!(self, Self::Stagger { .. } | Self::Morph { .. })
    }
}
