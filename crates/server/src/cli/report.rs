//! The arguments of `report`.

use std::path::PathBuf;

use clap::Args;

/// `report`
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// A file that was recorded with --record, or the number of a run in the data folder of `run`
    #[arg(value_name = "RUN")]
    pub run: PathBuf,
    /// Where the page goes, one HTML file
    #[arg(long, value_name = "FILE.html")]
    pub out: Option<PathBuf>,
    /// Data folder of `run` [default: lightbots in the user's data folder]
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}
