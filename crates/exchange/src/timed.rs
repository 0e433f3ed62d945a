//! Shows as other programs keep them: for each robot a timed path and its light over time, without frames.
//!
//! [`export`] makes a timed show from a planned one, [`import`] makes frames and trajectories from a timed show. The
//! formats `skyc`, `csv`, `vviz` and `fseq` convert between timed shows and bytes.

pub(crate) mod export;
pub(crate) mod fit;
pub(crate) mod import;
pub(crate) mod light;
mod matching;
pub(crate) mod music;
pub(crate) mod path;
pub(crate) mod sequence;
mod stands;

use light::TimedLight;
use music::TimedMusic;
use path::TimedPath;

/// A timed show, as a file has it.
#[derive(Clone, Debug, Default)]
pub(crate) struct TimedShow {
    /// Name for people; may be empty.
    pub name: String,
    /// The robots in the order of the file.
    pub robots: Vec<TimedRobot>,
    /// The music of the show; `None` if the file holds none.
    pub music: Option<TimedMusic>,
}

/// A robot of a timed show.
#[derive(Clone, Debug, Default)]
pub(crate) struct TimedRobot {
    /// Name of the robot in the file; may be empty.
    pub name: String,
    /// Path of the robot on the floor.
    pub path: TimedPath,
    /// Light of the robot over time.
    pub light: TimedLight,
}
