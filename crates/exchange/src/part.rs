//! The parts of a show that only some formats keep.

use lightbots_base::Limits;
use lightbots_plan::ShowPlan;
use lightbots_show::{Easing, Identity, Pixel, Show, Stage};

/// A part of a file that only some formats keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The name of the show.
    Title,
    /// Width and depth of the floor.
    FloorSize,
    /// Areas that robots drive around.
    NoGoAreas,
    /// Size, speed and acceleration of a robot.
    RobotLimits,
    /// Whether pixel ids are bound to robots.
    Identity,
    /// Where robots stand before the first frame.
    Starts,
    /// File name of the music.
    Music,
    /// How long each transition takes.
    Durations,
    /// How each transition speeds up and slows down.
    Easing,
    /// Which robot shows a pixel.
    ChosenRobots,
    /// The timed path of each robot.
    Plan,
}

impl Part {
    /// Every part.
    pub const ALL: [Self; 11] = [
        Self::Title,
        Self::FloorSize,
        Self::NoGoAreas,
        Self::RobotLimits,
        Self::Identity,
        Self::Starts,
        Self::Music,
        Self::Durations,
        Self::Easing,
        Self::ChosenRobots,
        Self::Plan,
    ];

    /// The word that programs use for the part, such as `no_go_areas`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Title => "title",
            Self::FloorSize => "floor_size",
            Self::NoGoAreas => "no_go_areas",
            Self::RobotLimits => "robot_limits",
            Self::Identity => "identity",
            Self::Starts => "starts",
            Self::Music => "music",
            Self::Durations => "durations",
            Self::Easing => "easing",
            Self::ChosenRobots => "chosen_robots",
            Self::Plan => "plan",
        }
    }

    /// The part in messages.
    pub fn words(self) -> &'static str {
        match self {
            Self::Title => "the name of the show",
            Self::FloorSize => "the size of the floor: it becomes 3 m x 3 m",
            Self::NoGoAreas => "the no-go areas",
            Self::RobotLimits => "size and speed of the robots",
            Self::Identity => "that pixel ids are bound to robots",
            Self::Starts => "where robots start",
            Self::Music => "the music",
            Self::Durations => "how long transitions take",
            Self::Easing => "how transitions speed up and slow down",
            Self::ChosenRobots => "which robot shows a pixel",
            Self::Plan => "the plan",
        }
    }
}

/// Whether a part differs from what a reader takes where a file does not have it.
pub(crate) fn uses(part: Part, show: &Show, plan: Option<&ShowPlan>) -> bool {
    let (stage, usual) = (&show.stage, Stage::default());
    let mut pixels = show.frames.iter().flat_map(|frame| &frame.pixels);
    match part {
        Part::Title => !show.name.is_empty(),
        Part::FloorSize => (stage.width_m, stage.depth_m) != (usual.width_m, usual.depth_m),
        Part::NoGoAreas => !stage.obstacles.is_empty(),
        Part::RobotLimits => stage.limits != Limits::default(),
        Part::Identity => is_fixed(show),
        Part::Starts => show.starts.is_some(),
        Part::Music => show.music.is_some(),
        Part::Durations => show.frames.iter().any(|frame| frame.transition_s.is_some()),
        Part::Easing => show.frames.iter().any(|frame| frame.easing != Easing::default()),
        Part::ChosenRobots => pixels.any(|pixel: &Pixel| pixel.robot.is_some()),
        Part::Plan => plan.is_some(),
    }
}

fn is_fixed(show: &Show) -> bool {
    let mut frames = show.frames.iter();
    frames.any(|frame| frame.identity.unwrap_or(show.identity) == Identity::Fixed)
}
