//! What an effect may depend on besides the moment.

use crate::colour::Linear;
use crate::floor_picture::FloorPicture;
use lightbots_base::Vec2;

/// A robot as effects see it at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LitRobot {
    /// Number of the robot, counted from 0. The robot keeps it over the whole show.
    pub index: u32,
    /// Number of all robots.
    pub count: u32,
    /// Where the robot is, stage metres.
    pub place: Vec2,
    /// Speed of the robot, metres per second.
    pub speed_mps: f64,
    /// Index of the frame that the robot shows or drives to, counted from 0.
    pub frame: u32,
    /// Id of the robot's pixel in that frame; `None`: the robot has no pixel.
    pub pixel: Option<u32>,
    /// The robot's colour without any layer.
    pub colour: Linear,
    /// The robot's colour in the next frame, without any layer.
    pub next_colour: Linear,
}

/// What effects need besides the robot.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightContext<'a> {
    /// Pictures and films that layers project. The numbers in `LightEffect::Picture` and `LightEffect::Sequence` are
    /// indices into this list.
    pub pictures: &'a [FloorPicture],
    /// How long show time has stood still until now, in total, seconds. The effects of layers that run freely are ahead by
    /// this time.
    pub lead_s: f64,
}
