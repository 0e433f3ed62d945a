//! Brokers for measurements: processes on free ports of loopback.
// Each example uses only a part of this module.
#![allow(dead_code)]

use std::error::Error;
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use lightbots_link::BrokerUrl;

/// Result of a step. Any error ends the measurement.
pub type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// A running broker. Dropping it ends the process.
pub struct Broker {
    child: Child,
    /// Address of the broker.
    pub url: BrokerUrl,
    folder: PathBuf,
}

impl Drop for Broker {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

impl Broker {
    /// Process id of the broker.
    pub fn process(&self) -> u32 {
        self.child.id()
    }
}

/// Path of the program `lightbots`, which cargo built beside this example. An error if it is missing.
pub fn program() -> Outcome<PathBuf> {
    let here = std::env::current_exe()?;
    let program = here.parent().and_then(Path::parent).ok_or("no folder")?.join("lightbots");
    if !program.is_file() {
        return Err(format!("{} is missing: build lightbots-server first", program.display()).into());
    }
    Ok(program)
}

/// Starts the embedded broker alone: `lightbots broker`.
pub fn embedded() -> Outcome<Broker> {
    let program = program()?;
    start("embedded", |port, _| {
        let mut command = Command::new(&program);
        command.args(["broker", "--mqtt-listen", &format!("127.0.0.1:{port}")]);
        Ok(command)
    })
}

/// Starts Mosquitto without its limits on queued and unacknowledged messages.
pub fn mosquitto() -> Outcome<Broker> {
    let program = std::env::var("LIGHTBOTS_MOSQUITTO").unwrap_or_else(|_| "mosquitto".into());
    start("mosquitto", |port, folder| {
        let settings = folder.join("mosquitto.conf");
        let text = format!(
            "listener {port} 127.0.0.1\nallow_anonymous true\nset_tcp_nodelay true\nmax_queued_messages 0\n\
             max_inflight_messages 0\n"
        );
        std::fs::write(&settings, text)?;
        let mut command = Command::new(&program);
        command.arg("-c").arg(settings);
        Ok(command)
    })
}

/// Starts a broker on a free port and waits until it listens.
fn start(name: &str, command: impl Fn(u16, &Path) -> Outcome<Command>) -> Outcome<Broker> {
    let port = TcpListener::bind("127.0.0.1:0")?.local_addr()?.port();
    let folder = std::env::temp_dir().join(format!("lightbots-round-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let child = command(port, &folder)?.stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
    let broker = Broker { child, url: BrokerUrl::new("127.0.0.1", port), folder };
    for _ in 0..500 {
        if TcpStream::connect(("127.0.0.1", port)).is_ok() {
            return Ok(broker);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    Err(format!("{name} did not open its port").into())
}
