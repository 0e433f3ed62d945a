//! Mosquitto, the broker most people have.

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
    /// Starts one on a free port of loopback; `None` where the tests were told to do without.
    pub fn start() -> Option<Self> {
        if std::env::var_os("LIGHTBOTS_NO_MOSQUITTO").is_some() {
            eprintln!("NOT TESTED: LIGHTBOTS_NO_MOSQUITTO is set");
            return None;
        }
        // Another program may take a port between its choice and its use.
        for _ in 0..10 {
            let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
            if let Some(child) = serve(port) {
                return Some(Self { child, port });
            }
        }
        panic!("mosquitto does not start on any of ten ports");
    }

    pub fn url(&self) -> String {
        format!("mqtt://127.0.0.1:{}", self.port)
    }

    /// Kills it and starts it again at the same address.
    pub fn restart(&mut self) {
        self.child.kill();
        self.child = wait_for("mosquitto to come back", || serve(self.port));
    }
}

/// A process that answers at that port, or `None` where it ended.
fn serve(port: u16) -> Option<Child> {
    let installed = Path::new("/usr/sbin/mosquitto");
    let program = if installed.exists() { installed } else { Path::new("mosquitto") };
    let found = Command::new(program).arg("-h").output().is_ok();
    assert!(
        found,
        "Mosquitto is missing: install it (apt-get install mosquitto), or set LIGHTBOTS_NO_MOSQUITTO"
    );
    let mut command = Command::new(program);
    command.args(["-p", &port.to_string()]);
    let mut child = Child::start(command, "mosquitto");
    wait_for("mosquitto", || {
        if child.exit_code().is_some() {
            return Some(false);
        }
        TcpStream::connect(("127.0.0.1", port)).is_ok().then_some(true)
    })
    .then_some(child)
}
