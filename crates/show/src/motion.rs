//! How robots drive to a frame, for example so that the picture before it moves as one.

use lightbots_base::Vec2;
use serde::{Deserialize, Serialize};

/// How robots drive from the picture before a frame to the frame, in place of the planner's shortest drive. Places are
/// stage metres, angles radians counter-clockwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PictureMotion {
    /// The formation travels, and each robot keeps its place in it.
    Travel {
        /// Offsets from the formation's first place, in order. The formation moves along a smooth curve from `(0, 0)`
        /// through all of them.
        along: Vec<Vec2>,
    },
    /// The formation turns about a point, and may grow or shrink meanwhile.
    Turn {
        /// Centre of the turn.
        center: Vec2,
        /// Angle of the whole turn, radians.
        turn: f64,
        /// Factor on distances from the centre at the end of the turn.
        size: f64,
    },
    /// The formation grows or shrinks about a point, and returns.
    Breathe {
        /// Centre of the change of size.
        center: Vec2,
        /// Factor on distances from the centre at the largest or smallest size.
        size: f64,
        /// How often the formation changes its size and returns.
        times: u32,
    },
    /// The robots form a line and follow the first of them along a curve. The first is the robot that is nearest to the
    /// begin of the curve. Each next robot is the one nearest to the robot before it.
    Follow {
        /// Places that the leader drives through, in order.
        along: Vec<Vec2>,
    },
    /// Each robot drives circles. How late it begins depends on its place, so that a wave runs through the formation.
    Wave {
        /// Radius of the circles, metres.
        radius_m: f64,
        /// Direction in which the wave runs, radians.
        direction: f64,
        /// Distance from one crest to the next, metres.
        length_m: f64,
        /// Number of circles of each robot.
        times: u32,
    },
    /// The planner's drive, but robots start one after another, in order of their places along a direction.
    Stagger {
        /// The direction in which starts run through the formation, radians.
        direction: f64,
        /// Time from the first start to the last, seconds.
        delay_s: f64,
    },
    /// A drive through further pictures, without a stop.
    Morph {
        /// The pictures in order. Each is a list of places.
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

    /// Whether each robot keeps its pixel: the frame has the pixels of the frame before, by their ids, at other places.
    pub fn is_of_formation(&self) -> bool {
        !matches!(self, Self::Stagger { .. } | Self::Morph { .. })
    }
}
