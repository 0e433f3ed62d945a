//! The arguments that say how commands read a show.

use clap::{Args, ValueEnum};
use lightbots_exchange::formats_in_words;
use lightbots_show::Identity;

use crate::numbers::floor;

/// How a show is read.
#[derive(Clone, Copy, Debug, Args)]
pub struct ShowArguments {
    /// Floor in metres for shows that do not carry a stage [default: 3x3]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = floor)]
    pub floor: Option<(f64, f64)>,
    /// Whether pixel id n is the same robot in every frame [default: as the show says, else any]
    #[arg(long, value_enum)]
    pub identity: Option<IdentityArgument>,
}

/// Whether robots are interchangeable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum IdentityArgument {
    /// Any robot may show any pixel.
    Any,
    /// Pixel id n is the same robot in every frame.
    Fixed,
}

impl From<IdentityArgument> for Identity {
    fn from(argument: IdentityArgument) -> Self {
        match argument {
            IdentityArgument::Any => Self::Any,
            IdentityArgument::Fixed => Self::Fixed,
        }
    }
}

/// Returns the help text for a show file, with the endings of all formats.
pub(super) fn show_help() -> String {
    format!("The {}", formats_in_words())
}
