//! Shows as other programs keep them: for each robot a timed path and its light over time, without frames.
//!
//! [`export`] makes this of a planned show, [`import`] makes frames and trajectories of it. The formats `skyc`,
//! `csv`, `vviz` and `fseq` are between this and bytes.

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

/// A show of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct TimedShow {
    /// Name for people; may be empty.
    pub name: String,
    /// The robots in the order of the file.
    pub robots: Vec<TimedRobot>,
    /// Its music; `None`: the file holds none.
    pub music: Option<TimedMusic>,
}

/// A robot of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct TimedRobot {
    /// Its name in the file; may be empty.
    pub name: String,
    /// Where it is, on the floor.
    pub path: TimedPath,
    /// What it shows.
    pub light: TimedLight,
}
