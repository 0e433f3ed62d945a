//! Lighting desks that send real UDP packets of Art-Net and sACN, and robots on a real broker.

use std::net::UdpSocket;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbots_base::{Rgb, RobotId, Vec2};
use lightbots_show::Stage;
use lightbots_sim::{Conditions, Fleet, FleetConfig};
use serde_json::json;

use crate::child::Child;
use crate::plain_mqtt::Mqtt;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

const RED: Rgb = Rgb::new(255, 0, 0);
const TEAL: Rgb = Rgb::new(0, 128, 129);

/// A simulated desk that sends packets.
struct LightingDesk {
    socket: UdpSocket,
    to: String,
    sequence: u8,
}

impl LightingDesk {
    fn new(to: &str) -> Self {
        Self { socket: UdpSocket::bind("127.0.0.1:0").unwrap(), to: to.to_owned(), sequence: 0 }
    }

    fn send(&self, bytes: &[u8]) {
        // A full send queue of the system is no error, because packets are repeated.
        let _ = self.socket.send_to(bytes, &self.to);
    }

    /// Sends an `ArtDmx` packet.
    fn art_net(&mut self, universe: u16, colours: &[Rgb]) {
        self.sequence = self.sequence.wrapping_add(1).max(1);
        let values = channels(colours);
        let mut bytes = b"Art-Net\0\x00\x50\x00\x0e".to_vec();
        bytes.extend([self.sequence, 0]);
        bytes.extend(universe.to_le_bytes());
        bytes.extend((values.len() as u16).to_be_bytes());
        bytes.extend(values);
        self.send(&bytes);
    }

    /// Sends a data packet of E1.31; an option of 0x40 ends the stream.
    fn sacn(&mut self, universe: u16, (priority, option): (u8, u8), colours: &[Rgb]) {
        self.sequence = self.sequence.wrapping_add(1);
        let values = channels(colours);
        let length = |from: usize| (0x7000 | (126 + values.len() - from) as u16).to_be_bytes();
        let mut bytes = b"\x00\x10\x00\x00ASC-E1.17\x00\x00\x00".to_vec();
        bytes.extend(length(16));
        bytes.extend([0, 0, 0, 4]);
        bytes.extend([42; 16]);
        bytes.extend(length(38));
        bytes.extend([0, 0, 0, 2]);
        bytes.extend([0; 64]);
        bytes.extend([priority, 0, 0, self.sequence, option]);
        bytes.extend(universe.to_be_bytes());
        bytes.extend(length(115));
        bytes.extend([2, 0xa1, 0, 0, 0, 1]);
        bytes.extend((values.len() as u16 + 1).to_be_bytes());
        bytes.push(0);
        bytes.extend(values);
        self.send(&bytes);
    }
}

/// Channel values of these colours, cut after 512 channels.
fn channels(colours: &[Rgb]) -> Vec<u8> {
    colours.iter().flat_map(|colour| [colour.r, colour.g, colour.b]).take(512).collect()
}

