//! PictureMotion as material: drives in which the picture before a frame moves as one.

use lightbots_base::Vec2;
use serde::{Deserialize, Serialize};

/// How robots drive from the picture before a frame to the frame, in place of the planner's shortest drive. Places are
/// stage metres, angles radians counter-clockwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PictureMotion {
    /// The formation travels, and each robot keeps its place in it.
    Travel {
        /// Offsets from where the formation stands, in order: a smooth curve from `(0, 0)` through all of them.
        along: Vec<Vec2>,
    },
    /// The formation turns about a point, and may grow or shrink meanwhile.
    Turn {
        /// The point.
        center: Vec2,
        /// The whole turn, radians.
        turn: f64,
        /// Factor on distances from the point at the end.
        size: f64,
    },
    /// The formation grows or shrinks about a point, and returns.
    Breathe {
        /// The point.
        center: Vec2,
        /// Factor on distances from the point at the widest or narrowest.
        size: f64,
        /// How often.
        times: u32,
    },
    /// The robots form a line and follow the first of them along a curve. The first is the robot that is nearest to the
    /// begin of the curve, the next is the nearest to it, and so on.
    Follow {
        /// Places that the leader drives through, in order.
        along: Vec<Vec2>,
    },
    /// Each robot drives circles, later by where it stands, so that a wave runs through the formation.
    Wave {
        /// Radius of the circles, metres.
        radius_m: f64,
        /// Where the wave runs to.
        direction: f64,
        /// Distance from one crest to the next, metres.
        length_m: f64,
        /// Number of circles of each robot.
        times: u32,
    },
    /// The planner's drive, begun later by each robot by where it stands.
    Stagger {
        /// The direction in which starts run through the formation.
        direction: f64,
        /// Time from the first start to the last, seconds.
        delay_s: f64,
    },
    /// A drive through pictures in between, without a stop.
    Morph {
        /// The pictures: places of each.
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

    /// Whether pixels of the frame are those of the frame before, by their ids, at other places.
    pub fn is_of_formation(&self) -> bool {
        !matches!(self, Self::Stagger { .. } | Self::Morph { .. })
    }
}
