//! Whole shows through the real driver: one process a robot on the stand-in, as Webots does it, with a real broker and
//! the real controller.

mod floor;
mod processes;

use std::process::{Command, Stdio};

use floor::{Account, Floor};
use lightbots_show::Show;
use processes::{Running, built, mosquitto, stand_in};

/// Plays a show of `shows/` with as many drivers as it has pixels; what the controller reported and the floor saw.
fn play(file: &str) -> (Show, serde_json::Value, Account) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shows/").to_owned() + file;
    let bytes = std::fs::read(&path).expect("the show is there");
    let show = lightbots_show::read(&bytes, Some("json")).expect("the show can be read").show;
    let count = show.frames[0].pixels.len();
    let starts = lightbots_show::front_rows(&show.stage, count);
    let folder = tempfile(file);
    let socket = folder.join("floor");
    let floor = Floor::open(&socket, &show.stage, &starts, 1);
    let (_broker, port) = mosquitto();
    let broker = format!("mqtt://127.0.0.1:{port}");
    let library = stand_in();
    let drivers: Vec<Running> = (1..=count)
        .map(|number| {
            let child = Command::new(env!("CARGO_BIN_EXE_LightBotFirmware"))
                .args(["--broker", &broker])
                .env("WEBOTS_ROBOT_NAME", format!("LightBot {number}"))
                .env("LIGHTBOTS_STANDIN", &socket)
                .env("LD_LIBRARY_PATH", library.parent().expect("it lies in a folder"))
                .spawn()
                .expect("the driver starts");
            Running(child)
        })
        .collect();
    let output = Command::new(built("lightbots"))
        .args(["play", &path, "--broker", &broker, "--wait", &count.to_string(), "--json"])
        .stderr(Stdio::inherit())
        .output()
        .expect("the controller starts");
    let account = floor.close();
    for mut driver in drivers {
        let status = driver.0.wait().expect("a child can be waited for");
        assert!(status.success(), "a driver did not end well: {status}");
    }
    let _ = std::fs::remove_dir_all(&folder);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let report = serde_json::from_str(&text).unwrap_or_else(|error| panic!("no report ({error}): {text}"));
    (show, report, account)
}

fn tempfile(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("lightbots-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
    folder
}

fn plays_without_contact(file: &str) {
    let (show, report, account) = play(file);
    assert_eq!(report["ok"], true, "{report:#}\n{account:?}");
    assert_eq!(report["frames_played"], show.frames.len(), "{report:#}");
    assert_eq!(account.contacts, 0, "{account:?}");
    assert!(account.closest_m.is_some_and(|closest_m| closest_m > 0.054), "{account:?}");
    let last = show.frames.last().expect("a show has frames");
    for pixel in &last.pixels {
        let nearest = account.places.iter().map(|at| at.distance(pixel.at)).fold(f64::INFINITY, f64::min);
        assert!(nearest <= 0.02, "nobody stands on pixel {}: {nearest} m", pixel.id);
    }
    assert!(account.colours.iter().any(|colour| *colour != 0), "no light is on");
}

#[test]
fn thirty_processes_play_a_show() {
    plays_without_contact("heart.lightbots.json");
}
