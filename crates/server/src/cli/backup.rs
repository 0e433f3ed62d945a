//! The arguments of `backup` and `restore`.

use std::path::PathBuf;

use clap::Args;

/// `backup`
#[derive(Debug, Args)]
pub struct BackupArguments {
    /// The file to write, a zip; keep it as safe as the data folder, because it holds keys and hashes of passwords
    pub file: PathBuf,
    /// Folder to save [default: lightbots in the user's data folder]
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Replace the file if it exists already
    #[arg(long)]
    pub replace: bool,
}

/// `restore`
#[derive(Debug, Args)]
pub struct RestoreArguments {
    /// A file that `backup` wrote
    pub file: PathBuf,
    /// Folder to make [default: lightbots in the user's data folder]
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Restore even if the folder holds files; the old folder is renamed and keeps them
    #[arg(long)]
    pub replace: bool,
}
