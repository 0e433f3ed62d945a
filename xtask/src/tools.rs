//! Programs that tests need and cargo does not install. A missing one is installed with apt-get or reported.

use crate::shell::{self, Outcome};
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// A program that the system's package manager installs.
pub struct Tool {
    /// Names of the executable. The first one that exists is used.
    pub programs: &'static [&'static str],
    /// Debian package that contains it.
    pub package: &'static str,
}

/// The browser of the end-to-end tests.
pub const CHROMIUM: Tool =
    Tool { programs: &["chromium", "chromium-browser", "google-chrome"], package: "chromium" };
/// An external broker.
pub const MOSQUITTO: Tool = Tool { programs: &["mosquitto"], package: "mosquitto" };
/// A broker that can form a cluster.
pub const RABBITMQ: Tool = Tool { programs: &["rabbitmq-server"], package: "rabbitmq-server" };

impl Tool {
    /// Path of the program, after installing it if necessary.
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
        apt_get(&["update", "-qq"]);
        let packages = ["install", "-y", "-qq", "--no-install-recommends", self.package];
        if !apt_get(&packages) {
            // If an earlier installation was interrupted, apt-get fails until dpkg has finished that installation.
            run_as_root("dpkg", &["--configure", "-a"]);
            apt_get(&packages);
        }
        // Debian starts a newly installed broker on the usual port. It is stopped, because tests need that port.
        if [MOSQUITTO.package, RABBITMQ.package].contains(&self.package) {
            let _ = as_root("service")
                .args([self.package, "stop"])
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status();
        }
    }
}

fn apt_get(arguments: &[&str]) -> bool {
    run_as_root("apt-get", arguments)
}

/// Runs a Debian program with root rights and without prompts. Returns whether it succeeded; a failure is printed.
fn run_as_root(program: &str, arguments: &[&str]) -> bool {
    let mut command = as_root(program);
    command.args(arguments).env("DEBIAN_FRONTEND", "noninteractive").stdout(Stdio::null());
    shell::run(&mut command).inspect_err(|message| eprintln!("xtask: {message}")).is_ok()
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