/// Our robots on the broker, with the colours of their lamps.
struct Lamps {
    lights: Arc<Mutex<Vec<(RobotId, Rgb)>>>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Lamps {
    fn start(broker: &str, robots: usize) -> Self {
        let starts = (0..robots).map(|robot| Vec2::new(0.1 * robot as f64, 1.3)).collect();
        let conditions = Conditions::default();
        let mut fleet = Fleet::new(&FleetConfig { stage: Stage::default(), starts, seed: 9, conditions });
        let mut topics = vec!["T/LightBot/Broadcast".to_owned()];
        topics.extend(fleet.ids().iter().map(|id| format!("T/LightBot/{id}")));
        let topics: Vec<&str> = topics.iter().map(String::as_str).collect();
        let mut mqtt = Mqtt::open(broker, "lamps", &topics);
        let (lights, stop) = (Arc::new(Mutex::new(Vec::new())), Arc::new(AtomicBool::new(false)));
        let (shown, wanted) = (lights.clone(), stop.clone());
        let thread = std::thread::spawn(move || {
            let began = Instant::now();
            let now = || lightbots_base::Instant(began.elapsed().as_micros() as u64);
            fleet.link(now(), true);
            while !wanted.load(Ordering::Relaxed) {
                while let Some((topic, payload)) = mqtt.next() {
                    fleet.receive(now(), &topic, payload.as_bytes());
                }
                fleet.advance(now());
                while let Some(message) = fleet.next_message() {
                    mqtt.publish(&message.topic.write(), message.payload);
                }
                let mut seen: Vec<_> = fleet.ids().into_iter().zip(fleet.lights()).collect();
                seen.sort();
                *shown.lock().unwrap() = seen;
                std::thread::sleep(Duration::from_millis(8));
            }
        });
        Self { lights, stop, thread: Some(thread) }
    }

    /// Colours of the lamps in the order of the robots' names.
    fn colours(&self) -> Vec<Rgb> {
        self.lights.lock().unwrap().iter().map(|(_, light)| *light).collect()
    }

    /// Calls `send` every 40 ms until the lamps show these colours. Returns how long that took.
    fn until(&self, what: &str, expected: &[Rgb], mut send: impl FnMut()) -> Duration {
        let began = Instant::now();
        let mut due = began;
        wait_for(what, || {
            if Instant::now() >= due {
                due += Duration::from_millis(40);
                send();
            }
            (self.colours() == expected).then(|| began.elapsed())
        })
    }
}

impl Drop for Lamps {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[test]
fn packets_on_the_wire_light_robots_and_silence_gives_the_light_back() {
    let _turn = alone();
    let patch = shows::file("patch", "others 1\n2 7 510 # the third robot\n");
    let options = ["--robots", "0", "--artnet=127.0.0.1:0", "--sacn=127.0.0.1:0", "--patch", &patch];
    let (mut server, address, broker) = start(&options);
    let mut art_net = LightingDesk::new(&server.said("Art-Net is received on "));
    let mut sacn = LightingDesk::new(&server.said("sACN is received on "));
    let lamps = Lamps::start(&broker, 4);
    let row = [RED, TEAL, RED, RED];
    let both = [RED, TEAL, Rgb::BLACK, RED];
    lamps.until("Art-Net on the lamps", &both, || art_net.art_net(1, &row));
    // A full universe of 512 channels. The third robot has the last three.
    let mut whole: Vec<Rgb> = (0..171).map(|_| Rgb::BLACK).collect();
    (whole[169], whole[170]) = (Rgb::new(9, 9, 1), Rgb::new(2, 3, 0));
    let expected = [RED, TEAL, Rgb::new(1, 2, 3), RED];
    lamps.until("sACN on the third lamp", &expected, || {
        art_net.art_net(1, &row);
        sacn.sacn(7, (100, 0), &whole);
    });
    // A source of higher priority takes the universe over, and invalid packets change nothing.
    let strangers: Vec<Vec<u8>> = (0..60usize).map(|n| vec![n as u8; n * 12]).collect();
    lamps.until("the higher priority", &[TEAL, RED, Rgb::BLACK, TEAL], || {
        strangers.iter().for_each(|bytes| [&art_net, &sacn].iter().for_each(|desk| desk.send(bytes)));
        art_net.art_net(1, &row);
        sacn.sacn(1, (101, 0), &[TEAL, RED, TEAL, TEAL]);
    });
    let passed = lamps.until("Art-Net again, after silence", &both, || art_net.art_net(1, &row));
    assert!(passed >= Duration::from_millis(2_300), "after {passed:?}");
    lamps.until("sACN once more", &[TEAL, TEAL, Rgb::BLACK, TEAL], || sacn.sacn(1, (101, 0), &[TEAL; 4]));
    // The desk still sends packets, so the source does not end by silence.
    lamps.until("the end of the stream", &both, || {
        art_net.art_net(1, &row);
        sacn.sacn(1, (101, 0x40), &[TEAL; 4]);
    });
    let silent = Instant::now();
    let mut screen = Screen::open(&address);
    screen.wait_for_log("A lighting desk drives the lights of");
    lamps.until("their own lights", &[Rgb::BLACK; 4], || {});
    let passed = silent.elapsed();
    assert!(
        passed >= Duration::from_millis(9_000),
        "Art-Net sends again every 4 s, but ended after {passed:?}"
    );
    screen.wait_for_log("The lighting desk sends no more");
}

#[test]
fn a_desk_has_the_lights_that_it_sends_while_a_show_plays_and_screens_show_them() {
    let _turn = alone();
    let show = shows::row_file(4, &[60.0]);
    let (mut server, address, _) = start(&["--robots", "4", "--sacn=127.0.0.1:0", &show]);
    let mut sacn = LightingDesk::new(&server.said("sACN is received on "));
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.wait_for_log("Frame 1 stands");
    let (orange, teal) = (0xff_8000, TEAL.number());
    let lit = |screen: &Screen| -> (usize, usize) {
        let colours = screen.get("robots")["colour"].as_array().cloned().unwrap_or_default();
        let count = |wanted: u32| colours.iter().filter(|colour| **colour == json!(wanted)).count();
        (count(orange), count(teal))
    };
    screen.until("the show's light", |screen| (lit(screen) == (4, 0)).then_some(()));
    screen.until("three lights of the desk", |screen| {
        sacn.sacn(1, (100, 0), &[TEAL; 3]);
        (lit(screen) == (1, 3)).then_some(())
    });
    screen.until("the show's light again", |screen| (lit(screen) == (4, 0)).then_some(()));
}

#[test]
fn what_is_wrong_with_a_desk_is_said_in_one_line() {
    let wrong = |options: &[&str], says: &[&str]| {
        let data = shows::own_folder();
        let all = [
            &["run", "--listen=127.0.0.1:0", "--mqtt-listen=127.0.0.1:0", "--data"][..],
            &[data.to_str().unwrap()],
            options,
        ];
        let mut child = Child::lightbots(&all.concat());
        assert_ne!(child.end(), 0);
        for part in says {
            assert!(child.err().contains(part), "{part}: {}", child.err());
        }
    };
    let patch = shows::file("wrong-patch", "r1 1 1\nr2 1 511\n");
    wrong(&["--sacn=127.0.0.1:0", "--patch", &patch], &["wrong-patch, line 2: channel 511: choose 1 to 510"]);
    wrong(&["--artnet=127.0.0.1:0", "--patch", "/nowhere"], &["/nowhere cannot be read"]);
    let good = shows::file("patch", "others 1");
    wrong(&["--patch", &good], &["--patch is for lighting desks: add --artnet or --sacn"]);
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap();
    wrong(&[&format!("--artnet={address}")], &["cannot receive Art-Net on", "choose another --artnet"]);
}
