//! The arguments of `replay`.

use std::path::PathBuf;

use clap::Args;

/// `replay`
#[derive(Debug, Args)]
pub struct ReplayArguments {
    /// A file that was recorded with --record, or the number of a run in the data folder of `run`
    #[arg(value_name = "RUN")]
    pub run: PathBuf,
    /// Data folder of `run` [default: lightbots in the user's data folder]
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Also write each input, output and event into this file, as a JSON object on each line
    #[arg(long, value_name = "FILE")]
    pub lines: Option<PathBuf>,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}
