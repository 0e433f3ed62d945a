//! A Mosquitto broker in a child process.

use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::Command;

use crate::child::Child;
use crate::wait_for;

pub struct Mosquitto {
    child: Child,
    port: u16,
}

impl Mosquitto {
    /// Starts a broker on a free port of loopback. `None` if the tests are told to run without Mosquitto.
    pub fn start() -> Option<Self> {
        if is_unwanted() {
            return None;
        }
        // Another program may take a port after it was chosen, so several ports are tried.
        for _ in 0..10 {
            let port = free_port();
            if let Some(child) = serve(port) {
                return Some(Self { child, port });
            }
        }
        panic!("mosquitto does not start on any of ten ports");
    }

    /// Starts a broker with settings for `PORTS` free ports. The settings must listen on the first of them.
    pub fn with_settings<const PORTS: usize>(
        settings: impl Fn([u16; PORTS]) -> String,
    ) -> Option<(Self, [u16; PORTS])> {
        if is_unwanted() {
            return None;
        }
        for _ in 0..10 {
            let ports = std::array::from_fn(|_| free_port());
            let file = crate::shows::file("mosquitto.conf", settings(ports));
            if let Some(child) = answering(&["-c", &file], ports[0]) {
                return Some((Self { child, port: ports[0] }, ports));
            }
        }
        panic!("mosquitto does not start with these settings");
    }

    pub fn url(&self) -> String {
        format!("mqtt://127.0.0.1:{}", self.port)
    }

    /// Kills the broker and starts it again at the same address.
    pub fn restart(&mut self) {
        self.kill();
        self.start_again();
    }

    /// Sends it a signal, named by an option of `kill`.
    #[cfg(unix)]
    pub fn signal(&self, signal: &str) {
        self.child.signal(signal);
    }

    pub fn kill(&mut self) {
        self.child.kill();
    }

    /// Starts the broker at the same address after it was killed.
    pub fn start_again(&mut self) {
        self.child = wait_for("mosquitto to come back", || serve(self.port));
    }
}

/// A port on which no program listens at this moment.
pub fn free_port() -> u16 {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

fn is_unwanted() -> bool {
    let unwanted = std::env::var_os("LIGHTBOTS_NO_MOSQUITTO").is_some();
    if unwanted {
        eprintln!("NOT TESTED: LIGHTBOTS_NO_MOSQUITTO is set");
    }
    unwanted
}

/// Starts a broker at this port and waits until it answers. `None` if the process ended.
fn serve(port: u16) -> Option<Child> {
    answering(&["-p", &port.to_string()], port)
}

fn answering(arguments: &[&str], port: u16) -> Option<Child> {
    let installed = Path::new("/usr/sbin/mosquitto");
    let program = if installed.exists() { installed } else { Path::new("mosquitto") };
    let found = Command::new(program).arg("-h").output().is_ok();
    assert!(
        found,
        "Mosquitto is missing: install it (apt-get install mosquitto), or set LIGHTBOTS_NO_MOSQUITTO"
    );
    let mut command = Command::new(program);
    command.args(arguments);
    let mut child = Child::start(command, "mosquitto");
    wait_for("mosquitto", || {
        if child.exit_code().is_some() {
            return Some(false);
        }
        TcpStream::connect(("127.0.0.1", port)).is_ok().then_some(true)
    })
    .then_some(child)
}
