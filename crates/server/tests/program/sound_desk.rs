//! Sound desks, which send and receive real UDP packets of OSC.

use std::net::UdpSocket;
use std::time::Duration;

use rosc::{OscMessage, OscPacket, OscType};
use serde_json::{Value, json};

use crate::child::Child;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

/// A simulated sound desk with one socket to send and receive.
struct SoundDesk {
    socket: UdpSocket,
    heard: Vec<OscMessage>,
}

impl SoundDesk {
    fn new() -> Self {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        socket.set_read_timeout(Some(Duration::from_millis(50))).unwrap();
        Self { socket, heard: Vec::new() }
    }

    fn address(&self) -> String {
        self.socket.local_addr().unwrap().to_string()
    }

    fn press(&self, to: &str, addr: &str, value: f32) {
        let message = OscMessage { addr: addr.to_owned(), args: vec![OscType::Float(value)] };
        self.socket.send_to(&rosc::encoder::encode(&OscPacket::Message(message)).unwrap(), to).unwrap();
    }

    /// Waits until the desk receives this message.
    fn hears(&mut self, addr: &str, args: &[OscType]) {
        wait_for(addr, || {
            let mut bytes = [0; 1_500];
            if let Ok(length) = self.socket.recv(&mut bytes)
                && let Ok((_, OscPacket::Message(message))) = rosc::decoder::decode_udp(&bytes[..length])
            {
                self.heard.push(message);
            }
            let is_it = |message: &OscMessage| message.addr == addr && message.args.starts_with(args);
            self.heard.iter().any(is_it).then_some(())
        });
    }
}

/// Writes a show of three frames whose second one waits for GO. Returns its path.
fn show_file() -> String {
    let mut show: Value = serde_json::from_str(&shows::row(3, &[0.1, 0.1, 30.0])).unwrap();
    show["lightbots"] = json!(2);
    show["frames"][1]["id"] = json!("second");
    show["cues"] = json!([{"name": "Curtain", "frame": "second"}]);
    shows::file("osc.lightbots.json", show.to_string())
}

#[test]
fn a_sound_desk_hears_of_frames_and_gives_go_and_stop() {
    let _turn = alone();
    let mut desk = SoundDesk::new();
    let out = desk.address();
    let (mut server, address, _) =
        start(&["--robots", "3", "--osc=127.0.0.1:0", "--osc-out", &out, &show_file()]);
    let osc = server.said("OSC is received on ");
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(3);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    desk.hears("/lightbots/state", &[OscType::String("playing".to_owned())]);
    desk.hears("/lightbots/drive", &[OscType::Int(1)]);
    desk.hears("/lightbots/frame", &[OscType::Int(1)]);
    desk.hears("/lightbots/cue", &[OscType::Int(2), OscType::String("Curtain".to_owned())]);
    // The release of a button and packets that are not OSC have no effect.
    desk.press(&osc, "/lightbots/go", 0.0);
    for length in [0, 1, 7, 900] {
        desk.socket.send_to(&vec![b'/'; length], &osc).unwrap();
    }
    std::thread::sleep(Duration::from_secs(1));
    assert!(!desk.heard.iter().any(|message| message.args.first() == Some(&OscType::Int(3))));
    desk.press(&osc, "/lightbots/go", 1.0);
    desk.hears("/lightbots/frame", &[OscType::Int(3)]);
    screen.wait_for_log("GO came by OSC.");
    desk.press(&osc, "/lightbots/stop", 1.0);
    screen.wait_for_log("Stop came by OSC.");
    screen.until("the end of the run", |screen| (screen.phase() == "ready").then_some(()));
}

#[test]
fn an_address_that_is_taken_is_said_in_one_line() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let data = shows::own_folder();
    let mut child = Child::lightbots(&[
        "run",
        "--listen=127.0.0.1:0",
        "--mqtt-listen=127.0.0.1:0",
        "--data",
        data.to_str().unwrap(),
        &format!("--osc={address}"),
    ]);
    assert_ne!(child.end(), 0);
    assert!(child.err().contains(&format!("cannot receive OSC on {address}")), "{}", child.err());
    assert!(child.err().contains("choose another --osc"), "{}", child.err());
}
