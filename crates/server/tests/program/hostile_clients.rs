//! Attacks of clients on the embedded broker and the web server, and their effect on other clients.

use std::io::Write;

use serde_json::json;

use crate::child::Child;
use crate::raw_mqtt::{RawMqtt, connect, packet, publish, text};
use crate::run::start;
#[cfg(target_os = "linux")]
use crate::run::start_by;
use crate::screen::Screen;
use crate::{alone, http, shows, wait_for};

/// Starts `lightbots broker` on a free port. Returns it with its address.
fn broker() -> (Child, String) {
    let mut broker = Child::lightbots(&["broker", "--mqtt-listen", "127.0.0.1:0"]);
    let address = broker.said("Broker mqtt://");
    (broker, address)
}

#[test]
fn topics_of_ten_thousand_levels_are_refused_and_the_broker_goes_on() {
    let (mut process, address) = broker();
    let deep = "/".repeat(10_000);
    let mut all = RawMqtt::open(&address, "all");
    assert!(all.subscribe("#"));
    let mut hostile = RawMqtt::open(&address, "hostile");
    assert!(!hostile.subscribe(&deep));
    assert!(!hostile.subscribe(&"x".repeat(600)));
    hostile.send(&packet(0xa2, &[&[0, 2][..], &text(&deep)].concat()));
    assert_eq!(hostile.read(4), [0xb0, 2, 0, 2]);
    hostile.send(&publish(&deep, b"x"));
    hostile.send(&publish("short", b"x"));
    assert_eq!(all.read(10), publish("short", b"x"), "the deep topic is not passed on");
    let mut with_will = RawMqtt::silent(&address);
    let will = [&text("MQTT")[..], &[4, 6, 0, 0], &text("will"), &text(&deep), &text("x")].concat();
    with_will.send(&packet(0x10, &will));
    assert_eq!(with_will.read(4), [0x20, 2, 0, 5]);
    assert!(hostile.is_answered() && process.exit_code().is_none());
}

#[test]
fn a_packet_longer_than_any_message_costs_the_connection() {
    let (mut process, address) = broker();
    let mut hostile = RawMqtt::open(&address, "hostile");
    // Only the head of a packet of 256 MB is sent: the broker must not wait for the rest.
    hostile.send(&[0x30, 0xff, 0xff, 0xff, 0x7f]);
    hostile.wait_for_close();
    process.complains("refused client hostile");
    assert!(RawMqtt::open(&address, "robot").is_answered());
}

/// Peak resident memory of a process, bytes.
#[cfg(target_os = "linux")]
fn peak_memory(process: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() << 10
}

#[cfg(target_os = "linux")]
#[test]
fn clients_that_do_not_read_cost_bounded_memory_and_no_other_clients_messages() {
    let (process, address) = broker();
    let mut slow: Vec<_> = (0..10).map(|number| RawMqtt::open(&address, &format!("slow-{number}"))).collect();
    assert!(slow.iter_mut().all(|client| client.subscribe("flood")));
    let mut robot = RawMqtt::open(&address, "LightBot/r1");
    assert!(robot.subscribe("T/LightBot/r1"));
    let mut hostile = RawMqtt::open(&address, "hostile");
    let message = publish("flood", &[b'x'; 60_000]);
    // 600 MB for each of the ten subscribers.
    for _ in 0..10_000 {
        hostile.send(&message);
    }
    assert!(hostile.is_answered(), "all of it was taken");
    let stop = publish("T/LightBot/r1", b"|STOP|");
    RawMqtt::open(&address, "BotControl/a").send(&stop);
    assert_eq!(robot.read(stop.len()), stop);
    let peak = peak_memory(process.id());
    assert!(peak < 300 << 20, "the broker took {} MiB", peak >> 20);
}

#[cfg(target_os = "linux")]
#[test]
fn connections_that_do_not_log_in_are_closed() {
    let (mut process, address) = broker();
    let silent = RawMqtt::silent(&address);
    let mut half = RawMqtt::silent(&address);
    half.send(&connect("half")[..9]);
    // More connections than may be without a login at the same time, so that the first of them are closed early.
    let crowd: Vec<_> = (0..700).map(|_| RawMqtt::silent(&address)).collect();
    let mut robot = RawMqtt::open(&address, "LightBot/r1");
    for client in [silent, half].into_iter().chain(crowd) {
        client.wait_for_close();
    }
    assert!(robot.is_answered(), "one that has logged in stays");
    process.complains("it did not log in");
}

