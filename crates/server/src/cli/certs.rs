//! The arguments of `certs`.

use std::path::PathBuf;

use clap::Args;

/// `certs`
#[derive(Debug, Args)]
pub struct CertsArguments {
    /// Folder for the files; an authority that is there already is used again. `run` takes those in the folder `certs` of
    /// its --data for the browser app
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Names and addresses of the machine beside localhost, such as stage.local or 192.168.0.7
    #[arg(long, value_name = "HOST", num_args = 1..)]
    pub name: Vec<String>,
    /// Clients to make certificates for, such as a robot's UUID
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub client: Vec<String>,
    /// How long they are good for, days
    #[arg(long, value_name = "N", default_value_t = 825, value_parser = clap::value_parser!(u32).range(1..=3650))]
    pub days: u32,
}
