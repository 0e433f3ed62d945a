//! What an effect may depend on besides the moment.

use crate::colour::Linear;
use crate::floor_picture::FloorPicture;
use lightbots_base::Vec2;

/// A robot as effects see it at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LitRobot {
    /// Its number, counted from 0; it keeps the number over the whole show.
    pub index: u32,
    /// Number of robots.
    pub count: u32,
    /// Where it is, stage metres.
    pub place: Vec2,
    /// Its speed, metres per second.
    pub speed_mps: f64,
    /// The frame that it shows or drives to, counted from 0.
    pub frame: u32,
    /// Id of its pixel in that frame; `None`: it has none.
    pub pixel: Option<u32>,
    /// Its colour without any layer.
    pub colour: Linear,
    /// Its colour in the next frame.
    pub next_colour: Linear,
}

/// What effects need besides the robot.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightContext<'a> {
    /// Pictures and films, by the number in `LightEffect::Picture`.
    pub pictures: &'a [FloorPicture],
    /// How long show time has stood still until now, seconds. Layers that run freely are ahead by this time.
    pub lead_s: f64,
}
