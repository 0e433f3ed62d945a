//! Programs that tests need and cargo does not bring: found, installed where that is allowed, or missed loudly.

use crate::shell::{self, Outcome};
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// A program of the system.
pub struct Tool {
    /// What it is called on the path; the first that is there is taken.
    pub programs: &'static [&'static str],
    /// Debian's package that brings it.
    pub package: &'static str,
}

/// The browser of the end-to-end tests.
pub const CHROMIUM: Tool =
    Tool { programs: &["chromium", "chromium-browser", "google-chrome"], package: "chromium" };
/// The broker that others use.
pub const MOSQUITTO: Tool = Tool { programs: &["mosquitto"], package: "mosquitto" };
/// The broker that makes a cluster.
pub const RABBITMQ: Tool = Tool { programs: &["rabbitmq-server"], package: "rabbitmq-server" };

impl Tool {
    /// Where it is, after installing it if need be.
    pub fn provide(&self) -> Outcome<PathBuf> {
        if let Some(found) = self.find() {
            return Ok(found);
        }
        eprintln!("xtask: {} is not installed, trying apt-get", self.package);
        self.install();
        self.find().ok_or_else(|| {
            format!(
                "{0} is missing and could not be installed: install it by hand, on Debian with `apt-get install {0}`",
                self.package
            )
        })
    }

    fn find(&self) -> Option<PathBuf> {
        let path = std::env::var_os("PATH").unwrap_or_default();
        let folders: Vec<_> =
            std::env::split_paths(&path).chain(["/usr/sbin".into(), "/usr/bin".into()]).collect();
        self.programs.iter().find_map(|program| {
            folders.iter().map(|folder| folder.join(program)).find(|candidate| candidate.is_file())
        })
    }

    fn install(&self) {
        for attempt in
            [["update", "-qq"].as_slice(), &["install", "-y", "-qq", "--no-install-recommends", self.package]]
        {
            let mut command = as_root("apt-get");
            command.args(attempt).env("DEBIAN_FRONTEND", "noninteractive").stdout(Stdio::null());
            if let Err(message) = shell::run(&mut command) {
                eprintln!("xtask: {message}");
            }
        }
        // Debian starts a broker of its own on the usual port: ours must be free to take it.
        if [MOSQUITTO.package, RABBITMQ.package].contains(&self.package) {
            let _ = as_root("service")
                .args([self.package, "stop"])
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status();
        }
    }
}

fn as_root(program: &str) -> Command {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.starts_with(b"0\n"));
    if is_root {
        return Command::new(program);
    }
    let mut command = Command::new("sudo");
    command.args(["-n", program]);
    command
}
