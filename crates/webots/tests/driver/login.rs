//! Logins of a driver at a broker: TLS with a private authority, a user, and a password from a file.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::PoisonError;

use lightbots_base::Vec2;
use lightbots_show::Stage;

use crate::floor::Floor;
use crate::pace::Pace;
use crate::processes::{Running, built, free_port};
use crate::tape::Tape;
use crate::{TURN, driver, driver_command, ends_well, id, tempfile};

/// Starts `lightbots run` without robots, with TLS and new certificates in `folder`. Returns the process, its plain
/// address and its TLS address.
fn server(folder: &Path) -> (Running, String, String) {
    let certs = Command::new(built("lightbots")).args(["certs", "--out"]).arg(folder).output();
    assert!(certs.is_ok_and(|output| output.status.success()));
    let mut command = Command::new(built("lightbots"));
    let any = "127.0.0.1:0";
    command.args(["run", "--robots", "0", "--listen", any, "--mqtt-listen", any, "--mqtt-tls-listen", any]);
    command.arg("--data").arg(folder).arg("--cert").arg(folder.join("server.pem"));
    let mut child = command
        .arg("--key")
        .arg(folder.join("server.key"))
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines().map_while(Result::ok);
    let running = Running(child);
    let mut said = |before: &str| {
        let line = lines.find(|line| line.starts_with(before)).expect("it says where");
        line[before.len()..].split([',', ' ']).next().unwrap_or_default().to_owned()
    };
    let plain = said("Broker ");
    let safe = said("Broker with TLS ");
    (running, plain, safe)
}

#[test]
fn a_driver_believes_the_authority_it_is_told_and_logs_in() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile("login");
    let (_server, plain, safe) = server(&folder);
    std::fs::write(folder.join("password"), "default\n").expect("the folder can be written");
    let socket = folder.join("floor");
    let floor = Floor::open(&socket, &Stage::default(), &[Vec2::ZERO], 1, (Pace::WEBOTS, 1));
    let tape = Tape::record(&plain);
    let file = |name: &str| folder.join(name).display().to_string();
    let login =
        ["--broker-user", "default", "--broker-password-file", &file("password"), "--ca", &file("ca.pem")];
    let mut driver = driver(1, &safe, &socket, &login);
    tape.wait_for(id(1));
    floor.close();
    ends_well(&mut driver);
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn a_driver_says_which_broker_it_cannot_reach() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile("nobody");
    let socket = folder.join("floor");
    let floor = Floor::open(&socket, &Stage::default(), &[Vec2::ZERO], 1, (Pace::WEBOTS, 1));
    let nothing = format!("127.0.0.1:{}", free_port());
    let mut command = driver_command(1, &format!("mqtt://{nothing}"), &socket);
    let mut child = command.stderr(Stdio::piped()).spawn().expect("the driver starts");
    let lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let mut running = Running(child);
    let line = lines.map_while(Result::ok).find(|line| line.contains(&nothing));
    assert!(line.is_some_and(|line| line.starts_with("LightBotFirmware: no broker answers at")));
    floor.close();
    ends_well(&mut running);
    let _ = std::fs::remove_dir_all(&folder);
}
