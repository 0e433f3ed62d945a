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
    /// Size and dynamic limits of the robots.
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
    /// What frames were made from.
    Sources,
    /// Which pixels are edited as one.
    Groups,
    /// Light over time.
    Layers,
    /// Moments at which frames should begin.
    AbsoluteTimes,
    /// Sections, markers and beats.
    Marks,
    /// Places where the show waits for GO.
    Cues,
    /// How robots drive to a frame, such as a picture that moves as one.
    Motions,
    /// Timed paths that the show prescribes.
    Trajectories,
    /// The number of spare robots.
    Spares,
    /// Names and hashes of the files that belong to the show.
    Assets,
    /// The files that belong to the show.
    AssetFiles,
    /// The timed path of each robot.
    Plan,
}

impl Part {
    /// All parts that our JSON document of a show has: every part except the plan and the contents of files.
    pub(crate) const DOCUMENT: [Self; 20] = [
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
        Self::Sources,
        Self::Groups,
        Self::Layers,
        Self::AbsoluteTimes,
        Self::Marks,
        Self::Cues,
        Self::Motions,
        Self::Trajectories,
        Self::Spares,
        Self::Assets,
    ];

    /// All parts of a show, without the plan.
    pub const SHOW: [Self; 21] = {
        let mut parts = [Self::AssetFiles; 21];
        let (documents, _) = parts.split_at_mut(Self::DOCUMENT.len());
        documents.copy_from_slice(&Self::DOCUMENT);
        parts
    };

    /// The parts that a file can express if it has the show's name and a timed path for each robot.
    pub(crate) const TIMED: [Self; 7] = [
        Self::Title,
        Self::Identity,
        Self::Starts,
        Self::Durations,
        Self::Easing,
        Self::Trajectories,
        Self::Plan,
    ];

    /// The parts of [`Self::TIMED`], the music, and which robot shows a pixel: the file names its robots.
    pub(crate) const TIMED_WITH_NAMES: [Self; 9] = {
        let mut parts = [Self::ChosenRobots; 9];
        let (timed, others) = parts.split_at_mut(Self::TIMED.len());
        timed.copy_from_slice(&Self::TIMED);
        others[0] = Self::Music;
        parts
    };

    /// The parts that a file can express if it has a table of places for each robot, named after the robot.
    pub(crate) const TABLES: [Self; 6] =
        [Self::Identity, Self::Starts, Self::Durations, Self::Easing, Self::ChosenRobots, Self::Plan];

    /// Every part.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::SHOW.into_iter().chain([Self::Plan])
    }

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
            Self::Sources => "sources",
            Self::Groups => "groups",
            Self::Layers => "layers",
            Self::AbsoluteTimes => "absolute_times",
            Self::Marks => "marks",
            Self::Cues => "cues",
            Self::Motions => "motions",
            Self::Trajectories => "trajectories",
            Self::Spares => "spares",
            Self::Assets => "assets",
            Self::AssetFiles => "asset_files",
            Self::Plan => "plan",
        }
    }

    /// The part in words, for messages.
    pub fn words(self) -> &'static str {
        match self {
            Self::Title => "the name of the show",
            Self::FloorSize => "the size of the floor, which becomes another one",
            Self::NoGoAreas => "the no-go areas",
            Self::RobotLimits => "size and speed of the robots",
            Self::Identity => "that pixel ids are bound to robots",
            Self::Starts => "where robots start",
            Self::Music => "the music",
            Self::Durations => "how long transitions take",
            Self::Easing => "how transitions speed up and slow down",
            Self::ChosenRobots => "which robot shows a pixel",
            Self::Sources => "what frames were made from",
            Self::Groups => "which pixels are edited as one",
            Self::Layers => "the layers of light",
            Self::AbsoluteTimes => "the moments at which frames must begin",
            Self::Marks => "sections, markers and beats",
            Self::Cues => "the cues",
            Self::Motions => "how pictures move as one",
            Self::Trajectories => "the prescribed trajectories",
            Self::Spares => "the number of spare robots",
            Self::Assets => "the list of files that belong to the show",
            Self::AssetFiles => "the files that belong to the show, such as pictures and music",
            Self::Plan => "the plan",
        }
    }
}

/// Whether the show uses `part`: whether the part differs from what a reader assumes if a file lacks it. The plan is
/// used if there is one.
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
        Part::Sources => {
            show.frames.iter().any(|frame| !frame.sources.is_empty())
                || pixels.any(|pixel: &Pixel| pixel.part.is_some())
        }
        Part::Groups => pixels.any(|pixel: &Pixel| pixel.group.is_some()),
        Part::Layers => !show.layers.is_empty(),
        Part::AbsoluteTimes => show.frames.iter().any(|frame| frame.at_s.is_some()),
        Part::Marks => show.beats.is_some() || !show.sections.is_empty() || !show.markers.is_empty(),
        Part::Cues => !show.cues.is_empty(),
        Part::Motions => show.frames.iter().any(|frame| frame.motion.is_some()),
        Part::Trajectories => !show.trajectories.is_empty(),
        Part::Spares => show.spares > 0,
        Part::Assets => !show.assets.is_empty(),
        Part::AssetFiles => show.assets.values().any(|asset| asset.content.is_some()),
        Part::Plan => plan.is_some(),
    }
}

/// The parts that version 2 of our format added. It also added ids of frames, which are no part.
const VERSION_2: [Part; 10] = [
    Part::Sources,
    Part::Groups,
    Part::Layers,
    Part::AbsoluteTimes,
    Part::Marks,
    Part::Cues,
    Part::Motions,
    Part::Trajectories,
    Part::Spares,
    Part::Assets,
];

/// Whether a show needs version 2 of our format.
pub(crate) fn is_version_2(show: &Show) -> bool {
    VERSION_2.into_iter().any(|part| uses(part, show, None))
        || show.frames.iter().any(|frame| frame.id.is_some())
}

fn is_fixed(show: &Show) -> bool {
    let mut frames = show.frames.iter();
    frames.any(|frame| frame.identity.unwrap_or(show.identity) == Identity::Fixed)
}
