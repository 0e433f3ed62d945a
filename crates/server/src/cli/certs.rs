//! The arguments of `certs`.

use std::path::PathBuf;

use clap::Args;

/// `certs`
#[derive(Debug, Args)]
pub struct CertsArguments {
    /// Folder for the files; an authority that is there already is used again. For the browser app, `run` takes the files in
    /// the folder `certs` of its --data
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Names and addresses of this machine other than localhost, such as stage.local or 192.168.0.7
    #[arg(long, value_name = "HOST", num_args = 1..)]
    pub name: Vec<String>,
    /// Clients to make certificates for, such as a robot's UUID
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub client: Vec<String>,
    /// How long the certificates are valid, days
    #[arg(long, value_name = "N", default_value_t = 825, value_parser = clap::value_parser!(u32).range(1..=3650))]
    pub days: u32,
}
