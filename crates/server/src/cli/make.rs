//! The arguments of `make`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lightbots_base::Rgb;
use lightbots_draw::Style;
use lightbots_draw::picture::PictureWay;
use lightbots_exchange::formats_in_words;

use crate::numbers::{color, floor, metres, seconds};

/// `make`
#[derive(Debug, Args)]
pub struct MakeArguments {
    /// What frames are made from, one after the other: text:WORDS, shape:NAME, or files: .svg, .png, .jpg, .webp, .gif,
    /// .csv (x, y, colour). In WORDS, \\n begins a new line
    #[arg(required = true, value_name = "SOURCE")]
    pub sources: Vec<String>,
    /// How many robots show each frame
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub robots: u32,
    #[arg(long, value_name = "SHOW", help = format!("The file to write: a {}", formats_in_words()))]
    pub out: PathBuf,
    /// The font of words: lato, league-spartan, quicksand, hershey-sans, ems-readability, or a font's file [default: lato]
    #[arg(long, value_name = "FONT")]
    pub font: Option<String>,
    /// Floor in metres [default: 3x3]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = floor)]
    pub floor: Option<(f64, f64)>,
    /// Least distance between two robots' centres, metres [default: 0.08, down to 0.062 where there is no room]
    #[arg(long, value_name = "M", value_parser = metres)]
    pub spacing: Option<f64>,
    /// Longer side of each picture, metres [default: chosen by floor and robots]
    #[arg(long, value_name = "M", value_parser = metres)]
    pub size: Option<f64>,
    /// How long each frame stays, seconds
    #[arg(long, value_name = "S", default_value_t = 3.0, value_parser = seconds)]
    pub air: f64,
    /// How areas are shown [default: auto]
    #[arg(long, value_enum)]
    pub style: Option<StyleArgument>,
    /// How pictures are shown [default: auto]
    #[arg(long, value_enum)]
    pub way: Option<WayArgument>,
    /// Colour of words and shapes, such as #ffa500; if repeated, the letters of words take the colours in turn
    #[arg(long, value_name = "COLOUR", value_parser = color)]
    pub color: Vec<Rgb>,
    /// A frame for each word of a text
    #[arg(long, conflicts_with = "scroll")]
    pub per_word: bool,
    /// Frames of the text scrolling past
    #[arg(long)]
    pub scroll: bool,
    /// Break the text into lines so that the whole is about this many times as wide as high
    #[arg(long, value_name = "RATIO", value_parser = metres)]
    pub wrap: Option<f64>,
    /// Seed of everything random
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u32,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// How areas are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StyleArgument {
    /// By size and number of robots.
    Auto,
    /// Evenly filled.
    Filled,
    /// Along the edge.
    Outline,
    /// Along the edge and filled.
    Both,
    /// Along strokes.
    Lines,
}

impl From<StyleArgument> for Style {
    fn from(argument: StyleArgument) -> Self {
        match argument {
            StyleArgument::Auto => Self::Auto,
            StyleArgument::Filled => Self::Filled,
            StyleArgument::Outline => Self::Outline,
            StyleArgument::Both => Self::Both,
            StyleArgument::Lines => Self::Lines,
        }
    }
}

/// How pictures are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WayArgument {
    /// Silhouette if a plain background is found, else tones.
    Auto,
    /// The thing without its background.
    Silhouette,
    /// The edge of the thing.
    Outline,
    /// Robots stand densely where the picture is light.
    Tones,
}

impl From<WayArgument> for PictureWay {
    fn from(argument: WayArgument) -> Self {
        match argument {
            WayArgument::Auto => Self::Auto,
            WayArgument::Silhouette => Self::Silhouette,
            WayArgument::Outline => Self::Outline,
            WayArgument::Tones => Self::Tones,
        }
    }
}
