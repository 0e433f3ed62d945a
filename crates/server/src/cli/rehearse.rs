//! The arguments of `rehearse`.

use std::path::PathBuf;

use clap::Args;
use lightbots_show::SPEED_MIN_PERCENT;

use super::show::{ShowArguments, show_help};
use crate::numbers::seed;

/// `rehearse`
#[derive(Debug, Args)]
pub struct RehearseArguments {
    #[arg(help = show_help())]
    pub show: PathBuf,
    #[command(flatten)]
    pub reading: ShowArguments,
    /// Seed of all random values: the same seed gives the same run
    #[arg(long, value_name = "S", allow_hyphen_values = true, default_value_t = 1, value_parser = seed)]
    pub seed: u64,
    /// Without sensor noise, wheel slip and delays
    #[arg(long)]
    pub ideal: bool,
    /// Faults to add, such as loss=5%,delay=100..300ms,slip=10%
    #[arg(long, value_name = "SPEC")]
    pub faults: Option<String>,
    /// Speed of drives, percent of the usual speed, as in `play`
    #[arg(long, value_name = "PERCENT", default_value_t = 100, value_parser = clap::value_parser!(u32).range(i64::from(SPEED_MIN_PERCENT)..=100))]
    pub speed: u32,
    /// Write a report for people
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Record the inputs of the controller, for `replay`
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Write the place of each robot about ten times a second: time_s, robot, x_m, y_m
    #[arg(long, value_name = "FILE.csv")]
    pub steps: Option<PathBuf>,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}
