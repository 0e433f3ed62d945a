//! The document in memory.

use lightbots_base::{Limits, Rgb, Vec2};

/// A show: frames in playing order, and the stage they play on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Show {
    /// Its name for people; may be empty.
    pub name: String,
    /// Where it plays, and with what robots.
    pub stage: Stage,
    /// Whether robots are interchangeable, for frames that do not say.
    pub identity: Identity,
    /// Where robots stand before the first frame; `None`: in rows along the front edge.
    pub starts: Option<Vec<Vec2>>,
    /// File name of the music; played by the screen.
    pub music: Option<String>,
    /// The pictures in playing order.
    pub frames: Vec<Frame>,
}

/// The floor and the robots on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Extent along x, metres.
    pub width_m: f64,
    /// Extent along y, metres.
    pub depth_m: f64,
    /// What robots must drive around.
    pub obstacles: Vec<Obstacle>,
    /// What a robot of this fleet is and can do.
    pub limits: Limits,
}

/// Something on the floor that robots must not touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A round one.
    Disc {
        /// Its centre, stage metres.
        at: Vec2,
        /// Its radius, metres.
        radius_m: f64,
    },
    /// One with sides along the axes.
    Rect {
        /// Corner with the smaller x and y, stage metres.
        min: Vec2,
        /// Corner with the larger x and y, stage metres.
        max: Vec2,
    },
}

/// Whether pixels are bound to robots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Identity {
    /// Any robot may show any pixel.
    #[default]
    Any,
    /// Pixel id n is the same robot in every frame.
    Fixed,
}

/// A picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Its name for people; may be empty.
    pub name: String,
    /// How long it stays, seconds.
    pub air_time_s: f64,
    /// How long the drive to it takes, seconds; `None`: as fast as legal.
    pub transition_s: Option<f64>,
    /// How the drive to it speeds up and slows down.
    pub easing: Easing,
    /// Overrides the show's.
    pub identity: Option<Identity>,
    /// Its pixels, sorted by id, ids unique.
    pub pixels: Vec<Pixel>,
}

/// How speed changes over a transition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Easing {
    /// Speeds up, cruises and slows down as quickly as limits allow.
    #[default]
    Swift,
    /// Speeds up over the first half and slows down over the second.
    Gentle,
}

/// One light of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixel {
    /// Its number, unique in its frame.
    pub id: u32,
    /// Where, stage metres.
    pub at: Vec2,
    /// Its colour.
    pub color: Rgb,
    /// The only robot that may show it.
    pub robot: Option<String>,
}

impl Default for Stage {
    fn default() -> Self {
        Self { width_m: 3.0, depth_m: 3.0, obstacles: Vec::new(), limits: Limits::default() }
    }
}

/// The show on a floor of `width_m` by `depth_m` metres; obstacles and robots stay. For shows that carry no stage.
pub fn with_floor(mut show: Show, width_m: f64, depth_m: f64) -> Show {
    show.stage.width_m = width_m;
    show.stage.depth_m = depth_m;
    show
}
