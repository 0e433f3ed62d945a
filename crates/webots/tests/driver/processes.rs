//! The processes of a test, which are killed when it ends. Their output is shown if it fails.

use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longest wait of a test on a busy machine, reached only on failure.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// A process that is killed when the value is dropped.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Path of another program that cargo built for this workspace, in the folder above the test's own.
pub fn built(name: &str) -> PathBuf {
    let test = std::env::current_exe().expect("a test knows its own path");
    let folder = test.parent().and_then(Path::parent).expect("tests lie in deps");
    let place = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(place.is_file(), "{} is missing: run `cargo test --workspace`", place.display());
    place
}

/// Path of the stand-in for libController, beside this test.
pub fn stand_in() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows its own path");
    let name = format!("{}Controller{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let place = test.with_file_name(name);
    assert!(place.is_file(), "{} is missing", place.display());
    place
}

/// Starts a Mosquitto on loopback. Returns it with its port.
pub fn mosquitto() -> (Running, u16) {
    let program = std::env::var("LIGHTBOTS_MOSQUITTO").unwrap_or_else(|_| "mosquitto".into());
    let fallback = Path::new("/usr/sbin/mosquitto");
    let program =
        if program == "mosquitto" && fallback.is_file() { fallback.to_path_buf() } else { program.into() };
    for _ in 0..10 {
        let port = free_port();
        let child = Command::new(&program)
            .args(["-p", &port.to_string()])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("Mosquitto starts: install it, on Debian with `apt-get install mosquitto`");
        let mut running = Running(child);
        let deadline = Instant::now() + PATIENCE;
        while Instant::now() < deadline && running.0.try_wait().expect("a child can be asked").is_none() {
            if TcpStream::connect(("127.0.0.1", port)).is_ok() {
                return (running, port);
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }
    panic!("Mosquitto did not open its port");
}

/// A free port on loopback.
pub fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("loopback has a free port");
    listener.local_addr().expect("it is bound").port()
}