#[cfg(target_os = "linux")]
#[test]
fn a_broker_that_dies_is_started_again_and_the_show_goes_on() {
    let _turn = alone();
    let (mut server, address, broker) = start(&["--robots", "4", &shows::row_file(4, &[0.1, 0.1, 0.1])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.until("the show", |screen| (screen.phase() == "playing").then_some(()));
    let children = server.children();
    assert_eq!(children.len(), 1);
    crate::child::kill(children[0]);
    let line = screen.wait_for_log("It is started again");
    assert!(line.contains("ended by signal 9"), "{line}");
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains("3 frames") && last.contains("0 dropouts"), "{last}");
    assert!(RawMqtt::open(&broker, "other").is_answered(), "it has the same address");
    server.terminate();
    assert_eq!(server.end(), 0);
}

#[cfg(target_os = "linux")]
#[test]
fn the_brokers_process_ends_with_the_program() {
    let (mut server, _, broker) = start(&["--robots", "0"]);
    assert_eq!(server.children().len(), 1);
    server.kill();
    wait_for("the end of the broker", || std::net::TcpStream::connect(&broker).is_err().then_some(()));
}

#[test]
fn a_broker_alone_is_refused_where_it_would_be_open_to_every_machine() {
    let (code, _, error) = crate::child::run(&["broker", "--mqtt-listen", "0.0.0.0:0"]);
    assert!(code == 2 && error.contains("--mqtt-user"), "{code} {error}");
    let (_process, address) = broker();
    let (code, _, error) = crate::child::run(&["run", "--listen", "127.0.0.1:0", "--mqtt-listen", &address]);
    assert!(code == 1 && error.contains("is taken"), "{code} {error}");
}

/// Sends the head of an upload of `length` bytes and its first byte.
fn begin_upload(address: &str, length: usize) -> std::net::TcpStream {
    let mut stream = std::net::TcpStream::connect(address).unwrap();
    let head = format!("POST /api/check HTTP/1.1\r\nHost: {address}\r\nContent-Length: {length}\r\n\r\n[");
    stream.write_all(head.as_bytes()).unwrap();
    stream
}

#[test]
fn uploads_that_never_end_do_not_keep_others_from_saving() {
    let (_server, address, _) = start(&["--robots", "0"]);
    let mut uploads: Vec<_> = (0..20).map(|_| begin_upload(&address, 60_000_000)).collect();
    uploads.extend((0..20).map(|_| begin_upload(&address, 1_000_000)));
    let show = shows::row(2, &[1.0]);
    let saved = http::request(&address, "PUT", "/api/shows/Saved%20meanwhile", &[], &show);
    assert_eq!(saved.status, 200, "{}", saved.body);
    let long = http::request(&address, "POST", "/api/check", &[("Content-Length", "70000000")], "");
    assert_eq!(long.status, 413, "{}", long.body);
    // An upload that breaks off is no show, and its memory is free again at once.
    drop(uploads);
    let padded = format!("{}{}", " ".repeat(40_000_000), show);
    assert_eq!(http::request(&address, "POST", "/api/check", &[], &padded).status, 200);
}

#[test]
fn a_robot_that_floods_is_cut_off_and_named_and_the_show_goes_on() {
    let _turn = alone();
    let (_server, address, broker) = start(&["--robots", "4", &shows::row_file(4, &[0.2, 0.2])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.until("the show", |screen| (screen.phase() == "playing").then_some(()));
    let mut hostile = RawMqtt::open(&broker, "LightBot/flood");
    let reports = publish("T/LightBot/UUID", b"flood 0.5 1.3").repeat(1_000);
    // The broker closes the connection during a write.
    while hostile.stream.write_all(&reports).is_ok() {}
    let line = screen.wait_for_log("is cut off");
    assert!(line.contains("LightBot/flood"), "{line}");
    let mut again = RawMqtt::silent(&broker);
    again.send(&connect("LightBot/flood"));
    assert_eq!(again.read(4), [0x20, 2, 0, 5]);
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains("2 frames") && last.contains("0 dropouts"), "{last}");
}

/// Opens more connections than the system allows the program. Open screens and robots must go on.
#[cfg(target_os = "linux")]
#[test]
fn a_flood_of_connections_to_the_web_app_is_named_and_the_show_goes_on() {
    let _turn = alone();
    let show = shows::row_file(4, &[0.2, 0.2]);
    let (mut server, address, broker) = start_by(&["prlimit", "--nofile=300:300"], &["--robots", "4", &show]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    let flood: Vec<_> = (0..400).map(|_| std::net::TcpStream::connect(&address).unwrap()).collect();
    let line = screen.wait_for_log("The web app has");
    assert!(line.contains("150 connections, the most it takes"), "{line}");
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains("2 frames") && last.contains("0 dropouts"), "{last}");
    assert!(RawMqtt::open(&broker, "LightBot/r1").is_answered());
    drop(flood);
    wait_for("room", || {
        let mut stream = std::net::TcpStream::connect(&address).unwrap();
        let head = format!("GET /api/shows HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
        let _ = stream.write_all(head.as_bytes());
        let mut answer = String::new();
        std::io::Read::read_to_string(&mut stream, &mut answer).ok()?;
        answer.starts_with("HTTP/1.1 200").then_some(())
    });
    server.terminate();
    assert_eq!(server.end(), 0);
}
