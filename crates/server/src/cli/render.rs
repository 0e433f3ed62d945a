//! The arguments of `render`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lightbots_film::FilmView;

use super::show::ShowArguments;
use crate::numbers::{fps, pixels};

/// `render`
#[derive(Debug, Args)]
pub struct RenderArguments {
    /// The show
    #[arg(value_name = "SHOW")]
    pub show: PathBuf,
    /// The file to write: .gif, .mp4 or .webm for a film, .png for a contact sheet, .pdf for a sheet for the crew. The
    /// program ffmpeg is needed for .mp4 and .webm. A contact sheet has all frames on one picture. The crew's sheet has
    /// starting places, cues and a checklist
    #[arg(value_name = "OUT")]
    pub out: PathBuf,
    /// Pixels of the film, or of each picture of a contact sheet [default: 640x360 for .gif, 1280x720 for .mp4 and .webm]
    #[arg(long, value_name = "WxH", value_parser = pixels)]
    pub size: Option<(u32, u32)>,
    /// Pictures a second [default: 20 for .gif, 30 for .mp4 and .webm]
    #[arg(long, value_name = "F", value_parser = fps)]
    pub fps: Option<f64>,
    /// Where the audience looks from
    #[arg(long, value_enum, default_value_t = ViewArgument::Above)]
    pub view: ViewArgument,
    /// How the show is read
    #[command(flatten)]
    pub reading: ShowArguments,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Where the audience looks from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewArgument {
    /// From above.
    Above,
    /// From seats before the front edge.
    Front,
}

impl From<ViewArgument> for FilmView {
    fn from(argument: ViewArgument) -> Self {
        match argument {
            ViewArgument::Above => Self::Above,
            ViewArgument::Front => Self::Front,
        }
    }
}
